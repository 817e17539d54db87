#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/place/facing.hpp>
#include <libmesh/place/point_sides.hpp>
#include <libmesh/place/relation_of.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

using detail::place::check_operand;
using detail::place::shape;

namespace {

plane_points plane_of(mesh_view mesh, std::uint32_t f) {
    const face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

/// Searches for pairs of faces, of which one was stopped, or none.
struct pair_searches {
    detail::base::effort* effort = nullptr;
    bool stopped = false;

    [[nodiscard]] face_pair_result pairs(const shape& a, const shape& b,
                                         const face_pair_options& options) {
        auto found = detail::intersect::mesh_intersections(a.mesh(), a.faces(), b.mesh(), b.faces(),
                                                           options, effort);
        stopped = stopped || found.status == treeform::status::cancelled;
        return found;
    }
};

/// The first face that passes through one of the other mesh.
std::optional<face_pair> crossing_faces(const shape& a, const shape& b,
                                        const progress_callback& progress, pair_searches& how) {
    if (a.prepared().is_cloud() || b.prepared().is_cloud())
        return std::nullopt;  // points only touch
    face_pair_options options;
    options.first_only = true;
    options.kinds = pair_kind::crossing;
    options.progress = progress;
    const auto crossing = how.pairs(a, b, options);
    if (!crossing.pairs.empty()) return crossing.pairs[0];
    return std::nullopt;
}

/// Faces of closed meshes that lie on each other with what is inside on the same side.
std::optional<face_pair> faces_on_one_side(const shape& a, const shape& b,
                                           const progress_callback& progress, pair_searches& how) {
    face_pair_options options;
    options.kinds = pair_kind::overlap;
    options.progress = progress;
    const auto found = how.pairs(a, b, options);
    for (const face_pair& pair : found.pairs) {
        const auto of_a = detail::place::sides_beside(a, pair.a);
        const auto of_b = detail::place::sides_beside(b, pair.b);
        const bool alike = normal_dot(plane_of(a.mesh(), pair.a), plane_of(b.mesh(), pair.b)) > 0;
        const bool before = alike ? of_b.front : of_b.behind;
        const bool beyond = alike ? of_b.behind : of_b.front;
        if ((of_a.front && before) || (of_a.behind && beyond)) return pair;
    }
    return std::nullopt;
}

/// Faces of `a` of which a corner is to be located in `b`: the first of each component, or, when
/// the meshes touch, all. A component that does not touch `b` is on one side of it as a whole.
std::vector<std::uint32_t> faces_to_locate(mesh_view a, bool touching) {
    std::vector<std::uint32_t> faces;
    if (touching) {
        for (std::uint32_t f = 0; f < a.faces.size(); ++f) faces.push_back(f);
        return faces;
    }
    const std::vector<std::uint32_t> component = face_components(a.points.size(), a.faces);
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < a.faces.size(); ++f)
        if (component[f] == next) {
            faces.push_back(f);
            ++next;
        }
    return faces;
}

/// The lowest of these faces with a corner strictly inside the closed mesh `b`.
std::optional<std::uint32_t> face_inside(const shape& of, const shape& solid, bool touching) {
    const auto box = bounding_box(solid.mesh().points);
    if (!box || !solid.closed()) return std::nullopt;
    const mesh_view a = of.joined();
    const auto may_be_inside = [&](const point3& p) {
        for (std::size_t k = 0; k < 3; ++k)
            if (!(box->min[k] < p[k] && p[k] < box->max[k])) return false;
        return true;
    };
    std::vector<std::uint32_t> faces;
    std::vector<point3> points;
    std::vector<bool> asked(a.points.size());
    for (const std::uint32_t f : faces_to_locate(a, touching))
        for (std::size_t i = 0; i < (touching ? 3U : 1U); ++i) {
            const std::uint32_t corner = a.faces[f][i];
            if (asked[corner] || !may_be_inside(a.points[corner])) continue;
            asked[corner] = true;
            faces.push_back(f);
            points.push_back(a.points[corner]);
        }
    // Of a cloud that penetrates, one of the first few is inside; of one that does not, none is.
    for (std::size_t from = 0, count = 1024; from < points.size(); from += count, count *= 8) {
        const auto batch = std::span(points).subspan(from, std::min(count, points.size() - from));
        const auto side = detail::place::sides_of(solid.joined(), solid.faces(), batch);
        const auto inside = std::find(side.begin(), side.end(), std::int8_t{-1});
        if (inside != side.end())
            return faces[from + static_cast<std::size_t>(inside - side.begin())];
    }
    return std::nullopt;
}

}  // namespace

relation_result detail::place::relation_of(const shape& a, const shape& b,
                                           const progress_callback& progress,
                                           base::effort* effort) {
    detail::base::work_progress work(progress);
    pair_searches search{effort};
    const relation_result cancelled{.status = status::cancelled};
    relation_result result;
    const auto penetrating = [&](std::uint32_t face_a, std::uint32_t face_b) {
        result.relation = mesh_relation::penetrating;
        result.face_a = face_a;
        result.face_b = face_b;
        work.reach(1.0);
        return result;
    };
    const auto crossing = crossing_faces(a, b, work.part(0.0, 0.3), search);
    if (search.stopped) return cancelled;
    if (crossing) return penetrating(crossing->a, crossing->b);

    face_pair_options first;
    first.first_only = true;
    first.progress = work.part(0.3, 0.6);
    const auto touch = search.pairs(a, b, first);
    if (search.stopped) return cancelled;
    const bool touching = !touch.pairs.empty();
    if (touching) {
        result.relation = mesh_relation::touching;
        result.face_a = touch.pairs[0].a;
        result.face_b = touch.pairs[0].b;
        if (a.closed() && b.closed()) {
            const auto pair = faces_on_one_side(a, b, work.part(0.6, 0.8), search);
            if (search.stopped) return cancelled;
            if (pair) return penetrating(pair->a, pair->b);
        }
    }
    const auto of_a = face_inside(a, b, touching);
    if (!work.reach(0.9)) return cancelled;
    const auto of_b = face_inside(b, a, touching);
    if (!of_a && !of_b) {
        work.reach(1.0);
        return result;
    }
    result.a_inside_b = of_a.has_value() && !touching;
    result.b_inside_a = of_b.has_value() && !touching;
    return penetrating(of_a ? *of_a : result.face_a, of_b ? *of_b : result.face_b);
}

relation_result relation(const mesh_ref& given_a, const mesh_ref& given_b,
                         const measure_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    check_operand("relation", "a", a);
    check_operand("relation", "b", b);
    relation_result found = detail::place::relation_of(
        shape(a, options.vertices), shape(b, options.vertices), options.progress);
    found.distance = found.surface_distance = std::numeric_limits<double>::quiet_NaN();
    return found;
}

}  // namespace treeform
