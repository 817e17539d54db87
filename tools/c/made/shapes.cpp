// Made by tools/bindings of shapes.h and the headers of C++: see its README.
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/simplify.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/shapes.hpp>

namespace tf = treeform;

static_assert(TREEFORM_THICKNESS_BY_RAY == static_cast<int>(tf::thickness_by::ray));
static_assert(TREEFORM_THICKNESS_BY_SPHERE == static_cast<int>(tf::thickness_by::sphere));

tf::offset_options glue::read(const treeform_offset_options* options) {
    return read(chosen(options, treeform_offset_options_init));
}
tf::offset_options glue::read(const treeform_offset_options& o) {
    tf::offset_options how;
    how.resolution = given(o.resolution);
    how.offset = given(o.offset);
    how.shift = o.shift;
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.progress = progress(o);

    return how;
}

void treeform_offset_options_init(treeform_offset_options* options, size_t size) {
    treeform_offset_options to{};
    const tf::offset_options from;
    using namespace glue;
    to.resolution = not_known;
    to.offset = not_known;
    to.shift = from.shift;
    to.precision = static_cast<treeform_precision>(from.precision);
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::offset_result& from, treeform_offset_result& to) {
    to.mesh = arrays(from.mesh);
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.distance = from.distance;
    to.resolution = from.resolution;
    to.least_distance = from.least_distance;
    to.greatest_distance = from.greatest_distance;
    to.cells = from.cells;
    to.sealed_cavities = from.sealed_cavities;
    to.blind_drains = or_null(from.blind_drains);
    to.blind_drain_count = from.blind_drains.size();
    to.tetrahedra = from.tetrahedra;
    to.tetrahedra_points = from.tetrahedra_points;
    to.filled_tetrahedra = from.filled_tetrahedra;
}

tf::simplify_options glue::read(const treeform_simplify_options* options) {
    return read(chosen(options, treeform_simplify_options_init));
}
tf::simplify_options glue::read(const treeform_simplify_options& o) {
    tf::simplify_options how;
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.target_faces = limit(o.target_faces);
    how.feature_angle = o.feature_angle;
    how.face_groups = array(o.face_groups, o.face_group_count, "face_groups");

    how.corner_groups = array(o.corner_groups, o.corner_group_count, "corner_groups");

    how.progress = progress(o);

    return how;
}

void treeform_simplify_options_init(treeform_simplify_options* options, size_t size) {
    treeform_simplify_options to{};
    const tf::simplify_options from;
    to.precision = static_cast<treeform_precision>(from.precision);
    to.target_faces = from.target_faces;
    to.feature_angle = from.feature_angle;
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::simplify_result& from, treeform_simplify_result& to) {
    to.mesh = arrays(from.mesh);
    to.face_source = or_null(from.face_source);
    to.vertex_source = or_null(from.vertex_source);
    to.face_of_new_vertex = or_null(from.face_of_new_vertex);
    to.corner_source = or_null(from.corner_source);
    to.collapses = from.collapses;
    to.refused_by_topology = from.refused_by_topology;
    to.refused_by_turning = from.refused_by_turning;
    to.refused_by_distance = from.refused_by_distance;
    to.refused_by_contact = from.refused_by_contact;
    to.input_to_result_bound = from.input_to_result_bound;
    to.result_to_input_bound = from.result_to_input_bound;
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
}

void glue::fill(keeper&, const tf::thickness_result& from, treeform_thickness_result& to) {
    to.of_face = or_null(from.of_face);
    to.least = from.least;
    to.thinnest = from.thinnest;
}

void glue::fill(keeper&, const tf::oriented_box& from, treeform_oriented_box& to) {
    copy(from.center, to.center);
    std::memcpy(to.axes, from.axes.data(), sizeof to.axes);
    copy(from.size, to.size);
}

static_assert(sizeof(treeform_isoline) == sizeof(tf::isoline));
static_assert(offsetof(treeform_isoline, level) == offsetof(tf::isoline, level));
static_assert(offsetof(treeform_isoline, first_point) == offsetof(tf::isoline, first_point));
static_assert(offsetof(treeform_isoline, point_count) == offsetof(tf::isoline, point_count));
static_assert(offsetof(treeform_isoline, closed) == offsetof(tf::isoline, closed));
static_assert(offsetof(treeform_isoline, oriented) == offsetof(tf::isoline, oriented));
static_assert(offsetof(treeform_isoline, length) == offsetof(tf::isoline, length));

void glue::fill(keeper&, const tf::isolines_result& from, treeform_isolines_result& to) {
    to.lines = same<treeform_isoline>(from.lines);
    to.line_count = from.lines.size();
    to.points = flat(from.points);
    to.point_count = from.points.size();
    to.faces = or_null(from.faces);
}

treeform_code treeform_wrap(const treeform_mesh* mesh, double size,
                            const treeform_offset_options* options,
                            treeform_offset_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::wrap(glue::ref(mesh, "mesh"), size, glue::read(options)), result);
    });
}

treeform_code treeform_offset(const treeform_mesh* mesh, double distance,
                              const treeform_offset_options* options,
                              treeform_offset_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::offset(glue::ref(mesh, "mesh"), distance, glue::read(options)),
                          result);
    });
}

treeform_code treeform_hollow(const treeform_mesh* mesh, double wall, const double* drains,
                              size_t count, const treeform_offset_options* options,
                              treeform_offset_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::hollow(glue::ref(mesh, "mesh"), wall,
                       glue::points_and_numbers(drains, count, "drains"), glue::read(options)),
            result);
    });
}

treeform_code treeform_thicken(const treeform_mesh* mesh, double thickness,
                               const treeform_offset_options* options,
                               treeform_offset_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::thicken(glue::ref(mesh, "mesh"), thickness, glue::read(options)),
                          result);
    });
}

treeform_code treeform_simplify(const treeform_mesh* mesh, double max_distance,
                                const treeform_simplify_options* options,
                                treeform_simplify_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::simplify(glue::ref(mesh, "mesh"), max_distance, glue::read(options)),
                          result);
    });
}

treeform_code treeform_wall_thickness(const treeform_mesh* mesh, treeform_thickness_by by,
                                      treeform_progress progress, void* progress_data,
                                      treeform_thickness_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::wall_thickness(glue::ref(mesh, "mesh"), glue::choice<tf::thickness_by>(by, 2, "by"),
                               glue::progress(progress, progress_data)),
            result);
    });
}

treeform_code treeform_find_oriented_box(const treeform_mesh* mesh, treeform_oriented_box** box) {
    return glue::guard([&] {
        glue::start(box);
        return glue::give(tf::find_oriented_box(glue::view(mesh).points), box);
    });
}

treeform_code treeform_isolines(const treeform_mesh* mesh, const double* values,
                                const double* levels, size_t count, treeform_progress progress,
                                void* progress_data, treeform_isolines_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            glue::isolines(glue::ref(mesh, "mesh"), values, glue::array(levels, count, "levels"),
                           glue::progress(progress, progress_data)),
            result);
    });
}

treeform_code treeform_write_isolines(const char* path, const treeform_isolines_result* lines,
                                      const double normal[3], const char* format,
                                      const char* unit) {
    return glue::guard([&] {
        glue::write_isolines(std::string(&glue::need(path, "path")), lines, normal,
                             glue::text(format), glue::text(unit));
    });
}

treeform_code treeform_cut_along(const treeform_mesh* mesh, const double* values,
                                 const double* levels, size_t count,
                                 const treeform_cut_options* options,
                                 treeform_cut_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            glue::cut_along(glue::ref(mesh, "mesh"), values, glue::array(levels, count, "levels"),
                            glue::read(options)),
            result);
    });
}
