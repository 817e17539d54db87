// Made by tools/bindings of solids.h and the headers of C++: see its README.
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/repair.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/solids.hpp>

namespace tf = treeform;

static_assert(TREEFORM_NONZERO == static_cast<int>(tf::fill_rule::nonzero));
static_assert(TREEFORM_ODD == static_cast<int>(tf::fill_rule::odd));
static_assert(TREEFORM_POSITIVE == static_cast<int>(tf::fill_rule::positive));
static_assert(TREEFORM_RESOLVE_SPLIT == static_cast<int>(tf::resolve_mode::split));
static_assert(TREEFORM_RESOLVE_OUTER == static_cast<int>(tf::resolve_mode::outer));
static_assert(TREEFORM_RESOLVE_REMOVE == static_cast<int>(tf::resolve_mode::remove));

tf::boolean_options glue::read(const treeform_boolean_options* options) {
    return read(chosen(options, treeform_boolean_options_init));
}
tf::boolean_options glue::read(const treeform_boolean_options& o) {
    tf::boolean_options how;
    how.inside = choice<tf::fill_rule>(o.inside, 3, "inside");
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.max_displacement = o.max_displacement;
    how.keep_cuts = o.keep_cuts != 0;
    how.simplify = o.simplify != 0;
    how.face_groups = array(o.face_groups, o.face_group_count, "face_groups");

    how.volumes = o.volumes != 0;
    how.min_volume = o.min_volume;
    how.gap = o.gap;
    how.progress = progress(o);

    return how;
}

void treeform_boolean_options_init(treeform_boolean_options* options, size_t size) {
    treeform_boolean_options to{};
    const tf::boolean_options from;
    to.inside = static_cast<treeform_fill_rule>(from.inside);
    to.precision = static_cast<treeform_precision>(from.precision);
    to.max_displacement = from.max_displacement;
    to.keep_cuts = from.keep_cuts;
    to.simplify = from.simplify;
    to.volumes = from.volumes;
    to.min_volume = from.min_volume;
    to.gap = from.gap;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::operand_volumes& from, treeform_volumes& to) {
    to.first = from.first;
    to.second = from.second;
    to.either = from.either;
    to.both = from.both;
}

void glue::fill(keeper& kept, const tf::boolean_result& from, treeform_boolean_result& to) {
    to.mesh = arrays(from.mesh);
    to.face_source = same<treeform_element>(from.face_source);
    to.vertex_source = same<treeform_element>(from.vertex_source);
    to.face_of_cut_vertex = same<treeform_element>(from.face_of_cut_vertex);
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.vanished_components = from.vanished_components;
    to.vanished_reach = from.vanished_reach;
    to.vanished_at = flat(from.vanished_at);
    to.vanished_listed = from.vanished_at.size();
    if (from.volumes) to.volumes = &filled<treeform_volumes>(kept, *from.volumes);
    to.pairs = from.statistics.pairs;
    to.cut_faces = from.statistics.cut_faces;
    to.degenerate = from.statistics.degenerate;
    to.skipped_faces = from.statistics.skipped_faces;
    to.covered = from.statistics.covered;
    to.exact_faces = from.statistics.exact_faces;
    to.split_vertices = from.statistics.split_vertices;
    to.slivers = from.statistics.slivers;
    to.rounding_rounds = from.statistics.rounding_rounds;
    to.small_parts = from.statistics.small_parts;
    to.small_volume = from.statistics.small_volume;
    to.filled_faces = from.statistics.filled_faces;
}

tf::resolve_options glue::read(const treeform_resolve_options* options) {
    return read(chosen(options, treeform_resolve_options_init));
}
tf::resolve_options glue::read(const treeform_resolve_options& o) {
    tf::resolve_options how;
    how.inside = choice<tf::fill_rule>(o.inside, 3, "inside");
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.max_displacement = o.max_displacement;
    how.keep_cuts = o.keep_cuts != 0;
    how.touching = o.touching != 0;
    how.removal_rounds = o.removal_rounds;
    how.max_loss = o.max_loss;
    how.progress = progress(o);

    return how;
}

void treeform_resolve_options_init(treeform_resolve_options* options, size_t size) {
    treeform_resolve_options to{};
    const tf::resolve_options from;
    to.inside = static_cast<treeform_fill_rule>(from.inside);
    to.precision = static_cast<treeform_precision>(from.precision);
    to.max_displacement = from.max_displacement;
    to.keep_cuts = from.keep_cuts;
    to.touching = from.touching;
    to.removal_rounds = from.removal_rounds;
    to.max_loss = from.max_loss;
    glue::init(options, size, to);
}

tf::repair_options glue::read(const treeform_repair_options* options) {
    return read(chosen(options, treeform_repair_options_init));
}
tf::repair_options glue::read(const treeform_repair_options& o) {
    tf::repair_options how;
    how.join = o.join != 0;
    how.orient = o.orient != 0;
    how.fill = o.fill != 0;
    how.resolve = o.resolve != 0;
    how.detach = o.detach != 0;
    how.gap = given(o.gap);
    how.largest_hole = o.largest_hole;
    how.strays = o.strays;
    if (o.inside != -1) how.inside = choice<tf::fill_rule>(o.inside, 3, "inside");
    how.max_loss = o.max_loss;
    how.sheet = o.sheet != 0;
    how.as_one = o.as_one != 0;
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.max_displacement = o.max_displacement;
    how.keep_cuts = o.keep_cuts != 0;
    how.progress = progress(o);

    return how;
}

void treeform_repair_options_init(treeform_repair_options* options, size_t size) {
    treeform_repair_options to{};
    const tf::repair_options from;
    using namespace glue;
    to.join = from.join;
    to.orient = from.orient;
    to.fill = from.fill;
    to.resolve = from.resolve;
    to.detach = from.detach;
    to.gap = not_known;
    to.largest_hole = from.largest_hole;
    to.strays = from.strays;
    to.inside = -1;
    to.max_loss = from.max_loss;
    to.sheet = from.sheet;
    to.as_one = from.as_one;
    to.precision = static_cast<treeform_precision>(from.precision);
    to.max_displacement = from.max_displacement;
    to.keep_cuts = from.keep_cuts;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::repair_statistics& from, treeform_repair_statistics& to) {
    to.tetrahedra = from.tetrahedra;
    to.degenerate = from.degenerate;
    to.repeated = from.repeated;
    to.closed_edges = from.closed_edges;
    to.split_edges = from.split_edges;
    to.gap_limit = from.gap_limit;
    to.widest_closed = from.widest_closed;
    to.flipped = from.flipped;
    to.turned_outward = from.turned_outward;
    to.strays = from.strays;
    to.holes = from.holes;
    to.hole_edges = from.hole_edges;
    to.filled = from.filled;
    to.sheets = from.sheets;
    to.open_edges = from.open_edges;
    to.resolved = from.resolved;
    to.pairs = from.pairs;
    to.labeled_cells = from.labeled_cells;
    to.dropped_area = from.dropped_area;
    to.flipped_area = from.flipped_area;
    to.removed = from.removed;
    to.covered = from.covered;
    to.left_open = from.left_open;
    to.exact_faces = from.exact_faces;
    to.split_vertices = from.split_vertices;
    to.detached = from.detached;
    to.touching = from.touching;
    to.vanished_components = from.vanished_components;
    to.dropped_shells = from.dropped_shells;
    to.volume_before = from.volume_before;
    to.volume_after = from.volume_after;
    to.area_before = from.area_before;
    to.area_after = from.area_after;
    to.area_lost = from.area_lost;
}

void glue::fill(keeper& kept, const tf::repair_result& from, treeform_repair_result& to) {
    to.mesh = arrays(from.mesh);
    to.face_source = or_null(from.face_source);
    to.vertex_source = or_null(from.vertex_source);
    to.is_left = or_null(from.is_left);
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.statistics = &filled<treeform_repair_statistics>(kept, from.statistics);
}

void glue::fill(keeper& kept, const tf::repaired_file& from, treeform_repair_result& to) {
    to.face_source = or_null(from.face_source);
    to.is_left = or_null(from.is_left);
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.statistics = &filled<treeform_repair_statistics>(kept, from.statistics);
}

void glue::fill(keeper& kept, const tf::solid_defects& from, treeform_solid_defects& to) {
    to.nonfinite_vertices = from.nonfinite_vertices;
    to.unusable_faces = from.unusable_faces;
    to.without_faces = from.without_faces;
    to.tetrahedra = from.tetrahedra;
    to.degenerate = from.degenerate;
    to.repeated = from.repeated;
    to.open_edges = from.open_edges;
    to.nonmanifold_edges = from.nonmanifold_edges;
    to.misoriented_edges = from.misoriented_edges;
    to.nonmanifold_vertices = from.nonmanifold_vertices;
    to.meeting_pairs = from.meeting_pairs;
    to.inverted = from.inverted;
    to.wrongly_nested = from.wrongly_nested;
    to.any = from.any();
    to.message = kept.keep(from.message()).c_str();
}

treeform_code treeform_boolean(const treeform_mesh* const* operands, size_t count,
                               const char* expression, const treeform_boolean_options* options,
                               treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            glue::boolean(glue::refs(operands, count, "operands"),
                          std::string(&glue::need(expression, "expression")), glue::read(options)),
            result);
    });
}

treeform_code treeform_boolean_named(const treeform_mesh* const* operands, const char* const* names,
                                     size_t count, const char* expression,
                                     const treeform_boolean_options* options,
                                     treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::boolean_named(operands, names, count,
                                              std::string(&glue::need(expression, "expression")),
                                              glue::read(options)),
                          result);
    });
}

treeform_code treeform_names_in(const char* expression, treeform_strings** strings) {
    return glue::guard([&] {
        glue::start(strings);
        return glue::give(glue::names_in(std::string(&glue::need(expression, "expression"))),
                          strings);
    });
}

treeform_code treeform_unite(const treeform_mesh* a, const treeform_mesh* b,
                             const treeform_boolean_options* options,
                             treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::unite(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_subtract(const treeform_mesh* a, const treeform_mesh* b,
                                const treeform_boolean_options* options,
                                treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::subtract(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_intersection(const treeform_mesh* a, const treeform_mesh* b,
                                    const treeform_boolean_options* options,
                                    treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::intersection(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)), result);
    });
}

treeform_code treeform_symmetric_difference(const treeform_mesh* a, const treeform_mesh* b,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::symmetric_difference(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)),
            result);
    });
}

treeform_code treeform_unite_all(const treeform_mesh* const* operands, size_t count,
                                 const treeform_boolean_options* options,
                                 treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            glue::unite_all(glue::refs(operands, count, "operands"), glue::read(options)), result);
    });
}

treeform_code treeform_clip(const treeform_mesh* const* operands, size_t count, uint32_t sheet,
                            const char* expression, const treeform_boolean_options* options,
                            treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            glue::clip(glue::refs(operands, count, "operands"), sheet,
                       std::string(&glue::need(expression, "expression")), glue::read(options)),
            result);
    });
}

treeform_code treeform_split(const treeform_mesh* const* operands, size_t count,
                             const treeform_boolean_options* options,
                             treeform_boolean_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::split(glue::refs(operands, count, "operands"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_resolve_self_intersections(const treeform_mesh* mesh,
                                                  treeform_resolve_mode mode,
                                                  const treeform_resolve_options* options,
                                                  treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::resolve_self_intersections(
                              glue::ref(mesh, "mesh"),
                              glue::choice<tf::resolve_mode>(mode, 3, "mode"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_repair(const treeform_mesh* mesh, const treeform_repair_options* options,
                              treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::repair(glue::ref(mesh, "mesh"), glue::read(options)), result);
    });
}

treeform_code treeform_repair_file(const treeform_file* file,
                                   const treeform_repair_options* options,
                                   treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::repair_file(glue::content(file, "file"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_find_solid_defects(const treeform_mesh* mesh, treeform_progress progress,
                                          void* progress_data, treeform_solid_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        return glue::give(tf::find_solid_defects(glue::ref(mesh, "mesh"),
                                                 glue::progress(progress, progress_data)),
                          defects);
    });
}

treeform_code treeform_find_solid_defects_of_file(const treeform_file* file,
                                                  treeform_progress progress, void* progress_data,
                                                  treeform_solid_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        return glue::give(glue::find_solid_defects_of_file(glue::content(file, "file"),
                                                           glue::progress(progress, progress_data)),
                          defects);
    });
}
