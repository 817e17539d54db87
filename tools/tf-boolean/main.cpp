/// \file
/// tf-boolean: set operations on solids.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-boolean/outputs.hpp"
#include "tools/tf-boolean/settings.hpp"
#include "tools/tf-boolean/solids.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace {

using tools::boolean_settings;
using tools::command_line;
using tools::common_options;
using tools::exit_status;

void add_options(command_line& line, boolean_settings& s) {
    line.group("Options");
    line.option(s.expression, {"--expr", "EXPR",
                               "instead of OP, such as \"(a-b)*(c+d)\"; a is INPUT 1,\n"
                               "or the first object of a single INPUT; + | union,\n"
                               "* & intersection, - difference, ^ exclusive or; or\n"
                               "names of parts, \"body-(bolt_1+'left bolt')\""});
    line.repeatable_option(s.matrix_texts,
                           {"--matrix", "N:FILE", "4x4 matrix for INPUT N (repeatable)"});
    line.option(s.fill_rule,
                {"--fill-rule", "RULE",
                 "which winding numbers are inside: nonzero |\n"
                 "even-odd | positive",
                 "nonzero"},
                tools::fill_rules);
    line.flag(s.check, {"--check", "", "only check that the inputs bound solids"});
    line.flag(s.accept_open, {"--accept-open", "",
                              "an open input is a surface that the others cut:\n"
                              "a difference or intersection keeps a part of it"});
    line.flag(s.repair, {"--repair", "", "repair each INPUT first, as tf-repair does"});
    line.flag(s.keep_cuts, {"--keep-cuts", "",
                            "do not merge coplanar faces that were cut, or\n"
                            "that overlap"});
    line.flag(s.simplify, {"--merge-coplanar", "",
                           "merge all coplanar faces with equal properties, also\n"
                           "those not cut; faces with texture coordinates or\n"
                           "normals of corners are not merged"});
    line.option({"--min-volume", "V", "drop parts, and fill voids, of less volume than V", "0"},
                [&s](std::string_view v) {
                    s.min_volume = tools::parse_volume("--min-volume", v);
                    s.min_volume_given = true;
                });
    line.option(s.gap, {"--gap", "DIST",
                        "union: fill gaps of at most DIST between faces of\n"
                        "different operands that face each other"});
    tools::add_max_move(line, s.limits);
}

void add_outputs(command_line& line, boolean_settings& s, common_options& options) {
    line.group("Output");
    line.output(options.output, {"-o, --output", "FILE", "the result"});
    line.option(s.source, {"--source", "P",
                           "for each face, write the input mesh and face that it\n"
                           "comes from to properties P_mesh, P_face (PLY, GLB)",
                           "source"});
    line.flag(s.no_attributes, {"--no-attributes", "",
                                "omit colors, normals, uv and other properties, also\n"
                                "of corners; omit materials and textures"});
    line.output(s.curves,
                {"--curves", "FILE", "the lines along which the inputs meet, as OBJ or PLY"});
}

/// Merging is not to lose what is written of faces, or would be with -o.
std::vector<std::uint32_t> groups_of(const boolean_settings& s,
                                     const std::vector<tools::solid>& solids) {
    return tools::sources_of(solids).face_groups(!s.no_attributes, s.source_given);
}

bool keeps_cuts(const boolean_settings& s, const std::vector<tools::solid>& solids) {
    return s.keep_cuts ||
           (!s.simplify && !s.no_attributes && tools::sources_of(solids).has_vertex_values());
}

tf::boolean_result ask(tools::job& work, const boolean_settings& s,
                       const std::vector<tools::solid>& solids,
                       const std::optional<std::uint32_t>& sheet, tf::precision precision) {
    const auto timing = work.time("cut");
    const std::vector<tf::mesh_view> views = tools::views_of(solids);
    tf::boolean_options options{.fill_rule = s.fill_rule,
                                .precision = precision,
                                .keep_cuts = keeps_cuts(s, solids),
                                .merge_coplanar = s.simplify,
                                .min_volume = s.min_volume,
                                .gap = s.gap ? s.gap->used(tools::diagonal_of(solids)) : 0.0};
    const std::vector<std::uint32_t> groups = groups_of(s, solids);
    options.face_groups = groups;
    options.volumes = work.options.detailed();
    options.progress = work.progress(s.name());
    tf::boolean_result result;
    if (s.splits())
        result = tf::split(views, options);
    else if (sheet)
        result = tf::clip(views, *sheet, tools::formula_of(s, views.size()), options);
    else
        result = tf::boolean(views, tools::formula_of(s, views.size()), options);
    work.call_ended(result.certificate.status == tf::status::cancelled);
    return result;
}

/// What to do where floats do not hold the result: what is nothing in them is tried in doubles.
std::string remedy_for_floats(tools::job& work, const boolean_settings& s,
                              const std::vector<tools::solid>& solids,
                              const std::optional<std::uint32_t>& sheet, bool vanished) {
    const std::string doubles = "--precision double, in a format that has it, ";
    if (!vanished) return "; " + doubles + "may help";
    const tf::boolean_result result = ask(work, s, solids, sheet, tf::precision::float64);
    if (!result.certificate) return "; double numbers are too coarse for it, too";
    return "; " + doubles + "gives " + tools::counted(result.mesh.faces.size(), "face", "faces");
}

std::string open_in_words(std::size_t open, std::size_t all) {
    if (all == 1) return "bounds no solid";
    return tools::grouped(open) + " of " + tools::grouped(all) +
           (open == 1 ? " bounds no solid" : " bound no solid");
}

exit_status check_only(tools::job& work, const std::vector<tools::solid>& solids) {
    const auto open_ones = tools::check_operands(work, solids);
    const std::size_t open = open_ones.size();
    tools::warn_of_open(work, solids, open_ones);
    const char* const sound = solids.size() == 1 ? "bounds a solid" : "all bound solids";
    const std::string verdict = open == 0 ? sound : open_in_words(open, solids.size());
    work.out.result(work.name + ": " + verdict);
    tools::write_page(work, solids, verdict, open == 0);
    return open == 0 ? tools::done : tools::found;
}

exit_status refuse_open(tools::job& work, const std::vector<tools::solid>& solids,
                        const std::vector<std::uint32_t>& open, const std::string& remark) {
    tools::warn_of_open(work, solids, open);
    const std::string verdict =
        open_in_words(open.size(), solids.size()) + "; " + remark + "nothing written";
    work.out.result(work.name + ": " + verdict);
    tools::write_page(work, solids, verdict, false);
    return tools::found;
}

/// Files of which the formula uses nothing.
void warn_of_unused(tools::job& work, const boolean_settings& s,
                    const std::vector<tools::solid>& solids) {
    if (s.expression.empty()) return;
    const tf::boolean_expression formula = tools::formula_of(s, solids.size());
    for (const std::string& path : work.options.inputs)
        if (std::ranges::none_of(formula.postfix(), [&](std::int32_t k) {
                return k >= 0 && solids[static_cast<std::size_t>(k)].path == path;
            }))
            work.warn("unused", tools::name_of_input(path) + ": ignored, since \"" + s.expression +
                                    "\" does not use it");
}

exit_status operate(tools::job& work, const boolean_settings& s) {
    tools::enter_blank_report(work, s);
    tools::check_outputs(work, {}, {s.curves});
    const std::vector<tools::solid> solids = tools::read_solids(work, s);
    if (s.check) return check_only(work, solids);
    warn_of_unused(work, s, solids);
    const tf::precision precision = tools::written_precision(work, solids);
    std::optional<std::uint32_t> sheet;
    if (s.accept_open && !s.splits()) {
        const std::vector<std::uint32_t> open = tools::check_operands(work, solids);
        if (open.size() > 1)
            return refuse_open(work, solids, open, "--accept-open allows one open input; ");
        if (!open.empty()) sheet = open.front();
        if (sheet && !tools::formula_of(s, solids.size()).is_inside(*sheet))
            return refuse_open(work, solids, open,
                               "an open surface can be cut, but not united with a solid; ");
    }
    tf::boolean_result result = ask(work, s, solids, sheet, precision);
    if (!result.certificate.open_edges.empty())
        return refuse_open(work, solids, tools::check_operands(work, solids), {});
    if (!sheet)
        for (tools::json& input : work.entry["inputs"])
            input["closed"] = s.splits() ? tools::json(nullptr) : tools::json(true);
    const bool bounds_solid = !s.splits() && !sheet;
    tools::enter_result(work, s, solids, result, bounds_solid);
    work.out.result(work.name + ": " + tools::verdict(work, s, result));
    tools::write_curves(work, s, solids);
    tools::write_page(work, solids, tools::verdict(work, s, result),
                      static_cast<bool>(result.certificate), &result);
    tools::say_details(work, result);
    tools::warn_of_surprises(work, s, solids, result);
    if (!result.certificate) {
        std::string remedy;
        if (precision == tf::precision::float32)
            remedy = remedy_for_floats(work, s, solids, sheet,
                                       result.certificate.status == tf::status::vanished);
        tools::warn_of_failure(work, result, remedy);
        return tools::found;
    }
    const std::string too_far = tools::move_objection(
        work.entry, s.limits, tools::diagonal_of(solids), result.certificate, result.mesh.points);
    if (!too_far.empty()) {
        work.warn("max-move", too_far + "; nothing written");
        return tools::found;
    }
    tools::warn_of_moves(work, result.mesh.points, result.certificate);
    tools::write_surface(work, s, solids, result);
    return tools::done;
}

}  // namespace

int main(int argc, char** argv) {
    command_line line("tf-boolean", "OP [OPTIONS] INPUT...",
                      "Exact set operations on solids bounded by triangle meshes.");
    boolean_settings s;
    common_options options;
    options.suffix = "-boolean";
    options.joined = true;
    options.words.assign(tools::operations.begin(), tools::operations.end());
    line.inputs(options.inputs, tools::mesh_inputs);
    line.group("OP");
    line.describe(tools::help_text);
    add_options(line, s);
    add_outputs(line, s, options);
    line.group("Common options");
    tools::add_common_options(
        line, options,
        {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf"}, .one_result = true});
    return tools::run(
        line, options, {"read", "prepare", "cut", "check", "write"}, argc, argv,
        [&] {
            s.source_given = line.given("--source");
            s.max_move_given = line.given("--max-move");
            tools::settle_words(s, options);
            if (!s.check) tools::require_output(line, options);
        },
        [&](tools::job& work) { return operate(work, s); });
}
