#include "tools/shell/written_form.hpp"

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

tf::precision written_precision(const common_options& options,
                                const std::optional<written_form>& form,
                                std::span<const tf::mesh_file* const> inputs) {
    const auto is_kept = [](const tf::mesh_file* file) { return is_single(*file); };
    const bool keeps_single =
        (form && form->single_unless_asked()) || std::ranges::all_of(inputs, is_kept);
    const bool single = (form && form->single_only()) || options.precision == "float" ||
                        (options.precision == "keep" && keeps_single);
    return single ? tf::precision::float32 : tf::precision::float64;
}

tf::write_options write_options_for(const common_options& options, const written_form& form) {
    tf::write_options how{.format = form.format,
                          .ascii = form.ascii,
                          .drop = options.drop,
                          .rename = options.rename,
                          .las_scale = options.las_scale,
                          .las_offset = options.las_offset};
    if (options.precision == "float") how.precision = tf::precision::float32;
    if (options.precision == "double") how.precision = tf::precision::float64;
    return how;
}

}  // namespace tools
