#pragma once
/// \file
/// Reads the points of a file in blocks, optionally with an index of its records.

#include <libmesh/io/detect.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace treeform::detail::io {

/// The implementation of `point_reader`.
class point_blocks {
  public:
    /// As for `point_reader`; `known` as for `open_xyz_points`, `unpacked` for `open_pcd_points`.
    point_blocks(const std::filesystem::path& path, const reading& how, std::uint64_t first,
                 row_use use, const record_index* known = nullptr,
                 const byte_getter* unpacked = nullptr);
    point_blocks(const point_blocks&) = delete;
    point_blocks& operator=(const point_blocks&) = delete;

    [[nodiscard]] const mesh_file& header() const { return rows_.head; }
    [[nodiscard]] std::uint64_t count() const { return rows_.count; }
    bool read(point_block& block, std::size_t most);
    bool read(row_block& block, std::size_t most) {
        return rows_.behind && rows_.behind(block, most, rows_.head.warnings);
    }
    [[nodiscard]] row_place next_row() { return rows_.next_row ? rows_.next_row() : row_place{}; }
    void go_to(const row_place& place) {
        if (rows_.go_to) rows_.go_to(place);
    }
    [[nodiscard]] std::vector<row_place> row_parts(std::size_t count) {
        return rows_.row_parts ? rows_.row_parts(count) : std::vector<row_place>();
    }

  private:
    source in_;  ///< declared before `rows_`, which reads from it
    point_rows rows_;
};

/// The index of the records of a part of a text file, with at most `most` marks. None if the file
/// is not a text file of points, or cannot be read, which is reported when it is opened. `even` as
/// for `scan_xyz`.
[[nodiscard]] std::optional<record_index> scan_points(const std::filesystem::path& path,
                                                      const reading& how, const file_part& part,
                                                      std::size_t most, bool even = true);

/// Whether the file is a PLY for which `has_listed_points`; false if it cannot be read.
[[nodiscard]] bool has_listed_points_at(const std::filesystem::path& path, const reading& how);

}  // namespace treeform::detail::io
