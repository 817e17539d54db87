#include <libmesh/stream/row_file.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

struct keyed_row {
    std::uint64_t first;
    std::uint32_t number;
};

std::size_t bytes_of_each(std::uint64_t memory, std::size_t files) {
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(memory / (files + 1), 4096, std::size_t{1} << 20));
}

}  // namespace

row_merge::row_merge(std::vector<row_reader> readers, std::size_t keys)
    : readers_(std::move(readers)), keys_(keys) {
    for (std::size_t i = 0; i < readers_.size(); ++i)
        if (!readers_[i].empty()) heap_.push_back(i);
    std::make_heap(heap_.begin(), heap_.end(),
                   [this](std::size_t a, std::size_t b) { return after(a, b); });
}

bool row_merge::after(std::size_t a, std::size_t b) const {
    const numbers x = readers_[a].front();
    const numbers y = readers_[b].front();
    for (std::size_t k = 0; k < keys_; ++k)
        if (x[k] != y[k]) return x[k] > y[k];
    return a > b;
}

void row_merge::pop() {
    const auto later = [this](std::size_t a, std::size_t b) { return after(a, b); };
    row_reader& first = readers_[heap_.front()];
    if (heap_.size() == 1) {
        first.pop();
        if (first.empty()) heap_.clear();
        return;
    }
    std::pop_heap(heap_.begin(), heap_.end(), later);
    first.pop();
    if (first.empty())
        heap_.pop_back();
    else
        std::push_heap(heap_.begin(), heap_.end(), later);
}

row_sorter::row_sorter(const work_folder& folder, std::string name, shape size,
                       std::uint64_t memory)
    : folder_(folder), name_(std::move(name)), shape_(size), memory_(memory) {
    const std::uint64_t row_bytes = 8 * size.width + sizeof(keyed_row);
    const std::uint64_t rows = std::clamp<std::uint64_t>(memory / row_bytes, 64, 1U << 30);
    most_ = static_cast<std::size_t>(rows) * size.width;
}

row_sorter::~row_sorter() {
    std::error_code ignored;
    for (std::size_t i = 0; i < pieces_.size(); ++i) std::filesystem::remove(path(i), ignored);
}

std::filesystem::path row_sorter::path(std::size_t i) const {
    return folder_.file(name_ + "." + std::to_string(i));
}

void row_sorter::write_held() {
    const std::size_t width = shape_.width;
    std::vector<keyed_row> order(held_.size() / width);
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = {held_[i * width], static_cast<std::uint32_t>(i)};
    const auto before = [&](const keyed_row& a, const keyed_row& b) {
        if (a.first != b.first) return a.first < b.first;
        for (std::size_t k = 1; k < shape_.keys; ++k) {
            const std::uint64_t x = held_[a.number * width + k];
            const std::uint64_t y = held_[b.number * width + k];
            if (x != y) return x < y;
        }
        return a.number < b.number;
    };
    if (!std::is_sorted(order.begin(), order.end(), before))
        std::sort(order.begin(), order.end(), before);
    row_writer writer(path(pieces_.size()), std::size_t{1} << 18);
    for (const keyed_row& r : order)
        writer.put(numbers(held_).subspan(std::size_t{r.number} * width, width));
    pieces_.push_back(writer.finish_unsynced());
    held_.clear();
}

row_merge row_sorter::sorted() {
    if (!held_.empty()) write_held();
    held_ = {};
    const std::uint64_t share = memory_ / (pieces_.size() + 1);
    const auto bytes =
        static_cast<std::size_t>(std::clamp<std::uint64_t>(share, 4096, std::size_t{1} << 20));
    std::vector<row_reader> readers;
    readers.reserve(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        readers.emplace_back(path(i), pieces_[i], shape_.width, bytes);
    return {std::move(readers), shape_.keys};
}

all_to_all::all_to_all(const work_folder& folder, const communicator& all, std::string name,
                       std::size_t width, std::uint64_t memory)
    : folder_(folder), all_(all), name_(std::move(name)), width_(width), memory_(memory) {
    to_.reserve(all.size());
    for (std::size_t r = 0; r < all.size(); ++r)
        to_.emplace_back(path(all.rank(), r), bytes_of_each(memory, all.size()));
}

std::filesystem::path all_to_all::path(std::size_t from, std::size_t to) const {
    return folder_.file(name_ + ".post." + std::to_string(from) + "." + std::to_string(to));
}

void all_to_all::send() {
    state_writer mine;
    for (row_writer& one : to_) store_count(one.finish_unsynced(), mine);
    to_.clear();
    for (state_reader& one : all_.exchange(mine)) {
        std::vector<record_count>& counts = counts_.emplace_back();
        for (std::size_t r = 0; r < all_.size(); ++r) counts.push_back(load_count(one));
    }
}

void all_to_all::add_received(std::size_t by, std::vector<row_reader>& readers) const {
    for (std::size_t from = 0; from < counts_.size(); ++from)
        if (counts_[from][by].records > 0)
            readers.emplace_back(path(from, by), counts_[from][by], width_,
                                 bytes_of_each(memory_, counts_.size()));
}

std::vector<row_reader> all_to_all::received() const {
    std::vector<row_reader> readers;
    add_received(all_.rank(), readers);
    return readers;
}

std::vector<row_reader> all_to_all::received_by_all() const {
    std::vector<row_reader> readers;
    for (std::size_t r = 0; r < counts_.size(); ++r) add_received(r, readers);
    return readers;
}

std::uint64_t all_to_all::rows_before() const {
    std::uint64_t sum = 0;
    for (const std::vector<record_count>& from : counts_)
        for (std::size_t r = 0; r < all_.rank(); ++r) sum += from[r].records;
    return sum / width_;
}

void all_to_all::remove_received() const {
    for (std::size_t from = 0; from < counts_.size(); ++from)
        std::filesystem::remove(path(from, all_.rank()));
}

shared_sorter::shared_sorter(const work_folder& folder, const communicator& all,
                             const std::string& name, row_sorter::shape size, std::uint64_t memory)
    : sorter_(folder, name + "." + std::to_string(all.rank()), size, memory) {
    if (!all.is_alone()) exchanged_.emplace(folder, all, name, size.width, memory / 2);
}

row_merge shared_sorter::sorted() {
    if (exchanged_) {
        exchanged_->send();
        for (row_reader& from : exchanged_->received())
            for (; !from.empty(); from.pop()) sorter_.put(from.front());
        exchanged_->remove_received();
        exchanged_.reset();
    }
    return sorter_.sorted();
}

}  // namespace treeform::detail::stream
