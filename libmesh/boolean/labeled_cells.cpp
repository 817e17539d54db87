#include <libmesh/boolean/cell_faces.hpp>
#include <libmesh/boolean/cell_windings.hpp>
#include <libmesh/boolean/labeled_cells.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr double share_dropped = 0.25;  // of an inner face with the same on both sides
constexpr double share_filling = 0.5;   // of a filling that separates
constexpr double units = 0x1p40;        // in all area together

/// Disagreement as a network, whose source stands for inside.
class disagreement {
  public:
    disagreement(const cell_faces& known, const cell_windings& cells) {
        const double all = std::accumulate(cells.area.begin(), cells.area.end(), 0.0);
        scale_ = all > 0.0 ? units / all : 0.0;
        const std::size_t count = cells.area.size();
        costs_.from_source.resize(count);  // of being outside
        costs_.to_sink.resize(count);      // of being inside
        for (std::size_t c = 1; c < count; ++c) {
            costs_.from_source[c] = whole(cells.area[c] * cells.winding[c]);
            costs_.to_sink[c] = whole(cells.area[c] * (1.0 - cells.winding[c]));
        }
        for (const cell_face& f : known.all) add(f);
        costs_.from_source[0] = 0;
        costs_.to_sink[0] = std::int64_t{1} << 60;  // more than all else together
    }

    [[nodiscard]] const network& costs() const { return costs_; }

  private:
    [[nodiscard]] std::int64_t whole(double area) const {
        return static_cast<std::int64_t>(area * scale_);
    }

    void add(const cell_face& f) {
        auto [out, in] = f.cells;
        if (out == in || (f.is_given && f.times == 0.0)) return;
        if (!f.is_given) {
            costs_.edges.push_back({in, out, whole(share_filling * f.area)});
            costs_.edges.push_back({out, in, whole(share_filling * f.area)});
            return;
        }
        if (f.is_outer) {
            costs_.from_source[std::max(out, in)] += whole(f.area);
            return;
        }
        // With x = 1 inside: s (1 + x_out - x_in) + (1 - 2 s) x_out (1 - x_in) for the share s is 0
        // where the face separates as it should, s where it does not, and 1 where it is turned.
        if (f.times < 0.0) std::swap(out, in);
        const double area = f.area * (f.is_doubted ? share_doubted : 1.0);
        costs_.to_sink[out] += whole(share_dropped * area);
        costs_.from_source[in] += whole(share_dropped * area);
        costs_.edges.push_back({out, in, whole((1.0 - 2.0 * share_dropped) * area)});
    }

    double scale_ = 0.0;
    network costs_{};
};

labeled_cells counted(const cell_faces& known, std::vector<std::uint8_t> inside) {
    labeled_cells result{.inside = std::move(inside)};
    for (const cell_face& f : known.all) {
        if (!f.is_given) continue;
        const bool in_front = result.inside[f.cells[0]] != 0;
        const bool is_behind = result.inside[f.cells[1]] != 0;
        const double area = f.area * known.unit * known.unit;
        if (in_front == is_behind)
            result.dropped_area += area;
        else if (f.times != 0.0 && in_front == (f.times > 0.0))
            result.flipped_area += area;
    }
    return result;
}

}  // namespace

std::optional<labeled_cells> label_cells(const mesh_arrangement& cut,
                                         const arrangement_cells& cells, std::size_t count,
                                         std::span<const std::uint32_t> is_filling,
                                         function_ref<bool()> stop) {
    const cell_faces known = find_cell_faces(cut, cells, count, is_filling);
    if (stop()) return std::nullopt;
    const auto windings = find_cell_windings(known, cut.faces, stop);
    if (!windings) return std::nullopt;
    auto inside = minimum_cut(disagreement(known, *windings).costs(), stop);
    if (!inside) return std::nullopt;
    (*inside)[0] = 0;
    return counted(known, std::move(*inside));
}

}  // namespace treeform::detail::boolean
