#include "arrays.hpp"
#include "bindings.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/weld_stream.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace binding {
namespace {

using conditions = std::vector<std::pair<std::string, double>>;

/// The share of all four steps that is done.
double whole_share(std::string_view step, double share) {
    constexpr std::array<std::string_view, 4> steps{"look", "scatter", "weld", "write"};
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (step == steps[i]) return (static_cast<double>(i) + share) / 4.0;
    return 0.0;
}

py::dict as_dict(const tf::weld_stream_result& result) {
    py::dict made;
    made["points"] = result.survey.points;
    made["kept"] = result.counts.kept;
    made["groups"] = result.counts.groups;
    made["max_displacement"] = result.counts.max_displacement;
    made["tolerance"] = result.survey.tolerance;
    made["non_finite"] = result.survey.non_finite;
    made["tiles"] = result.survey.tiles;
    made["continued"] = result.survey.continued;
    py::list warnings;
    for (const tf::io_warning& one : result.survey.warnings) warnings.append(one.text);
    made["warnings"] = warnings;
    return made;
}

py::dict weld_stream(const std::vector<std::filesystem::path>& inputs,
                     const std::filesystem::path& output, const std::string& removed,
                     const std::string& label, double tolerance, bool relative,
                     const std::string& rule, const conditions& same, const std::string& keep,
                     const std::string& keep_by, const std::string& order,
                     const std::string& order_by, std::uint64_t memory, const std::string& folder,
                     std::uint64_t points_per_tile) {
    tf::weld_stream_options options{
        .tolerance = tolerance,
        .relative = relative,
        .rule = choice<tf::weld_rule>("rule", weld_rule_words, rule),
        .keep = choice<tf::weld_keep>("keep", weld_keep_words, keep),
        .keep_by = keep_by,
        .order = choice<tf::weld_order>("order", weld_order_words, order),
        .order_by = order_by,
        .memory = memory,
        .folder = folder,
        .points_per_tile = points_per_tile};
    for (const auto& [name, within] : same) options.same.push_back({name, within});
    tf::weld_stream_outputs outputs;
    outputs.welded = {output, {}};
    if (!removed.empty()) outputs.removed = {removed, {}};
    outputs.label = label;
    return as_dict(run([&](const tf::progress_callback& report) {
        options.progress = [&](std::string_view step, double share) {
            return !report || report(whole_share(step, share));
        };
        return tf::weld_stream({.paths = inputs}, outputs, options);
    }));
}

}  // namespace

void add_streams(py::module_& module) { module.def("weld_stream", &weld_stream); }

}  // namespace binding
