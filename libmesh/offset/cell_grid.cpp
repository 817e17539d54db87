#include <libmesh/base/words.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/offset/cell_grid.hpp>
#include <treeform/mesh/point_location.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace treeform::detail::offset {
namespace {

constexpr double most_cells = 0x1p22;
constexpr double sure_cells = 0x1p12;      ///< from so many on, a level has four times as many
constexpr double sure_share = 64.0;        ///< times the most: it need not be tried
constexpr int most_levels = 19;            ///< so that corners have 20 bits
constexpr double half_diagonal = 0.86603;  ///< of a cube of edge 1, and a little more

constexpr std::uint32_t mask = (1U << 20) - 1;

/// Whether a cube is known to be on a side.
enum class known : std::uint8_t { neither, inside, outside };

/// Cubes of one level of an octree. Keys count steps of that level.
struct level {
    std::vector<lattice_key> cells{};
    std::vector<known> sides{};
};

[[noreturn]] void refuse_step(const char* function, double step, double expected) {
    const std::string enough =
        base::brief(1.1 * step * std::sqrt(std::max(expected / most_cells, 1.0)));
    throw std::invalid_argument(
        "treeform::" + std::string(function) + ": the resolution " + base::brief(step) +
        " is too fine: the surface would pass through more than 2^22 cells; use " + enough +
        " or more, for distances of at least twice that");
}

level split(const level& from) {
    level to;
    to.cells.reserve(8 * from.cells.size());
    to.sides.reserve(8 * from.cells.size());
    for (std::size_t i = 0; i < from.cells.size(); ++i)
        for (unsigned child = 0; child < 8; ++child) {
            to.cells.push_back(cell_grid::corner_of(from.cells[i] << 1, child));
            to.sides.push_back(from.sides[i]);
        }
    return to;
}

/// Cubes whose centers have distances that allow the level in them.
level near_level(level&& all, const prepared_mesh& mesh, double distance, const cell_grid& grid) {
    const double radius = half_diagonal * grid.step;
    std::vector<point3> centers(all.cells.size());
    for (std::size_t i = 0; i < centers.size(); ++i) centers[i] = grid.point(all.cells[i], 0.5);
    const auto found =
        nearness::closest_point_query_of(mesh).nearest(centers, distance + 1.001 * radius);
    level kept;
    std::vector<std::uint32_t> asked;
    std::vector<point3> places;
    for (std::size_t i = 0; i < centers.size(); ++i) {
        if (!found[i] || found[i]->distance < distance - 1.001 * radius) continue;
        // No face in the cube: all of it is on one side.
        if (found[i]->distance > 1.001 * radius && all.sides[i] == known::neither) {
            asked.push_back(static_cast<std::uint32_t>(kept.cells.size()));
            places.push_back(centers[i]);
        }
        kept.cells.push_back(all.cells[i]);
        kept.sides.push_back(all.sides[i]);
    }
    if (asked.empty()) return kept;
    const std::vector<point_location> where = locate(mesh, places);
    for (std::size_t i = 0; i < asked.size(); ++i)
        kept.sides[asked[i]] = where[i].where == location::inside ? known::inside : known::outside;
    return kept;
}

void drop_wrong_side(level& of, wanted_side side) {
    const known wrong = side == wanted_side::inside ? known::outside : known::inside;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < of.cells.size(); ++i) {
        if (of.sides[i] == wrong) continue;
        of.cells[kept] = of.cells[i];
        of.sides[kept++] = of.sides[i];
    }
    of.cells.resize(kept);
    of.sides.resize(kept);
}

}  // namespace

point3 cell_grid::point(lattice_key at, double shift) const {
    const auto along = [&](std::size_t axis, lattice_key i) {
        return low[axis] + step * (static_cast<double>(i) + shift);
    };
    return {along(0, at >> 40 & mask), along(1, at >> 20 & mask), along(2, at & mask)};
}

cell_grid cells_at(const char* function, const prepared_mesh& mesh, double distance,
                   wanted_side side, double step, base::work_progress& progress) {
    const box3 box = *bounding_box(mesh.indexed_view().points);
    cell_grid grid;
    double extent = 0.0;
    const double margin = (side == wanted_side::inside ? 0.0 : distance) + 2.0 * step;
    for (std::size_t k = 0; k < 3; ++k) {
        grid.low[k] = box.min[k] - margin;
        extent = std::max(extent, box.max[k] - box.min[k] + 2.0 * margin);
    }
    int levels = 0;
    while (std::ldexp(step, levels) < extent) ++levels;
    if (levels > most_levels)
        refuse_step(function, step, most_cells * std::ldexp(1.0, 2 * (levels - most_levels)));
    grid.step = std::ldexp(step, levels);
    level now{{0}, {side == wanted_side::any ? known::outside : known::neither}};
    for (int left = levels; left >= 0; --left) {
        if (left < levels) {
            now = split(now);
            grid.step *= 0.5;
        }
        now = near_level(std::move(now), mesh, distance, grid);
        if (side != wanted_side::any) drop_wrong_side(now, side);
        const auto count = static_cast<double>(now.cells.size());
        const double expected = std::ldexp(count, 2 * left);
        if ((count > sure_cells && expected > sure_share * most_cells) ||
            count > (left > 0 ? 0.5 : 1.0) * most_cells)
            refuse_step(function, step, expected);
        if (!progress.reach(0.3 * std::ldexp(1.0, -2 * left))) return {};
    }
    grid.cells = std::move(now.cells);
    std::sort(grid.cells.begin(), grid.cells.end());
    return grid;
}

}  // namespace treeform::detail::offset
