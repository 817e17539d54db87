// Made by tools/bindings of properties.h and the headers of C++: see its README.
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/properties.hpp>

namespace tf = treeform;

static_assert(TREEFORM_PLANE == static_cast<int>(tf::feature_kind::plane));
static_assert(TREEFORM_AXIS == static_cast<int>(tf::feature_kind::axis));

void glue::fill(keeper&, const tf::mass_properties& from, treeform_mass_properties& to) {
    to.volume = from.volume;
    copy(from.center, to.center);
    copy(from.inertia, to.inertia);
}

void glue::fill(keeper&, const tf::topology_counts& from, treeform_topology& to) {
    to.edges = from.edges;
    to.boundary_edges = from.boundary_edges;
    to.nonmanifold_edges = from.nonmanifold_edges;
    to.misoriented_edges = from.misoriented_edges;
    to.nonmanifold_points = from.nonmanifold_points;
    to.components_by_point = from.components_by_point;
    to.components_by_edge = from.components_by_edge;
    to.points_used = from.points_used;
    to.faces = from.faces;
    to.repeated_corner_faces = from.repeated_corner_faces;
    to.duplicate_faces = from.duplicate_faces;
    to.closed = from.closed;
}

void glue::fill(keeper&, const tf::mesh_defects& from, treeform_defects& to) {
    to.nonfinite_points = or_null(from.nonfinite_points);
    to.nonfinite_point_count = from.nonfinite_points.size();
    to.nonfinite_faces = or_null(from.nonfinite_faces);
    to.nonfinite_face_count = from.nonfinite_faces.size();
    to.degenerate_faces = or_null(from.degenerate_faces);
    to.degenerate_face_count = from.degenerate_faces.size();
    to.out_of_range_faces = or_null(from.out_of_range_faces);
    to.out_of_range_face_count = from.out_of_range_faces.size();
}

void glue::fill(keeper&, const tf::mesh_feature& from, treeform_feature& to) {
    to.kind = static_cast<treeform_feature_kind>(from.kind);
    copy(from.origin, to.origin);
    copy(from.direction, to.direction);
    to.radius = from.radius;
    to.hollow = from.hollow;
    to.area = from.area;
    to.deviation = from.deviation;
    to.faces = or_null(from.faces);
    to.face_count = from.faces.size();
}

tf::feature_options glue::read(const treeform_feature_options* options) {
    return read(chosen(options, treeform_feature_options_init));
}
tf::feature_options glue::read(const treeform_feature_options& o) {
    tf::feature_options how;
    how.tolerance = given(o.tolerance);
    how.plane_angle = o.plane_angle;
    how.facet_angle = o.facet_angle;
    how.arc = o.arc;
    how.progress = progress(o);

    return how;
}

void treeform_feature_options_init(treeform_feature_options* options, size_t size) {
    treeform_feature_options to{};
    const tf::feature_options from;
    using namespace glue;
    to.tolerance = not_known;
    to.plane_angle = from.plane_angle;
    to.facet_angle = from.facet_angle;
    to.arc = from.arc;
    glue::init(options, size, to);
}

static_assert(sizeof(treeform_hull_side) == sizeof(tf::hull_side));
static_assert(offsetof(treeform_hull_side, first_face) == offsetof(tf::hull_side, first_face));
static_assert(offsetof(treeform_hull_side, face_count) == offsetof(tf::hull_side, face_count));
static_assert(offsetof(treeform_hull_side, area) == offsetof(tf::hull_side, area));
static_assert(offsetof(treeform_hull_side, normal) == offsetof(tf::hull_side, normal));
static_assert(offsetof(treeform_hull_side, center) == offsetof(tf::hull_side, center));

void glue::fill(keeper& kept, const std::vector<tf::mesh_feature>& from, treeform_features& to) {
    to.features = list<treeform_feature>(kept, from);
    to.count = from.size();
}

treeform_code treeform_volume(const treeform_mesh* mesh, double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::volume(mesh);
    });
}

treeform_code treeform_area(const treeform_mesh* mesh, double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::area(mesh);
    });
}

treeform_code treeform_find_mass_properties(const treeform_mesh* mesh,
                                            treeform_mass_properties* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::find_mass_properties(glue::ref(mesh, "mesh"));
    });
}

treeform_code treeform_bounds(const treeform_mesh* mesh, treeform_box* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::bounds(glue::view(mesh));
    });
}

treeform_code treeform_is_solid(const treeform_mesh* mesh, int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::is_solid(glue::ref(mesh, "mesh"));
    });
}

treeform_code treeform_check_solid(const treeform_mesh* mesh, treeform_progress progress,
                                   void* progress_data, treeform_certificate** certificate) {
    return glue::guard([&] {
        glue::start(certificate);
        return glue::give(
            tf::check_solid(glue::ref(mesh, "mesh"), glue::progress(progress, progress_data)),
            certificate);
    });
}

treeform_code treeform_count_topology(const treeform_mesh* mesh, treeform_topology** topology) {
    return glue::guard([&] {
        glue::start(topology);
        return glue::give(glue::count_topology(glue::view(mesh)), topology);
    });
}

treeform_code treeform_face_components(const treeform_mesh* mesh, uint32_t* component,
                                       size_t* count) {
    return glue::guard([&] { glue::face_components(glue::view(mesh), component, count); });
}

treeform_code treeform_find_defects(const treeform_mesh* mesh, treeform_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        return glue::give(tf::find_defects(glue::ref(mesh, "mesh")), defects);
    });
}

treeform_code treeform_find_open_edge(const treeform_mesh* mesh, uint32_t edge[2]) {
    return glue::guard([&] { glue::find_open_edge(glue::view(mesh), edge); });
}

treeform_code treeform_closing_tolerance(const treeform_mesh* mesh, const double* tolerances,
                                         size_t count, size_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result =
            glue::closing_tolerance(glue::view(mesh), glue::array(tolerances, count, "tolerances"));
    });
}

treeform_code treeform_same_triangles(const treeform_mesh* a, const treeform_mesh* b,
                                      int32_t any_order, int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::same_triangles(glue::view(a), glue::view(b), any_order != 0);
    });
}

treeform_code treeform_find_features(const treeform_mesh* mesh, treeform_feature_kind kind,
                                     const treeform_feature_options* options,
                                     treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        return glue::give(
            glue::find_features(glue::view(mesh), glue::choice<tf::feature_kind>(kind, 2, "kind"),
                                options),
            features);
    });
}

treeform_code treeform_feature_at_face(const treeform_mesh* mesh, treeform_feature_kind kind,
                                       uint32_t face, const treeform_feature_options* options,
                                       treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        return glue::give(glue::as_list(glue::feature_at_face(
                              glue::view(mesh), glue::choice<tf::feature_kind>(kind, 2, "kind"),
                              face, glue::read(options))),
                          features);
    });
}

treeform_code treeform_feature_at_point(const treeform_mesh* mesh, treeform_feature_kind kind,
                                        const double point[3],
                                        const treeform_feature_options* options,
                                        treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        return glue::give(glue::as_list(glue::feature_at_point(
                              glue::view(mesh), glue::choice<tf::feature_kind>(kind, 2, "kind"),
                              glue::finite(point, "point"), glue::read(options))),
                          features);
    });
}

treeform_code treeform_fit_feature(const treeform_mesh* mesh, treeform_feature_kind kind,
                                   const uint32_t* faces, size_t count,
                                   treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        return glue::give(glue::as_list(tf::fit_feature(
                              glue::view(mesh), glue::choice<tf::feature_kind>(kind, 2, "kind"),
                              glue::array(faces, count, "faces"))),
                          features);
    });
}

treeform_code treeform_convex_hull(const treeform_mesh* mesh, treeform_progress progress,
                                   void* progress_data, treeform_hull** hull) {
    return glue::guard([&] {
        glue::start(hull);
        return glue::give(
            glue::convex_hull(glue::view(mesh), glue::progress(progress, progress_data)), hull);
    });
}

treeform_code treeform_orient2d(const double a[2], const double b[2], const double c[2],
                                int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::orient2d(glue::finite2(a, "a"), glue::finite2(b, "b"), glue::finite2(c, "c"));
    });
}

treeform_code treeform_orient3d(const double a[3], const double b[3], const double c[3],
                                const double d[3], int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::orient3d(glue::finite(a, "a"), glue::finite(b, "b"), glue::finite(c, "c"),
                               glue::finite(d, "d"));
    });
}

treeform_code treeform_compare_distance(const double a[3], const double b[3], const double c[3],
                                        const double d[3], int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::compare_distance(glue::finite(a, "a"), glue::finite(b, "b"),
                                       glue::finite(c, "c"), glue::finite(d, "d"));
    });
}

treeform_code treeform_intersect_triangles(const double a[9], const double b[9],
                                           treeform_triangle_contact* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::intersect_triangles(a, b);
    });
}
