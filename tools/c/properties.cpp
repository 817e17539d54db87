#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace tf = treeform;

namespace {

tf::triangle3 triangle(const double* data, const char* name) {
    (void)glue::need(data, name);
    return {glue::finite(data, name), glue::finite(data + 3, name), glue::finite(data + 6, name)};
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
        treeform_mass_properties& to = glue::need(properties, "properties");
        constexpr std::array none{glue::not_known, glue::not_known, glue::not_known};
        const tf::mass_properties nothing{0.0, glue::nowhere, {none, none, none}};
        glue::keeper kept;
        glue::fill(kept, tf::find_mass_properties(glue::view(mesh)).value_or(nothing), to);
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

treeform_code treeform_find_open_edge(const treeform_mesh* mesh, uint32_t edge[2]) {
    return glue::guard([&] {
        (void)glue::need(edge, "edge");
        const auto found =
            tf::find_open_edge(glue::view(mesh)).value_or(std::array{TREEFORM_NONE, TREEFORM_NONE});
        edge[0] = found[0];
        edge[1] = found[1];
    });
}

treeform_code treeform_find_features(const treeform_mesh* mesh, treeform_feature_kind kind,
                                     const treeform_feature_options* options,
                                     treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        tf::feature_options how = glue::read(options);
        bool stopped = false;
        if (const auto report = how.progress ? how.progress : glue::thread_progress())
            how.progress = [&stopped, report](double done) {
                stopped = !report(done);
                return !stopped;
            };
        const auto which = glue::choice<tf::feature_kind>(kind, 2, "kind");
        auto found = tf::find_features(glue::view(mesh), which, how);
        if (stopped) throw glue::cancelled{};
        return glue::give(std::move(found), features);
    });
}

treeform_code treeform_feature_at_point(const treeform_mesh* mesh, treeform_feature_kind kind,
                                        const double point[3],
                                        const treeform_feature_options* options,
                                        treeform_features** features) {
    return glue::guard([&] {
        glue::start(features);
        const tf::mesh_view view = glue::view(mesh);
        const auto which = glue::choice<tf::feature_kind>(kind, 2, "kind");
        const auto at = tf::closest_point(view, glue::finite(point, "point"));
        return glue::give(
            glue::as_list(at ? tf::feature_at(view, which, at->face, glue::read(options))
                             : std::nullopt),
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
            const auto of_side = found.corners_of(side, points);
            corners.insert(corners.end(), of_side.begin(), of_side.end());
            begin.push_back(corners.size());
        }
        h.corner_begin = made->keep(std::move(begin)).data();
        h.corners = made->keep(std::move(corners)).data();
        h.mesh = glue::arrays(made->keep(found.mesh(points)));
        glue::give(std::move(made), hull);
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
