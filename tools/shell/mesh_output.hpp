#pragma once
/// \file
/// Meshes as they are written, what rounding does to them, and what the report says of that.

#include "tools/shell/run.hpp"
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <initializer_list>
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

/// Looks at outputs before the work, so that it is not lost in the end: `always`, and unless it is
/// a dry run `also` and the mesh. Empty paths pass. \throws failure
void check_outputs(const job& work, std::initializer_list<std::filesystem::path> always,
                   std::initializer_list<std::filesystem::path> also = {});

/// Says so where rounding and mending have moved points by more than a step of the numbers written,
/// which rounding alone does not.
void warn_of_moves(job& work, tf::points_view points, const tf::certificate& known);

/// Says that `whose` coordinates were rounded to float32, if they were.
void warn_of_rounding(job& work, double max_displacement, const std::string& whose = {});

/// Says which faces rounding to these numbers has folded, if any.
void warn_of_folds(job& work, const tf::rounding_effects& defects, tf::precision precision);

/// Enters what points have lost at their places as "rounding", and says what is noticeable of it.
void enter_rounding(job& work, const tf::rounding_effects& lost, tf::precision precision);

/// Says which materials inputs with different material files name alike, for an OBJ that is made of
/// them: it has one of a name.
void warn_of_ambiguous_materials(job& work, std::span<const tf::mesh_file* const> inputs);

/// Enters file, format, numbers and what these have moved as "output", beside what is there, and
/// says what the writer warns of. `moved` is how far rounding had moved coordinates before.
void enter_output(job& work, const std::filesystem::path& path, const tf::write_result& written,
                  double moved = 0.0);

/// A file of coordinates that were checked.
[[nodiscard]] tf::mesh_file file_of(tf::mesh&& surface, const tf::certificate& known);

/// Writes `file` to `path` and enters it; `moved` as above. \throws failure (bad_output)
tf::write_result write_mesh(job& work, const tf::mesh_file& file, const tf::write_options& options,
                            const std::filesystem::path& path, double moved = 0.0);

/// The same for a mesh that was checked in the coordinates of `file`: it is read again, and only
/// then has its name. \throws std::logic_error when the file does not hold what was checked
void write_certified(job& work, const tf::mesh_file& file, const written_form& form,
                     const std::filesystem::path& path, double moved);

}  // namespace tools
