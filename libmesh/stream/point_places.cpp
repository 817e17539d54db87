#include <libmesh/stream/point_places.hpp>
#include <libmesh/stream/record_file.hpp>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t held_at_most = std::size_t{1} << 26;  ///< bytes, while points are put

}  // namespace

void placed_points::put(points_view points) {
    std::memcpy(file_->data() + size_, points.data(), points.size_bytes());
    size_ += points.size_bytes();
    if ((held_ += points.size_bytes()) < held_at_most) return;
    file_->release_memory();
    held_ = 0;
}

point3 placed_points::at(std::uint32_t point) {
    if (budget_.is_spent()) file_->release_memory();
    point3 p;
    std::memcpy(&p, file_->data() + point * sizeof p, sizeof p);
    return p;
}

shared_points::shared_points(const work_folder& folder, const communicator& all, std::size_t count,
                             std::uint64_t memory)
    : folder_(folder), rank_(all.rank()), budget_(memory) {
    for (std::size_t r = 0; r <= all.size(); ++r)
        firsts_.push_back(io::file_part{r, all.size()}.first(count));
    std::filesystem::remove(path(folder_, rank_));
    append_to(path(folder_, rank_), {});
}

std::filesystem::path shared_points::path(const work_folder& folder, std::size_t part) {
    return folder.file("points." + std::to_string(part));
}

void shared_points::put(points_view points) {
    append_to(path(folder_, rank_), std::as_bytes(points));
}

point3 shared_points::at(std::uint32_t point) {
    if (parts_.empty())
        for (std::size_t part = 0; part + 1 < firsts_.size(); ++part)
            parts_.push_back(io::source::open(path(folder_, part)));
    if (budget_.is_spent())
        for (const io::source& part : parts_) {
            part.rewind();
            part.release_before(part.end());
        }
    if (point < firsts_[last_] || point >= firsts_[last_ + 1])
        last_ = static_cast<std::size_t>(
            std::upper_bound(firsts_.begin(), firsts_.end(), std::uint64_t{point}) -
            firsts_.begin() - 1);
    point3 p;
    std::memcpy(&p, parts_[last_].begin() + (point - firsts_[last_]) * sizeof p, sizeof p);
    return p;
}

}  // namespace treeform::detail::stream
