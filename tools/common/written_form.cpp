#include "tools/common/written_form.hpp"

#include <treeform/tf.hpp>

#include <algorithm>

namespace tools {
namespace {

bool is_text(const std::string& format) {
    return format.ends_with("ascii") || format.starts_with("obj") || format.starts_with("off") ||
           format.starts_with("xyz") || format.starts_with("csv");
}

}  // namespace

written_form form_of(const job& work, const tf::mesh_file& input,
                     const std::filesystem::path& path) {
    const common_options& o = work.options;
    if (!o.in_place) return {mesh_format(o, path), o.ascii};
    const std::string format = input.format.substr(0, input.format.find('-'));
    if (std::find(o.mesh_formats.begin(), o.mesh_formats.end(), format) == o.mesh_formats.end())
        throw failure(bad_output, "output",
                      work.path + ": --in-place cannot write " + input.format + "; use -o");
    return {format, o.ascii || (input.format.ends_with("ascii") && !o.binary)};
}

bool is_single(const tf::mesh_file& file) {
    return file.stored_as == tf::precision::float32 && !is_text(file.format) &&
           tf::fits_single(file.mesh.points);
}

bool writes_single(const common_options& options, const std::optional<written_form>& form,
                   std::span<const tf::mesh_file* const> inputs) {
    if (form && form->single_only()) return true;
    if (options.precision != "keep") return options.precision == "float";
    return std::all_of(inputs.begin(), inputs.end(),
                       [](const tf::mesh_file* file) { return is_single(*file); });
}

}  // namespace tools
