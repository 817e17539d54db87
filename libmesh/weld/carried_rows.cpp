#include <libmesh/base/point_math.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/weld/carried_rows.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/vertex_values.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

void check_column(const element& e, const column& c) {
    if (c.role != column_role::data) return;
    const std::size_t values = c.size();
    const std::vector<std::uint64_t>& begin = c.list_begin;
    const bool fits = c.list_length
                          ? begin.size() == e.rows + 1 && begin.front() == 0 &&
                                begin.back() == values && std::is_sorted(begin.begin(), begin.end())
                          : values == e.rows;
    if (!fits) refuse("column '" + c.name + "' does not fit element '" + e.name + "'");
}

constexpr std::string_view names_of_points[] = {"vertex1", "vertex2", "vertex_index",
                                                "vertex_indices"};

void renumber_points(column& c, const std::vector<std::uint32_t>& new_of_old) {
    if (!numbers_points(c)) return;
    for_chunks(c.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        renumber(c, begin, end, new_of_old.size(),
                 [&](std::uint64_t old) { return new_of_old[static_cast<std::size_t>(old)]; });
    });
}

element carried(const element& e, const weld_result& welded) {
    if (e.name == "vertex") return e.gathered(welded.vertex_source);
    if (e.name == "face") return e.gathered(welded.face_source);
    element other = e;
    for (column& c : other.columns) renumber_points(c, welded.groups.group_of_point);
    return other;
}

/// From where to where a point went.
struct move {
    point3 from{};
    point3 to{};

    [[nodiscard]] bool further_than(const move& other) const {
        const order known = compare_rounded(rounded_squared_distance(from, to),
                                            rounded_squared_distance(other.from, other.to));
        if (known != order::unsure) return known == order::more;
        return compare_distance(from, to, other.from, other.to) > 0;
    }

    /// By bisection: doubles that are not negative are ordered as their bits.
    [[nodiscard]] double distance_above() const {
        std::uint64_t low = 0;
        auto high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
        while (low < high) {
            const std::uint64_t middle = low + (high - low) / 2;
            const point3 reach{std::bit_cast<double>(middle), 0.0, 0.0};
            if (compare_distance(from, to, {}, reach) <= 0)
                high = middle;
            else
                low = middle + 1;
        }
        return std::bit_cast<double>(low);
    }
};

plane_points corners_of(mesh_view mesh, const face& f) {
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

bool finite(const plane_points& p) {
    return detail::base::is_finite(p.a) && detail::base::is_finite(p.b) &&
           detail::base::is_finite(p.c);
}

}  // namespace

bool numbers_points(const column& c) {
    return c.role == column_role::data && c.type != scalar_type::float32 &&
           c.type != scalar_type::float64 &&
           std::ranges::find(names_of_points, c.name) != std::end(names_of_points);
}

void check_rows(const attributes& properties, std::size_t point_count, std::size_t face_count) {
    for (const element& e : properties.elements) {
        if (e.name == "vertex" && e.rows != point_count)
            refuse("element 'vertex' has " + std::to_string(e.rows) + " rows for " +
                   std::to_string(point_count) + " points");
        if (e.name == "face" && e.rows != face_count)
            refuse("element 'face' has " + std::to_string(e.rows) + " rows for " +
                   std::to_string(face_count) + " faces");
        for (const column& c : e.columns) check_column(e, c);
    }
    if (const auto fault = properties.corners.fault(face_count); !fault.empty()) refuse(fault);
}

attributes carry_rows(const attributes& properties, const weld_result& welded) {
    attributes result{.corners = properties.corners.gathered(welded.face_source),
                      .parts = properties.parts,
                      .material_files = properties.material_files,
                      .texture_files = properties.texture_files,
                      .comments = properties.comments,
                      .obj_info = properties.obj_info,
                      .header = properties.header};
    result.elements.reserve(properties.elements.size());
    for (const element& e : properties.elements) result.elements.push_back(carried(e, welded));
    const std::vector<std::uint32_t>& faces = welded.face_source;
    for (named_faces& p : result.parts)
        p.first_face = static_cast<std::uint32_t>(
            std::lower_bound(faces.begin(), faces.end(), p.first_face) - faces.begin());
    return result;
}

double max_displacement(points_view points, std::span<const std::uint32_t> group_of_point,
                        points_view places) {
    std::vector<move> furthest(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i) {
            const move mine{points[i], places[group_of_point[i]]};
            if (mine.from == mine.to || !detail::base::is_finite(mine.from)) continue;
            if (mine.further_than(furthest[c])) furthest[c] = mine;
        }
    });
    move found;
    for (const move& m : furthest)
        if (m.further_than(found)) found = m;
    return found.distance_above();
}

bool is_flipped(const plane_points& before, const plane_points& after) {
    if (before.a == after.a && before.b == after.b && before.c == after.c) return false;
    return finite(before) && finite(after) && normal_dot(before, after) < 0;
}

std::uint64_t count_flipped(mesh_view before, mesh_view after,
                            std::span<const std::uint32_t> face_source) {
    std::vector<std::uint64_t> found(chunk_count(after.faces.size(), light_grain), 0);
    for_chunks(after.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t i = begin; i < end; ++i)
                       found[c] += is_flipped(corners_of(before, before.faces[face_source[i]]),
                                              corners_of(after, after.faces[i]))
                                       ? 1
                                       : 0;
               });
    std::uint64_t total = 0;
    for (const std::uint64_t n : found) total += n;
    return total;
}

}  // namespace treeform::detail::weld
