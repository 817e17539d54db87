#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/cell_faces.hpp>
#include <libmesh/boolean/unbalanced_parts.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace treeform::detail::boolean {
namespace {

void take_points(cell_faces& found, const mesh_arrangement& cut) {
    const std::size_t given = cut.given_points.size();
    std::vector<point3>& points = found.points;
    points.resize(given + cut.constructed.size());
    std::copy(cut.given_points.begin(), cut.given_points.end(), points.begin());
    for (std::size_t p = given; p < points.size(); ++p)
        points[p] = cut.constructed[p - given].center();
    const auto box = bounding_box(points);
    if (!box) return;
    double unit = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        unit = std::max(unit, box->max[k] / 2.0 - box->min[k] / 2.0);
    if (unit > 0.0) found.unit = unit;
    for (point3& p : points)
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = (p[k] - (box->min[k] / 2.0 + box->max[k] / 2.0)) / found.unit;
}

cell_face look_at(std::size_t f, const cell_faces& found, const mesh_arrangement& cut,
                  const arrangement_cells& cells, std::span<const std::uint32_t> is_filling) {
    cell_face known;
    known.cells = cells.cell_of_side[f];
    const auto [a, b, c] = base::triangle_of(found.points, cut.faces[f]);
    const point3 normal = base::cross(base::minus(b, a), base::minus(c, a));
    known.area = std::sqrt(base::dot(normal, normal)) / 2.0;
    for (const covering_face& cover : cut.covers_of(f)) {
        if (is_filling[cover.face] != 0) continue;
        known.is_given = true;
        known.times += cover.opposite ? -1.0 : 1.0;
    }
    const auto [front, behind] = known.cells;
    if (!known.separates()) known.times = 0.0;
    known.is_outer = known.separates() && (front == 0 || behind == 0);
    if (known.is_given && known.is_outer)
        known.times = std::max(std::abs(known.times), 1.0) * (front == 0 ? 1.0 : -1.0);
    return known;
}

/// Outer faces are balanced among themselves, so that the others are if all together are.
void doubt_walls(cell_faces& found, const mesh_arrangement& cut) {
    std::vector<double> times(found.all.size());
    for (std::size_t f = 0; f < times.size(); ++f)
        times[f] = found.all[f].is_outer ? 0.0 : found.all[f].times;
    const auto is_unbalanced = find_unbalanced_parts(found.points.size(), cut.faces, times);
    for (std::size_t f = 0; f < times.size(); ++f) found.all[f].is_doubted = is_unbalanced[f] != 0;
}

void list_by_cell(cell_faces& found, std::size_t cell_count) {
    std::vector<std::size_t>& begin = found.begin;
    begin.assign(cell_count + 1, 0);
    for (const cell_face& known : found.all)
        if (known.separates())
            for (const std::uint32_t cell : known.cells) ++begin[cell];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    found.faces_at.resize(begin.back());
    for (std::size_t f = found.all.size(); f-- > 0;)
        if (found.all[f].separates())
            for (const std::uint32_t cell : found.all[f].cells)
                found.faces_at[--begin[cell]] = static_cast<std::uint32_t>(f);
}

}  // namespace

cell_faces find_cell_faces(const mesh_arrangement& cut, const arrangement_cells& cells,
                           std::size_t cell_count, std::span<const std::uint32_t> is_filling) {
    cell_faces found;
    take_points(found, cut);
    found.all.resize(cut.faces.size());
    for_chunks(found.all.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            found.all[f] = look_at(f, found, cut, cells, is_filling);
    });
    doubt_walls(found, cut);
    list_by_cell(found, cell_count);
    return found;
}

}  // namespace treeform::detail::boolean
