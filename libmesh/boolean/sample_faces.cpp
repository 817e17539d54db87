#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/sample_faces.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// The i-th of `count` numbers below `size`, one in each of so many equal parts; in each part
/// elsewhere, for crowds of copies repeat themselves.
std::uint32_t sample(std::size_t i, std::size_t count, std::size_t size) {
    constexpr double golden = 0.6180339887498949;
    const double within = golden * static_cast<double>(i + 1);
    const double at = static_cast<double>(i) + (within - std::floor(within));
    return static_cast<std::uint32_t>(at / static_cast<double>(count) * static_cast<double>(size));
}

/// Places on both sides of a face, in its middle and near its corners: on both, since of faces that
/// touch it is not the sides between them that are hidden.
std::array<point3, 8> places_beside(mesh_view mesh, std::uint32_t f) {
    const auto [a, b, c] = base::triangle_of(mesh, f);
    const point3 along = base::minus(b, a), away = base::minus(c, a);
    const point3 normal = base::cross(along, away);
    const double area = std::sqrt(base::dot(normal, normal));
    // A thousandth of what is about the size of the face.
    const point3 off = base::scaled(normal, area > 0.0 ? 0x1p-10 / std::sqrt(area) : 0.0);
    constexpr std::array<point2, 4> within{{{0.33, 0.33}, {0.05, 0.05}, {0.9, 0.05}, {0.05, 0.9}}};
    std::array<point3, 8> places;
    for (std::size_t i = 0; i < within.size(); ++i) {
        const point3 on = base::plus(
            a, base::plus(base::scaled(along, within[i].x), base::scaled(away, within[i].y)));
        places[2 * i] = base::plus(on, off);
        places[2 * i + 1] = base::minus(on, off);
    }
    return places;
}

/// Whether components that wind equally often around all places decide the expression, whatever the
/// others do. `state` is that of component `own` alone, and is given back.
bool are_decided(const surface_components& components, std::uint32_t own,
                 std::span<const point3> places, partial_expression& state) {
    aabb<double, 3> box;
    for (const point3& q : places) {
        if (!base::is_finite(q)) return false;  // of a normal that overflows
        box.include(q);
    }
    std::vector<std::pair<std::uint32_t, winding_range>> around;
    components.visit_overlapping(box, [&](std::uint32_t c) {
        if (c == own) return;
        const std::int64_t first = components.winding_around(c, places[0]);
        const bool alike = std::ranges::all_of(places.subspan(1), [&](const point3& q) {
            return components.winding_around(c, q) == first;
        });
        around.emplace_back(components.operand(c),
                            alike ? winding_range::only(first) : components.range(c));
    });
    for (const auto& [operand, range] : around) state.add(operand, range);
    const bool decided = state.value().has_value();
    for (const auto& [operand, range] : around) state.add(operand, {-range.low, -range.high});
    return decided;
}

/// Faces of components other than `own` whose boxes overlap that of face f.
std::size_t count_neighbors(const surface_components& components, std::uint32_t own,
                            std::uint32_t f) {
    const aabb<double, 3> box =
        base::face_boxes(components.mesh().points)(components.mesh().faces[f]);
    std::size_t count = 0;
    components.visit_overlapping(box, [&](std::uint32_t c) {
        if (c != own) search(components.tree_of(c), box, [&](std::uint32_t) { ++count; });
    });
    return count;
}

}  // namespace

face_samples sample_faces(const surface_components& components,
                          const partial_expression& at_nowhere) {
    constexpr std::size_t most_samples = 64, samples_a_chunk = 8;
    const mesh_view mesh = components.mesh();
    const std::size_t count = std::min(most_samples, mesh.faces.size());
    std::vector<std::uint32_t> component(mesh.faces.size());
    for (std::uint32_t c = 0; c < components.size(); ++c)
        for (const std::uint32_t f : components.faces(c)) component[f] = c;
    std::atomic<std::size_t> hidden{0}, neighbors{0};
    for_chunks(count, samples_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        partial_expression state = at_nowhere;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t f = sample(i, count, mesh.faces.size());
            const std::uint32_t own = component[f];
            const std::size_t near = count_neighbors(components, own, f);
            neighbors += near;
            const winding_range& range = components.range(own);
            state.add(components.operand(own), range);
            const auto places = places_beside(mesh, f);
            if (are_decided(components, own, places, state)) hidden += 1 + near;
            state.add(components.operand(own), {-range.low, -range.high});
        }
    });
    const auto all = static_cast<double>(count), near = static_cast<double>(neighbors);
    return {static_cast<double>(hidden) / (all + near), near / all};
}

}  // namespace treeform::detail::boolean
