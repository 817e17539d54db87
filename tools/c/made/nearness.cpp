// Made by tools/bindings of nearness.h and the headers of C++: see its README.
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/measure.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/nearness.hpp>

namespace tf = treeform;

static_assert(TREEFORM_OUTSIDE == static_cast<int>(tf::location::outside));
static_assert(TREEFORM_INSIDE == static_cast<int>(tf::location::inside));
static_assert(TREEFORM_BOUNDARY == static_cast<int>(tf::location::boundary));
static_assert(TREEFORM_SEPARATE == static_cast<int>(tf::mesh_relation::separate));
static_assert(TREEFORM_MEETING == static_cast<int>(tf::mesh_relation::touching));
static_assert(TREEFORM_PENETRATING == static_cast<int>(tf::mesh_relation::penetrating));
static_assert(TREEFORM_TOO_CLOSE == static_cast<int>(tf::mesh_relation::closer_than_clearance));
static_assert(TREEFORM_CLEAR == static_cast<int>(tf::mesh_relation::clear));

static_assert(sizeof(treeform_hit) == sizeof(tf::mesh_hit));
static_assert(offsetof(treeform_hit, face) == offsetof(tf::mesh_hit, face));
static_assert(offsetof(treeform_hit, at) == offsetof(tf::mesh_hit, at));
static_assert(offsetof(treeform_hit, coplanar) == offsetof(tf::mesh_hit, coplanar));
static_assert(offsetof(treeform_hit, t) == offsetof(tf::mesh_hit, t));
static_assert(offsetof(treeform_hit, t_end) == offsetof(tf::mesh_hit, t_end));

tf::measure_options glue::read(const treeform_measure_options* options) {
    return read(chosen(options, treeform_measure_options_init));
}
tf::measure_options glue::read(const treeform_measure_options& o) {
    tf::measure_options how;
    how.radius = o.radius;
    how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.directions = limit(o.directions);
    how.effort = o.effort;
    how.progress = progress(o);

    return how;
}

void treeform_measure_options_init(treeform_measure_options* options, size_t size) {
    treeform_measure_options to{};
    const tf::measure_options from;
    to.radius = from.radius;
    to.vertices = static_cast<treeform_vertices>(from.vertices);
    to.directions = from.directions;
    to.effort = from.effort;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::mesh_measure& from, treeform_relation& to) {
    to.how = static_cast<treeform_mesh_relation>(from.relation);
    to.face_a = from.face_a;
    to.face_b = from.face_b;
    to.a_inside_b = from.a_inside_b;
    to.b_inside_a = from.b_inside_a;
    to.distance = from.distance;
    to.surface_distance = from.surface_distance;
    to.nearest_a = from.on_a.face;
    copy(from.on_a.point, to.on_a);
    std::copy(from.on_a.barycentric.begin(), from.on_a.barycentric.end(), to.barycentric_a);
    to.nearest_b = from.on_b.face;
    copy(from.on_b.point, to.on_b);
    std::copy(from.on_b.barycentric.begin(), from.on_b.barycentric.end(), to.barycentric_b);
}

tf::deviation_options glue::read(const treeform_deviation_options* options) {
    return read(chosen(options, treeform_deviation_options_init));
}
tf::deviation_options glue::read(const treeform_deviation_options& o) {
    tf::deviation_options how;
    if (!std::isnan(o.band_low) || !std::isnan(o.band_high)) how.band = {o.band_low, o.band_high};

    how.bins = limit(o.bins);
    how.both_ways = o.both_ways != 0;
    how.progress = progress(o);

    return how;
}

void treeform_deviation_options_init(treeform_deviation_options* options, size_t size) {
    treeform_deviation_options to{};
    const tf::deviation_options from;
    using namespace glue;
    to.band_low = not_known;
    to.band_high = not_known;
    to.bins = from.bins;
    to.both_ways = from.both_ways;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::deviation_result& from, treeform_deviation_result& to) {
    to.distances = or_null(from.distances);
    to.count = from.distances.size();
    to.faces = or_null(from.faces);
    to.is_signed = from.is_signed;
    if (from.side_counts)
        std::copy(from.side_counts->begin(), from.side_counts->end(), to.side_counts);
    to.mean = from.mean;
    to.mean_absolute = from.mean_absolute;
    to.rms = from.rms;
    to.p50 = from.p50;
    to.p95 = from.p95;
    to.p99 = from.p99;
    to.max = from.max;
    to.worst = from.worst;
    to.lowest = from.lowest;
    to.highest = from.highest;
    to.max_bound = from.max_bound;
    to.back_max = from.back_max.value_or(not_known);
    to.back_max_bound = from.back_max_bound.value_or(not_known);
    to.histogram = or_null(from.histogram);
    to.bins = from.histogram.size();
    if (from.band_counts)
        std::copy(from.band_counts->begin(), from.band_counts->end(), to.band_counts);
}

treeform_code treeform_closest_point(const treeform_mesh* mesh, const double* queries, size_t count,
                                     double radius, uint32_t* faces, double* distances,
                                     double* points) {
    return glue::guard(
        [&] { glue::closest_point(mesh, queries, count, radius, faces, distances, points); });
}

treeform_code treeform_closest_points(const treeform_mesh* a, const treeform_mesh* b,
                                      const double* move_a, const double* move_b, double radius,
                                      treeform_closest* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::closest_points(glue::ref(a, "a"), glue::ref(b, "b"), glue::matrix(move_a),
                                       glue::matrix(move_b), radius);
    });
}

treeform_code treeform_distance(const treeform_mesh* a, const treeform_mesh* b,
                                const double* move_a, const double* move_b, double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::distance(glue::ref(a, "a"), glue::ref(b, "b"), glue::matrix(move_a),
                                 glue::matrix(move_b));
    });
}

treeform_code treeform_distance_poses(const treeform_mesh* a, const treeform_mesh* b,
                                      const double* moves_a, const double* moves_b, size_t count,
                                      double radius, double* distances) {
    return glue::guard(
        [&] { glue::distance_poses(a, b, moves_a, moves_b, count, radius, distances); });
}

treeform_code treeform_locate(const treeform_mesh* mesh, const double* points, size_t count,
                              uint8_t* where, int32_t* winding, uint32_t* on) {
    return glue::guard([&] { glue::locate(mesh, points, count, where, winding, on); });
}

treeform_code treeform_contains(const treeform_mesh* mesh, const double* points, size_t count,
                                uint8_t* inside) {
    return glue::guard([&] { glue::contains(mesh, points, count, inside); });
}

treeform_code treeform_winding_number(const treeform_mesh* mesh, const double* points, size_t count,
                                      int32_t* winding) {
    return glue::guard([&] { glue::winding_number(mesh, points, count, winding); });
}

treeform_code treeform_locate_in_curves(const double* points, size_t point_count,
                                        const uint32_t* edges, size_t edge_count,
                                        const double* queries, size_t count, uint8_t* where,
                                        int32_t* winding) {
    return glue::guard([&] {
        glue::locate_in_curves(points, point_count, edges, edge_count, queries, count, where,
                               winding);
    });
}

treeform_code treeform_raycast(const treeform_mesh* mesh, const treeform_ray* rays, size_t count,
                               treeform_hit* hits) {
    return glue::guard([&] { glue::raycast(mesh, rays, count, hits); });
}

treeform_code treeform_raycast_any(const treeform_mesh* mesh, const treeform_ray* rays,
                                   size_t count, uint8_t* hit) {
    return glue::guard([&] { glue::raycast_any(mesh, rays, count, hit); });
}

treeform_code treeform_raycast_all(const treeform_mesh* mesh, const treeform_ray* rays,
                                   size_t count, treeform_hits** hits) {
    return glue::guard([&] {
        glue::start(hits);
        return glue::give(glue::raycast_all(mesh, rays, count), hits);
    });
}

treeform_code treeform_measure(const treeform_mesh* a, const treeform_mesh* b,
                               const treeform_measure_options* options,
                               treeform_relation** relation) {
    return glue::guard([&] {
        glue::start(relation);
        return glue::give(tf::measure(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)),
                          relation);
    });
}

treeform_code treeform_relate(const treeform_mesh* a, const treeform_mesh* b,
                              treeform_vertices vertices, treeform_mesh_relation* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = static_cast<treeform_mesh_relation>(
            glue::relate(glue::ref(a, "a"), glue::ref(b, "b"),
                         glue::choice<tf::vertex_identity>(vertices, 2, "vertices")));
    });
}

treeform_code treeform_penetration_depth(const treeform_mesh* a, const treeform_mesh* b,
                                         const treeform_measure_options* options, double* depth,
                                         double move[3], treeform_search_effort* effort) {
    return glue::guard([&] {
        glue::penetration_depth(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options), depth,
                                move, effort);
    });
}

treeform_code treeform_count_inside_out(const treeform_mesh* mesh, uint64_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::count_inside_out(glue::ref(mesh, "mesh"));
    });
}

treeform_code treeform_count_sides(const double* points, size_t points_count,
                                   const treeform_mesh* const* solids, size_t solids_count,
                                   uint64_t counts[3]) {
    return glue::guard([&] {
        glue::count_sides(glue::points(points, points_count, "points"),
                          glue::refs(solids, solids_count, "solids"), counts);
    });
}

treeform_code treeform_deviation(const treeform_mesh* a, const treeform_mesh* const* b,
                                 size_t count, const treeform_deviation_options* options,
                                 treeform_deviation_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::deviation(glue::ref(a, "a"), glue::refs(b, count, "b"), glue::read(options)),
            result);
    });
}
