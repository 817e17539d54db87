#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/cell_windings.hpp>
#include <libmesh/boolean/winding_sum.hpp>
#include <libmesh/geometry/solid_angle.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::size_t faces_asked = 8;  // of a cell

class asker {
  public:
    asker(const cell_faces& known, std::span<const face> faces, const winding_sum& sum)
        : known_(known), mesh_{known.points, faces}, sum_(sum) {}

    [[nodiscard]] double winding_of(std::uint32_t cell) const {
        const auto own = known_.of_cell(cell);
        std::vector<std::uint32_t> asked(own.begin(), own.end());
        std::vector<std::uint32_t> doubted;
        for (const std::uint32_t f : own)
            if (known_.all[f].is_doubted) doubted.push_back(f);
        const auto some =
            asked.begin() + static_cast<std::ptrdiff_t>(std::min(asked.size(), faces_asked));
        std::ranges::partial_sort(
            asked, some, {}, [&](std::uint32_t f) { return std::pair(-known_.all[f].area, f); });
        double sum = 0.0, area = 0.0;
        for (auto f = asked.begin(); f != some; ++f) {
            sum += known_.all[*f].area * winding_at(*f, cell, doubted);
            area += known_.all[*f].area;
        }
        return area > 0.0 ? std::min(std::abs(sum / area), 1.0) : 0.0;
    }

  private:
    /// At the middle of face f, on the side of the cell.
    [[nodiscard]] double winding_at(std::uint32_t f, std::uint32_t cell,
                                    const std::vector<std::uint32_t>& doubted) const {
        const auto [a, b, c] = base::triangle_of(mesh_, f);
        const point3 q = base::scaled(base::plus(base::plus(a, b), c), 1.0 / 3.0);
        const cell_face& here = known_.all[f];
        const double side = here.cells[1] == cell ? 0.5 : -0.5;
        double winding = sum_.around(q, f);
        winding += side * here.times * (here.is_doubted ? share_doubted : 1.0);
        double angles = 0.0;
        for (const std::uint32_t g : doubted) {
            if (g == f) continue;
            const auto [d, e, h] = base::triangle_of(mesh_, g);
            angles +=
                known_.all[g].times *
                geometry::solid_angle(base::minus(d, q), base::minus(e, q), base::minus(h, q));
        }
        return winding + share_doubted * angles / geometry::full_solid_angle;
    }

    const cell_faces& known_;
    mesh_view mesh_;
    const winding_sum& sum_;
};

}  // namespace

std::optional<cell_windings> find_cell_windings(const cell_faces& known,
                                                std::span<const face> faces,
                                                function_ref<bool()> stop) {
    std::vector<double> times(known.all.size());
    for (std::size_t f = 0; f < times.size(); ++f)
        times[f] = known.all[f].is_doubted ? 0.0 : known.all[f].times;
    const winding_sum sum({known.points, faces}, times);
    if (stop()) return std::nullopt;
    const asker ask(known, faces, sum);
    const std::size_t count = known.begin.size() - 1;
    cell_windings found{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
    constexpr std::size_t cells_between_questions = 4096;
    for (std::size_t first = 0; first < count; first += cells_between_questions) {
        const std::size_t some = std::min(count - first, cells_between_questions);
        for_chunks(some, 1, [&](std::size_t i, std::size_t, std::size_t) {
            const std::size_t c = first + i;
            for (const std::uint32_t f : known.of_cell(c)) found.area[c] += known.all[f].area;
            if (c > 0) found.winding[c] = ask.winding_of(static_cast<std::uint32_t>(c));
        });
        if (stop()) return std::nullopt;
    }
    return found;
}

}  // namespace treeform::detail::boolean
