#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/wrap.hpp>

#include <tools/c/glue.hpp>
#include <tools/c/inputs.hpp>

#include <limits>

namespace tf = treeform;

namespace {

tf::fill_rule rule(treeform_fill_rule value) {
    return glue::choice<tf::fill_rule>(value, 3, "inside");
}

tf::boolean_options options_of(const treeform_boolean_options* options) {
    const auto o = glue::chosen(options, treeform_boolean_options_init);
    tf::boolean_options how;
    how.inside = rule(o.inside);
    how.precision = glue::precision(o.precision);
    how.max_displacement = o.max_displacement;
    how.keep_cuts = o.keep_cuts != 0;
    how.simplify = o.simplify != 0;
    how.volumes = o.volumes != 0;
    how.face_groups = glue::array(o.face_groups, o.face_group_count, "face_groups");
    how.min_volume = o.min_volume;
    how.gap = o.gap;
    how.progress = glue::progress(o);
    return how;
}

std::vector<tf::mesh_ref> operands_of(const treeform_mesh* const* operands, std::size_t count) {
    std::vector<tf::mesh_ref> result;
    for (const treeform_mesh* one : glue::array(operands, count, "operands"))
        if (glue::need(one, "an operand").one_use)
            result.emplace_back(one->prepared->view());
        else
            result.emplace_back(*one->prepared);
    return result;
}

treeform_code give_solid(tf::boolean_result from, treeform_boolean_result** out) {
    const treeform_code code = glue::code_of(from.certificate);
    auto made = glue::make<treeform_boolean_result>();
    const tf::boolean_result& kept = made->keep(std::move(from));
    treeform_boolean_result& r = made->value;
    r.mesh = glue::arrays(kept.mesh);
    r.face_source = glue::same<treeform_element>(kept.face_source);
    r.vertex_source = glue::same<treeform_element>(kept.vertex_source);
    if (!kept.face_of_cut_vertex.empty())
        r.face_of_cut_vertex = glue::same<treeform_element>(kept.face_of_cut_vertex);
    r.certificate = glue::keep(*made, kept.certificate);
    r.vanished_components = kept.vanished_components;
    r.vanished_reach = kept.vanished_reach;
    r.vanished_at = glue::flat(kept.vanished_at);
    r.vanished_listed = kept.vanished_at.size();
    if (kept.volumes)
        r.volumes = &made->keep(treeform_volumes{kept.volumes->first, kept.volumes->second,
                                                 kept.volumes->either, kept.volumes->both});
    r.pairs = kept.statistics.pairs;
    r.cut_faces = kept.statistics.cut_faces;
    r.degenerate = kept.statistics.degenerate;
    r.skipped_faces = kept.statistics.skipped_faces;
    r.covered = kept.statistics.covered;
    r.exact_faces = kept.statistics.exact_faces;
    r.split_vertices = kept.statistics.split_vertices;
    r.slivers = kept.statistics.slivers;
    r.rounding_rounds = kept.statistics.rounding_rounds;
    r.small_parts = kept.statistics.small_parts;
    r.small_volume = kept.statistics.small_volume;
    r.filled_faces = kept.statistics.filled_faces;
    glue::give(std::move(made), out);
    return code;
}

using binary = tf::boolean_result (*)(const tf::mesh_ref&, const tf::mesh_ref&,
                                      const tf::boolean_options&);

treeform_code combine(binary operation, const treeform_mesh* a, const treeform_mesh* b,
                      const treeform_boolean_options* options, treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const treeform_mesh* const both[] = {a, b};
        const auto operands = operands_of(both, 2);
        return give_solid(operation(operands[0], operands[1], options_of(options)), result);
    });
}

tf::repair_options options_of(const treeform_repair_options* options) {
    const auto o = glue::chosen(options, treeform_repair_options_init);
    tf::repair_options how;
    how.join = o.join != 0;
    how.orient = o.orient != 0;
    how.fill = o.fill != 0;
    how.resolve = o.resolve != 0;
    how.detach = o.detach != 0;
    how.gap = glue::given(o.gap);
    how.largest_hole = o.largest_hole;
    how.strays = o.strays;
    how.inside = glue::choice<tf::repair_rule>(o.inside, 4, "inside");
    how.max_loss = o.max_loss;
    how.sheet = o.sheet != 0;
    how.precision = glue::precision(o.precision);
    how.max_displacement = o.max_displacement;
    how.keep_cuts = o.keep_cuts != 0;
    how.progress = glue::progress(o);
    return how;
}

treeform_repair_statistics statistics_of(const tf::repair_statistics& s) {
    return {s.tetrahedra,
            s.degenerate,
            s.repeated,
            s.closed_edges,
            s.split_edges,
            s.gap,
            s.widest,
            s.flipped,
            s.turned,
            s.strays,
            s.holes,
            s.hole_edges,
            s.filled,
            s.sheets,
            s.open_edges,
            s.resolved,
            s.pairs,
            s.labeled_cells,
            s.dropped_area,
            s.turned_area,
            s.removed,
            s.split_vertices,
            s.detached,
            s.touching,
            s.vanished_components,
            s.dropped_shells,
            s.volume_before,
            s.volume_after,
            s.area_before,
            s.area_after,
            s.area_lost};
}

/// What `repair` and `repair_file` have in common.
template <class Result>
void fill(glue::answer<treeform_repair_result>& made, const Result& kept) {
    treeform_repair_result& r = made.value;
    r.face_source = kept.face_source.data();
    r.is_left = kept.is_left.data();
    r.certificate = glue::keep(made, kept.certificate);
    r.statistics = &made.keep(statistics_of(kept.statistics));
}

tf::repair_scope scope_of(treeform_repair_scope scope) {
    return glue::choice<tf::repair_scope>(scope, 2, "scope");
}

void give_defects(const tf::solid_defects& found, treeform_solid_defects** out) {
    if (found.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_solid_defects>();
    treeform_solid_defects& d = made->value;
    d.any = found.any();
    d.message = made->keep(found.message()).c_str();
    d.nonfinite_vertices = found.nonfinite_vertices;
    d.unusable_faces = found.unusable_faces;
    d.without_faces = found.without_faces;
    d.tetrahedra = found.tetrahedra;
    d.degenerate = found.degenerate;
    d.repeated = found.repeated;
    d.open_edges = found.open_edges;
    d.nonmanifold_edges = found.nonmanifold_edges;
    d.misoriented_edges = found.misoriented_edges;
    d.nonmanifold_vertices = found.nonmanifold_vertices;
    d.meeting_pairs = found.meeting_pairs;
    d.inverted = found.inverted;
    d.wrongly_nested = found.wrongly_nested;
    glue::give(std::move(made), out);
}

}  // namespace

void treeform_boolean_options_init(treeform_boolean_options* options, size_t size) {
    treeform_boolean_options defaults{};
    defaults.precision = TREEFORM_FLOAT64;
    defaults.max_displacement = glue::infinity;
    glue::init(options, size, defaults);
}

treeform_code treeform_boolean(const treeform_mesh* const* operands, size_t count,
                               const char* expression, const treeform_boolean_options* options,
                               treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::boolean_expression formula(&glue::need(expression, "expression"), count);
        return give_solid(tf::boolean(operands_of(operands, count), formula, options_of(options)),
                          result);
    });
}

treeform_code treeform_boolean_named(const treeform_mesh* const* operands, const char* const* names,
                                     size_t count, const char* expression,
                                     const treeform_boolean_options* options,
                                     treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const std::vector<std::string> words = glue::texts(names, count, "names");
        const tf::boolean_expression formula(&glue::need(expression, "expression"), words);
        return give_solid(tf::boolean(operands_of(operands, count), formula, options_of(options)),
                          result);
    });
}

treeform_code treeform_names_in(const char* expression, treeform_strings** names) {
    return glue::guard([&] {
        glue::start(names);
        auto made = glue::make<treeform_strings>();
        const auto& found =
            made->keep(tf::boolean_expression::names_in(&glue::need(expression, "expression")));
        made->value.values = glue::words(*made, found);
        made->value.count = found.size();
        glue::give(std::move(made), names);
    });
}

treeform_code treeform_unite(const treeform_mesh* a, const treeform_mesh* b,
                             const treeform_boolean_options* options,
                             treeform_boolean_result** result) {
    return combine(tf::unite, a, b, options, result);
}

treeform_code treeform_subtract(const treeform_mesh* a, const treeform_mesh* b,
                                const treeform_boolean_options* options,
                                treeform_boolean_result** result) {
    return combine(tf::subtract, a, b, options, result);
}

treeform_code treeform_intersection(const treeform_mesh* a, const treeform_mesh* b,
                                    const treeform_boolean_options* options,
                                    treeform_boolean_result** result) {
    return combine(tf::intersection, a, b, options, result);
}

treeform_code treeform_symmetric_difference(const treeform_mesh* a, const treeform_mesh* b,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result) {
    return combine(tf::symmetric_difference, a, b, options, result);
}

treeform_code treeform_unite_all(const treeform_mesh* const* operands, size_t count,
                                 const treeform_boolean_options* options,
                                 treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return give_solid(tf::boolean(operands_of(operands, count),
                                      tf::boolean_expression::union_of(count), options_of(options)),
                          result);
    });
}

treeform_code treeform_clip(const treeform_mesh* const* operands, size_t count, uint32_t sheet,
                            const char* expression, const treeform_boolean_options* options,
                            treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::boolean_expression formula(&glue::need(expression, "expression"), count);
        return give_solid(
            tf::clip(glue::views(operands, count, "operands"), sheet, formula, options_of(options)),
            result);
    });
}

treeform_code treeform_split(const treeform_mesh* const* operands, size_t count,
                             const treeform_boolean_options* options,
                             treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return give_solid(tf::split(glue::views(operands, count, "operands"), options_of(options)),
                          result);
    });
}

void treeform_resolve_options_init(treeform_resolve_options* options, size_t size) {
    const tf::resolve_options from;
    treeform_resolve_options defaults{};
    defaults.precision = TREEFORM_FLOAT64;
    defaults.max_displacement = from.max_displacement;
    defaults.removal_rounds = from.removal_rounds;
    defaults.max_loss = from.max_loss;
    glue::init(options, size, defaults);
}

treeform_code treeform_resolve_self_intersections(const treeform_mesh* mesh,
                                                  treeform_resolve_mode mode,
                                                  const treeform_resolve_options* options,
                                                  treeform_resolve_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const auto o = glue::chosen(options, treeform_resolve_options_init);
        tf::resolve_options how;
        how.inside = rule(o.inside);
        how.precision = glue::precision(o.precision);
        how.max_displacement = o.max_displacement;
        how.touching = o.touching != 0;
        how.removal_rounds = o.removal_rounds;
        how.max_loss = o.max_loss;
        how.keep_cuts = o.keep_cuts != 0;
        how.progress = glue::progress(o);
        auto made = glue::make<treeform_resolve_result>();
        const tf::resolve_result& kept = made->keep(tf::resolve_self_intersections(
            glue::view(mesh), glue::choice<tf::resolve_mode>(mode, 3, "mode"), how));
        const treeform_code code = glue::code_of(kept.certificate);
        treeform_resolve_result& r = made->value;
        r.mesh = glue::arrays(kept.mesh);
        r.face_source = kept.face_source.data();
        r.vertex_source = kept.vertex_source.data();
        r.certificate = glue::keep(*made, kept.certificate);
        r.vanished_components = kept.vanished_components;
        r.removed = kept.statistics.removed;
        r.covered = kept.statistics.covered;
        r.filled = kept.statistics.filled;
        r.left_open = kept.statistics.left_open;
        r.exact_faces = kept.statistics.exact_faces;
        r.split_vertices = kept.statistics.split_vertices;
        glue::give(std::move(made), result);
        return code;
    });
}

void treeform_repair_options_init(treeform_repair_options* options, size_t size) {
    const tf::repair_options from;
    treeform_repair_options defaults{};
    defaults.join = defaults.orient = defaults.fill = defaults.resolve = defaults.detach = 1;
    defaults.gap = std::numeric_limits<double>::quiet_NaN();
    defaults.largest_hole = from.largest_hole;
    defaults.strays = from.strays;
    defaults.max_loss = from.max_loss;
    defaults.precision = TREEFORM_FLOAT64;
    defaults.max_displacement = from.max_displacement;
    glue::init(options, size, defaults);
}

treeform_code treeform_repair(const treeform_mesh* mesh, const treeform_repair_options* options,
                              treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_repair_result>();
        const tf::repair_result& kept =
            made->keep(tf::repair(glue::view(mesh), options_of(options)));
        const treeform_code code = glue::code_of(kept.certificate);
        fill(*made, kept);
        made->value.mesh = glue::arrays(kept.mesh);
        made->value.vertex_source = kept.vertex_source.data();
        glue::give(std::move(made), result);
        return code;
    });
}

treeform_code treeform_repair_file(const treeform_file* file, treeform_repair_scope scope,
                                   const treeform_repair_options* options,
                                   treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_repair_result>();
        const glue::usable_input input(glue::need(file, "file").content);
        tf::repaired_file& kept =
            made->keep(tf::repair_file(input.source(), options_of(options), scope_of(scope)));
        const treeform_code code = glue::code_of(kept.certificate);
        fill(*made, kept);
        made->value.file = glue::keep(*made, std::move(kept.file));
        made->value.mesh = glue::arrays(made->value.file->content.mesh);
        glue::give(std::move(made), result);
        return code;
    });
}

treeform_code treeform_find_solid_defects(const treeform_mesh* mesh, treeform_progress progress,
                                          void* progress_data, treeform_solid_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        give_defects(
            tf::find_solid_defects(glue::view(mesh), glue::progress(progress, progress_data)),
            defects);
    });
}

treeform_code treeform_find_solid_defects_of_file(const treeform_file* file,
                                                  treeform_repair_scope scope,
                                                  treeform_progress progress, void* progress_data,
                                                  treeform_solid_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        const glue::usable_input input(glue::need(file, "file").content);
        tf::solid_defects found = tf::find_solid_defects(input.source(), scope_of(scope),
                                                         glue::progress(progress, progress_data));
        found.unusable_faces += input.dropped();
        give_defects(found, defects);
    });
}

void treeform_wrap_options_init(treeform_wrap_options* options, size_t size) {
    treeform_wrap_options defaults{};
    defaults.offset = std::numeric_limits<double>::quiet_NaN();
    defaults.precision = TREEFORM_FLOAT64;
    glue::init(options, size, defaults);
}

treeform_code treeform_wrap(const treeform_mesh* mesh, double size,
                            const treeform_wrap_options* options, treeform_wrap_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const auto o = glue::chosen(options, treeform_wrap_options_init);
        tf::wrap_options how;
        how.offset = glue::given(o.offset);
        how.precision = glue::precision(o.precision);
        how.progress = glue::progress(o);
        auto made = glue::make<treeform_wrap_result>();
        const tf::wrap_result& kept = made->keep(tf::wrap(glue::view(mesh), size, how));
        const treeform_code code = glue::code_of(kept.certificate);
        treeform_wrap_result& r = made->value;
        r.mesh = glue::arrays(kept.mesh);
        r.certificate = glue::keep(*made, kept.certificate);
        r.size = kept.statistics.size;
        r.offset = kept.statistics.offset;
        r.area = kept.statistics.area;
        r.points = kept.statistics.points;
        r.tetrahedra = kept.statistics.tetrahedra;
        r.filled = kept.statistics.filled;
        glue::give(std::move(made), result);
        return code;
    });
}
