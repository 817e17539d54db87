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

}  // namespace treeform::detail::stream
