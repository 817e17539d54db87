#pragma once
/// \file
/// What tf-weld writes: the welded set, the map, the points removed, the report.

#include "tools/shell/mesh_output.hpp"
#include "tools/shell/output_file.hpp"
#include "tools/tf-weld/welding.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// Files that appear together, when all are whole.
class pending_outputs {
  public:
    explicit pending_outputs(job& work) : work_(work) {}
    /// Where to write what will be at `path`. \throws failure (bad_output) as `output_place`
    const std::filesystem::path& add(const std::filesystem::path& path, bool force);
    /// Folders that stay when the process is killed.
    [[nodiscard]] std::vector<std::filesystem::path> unfinished() const;
    /// What writers say of these files, said of what they will be.
    [[nodiscard]] std::string said_of_paths(std::string text) const;
    void commit();

  private:
    job& work_;
    std::vector<std::unique_ptr<output_place>> places_{};
};

/// The format of a file of points, by its extension.
/// \throws failure (bad_usage) when it is none of ply, pcd, las, laz, xyz (txt, asc) and csv
std::string check_points_format(const std::filesystem::path& path);

/// Looks whether what comes of `file` can be written as asked. \throws failure
void check_formats(const job& work, const weld_request& request, const tf::mesh_file& file);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const weld_request& request);
void enter_report(job& work, const welding& w, const weld_request& request);

/// The new index of each point, as CSV or as 64-bit integers.
inline constexpr const char* map_heading = "input,output\n";  ///< where it is CSV
void put_map_row(std::string& text, std::uint64_t input, std::uint64_t output, bool as_csv);
void write_map(output_file& file, const welding& w, bool as_csv);
[[nodiscard]] bool map_is_csv(const std::filesystem::path& path);

/// The points of `file` that were dropped, with their properties.
void write_removed(job& work, pending_outputs& outputs, const tf::mesh_file& file, const welding& w,
                   const std::filesystem::path& path);

/// Page and picture, where they are asked for: points by the sizes of their groups, where the
/// dropped ones went, and how far points are apart.
void write_page(job& work, const tf::mesh_file& file, const welding& w,
                const weld_request& request);

/// What files are not as they were.
void warn_of_replaced(job& work, const std::string& label);
void warn_of_las_grid(job& work, const std::string& what, double moved);

/// Enters what was written, and says what rounding has done to it.
void enter_result(job& work, const weld_request& request, const std::filesystem::path& path,
                  const tf::write_result& written, std::optional<std::uint64_t> again);

/// The set at `path`, in the precision asked for; what is written is looked at in that precision.
void write_result(job& work, pending_outputs& outputs, const tf::mesh_file& welded,
                  const welding& w, const weld_request& request, const std::filesystem::path& path);

}  // namespace tools
