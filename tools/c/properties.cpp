#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/triangle.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace tf = treeform;

namespace {

tf::feature_options features_of(const treeform_feature_options* options) {
    const auto o = glue::chosen(options, treeform_feature_options_init);
    return {.tolerance = glue::given(o.tolerance),
            .plane_angle = o.plane_angle,
            .facet_angle = o.facet_angle,
            .arc = o.arc};
}

tf::feature_kind kind_of(treeform_feature_kind kind) {
    return glue::choice<tf::feature_kind>(kind, 2, "kind");
}

void give_features(std::vector<tf::mesh_feature> found, treeform_features** out) {
    auto made = glue::make<treeform_features>();
    std::vector<treeform_feature> all;
    for (const tf::mesh_feature& one : made->keep(std::move(found))) {
        treeform_feature& f = all.emplace_back();
        f.kind = static_cast<treeform_feature_kind>(one.kind);
        f.hollow = one.hollow;
        glue::copy(one.origin, f.origin);
        glue::copy(one.direction, f.direction);
        f.radius = one.radius;
        f.area = one.area;
        f.deviation = one.deviation;
        f.faces = one.faces.data();
        f.face_count = one.faces.size();
    }
    made->value.count = all.size();
    made->value.features = made->keep(std::move(all)).data();
    glue::give(std::move(made), out);
}

void give_feature(std::optional<tf::mesh_feature> found, treeform_features** out) {
    std::vector<tf::mesh_feature> one;
    if (found) one.push_back(std::move(*found));
    give_features(std::move(one), out);
}

/// A point that is known to be finite, as the predicates need it.
tf::point3 finite(const double* data, const char* name) {
    const tf::point3 p = glue::point(data, name);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw std::invalid_argument(std::string(name) + " is not finite");
    return p;
}
tf::point2 finite2(const double* data, const char* name) {
    (void)glue::need(data, name);
    if (!std::isfinite(data[0]) || !std::isfinite(data[1]))
        throw std::invalid_argument(std::string(name) + " is not finite");
    return {data[0], data[1]};
}
tf::triangle3 triangle(const double* data, const char* name) {
    (void)glue::need(data, name);
    return {finite(data, name), finite(data + 3, name), finite(data + 6, name)};
}

/// `value` of all points being finite, which the library takes for granted.
double of_finite(const treeform_mesh* mesh, double (*value)(const tf::mesh_ref&)) {
    const tf::mesh_view view = glue::view(mesh);
    const double result = value(view);
    if (!std::isfinite(result))
        if (const auto bad = tf::find_defects(view).nonfinite_faces; !bad.empty())
            throw std::invalid_argument("face " + std::to_string(bad[0]) +
                                        " has a corner that is not finite");
    return result;
}

}  // namespace

treeform_code treeform_volume(const treeform_mesh* mesh, double* volume) {
    return glue::guard([&] { glue::need(volume, "volume") = of_finite(mesh, tf::signed_volume); });
}

treeform_code treeform_area(const treeform_mesh* mesh, double* area) {
    return glue::guard([&] { glue::need(area, "area") = of_finite(mesh, tf::surface_area); });
}

treeform_code treeform_find_mass_properties(const treeform_mesh* mesh,
                                            treeform_mass_properties* properties) {
    return glue::guard([&] {
        const auto found = tf::find_mass_properties(glue::view(mesh));
        treeform_mass_properties& p = glue::need(properties, "properties");
        p.volume = found ? found->volume : 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            p.center[i] = found ? found->center[i] : glue::not_known;
            for (std::size_t j = 0; j < 3; ++j)
                p.inertia[3 * i + j] = found ? found->inertia[i][j] : glue::not_known;
        }
    });
}

treeform_code treeform_bounds(const treeform_mesh* mesh, treeform_box* bounds) {
    return glue::guard([&] {
        constexpr double far = std::numeric_limits<double>::infinity();
        const std::optional<tf::box3> found = tf::bounding_box(glue::view(mesh).points);
        glue::need(bounds, "bounds") =
            glue::copied(found.value_or(tf::box3{{far, far, far}, {-far, -far, -far}}));
    });
}

treeform_code treeform_is_solid(const treeform_mesh* mesh, int32_t* is_solid) {
    return glue::guard([&] {
        (void)glue::need(is_solid, "is_solid");
        *is_solid = static_cast<bool>(tf::check_solid(glue::view(mesh)));
    });
}

treeform_code treeform_check_solid(const treeform_mesh* mesh, treeform_progress progress,
                                   void* progress_data, treeform_certificate** certificate) {
    return glue::guard([&] {
        glue::start(certificate);
        auto made = glue::make<treeform_certificate>();
        void* const owner = made->value.owner;
        const auto& found =
            made->keep(tf::check_solid(glue::view(mesh), glue::progress(progress, progress_data)));
        if (found.status == tf::status::cancelled) throw glue::cancelled{};
        made->value = *glue::keep(*made, found);
        made->value.owner = owner;
        glue::give(std::move(made), certificate);
    });
}

treeform_code treeform_count_topology(const treeform_mesh* mesh, treeform_topology** topology) {
    return glue::guard([&] {
        glue::start(topology);
        const tf::mesh_view view = glue::view(mesh);
        const tf::topology_counts c = tf::count_topology(view.points.size(), view.faces);
        auto made = glue::make<treeform_topology>();
        treeform_topology& t = made->value;
        t.edges = c.edges;
        t.boundary_edges = c.boundary_edges;
        t.nonmanifold_edges = c.nonmanifold_edges;
        t.misoriented_edges = c.misoriented_edges;
        t.nonmanifold_points = c.nonmanifold_points;
        t.components_by_point = c.components_by_point;
        t.components_by_edge = c.components_by_edge;
        t.points_used = c.points_used;
        t.faces = c.faces;
        t.repeated_corner_faces = c.repeated_corner_faces;
        t.duplicate_faces = c.duplicate_faces;
        t.closed = c.closed;
        glue::give(std::move(made), topology);
    });
}

treeform_code treeform_face_components(const treeform_mesh* mesh, uint32_t* component,
                                       size_t* count) {
    return glue::guard([&] {
        const tf::mesh_view view = glue::view(mesh);
        const std::span out = glue::array(component, view.faces.size(), "component");
        (void)glue::need(count, "count");
        const auto found = tf::face_components(view.points.size(), view.faces);
        std::copy(found.begin(), found.end(), out.begin());
        *count = found.empty() ? 0 : *std::max_element(found.begin(), found.end()) + std::size_t{1};
    });
}

treeform_code treeform_find_defects(const treeform_mesh* mesh, treeform_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        auto made = glue::make<treeform_defects>();
        const tf::mesh_defects& found = made->keep(tf::find_defects(glue::view(mesh)));
        treeform_defects& d = made->value;
        d.nonfinite_points = found.nonfinite_points.data();
        d.nonfinite_point_count = found.nonfinite_points.size();
        d.nonfinite_faces = found.nonfinite_faces.data();
        d.nonfinite_face_count = found.nonfinite_faces.size();
        d.degenerate_faces = found.degenerate_faces.data();
        d.degenerate_face_count = found.degenerate_faces.size();
        glue::give(std::move(made), defects);
    });
}

treeform_code treeform_find_open_edge(const treeform_mesh* mesh, uint32_t edge[2]) {
    return glue::guard([&] {
        (void)glue::need(edge, "edge");
        const auto found =
            tf::find_open_edge(glue::view(mesh)).value_or(std::array{TREEFORM_NONE, TREEFORM_NONE});
        edge[0] = found[0];
        edge[1] = found[1];
    });
}

treeform_code treeform_closing_tolerance(const treeform_mesh* mesh, const double* tolerances,
                                         size_t count, size_t* which) {
    return glue::guard([&] {
        (void)glue::need(which, "which");
        *which =
            tf::closing_tolerance(glue::view(mesh), glue::array(tolerances, count, "tolerances"))
                .value_or(count);
    });
}

treeform_code treeform_same_triangles(const treeform_mesh* a, const treeform_mesh* b,
                                      int32_t any_order, int32_t* same) {
    return glue::guard([&] {
        (void)glue::need(same, "same");
        *same = tf::same_triangles(glue::view(a), glue::view(b),
                                   any_order != 0 ? tf::face_order::any : tf::face_order::kept);
    });
}

void treeform_feature_options_init(treeform_feature_options* options, size_t size) {
    const tf::feature_options from;
    treeform_feature_options defaults{};
    defaults.tolerance = std::numeric_limits<double>::quiet_NaN();
    defaults.plane_angle = from.plane_angle;
    defaults.facet_angle = from.facet_angle;
    defaults.arc = from.arc;
    glue::init(options, size, defaults);
}

treeform_code treeform_find_features(const treeform_mesh* mesh, treeform_feature_kind kind,
                                     const treeform_feature_options* options,
                                     treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        tf::feature_options o = features_of(options);
        bool stopped = false;
        if (glue::thread_progress())
            o.progress = [&](double done) {
                stopped = !glue::thread_progress()(done);
                return !stopped;
            };
        auto found = tf::find_features(glue::view(mesh), kind_of(kind), o);
        if (stopped) throw glue::cancelled{};
        give_features(std::move(found), features);
    });
}

treeform_code treeform_feature_at_face(const treeform_mesh* mesh, treeform_feature_kind kind,
                                       uint32_t face, const treeform_feature_options* options,
                                       treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        give_feature(tf::feature_at(glue::view(mesh), kind_of(kind), face, features_of(options)),
                     features);
    });
}

treeform_code treeform_feature_at_point(const treeform_mesh* mesh, treeform_feature_kind kind,
                                        const double point[3],
                                        const treeform_feature_options* options,
                                        treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        const tf::mesh_view view = glue::view(mesh);
        const auto at = tf::closest_point(view, finite(point, "point"));
        give_feature(
            at ? tf::feature_at(view, kind_of(kind), at->face, features_of(options)) : std::nullopt,
            features);
    });
}

treeform_code treeform_fit_feature(const treeform_mesh* mesh, treeform_feature_kind kind,
                                   const uint32_t* faces, size_t face_count,
                                   treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        give_feature(tf::fit_feature(glue::view(mesh), kind_of(kind),
                                     glue::array(faces, face_count, "faces")),
                     features);
    });
}

treeform_code treeform_convex_hull(const treeform_mesh* mesh, treeform_progress progress,
                                   void* progress_data, treeform_hull** hull) {
    return glue::guard([&] {
        glue::start(hull);
        const tf::points_view points = glue::view(mesh).points;
        auto made = glue::make<treeform_hull>();
        const tf::convex_hull_result& found =
            made->keep(tf::convex_hull(points, glue::progress(progress, progress_data)));
        if (found.status == tf::status::cancelled) throw glue::cancelled{};
        treeform_hull& h = made->value;
        h.dimension = found.dimension;
        h.faces = glue::arrays({points, found.faces}).faces;
        h.face_count = found.faces.size();
        h.sides = glue::same<treeform_hull_side>(found.sides);
        h.side_count = found.sides.size();
        std::vector<std::size_t> begin{0};
        std::vector<std::uint32_t> corners;
        for (const tf::hull_side& side : found.sides) {
            const auto of_side = tf::corners_of(found, side, points);
            corners.insert(corners.end(), of_side.begin(), of_side.end());
            begin.push_back(corners.size());
        }
        h.corner_begin = made->keep(std::move(begin)).data();
        h.corners = made->keep(std::move(corners)).data();
        glue::give(std::move(made), hull);
    });
}

treeform_code treeform_orient2d(const double a[2], const double b[2], const double c[2],
                                int32_t* sign) {
    return glue::guard([&] {
        glue::need(sign, "sign") = tf::orient2d(finite2(a, "a"), finite2(b, "b"), finite2(c, "c"));
    });
}

treeform_code treeform_orient3d(const double a[3], const double b[3], const double c[3],
                                const double d[3], int32_t* sign) {
    return glue::guard([&] {
        glue::need(sign, "sign") =
            tf::orient3d(finite(a, "a"), finite(b, "b"), finite(c, "c"), finite(d, "d"));
    });
}

treeform_code treeform_compare_distance(const double a[3], const double b[3], const double c[3],
                                        const double d[3], int32_t* sign) {
    return glue::guard([&] {
        glue::need(sign, "sign") =
            tf::compare_distance(finite(a, "a"), finite(b, "b"), finite(c, "c"), finite(d, "d"));
    });
}

treeform_code treeform_intersect_triangles(const double a[9], const double b[9],
                                           treeform_triangle_contact* contact) {
    return glue::guard([&] {
        (void)glue::need(contact, "contact");
        const tf::triangle_contact found = tf::intersect(triangle(a, "a"), triangle(b, "b"));
        contact->dimension = static_cast<std::int32_t>(found.kind) - 1;
        contact->coplanar = found.coplanar;
        contact->crossing = found.crossing;
    });
}
