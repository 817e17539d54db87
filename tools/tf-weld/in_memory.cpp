#include "tools/tf-weld/in_memory.hpp"

#include "tools/shell/mesh_output.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/welding.hpp"
#include "tools/tf-weld/words.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/tf.hpp>

#include <stdexcept>
#include <utility>

namespace tools {
namespace {

void warn_of_materials(job& work, const std::vector<tf::mesh_file>& files) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || form_of(work, files.front(), *path).format != "obj") return;
    std::vector<const tf::mesh_file*> all;
    all.reserve(files.size());
    for (const tf::mesh_file& file : files) all.push_back(&file);
    warn_of_ambiguous_materials(work, all);
}

/// What the library says, without the name of its function.
std::string in_plain_words(const std::exception& error) {
    const std::string text = error.what();
    return text.substr(text.find(": ") + 2);
}

tf::mesh_file join(std::vector<tf::mesh_file> files, const std::vector<std::string>& names,
                   bool mixed) {
    if (files.size() == 1) return std::move(files.front());
    try {
        tf::mesh_file all = tf::concatenate_files(std::move(files), names, mixed);
        for (tf::io_warning& w : all.warnings)
            if (w.code == "data-dropped") w.text += " by --join";
        return all;
    } catch (const std::length_error& error) {
        throw failure(bad_input, "size", in_plain_words(error));
    } catch (const std::invalid_argument& error) {
        const std::string text = in_plain_words(error);
        const bool of_las = text.find("reference systems") != std::string::npos ||
                            text.find("GPS time") != std::string::npos;
        throw failure(
            bad_input, of_las ? "mixed" : "property",
            text + (of_las ? "; convert one first (pdal translate), or --mixed joins them "
                             "without conversion"
                           : ""));
    }
}

tf::mesh_file read_all(job& work, bool mixed) {
    const std::vector<std::string> names =
        work.options.joined ? work.options.inputs : std::vector<std::string>{work.path};
    std::vector<tf::mesh_file> files;
    std::uint64_t first_point = 0;
    for (const std::string& name : names) {
        json source{{"input", name}};
        files.push_back(work.read(name, source));
        source["points"] = files.back().mesh.points.size();
        source["faces"] = files.back().stored_faces;
        source["first_point"] = first_point;
        first_point += files.back().mesh.points.size();
        work.entry["sources"].push_back(std::move(source));
    }
    const json& first = work.entry["sources"].front();
    for (const char* key : {"format", "sha256"})
        work.entry[key] = files.size() == 1 ? first[key] : json(nullptr);
    warn_of_materials(work, files);
    tf::mesh_file all = join(std::move(files), names, mixed);
    work.entry["precision_in"] = name_of(all.stored_as);
    work.warn(all.warnings);
    return all;
}

/// `file` as it was, with the number of each point's group.
void label(job& work, tf::mesh_file& file, const welding& w, const std::string& name) {
    tf::element& vertices = file.attributes.find_or_add("vertex", file.mesh.points.size());
    if (vertices.set(tf::column::of<std::uint32_t>(name, w.result.groups.group_of_point)))
        warn_of_replaced(work, name);
}

/// Where the output is LAS: as it will be there, so that what is decided holds for what is written.
void fit_to_las(job& work, tf::mesh_file& file, const std::string& why) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || !form_of(work, file, *path).is_las()) return;
    warn_of_las_grid(work, why, tf::round_to_las(file, write_options_for(work.options, {})));
}

}  // namespace

exit_status weld_in_memory(job& work, const weld_request& request, const std::string& remark) {
    const common_options& o = work.options;
    const weld_outputs& asked = request.outputs;
    enter_blank_report(work, request);
    if (!remark.empty()) work.warn("in-memory", remark);
    check_outputs(work, {asked.map}, {asked.removed});
    tf::mesh_file file = read_all(work, request.mixed);
    check_formats(work, request, file);
    fit_to_las(work, file, "coordinates");
    const auto path = mesh_output(o, work.path);

    welding w = weld(work, file, request.settings);
    work.out.result(work.name + ": " + verdict(w, request));
    say_details(work, w);
    enter_report(work, w, request);
    warn_of_defects(work, w);
    write_page(work, file, w, request);

    const job::timer timing = work.time("write");
    pending_outputs outputs(work);
    std::optional<output_file> map;
    if (!asked.map.empty()) {
        map.emplace(asked.map, o.force);
        write_map(*map, w, map_is_csv(asked.map));
    }
    if (!asked.removed.empty() && !o.dry_run) write_removed(work, outputs, file, w, asked.removed);
    if (asked.withhold)
        w.result.withhold(file);
    else if (!asked.label.empty())
        label(work, file, w, asked.label);
    else
        file = std::move(w.result.file);
    if (!asked.drops_nothing() && request.settings.options.keep == tf::weld_keep::mean)
        fit_to_las(work, file, "means");
    work.entry["polygons"] = {{"in", w.polygons}, {"out", file.stored_faces}};
    if (path && !o.dry_run) write_result(work, outputs, file, w, request, *path);
    if (map) map->commit();
    outputs.commit();
    return asked.check && w.removed() > 0 ? found : done;
}

}  // namespace tools
