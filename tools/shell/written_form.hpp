#pragma once
/// \file
/// In which format, and with which numbers, a mesh is written.

#include "tools/shell/run.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tools {

struct written_form {
    std::string format{};  ///< extension without its dot
    bool ascii = false;

    /// Whether it has coordinates in float32 only.
    [[nodiscard]] bool single_only() const {
        return format == "glb" || (format == "stl" && !ascii);
    }
    /// Whether its readers make float32 of what they read, so that doubles have to be asked for.
    [[nodiscard]] bool single_unless_asked() const { return format == "3mf"; }
    /// Whether coordinates are whole numbers of steps.
    [[nodiscard]] bool is_las() const { return format == "las" || format == "laz"; }
};

/// How what is made of `input` is written to `path`: as the options or the extension say; in place,
/// as the input is. \throws failure (bad_usage), or (bad_output) where that cannot be
[[nodiscard]] written_form form_of(const job& work, const tf::mesh_file& input,
                                   const std::filesystem::path& path);

/// Whether the file holds its coordinates as float32.
[[nodiscard]] bool is_single(const tf::mesh_file& file);

/// The numbers that coordinates become: floats where `form` has nothing else, or where the user, or
/// else every input, says so. Known before the work, which depends on it.
[[nodiscard]] tf::precision written_precision(const common_options& options,
                                              const std::optional<written_form>& form,
                                              std::span<const tf::mesh_file* const> inputs);

/// For a mesh that nothing was computed for: coordinates as the user says, or as they were stored.
[[nodiscard]] tf::write_options write_options_for(const common_options& options,
                                                  const written_form& form);

}  // namespace tools
