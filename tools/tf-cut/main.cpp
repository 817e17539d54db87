/// \file
/// tf-cut: sections, halves and pieces of meshes by planes; their parts; what they are.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace {

using tools::command_line;
using tools::common_options;
using tools::cut_mode;
using tools::cut_off;
using tools::cut_settings;
using tools::exit_status;
using tools::refuse;
using tools::usable_input;

std::vector<cut_off> parts_of(const usable_input& input, const cut_settings& s) {
    std::vector<cut_off> parts;
    for (tf::mesh_part& part : tf::components(input.file.mesh, s.parts.min_volume, s.parts.largest))
        parts.push_back(tools::cut_off_of(std::move(part.mesh), std::move(part.face_source),
                                          std::move(part.vertex_source),
                                          {.precision = input.file.stored_as}));
    return parts;
}

std::vector<cut_off> pieces_of(tf::cut_result&& made, const cut_settings& s) {
    std::vector<cut_off> pieces;
    for (std::size_t i = 0; i < made.pieces.size(); ++i) {
        if (s.keeps_one() && (i == 0) != (s.keep == tools::kept_half::below)) continue;
        tf::cut_piece& piece = made.pieces[i];
        if (piece.mesh.faces.empty() && !s.keeps_one()) continue;
        cut_off& one = pieces.emplace_back(
            tools::cut_off_of(std::move(piece.mesh), std::move(piece.face_source),
                              std::move(piece.vertex_source), std::move(piece.certificate)));
        one.cap = std::move(piece.cap);
    }
    return pieces;
}

/// Of the coordinates written.
tf::precision precision_of(tools::job& work, const usable_input& input) {
    std::optional<tools::written_form> form;
    if (const auto output = tools::mesh_output(work.options, work.path))
        form = tools::form_of(work, input.file, *output);
    const tf::mesh_file* const files = &input.file;
    return tools::written_precision(work.options, form, {&files, 1});
}

tf::cut_result cut(tools::job& work, const usable_input& input, const cut_settings& s) {
    const auto timing = work.time("cut");
    const tf::attribute_source source = input.source();
    const tf::cut_options options{.precision = precision_of(work, input),
                                  .caps = !s.open,
                                  .keep_cuts = tf::attribute_sources(source).merging_mixes_values(),
                                  .progress = work.progress("cut")};
    tf::cut_result made = tools::suitable(s.bed ? "--bed" : "--height", [&] {
        return s.bed ? tf::cut_to_fit(input.file.mesh, *s.bed, options)
                     : tf::cut(input.file.mesh, s.plane, s.heights, options);
    });
    work.call_ended(made.certificate.status == tf::status::cancelled);
    return made;
}

exit_status not_made(tools::job& work, const cut_settings& s, const usable_input& input,
                     const tf::certificate& why) {
    work.out.result(work.name + ": not made: " + tools::message_of(why, [&](std::uint32_t f) {
                        return input.source().face_in_file(f);
                    }));
    if (why.status == tf::status::open_input)
        work.warn("no-solid",
                  "the input bounds no solid; tf-repair may make one, and thicken takes any "
                  "surface");
    if (why.status == tf::status::vanished)
        work.warn("too-thin",
                  s.mode == cut_mode::hollow
                      ? "there is no cavity: the solid is nowhere thicker than two walls"
                      : "the solid is too thin: shrunk by this distance, it is less than a cell "
                        "thick");
    return tools::found;
}

/// Of numbered outputs, at least the first is known before the cut.
void check_outputs(tools::job& work, const cut_settings& s) {
    tools::check_outputs(work, {}, {s.output});
    if (work.options.dry_run) return;
    for (const auto& path : {s.output, tools::mesh_output(work.options, work.path).value_or("")})
        static_cast<void>(tools::numbered_paths(work, path, 1));
}

exit_status look_at(tools::job& work, const cut_settings& s) {
    check_outputs(work, s);
    const usable_input input = tools::read_usable(work);
    tools::enter_blank_report(work, s, input);
    if (s.mode == cut_mode::section) return tools::make_section(work, input, s);
    if (s.mode == cut_mode::isolines) return tools::make_isolines(work, input, s);
    if (s.mode == cut_mode::info) {
        tools::say_info(work, s, input);
        tools::write_page(work, input, "info", true, {}, nullptr);
        return tools::done;
    }
    std::vector<cut_off> pieces;
    if (s.mode == cut_mode::parts) {
        const auto timing = work.time("cut");
        pieces = parts_of(input, s);
    } else if (s.mode > cut_mode::info) {
        pieces.push_back(tools::suitable(tools::option_of(s.mode), [&] {
            return tools::shape_of(work, s, input, precision_of(work, input));
        }));
        if (!pieces[0].certificate) return not_made(work, s, input, pieces[0].certificate);
    } else {
        tf::cut_result made = cut(work, input, s);
        if (!made.certificate) {
            const std::string why = tools::message_of(
                made.certificate, [&](std::uint32_t f) { return input.source().face_in_file(f); });
            work.out.result(work.name + ": not cut: " + why);
            if (made.certificate.status == tf::status::open_input)
                work.warn("no-solid",
                          "the input bounds no solid; tf-repair may make one, and "
                          "--open cuts it as a surface");
            tools::write_page(work, input, "not cut: " + why, false, {}, nullptr);
            return tools::found;
        }
        if (made.resolved)
            work.warn("self-intersections",
                      s.open ? "the mesh has self-intersections: its faces are cut along "
                               "each other first"
                             : "the mesh has self-intersections: overlapping parts are "
                               "merged before the cut");
        pieces = pieces_of(std::move(made), s);
        const auto furthest = std::ranges::max_element(
            pieces, {}, [](const cut_off& piece) { return piece.certificate.max_displacement; });
        if (furthest != pieces.end()) {
            const std::string too_far =
                tools::move_objection(work.entry, s.limits, tools::diagonal_of(input),
                                      furthest->certificate, furthest->mesh.points);
            if (!too_far.empty()) {
                work.out.result(work.name + ": not written: " + too_far);
                return tools::found;
            }
            tools::warn_of_moves(work, furthest->mesh.points, furthest->certificate);
        }
    }
    tools::say_pieces(work, s, input, pieces);
    tools::write_page(work, input, s.mode_text, true, pieces, nullptr);
    if (!pieces.empty()) tools::write_pieces(work, s, input, pieces);
    return tools::done;
}

}  // namespace

int main(int argc, char** argv) {
    command_line line(
        "tf-cut", "MODE [OPTIONS] INPUT...",
        "Cut meshes by planes: sections, halves, pieces for a printer; extract their\n"
        "parts, and measure them. Sides of planes and loops are decided exactly.");
    cut_settings s;
    common_options options;
    options.suffix = "-cut";
    options.table = {{"faces", "/faces"},
                     {"solid", "/info/solid", false},
                     {"components", "/info/components"},
                     {"area", "/info/area"},
                     {"volume", "/info/volume"},
                     {"thinnest wall", "/info/thinnest/thickness", false}};
    line.word("MODE", [&](std::string_view text) { s.mode_text = text; });
    line.inputs(options.inputs, tools::mesh_inputs);
    tools::add_settings(line, s);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf"}});
    line.offer("--output", {"ply", "obj", "stl", "off", "glb", "3mf", "svg", "dxf", "json"});
    return tools::run(
        line, options, {"read", "prepare", "check", "cut", "write"}, argc, argv,
        [&] { tools::check_request(line, s, options); },
        [&](tools::job& work) { return look_at(work, s); });
}
