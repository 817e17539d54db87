/// \file
/// tf-repair: makes solids of dirty meshes.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-repair/outputs.hpp"
#include "tools/tf-repair/wrapping.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace {

using tools::command_line;
using tools::common_options;
using tools::exit_status;
using tools::repair_settings;

/// One of the steps that can be left out.
struct step {
    const char* name;
    const char* text;
    bool tf::repair_options::*wanted;
};
constexpr std::array<step, 5> steps{
    {{"join",
      "drop degenerate and duplicate faces; close cracks\n"
      "narrower than --gap and T-junctions",
      &tf::repair_options::join},
     {"orient", "orient faces consistently and outward; drop strays", &tf::repair_options::orient},
     {"fill", "fill holes", &tf::repair_options::fill},
     {"resolve",
      "cut self-intersections; drop faces that do not bound\n"
      "the solid",
      &tf::repair_options::resolve},
     {"detach", "separate parts that touch in an edge or a point", &tf::repair_options::detach}}};

struct request {
    repair_settings settings{};
    std::array<bool, steps.size()> left_out{};
};

void add_steps(command_line& line, request& r) {
    line.group("Steps, in this order (--no-STEP skips one)");
    for (std::size_t i = 0; i < steps.size(); ++i) {
        line.mention({.names = steps[i].name, .text = steps[i].text});
        line.flag(r.left_out[i], {.names = std::string("--no-") + steps[i].name});
    }
}

void add_options(command_line& line, repair_settings& s) {
    line.group("Options");
    line.option(s.gap, {"--gap", "DIST", "close cracks up to this width", "chosen, at most 0.1%"});
    line.option(s.steps.largest_hole, {"--holes", "N", "fill holes of at most N edges", "all"});
    line.option(
        {"--strays", "SHARE", "drop loose open pieces below this share of the area", "0.1%"},
        [&s](std::string_view text) {
            s.steps.stray_share = tools::parse_share("--strays", text);
        });
    line.option(
        {.names = "--fill-rule",
         .value = "RULE",
         .text = "which winding numbers are inside: auto | nonzero |\neven-odd | positive",
         .fallback = "auto",
         .offered = {"auto", "nonzero", "even-odd", "positive"}},
        [&s](std::string_view text) {
            const std::array<const char*, 4> rules{"auto", "nonzero", "even-odd", "positive"};
            const std::size_t chosen = tools::parse_choice("--fill-rule", text, rules);
            s.steps.fill_rule.reset();
            if (chosen > 0) s.steps.fill_rule = static_cast<tf::fill_rule>(chosen - 1);
        });
    line.flag(s.steps.sheet, {"--sheet", "", "the input is an open surface: keep its border"});
    line.flag(s.steps.keep_cuts, {"--keep-cuts", "",
                                  "do not merge coplanar faces that were cut, or\n"
                                  "that overlap"});
    line.flag(s.check, {"--check", "",
                        "change nothing; list the defects; exit 1 if there\n"
                        "are any"});
    line.group("Limits (if one is exceeded, nothing is written; exit 1)");
    tools::add_max_loss(line, s.limits);
    tools::add_max_move(line, s.limits);
}

void add_outputs(command_line& line, repair_settings& s, common_options& options) {
    line.group("Output");
    line.output(options.output, {"-o, --output", "FILE", "the solid"});
    line.output(s.curves, {"--curves", "FILE", "intersection curves of the input, as OBJ or PLY"});
    line.option(s.source, {"--source", "P",
                           "write the input face of each face to property P of\n"
                           "a PLY or GLB; -1 for new faces"});
}

void check_request(const command_line& line, request& r, common_options& options) {
    using tools::refuse;
    repair_settings& s = r.settings;
    tools::check_wrapping(line, s.wrap);
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (r.left_out[i]) s.steps.*steps[i].wanted = false;
    tools::check_curve_path(s.curves);
    if (s.gap && !s.steps.join) refuse("--gap: --no-join skips the step that closes cracks");
    if (line.given("--holes") && (!s.steps.fill || s.steps.sheet))
        refuse("--holes: --no-fill and --sheet fill no holes");
    for (const char* name : {"--fill-rule", "--keep-cuts"})
        if (line.given(name) && !s.steps.resolve)
            refuse(std::string(name) + ": --no-resolve skips the cutting");
    if (s.steps.keep_cuts && s.steps.sheet) refuse("--keep-cuts: --sheet never merges faces");
    if (!options.output.empty()) {
        const std::string format = tools::mesh_format(options, options.output);
        if (!s.source.empty() && format != "ply" && format != "glb")
            refuse("--source needs an output with properties: ply, glb");
    }
    s.steps.max_loss = s.limits.loss();
    if (!s.check) {
        tools::require_output(line, options, "--check only lists the defects");
        return;
    }
    if (tools::wants_mesh(options)) refuse("--check writes no mesh");
    for (const char* name :
         {"--max-loss", "--accept-loss", "--max-move", "--gap", "--holes", "--strays",
          "--fill-rule", "--sheet", "--keep-cuts", "--source", "--precision"})
        if (line.given(name)) refuse(std::string(name) + ": --check changes nothing");
}

tools::dirty_mesh read_mesh(tools::job& work) {
    tools::dirty_mesh input{tools::read_usable(work)};
    const tf::mesh& mesh = input.file.mesh;
    if (const auto box = tf::bounding_box(mesh.points)) input.diagonal = box->diagonal();
    input.volume = tf::signed_volume(mesh);
    return input;
}

exit_status check_only(tools::job& work, const tools::dirty_mesh& input) {
    const auto timing = work.time("check");
    tf::solid_defects found = tf::find_solid_defects(input.source(), work.progress("check"));
    found.unusable_faces += input.non_finite;
    work.call_ended(found.status == tf::status::cancelled);
    tools::say_defects(work, input, found);
    tools::write_page(work, input, found.message(), !found.any());
    return found.any() ? tools::found : tools::done;
}

/// Where the output has no objects, overlapping ones become one solid.
bool becomes_one(const common_options& options, const std::filesystem::path& output) {
    const std::string format = tools::mesh_format(options, output);
    return format != "3mf" && format != "obj";
}

tf::repaired_file mend(tools::job& work, const tools::dirty_mesh& input,
                       const repair_settings& settings, tf::precision precision, bool as_one) {
    const auto timing = work.time("repair");
    tf::repair_options options = settings.steps;
    if (settings.gap) options.gap = settings.gap->used(input.diagonal);
    options.precision = precision;
    options.as_one = as_one;
    options.max_displacement = settings.limits.max_move.used(input.diagonal);
    options.progress = work.progress("repair");
    tf::repaired_file made = tf::repair_file(input.source(), options);
    work.call_ended(made.certificate.status == tf::status::cancelled);
    return made;
}

exit_status look_at(tools::job& work, const repair_settings& s) {
    const common_options& o = work.options;
    tools::check_outputs(work, {}, {s.curves});
    const tools::dirty_mesh input = read_mesh(work);
    tools::enter_blank_report(work, input, s);
    tools::write_curves(work, input, s);
    if (s.check) return check_only(work, input);
    const auto output = tools::mesh_output(o, work.path);
    if (s.wrap.size) return tools::wrap(work, input, s.wrap, output);
    std::optional<tools::written_form> form;
    if (output) form = tools::form_of(work, input.file, *output);
    const tf::mesh_file* const inputs = &input.file;
    const tf::precision precision = tools::written_precision(o, form, {&inputs, 1});
    const bool as_one = output && becomes_one(o, *output);
    tf::repaired_file made = mend(work, input, s, precision, as_one);
    tools::enter_repair(work, input, s, made);
    const auto works = [&](const repair_settings& tried) {
        const tf::certificate known = mend(work, input, tried, precision, as_one).certificate;
        return static_cast<bool>(known) || known.status == tf::status::sheet;
    };
    std::string why = tools::objection(s, made, works);
    const std::string too_far = tools::move_objection(
        work.entry["repair"], s.limits, input.diagonal, made.certificate, made.file.mesh.points);
    if (why.empty()) why = too_far;
    if (!why.empty()) {
        work.out.result(work.name + ": not written: " + why);
        tools::write_page(work, input, "not written: " + why, false, made.file.mesh,
                          made.face_source, made.is_kept);
        return tools::found;
    }
    const std::string verdict = tools::verdict(input, made);
    work.out.result(work.name + ": " + verdict);
    tools::warn_of_surprises(work, s, made);
    tools::warn_of_moves(work, made.file.mesh.points, made.certificate);
    tools::write_page(work, input, verdict, true, made.file.mesh, made.face_source, made.is_kept);
    if (output && !o.dry_run) tools::write_solid(work, input, s, made, *output);
    return tools::done;
}

}  // namespace

int main(int argc, char** argv) {
    command_line line("tf-repair", "[OPTIONS] INPUT...",
                      "Repair meshes to solids: closed, oriented, manifold and free of\n"
                      "self-intersections in the file that is written, or report why not.");
    const auto asked = std::make_unique<request>();  // on the stack, GCC 12 sees it uninitialized
    request& r = *asked;
    common_options options;
    options.suffix = "-repaired";
    options.table = {{"faces", "/faces"}, {"faces out", "/repair/faces"}};
    line.inputs(options.inputs, tools::mesh_inputs);
    add_steps(line, r);
    add_options(line, r.settings);
    tools::add_wrapping(line, r.settings.wrap);
    add_outputs(line, r.settings, options);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf"}});
    line.describe(tools::help_text);
    return tools::run(
        line, options, {"read", "prepare", "check", "repair", "write"}, argc, argv,
        [&] { check_request(line, r, options); },
        [&](tools::job& work) { return look_at(work, r.settings); });
}
