#pragma once
/// \file
/// What tf-repair says and writes.

#include "tools/shell/change_limits.hpp"
#include "tools/shell/run.hpp"
#include "tools/shell/usable_input.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tools {

struct wrap_settings {
    std::optional<distance> size{};
    std::optional<distance> offset{};
};

struct repair_settings {
    tf::repair_options steps{};
    std::optional<distance> gap{};
    tools::change_limits limits{};
    bool check = false;
    wrap_settings wrap{};
    std::string source{};  ///< name of the property with the face that each one lies in; or none
    std::filesystem::path curves{};
};

struct dirty_mesh : usable_input {
    double diagonal = 0.0;
    double volume = 0.0;  ///< signed, of what it is
};

/// "repair" of a report for which nothing has been done yet.
void enter_blank_report(job& work, const dirty_mesh& input, const repair_settings& settings);

/// Enters what is wrong, and says it.
void say_defects(job& work, const dirty_mesh& input, const tf::solid_defects& found);

/// Enters what was done in the report.
void enter_repair(job& work, const dirty_mesh& input, const repair_settings& settings,
                  const tf::repaired_file& made);

/// "solid, 14,454 faces, volume 12034.5 (was 12034.5): 3 holes filled (41 edges)"
[[nodiscard]] std::string verdict(const dirty_mesh& input, const tf::repaired_file& made);

/// Whether what these settings make is written.
using attempt = std::function<bool(const repair_settings&)>;

/// Why the result is not to be written, with what helps against it, tried where it is no wrap;
/// empty when it is.
[[nodiscard]] std::string objection(const repair_settings& settings, const tf::repaired_file& made,
                                    const attempt& works);

/// Says what the user may want to look at.
void warn_of_surprises(job& work, const repair_settings& settings, const tf::repaired_file& made);

/// Writes the mesh with the attributes of the input. \throws failure
void write_solid(job& work, const dirty_mesh& input, const repair_settings& settings,
                 tf::repaired_file& made, const std::filesystem::path& path);

/// Page and picture, where they are asked for: before and after with what became of each face, or
/// the input alone where nothing was `made`. `face_source` and `is_kept` are as in `repaired_file`;
/// a wrap has nothing left of any face.
void write_page(job& work, const dirty_mesh& input, const std::string& verdict, bool good,
                const tf::mesh& made = {}, const std::vector<std::uint32_t>& face_source = {},
                const std::vector<std::uint8_t>& is_kept = {});

/// The lines along which faces of the input meet, as OBJ or PLY, where a file is named.
void write_curves(job& work, const dirty_mesh& input, const repair_settings& settings);

}  // namespace tools
