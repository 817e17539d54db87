#include "arrays.hpp"
#include "bindings.hpp"
#include "file_data.hpp"
#include "job.hpp"
#include "steps.hpp"
#include "words.hpp"
#include <treeform/mesh/weld_stream.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace binding {
namespace {

using conditions = std::vector<std::pair<std::string, double>>;

/// The share of all steps that is done.
double whole_share(std::string_view step, double share) {
    constexpr std::array<std::string_view, 5> steps{"look", "scatter", "weld", "borders", "write"};
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (step == steps[i]) return (static_cast<double>(i) + share) / steps.size();
    return 0.0;
}

py::dict as_dict(const tf::weld_stream_result& result) {
    py::dict made;
    made["points"] = result.survey.points;
    made["kept"] = result.counts.kept;
    made["groups"] = result.counts.groups;
    made["max_displacement"] = result.counts.max_displacement + result.survey.las_moved;
    made["tolerance"] = result.survey.tolerance;
    made["non_finite"] = result.survey.non_finite;
    made["tiles"] = result.survey.tiles;
    made["continued"] = result.survey.continued;
    made["faces"] = result.counts.faces;
    py::dict counted;
    counted["triangles"] = result.counts.triangles;
    counted["collapsed"] = result.counts.collapsed;
    counted["degenerate"] = result.counts.degenerate;
    counted["nonmanifold_before"] = result.counts.nonmanifold_before;
    counted["nonmanifold_after"] = result.counts.nonmanifold_after;
    counted["flipped"] = result.counts.flipped;
    made["statistics"] = counted;
    py::list warnings;
    for (const tf::io_warning& one : result.survey.warnings) warnings.append(one.text);
    for (const auto* const written : {&result.written.welded, &result.written.removed})
        if (*written)
            for (const tf::io_warning& one : (*written)->warnings) warnings.append(one.text);
    made["warnings"] = warnings;
    return made;
}

/// How to weld a cloud of files, from Python.
struct stream_settings {
    tf::cloud_inputs inputs{};
    tf::weld_stream_options options{};
};

stream_settings settings_of(std::vector<std::filesystem::path> inputs, double tolerance,
                            bool relative, const std::string& rule, const conditions& same,
                            const std::string& keep, const std::string& keep_by,
                            const std::string& order, const std::string& order_by, bool keep_seams,
                            const std::vector<std::string>& across, bool keep_degenerate,
                            bool as_las, std::uint64_t memory, const std::string& folder,
                            std::uint64_t points_per_tile, const name_pairs& columns, bool mixed) {
    stream_settings made;
    made.inputs.paths = std::move(inputs);
    made.inputs.columns = columns_of(columns);
    made.inputs.mixed = mixed;
    made.options = {.tolerance = tolerance,
                    .relative = relative,
                    .rule = choice<tf::weld_rule>("rule", weld_rule_words, rule),
                    .keep = choice<tf::weld_keep>("keep", weld_keep_words, keep),
                    .keep_by = keep_by,
                    .order = choice<tf::weld_order>("order", weld_order_words, order),
                    .order_by = order_by,
                    .keep_seams = keep_seams,
                    .across = across,
                    .keep_degenerate = keep_degenerate,
                    .as_las = as_las,
                    .memory = memory,
                    .folder = folder,
                    .points_per_tile = points_per_tile};
    for (const auto& [name, within] : same) made.options.same.push_back({name, within});
    return made;
}

tf::weld_stream_outputs outputs_of(const std::filesystem::path& output, const std::string& removed,
                                   const std::string& label, bool withhold) {
    tf::weld_stream_outputs outputs;
    outputs.welded = {output, {}};
    if (!removed.empty()) outputs.removed = {removed, {}};
    outputs.label = label;
    outputs.withhold = withhold;
    return outputs;
}

py::dict weld_stream(const stream_settings& settings, const std::filesystem::path& output,
                     const std::string& removed, const std::string& label, bool withhold,
                     const py::object& team) {
    tf::weld_stream_options options = settings.options;
    options.team = team_of(team);
    const at_work here(team);
    return as_dict(run([&](const tf::progress_callback& report) {
        options.progress = [&](std::string_view step, double share) {
            return !report || report(whole_share(step, share));
        };
        return tf::weld_stream(settings.inputs, outputs_of(output, removed, label, withhold),
                               options);
    }));
}

// ---- step by step, by many processes ----

struct shared_weld {
    tf::stream_weld work;
    bool looked = false;

    [[nodiscard]] tf::status look() {
        if (looked) return tf::status::ok;
        const tf::status ended = work.look();
        looked = ended == tf::status::ok;
        return ended;
    }
    /// The number of tiles.
    [[nodiscard]] std::size_t scatter() {
        if (look() != tf::status::ok || work.scatter() != tf::status::ok) return 0;
        return work.survey().tiles;
    }
    [[nodiscard]] tf::weld_stream_result finish(const tf::weld_stream_outputs& outputs) {
        work.check_tiles();
        tf::weld_stream_result result;
        result.status = look();
        if (result.status == tf::status::ok) result.status = work.weld();
        if (result.status == tf::status::ok) result.status = work.write(outputs);
        result.survey = work.survey();
        result.counts = work.counts();
        result.written = work.written();
        return result;
    }
};

using weld_in_steps = work_in_steps<shared_weld>;

std::unique_ptr<weld_in_steps> weld_of(const stream_settings& settings) {
    tf::weld_stream_options options = settings.options;
    options.shared = true;
    return run([&](const tf::progress_callback&) {
        return std::make_unique<weld_in_steps>([&](const step_progress& progress) {
            options.progress = std::ref(progress);
            return shared_weld{tf::stream_weld(settings.inputs, options)};
        });
    });
}

void add_weld_in_steps(py::module_& module) {
    py::class_<weld_in_steps>(module, "WeldInSteps")
        .def("scatter",
             [](weld_in_steps& all) {
                 return all.step([](shared_weld& one) { return one.scatter(); });
             })
        .def("tiles",
             [](weld_in_steps& all) {
                 return all.step([](shared_weld& one) {
                     one.work.check_tiles();
                     return one.work.survey().tiles;
                 });
             })
        .def("weld_tile",
             [](weld_in_steps& all, std::size_t tile) {
                 all.step([=](shared_weld& one) { return one.work.weld_tile(tile); });
             })
        .def("finish",
             [](weld_in_steps& all, const std::filesystem::path& output, const std::string& removed,
                const std::string& label, bool withhold) {
                 return as_dict(all.step([&](shared_weld& one) {
                     return one.finish(outputs_of(output, removed, label, withhold));
                 }));
             })
        .def("remove_folder",
             [](weld_in_steps& all) {
                 all.step([](shared_weld& one) {
                     one.work.remove_folder();
                     return true;
                 });
             })
        .def("close", &weld_in_steps::close);
    module.def("weld_of", &weld_of);
}

}  // namespace

void add_streams(py::module_& module) {
    py::class_<stream_settings>(module, "StreamSettings").def(py::init(&settings_of));
    module.def("weld_stream", &weld_stream);
    add_weld_in_steps(module);
}

}  // namespace binding
