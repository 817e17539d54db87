#include <libmesh/laz/entropy.hpp>

#include <algorithm>

namespace treeform::detail::laz {

void bit_model::update() {
    count_ += cycle_;
    if (count_ > 1u << scale) {
        count_ = (count_ + 1) >> 1;
        zero_count_ = (zero_count_ + 1) >> 1;
        if (zero_count_ == count_) ++count_;
    }
    zeros_ = (zero_count_ * (0x80000000u / count_)) >> (31 - scale);
    cycle_ = std::min((5 * cycle_) >> 2, 64u);
    left_ = cycle_;
}

void symbol_model::start() {
    if (symbols_ > 16) {
        table_bits_ = 3;
        while (symbols_ > 1u << (table_bits_ + 2)) ++table_bits_;
    }
    const std::size_t table = table_bits_ == 0 ? 0 : (std::size_t{1} << table_bits_) + 1;
    numbers_.assign(2 * symbols_ + table, 0);
    std::fill_n(numbers_.begin() + symbols_, symbols_, std::uint16_t{1});
    cycle_ = symbols_;
    update();
    cycle_ = (symbols_ + 6) >> 1;
    left_ = cycle_;
}

void symbol_model::update() {
    std::uint16_t* const below = numbers_.data();
    std::uint16_t* const count = below + symbols_;
    total_ += cycle_;
    if (total_ > 1u << scale) {
        total_ = 0;
        for (unsigned s = 0; s < symbols_; ++s) {
            count[s] = static_cast<std::uint16_t>((count[s] + 1) >> 1);
            total_ += count[s];
        }
    }
    const std::uint32_t unit = 0x80000000u / total_;
    std::uint32_t sum = 0;
    for (unsigned s = 0; s < symbols_; ++s) {
        below[s] = static_cast<std::uint16_t>((unit * sum) >> (31 - scale));
        sum += count[s];
    }
    if (table_bits_ > 0) {
        std::uint16_t* const first = count + symbols_;
        const unsigned shift = scale - table_bits_;
        unsigned s = 0;
        for (std::uint32_t high = 0; high < 1u << table_bits_; ++high) {
            while (s + 1 < symbols_ && below[s + 1] <= high << shift) ++s;
            first[high] = static_cast<std::uint16_t>(s);
        }
        first[std::size_t{1} << table_bits_] = static_cast<std::uint16_t>(symbols_ - 1);
    }
    cycle_ = std::min((5 * cycle_) >> 2, (symbols_ + 6) << 3);
    left_ = cycle_;
}

unsigned symbol_model::at(std::uint32_t place) const {
    unsigned low = 0;
    unsigned high = symbols_;  // the symbol is in [low, high)
    if (table_bits_ > 0) {
        const std::uint16_t* const first = numbers_.data() + 2 * symbols_;
        const std::uint32_t index = place >> (scale - table_bits_);
        low = first[index];
        high = first[index + 1] + 1u;
    }
    while (low + 1 < high) {
        const unsigned middle = (low + high) >> 1;
        (numbers_[middle] > place ? high : low) = middle;
    }
    return low;
}

decoder::decoder(std::span<const std::uint8_t> bytes)
    : at_(bytes.data()), end_(bytes.data() + bytes.size()) {
    if (bytes.size() < 4) throw damaged("compressed data end too early");
    for (int i = 0; i < 4; ++i) value_ = value_ << 8 | *at_++;
}

void decoder::shift() {
    do {
        if (at_ == end_) throw damaged("compressed data end too early");
        value_ = value_ << 8 | *at_++;
        length_ <<= 8;
    } while (length_ < least_length);
}

std::uint32_t decoder::symbol(symbol_model& model, std::uint32_t) {
    model.need();
    const std::uint32_t unit = length_ >> symbol_model::scale;
    // Damaged bytes can put the value behind the interval.
    const unsigned s = model.at(std::min(value_ / unit, (1u << symbol_model::scale) - 1));
    const std::uint32_t low = model.below(s) * unit;
    const std::uint32_t high = s == model.last() ? length_ : model.below(s + 1) * unit;
    value_ -= low;
    length_ = high - low;
    if (length_ < least_length) shift();
    model.saw(s);
    return s;
}

std::uint32_t decoder::bit(bit_model& model, std::uint32_t) {
    const std::uint32_t zeros = model.zeros() * (length_ >> bit_model::scale);
    const bool one = value_ >= zeros;
    if (one) {
        value_ -= zeros;
        length_ -= zeros;
    } else {
        length_ = zeros;
    }
    if (length_ < least_length) shift();
    model.saw(one);
    return one ? 1 : 0;
}

std::uint32_t decoder::few_bits(unsigned count) {
    length_ >>= count;
    const std::uint32_t read = value_ / length_;
    if (read >> count != 0) throw damaged("compressed data are damaged");
    value_ -= length_ * read;
    if (length_ < least_length) shift();
    return read;
}

std::uint32_t decoder::bits(unsigned count, std::uint32_t) {
    if (count <= 19) return few_bits(count);
    const std::uint32_t low = few_bits(16);
    return few_bits(count - 16) << 16 | low;
}

void encoder::add(std::uint32_t to_base) {
    const std::uint32_t before = base_;
    base_ += to_base;
    if (base_ >= before) return;
    std::size_t i = bytes_.size();  // a carry never goes beyond the first byte
    while (bytes_[--i] == 0xff) bytes_[i] = 0;
    ++bytes_[i];
}

void encoder::shift() {
    do {
        bytes_.push_back(static_cast<std::uint8_t>(base_ >> 24));
        base_ <<= 8;
        length_ <<= 8;
    } while (length_ < least_length);
}

std::uint32_t encoder::symbol(symbol_model& model, std::uint32_t value) {
    model.need();
    const std::uint32_t unit = length_ >> symbol_model::scale;
    const std::uint32_t low = model.below(value) * unit;
    const std::uint32_t high = value == model.last() ? length_ : model.below(value + 1) * unit;
    add(low);
    length_ = high - low;
    if (length_ < least_length) shift();
    model.saw(value);
    return value;
}

std::uint32_t encoder::bit(bit_model& model, std::uint32_t value) {
    const std::uint32_t zeros = model.zeros() * (length_ >> bit_model::scale);
    if (value == 0) {
        length_ = zeros;
    } else {
        add(zeros);
        length_ -= zeros;
    }
    if (length_ < least_length) shift();
    model.saw(value != 0);
    return value;
}

void encoder::few_bits(unsigned count, std::uint32_t value) {
    length_ >>= count;
    add(value * length_);
    if (length_ < least_length) shift();
}

std::uint32_t encoder::bits(unsigned count, std::uint32_t value) {
    if (count > 19) {
        few_bits(16, value & 0xffffu);
        few_bits(count - 16, value >> 16);
    } else {
        few_bits(count, value);
    }
    return value;
}

std::vector<std::uint8_t> encoder::finish() {
    // Any number in the interval will do: one whose last bytes are zero. The decoder is always four
    // bytes ahead, so these follow.
    const bool wide = length_ > 2 * least_length;
    add(wide ? least_length : least_length >> 1);
    length_ = wide ? least_length >> 1 : least_length >> 9;
    shift();
    bytes_.insert(bytes_.end(), wide ? 3 : 2, std::uint8_t{0});
    return std::move(bytes_);
}

}  // namespace treeform::detail::laz
