#pragma once
/// \file
/// Stores the points of a mesh in files while its faces are read.

#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/work_folder.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace treeform::detail::stream {

/// Limits the pages of mapped files in memory.
class page_budget {
  public:
    /// Keeps at most about `memory` bytes.
    explicit page_budget(std::uint64_t memory)
        : at_once_(std::max<std::uint64_t>(1024, memory / page)) {}

    /// Whether memory must be released before the next access.
    [[nodiscard]] bool is_spent() {
        if (++since_ <= at_once_) return false;
        since_ = 0;
        return true;
    }

  private:
    static constexpr std::uint64_t page = 4096;  ///< bytes loaded by reading one record

    std::uint64_t at_once_;
    std::uint64_t since_ = 0;
};

/// Points in a private file.
class placed_points : public io::point_store {
  public:
    placed_points(std::unique_ptr<io::scratch> file, std::uint64_t memory)
        : file_(std::move(file)), budget_(memory) {}

    void put(points_view points) override;
    [[nodiscard]] point3 at(std::uint32_t point) override;

  private:
    std::unique_ptr<io::scratch> file_;
    page_budget budget_;
    std::size_t size_ = 0;
    std::size_t held_ = 0;  ///< bytes since memory was released
};

/// Points in one file for each rank.
class shared_points : public io::point_store {
  public:
    /// For `count` points in total; the process puts those of its `io::file_part`.
    shared_points(const work_folder& folder, const communicator& all, std::size_t count,
                  std::uint64_t memory);

    void put(points_view points) override;
    [[nodiscard]] point3 at(std::uint32_t point) override;
    /// Removes the file of a rank; call it when no rank needs it any more.
    static void remove(const work_folder& folder, std::size_t rank) {
        std::filesystem::remove(path(folder, rank));
    }

  private:
    [[nodiscard]] static std::filesystem::path path(const work_folder& folder, std::size_t part);

    const work_folder& folder_;
    std::size_t rank_;
    std::vector<std::uint64_t> firsts_{};  ///< first point of each part, then the count
    page_budget budget_;
    std::vector<io::source> parts_{};
    std::size_t last_ = 0;  ///< the part accessed last
};

}  // namespace treeform::detail::stream
