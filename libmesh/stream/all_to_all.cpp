#include <libmesh/stream/all_to_all.hpp>

#include <algorithm>
#include <utility>

namespace treeform::detail::stream {
namespace {

std::size_t bytes_of_each(std::uint64_t memory, std::size_t files) {
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(memory / (files + 1), 4096, std::size_t{1} << 20));
}

}  // namespace

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
