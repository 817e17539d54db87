#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/labeled_cells.hpp>
#include <libmesh/boolean/unbalanced_patches.hpp>
#include <libmesh/boolean/winding_sum.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr double share_dropped = 0.25;   // of an inner face with the same on both sides
constexpr double share_doubted = 0.5;    // of what inner faces say that others do not go on with
constexpr double share_filling = 0.5;    // of a filling that separates
constexpr std::size_t faces_asked = 32;  // of a cell, for its winding number
constexpr double units = 0x1p40;         // in all area together

/// What is known of a face of the arrangement.
struct known_face {
    std::array<std::uint32_t, 2> cells{};  ///< in front and behind
    double area = 0.0;
    bool is_given = false;  ///< not only fillings cover it
    bool is_outer = false;  ///< between the unbounded cell and another one
    double times = 0.0;     ///< given faces that run as it does, less those that run against it
};

class labeler {
  public:
    labeler(const mesh_arrangement& cut, const arrangement_cells& cells, std::size_t count,
            std::span<const std::uint32_t> is_filling)
        : cut_(cut),
          cells_(cells),
          count_(count),
          is_filling_(is_filling),
          faces_(cut.faces.size()) {}

    std::optional<labeled_cells> run(function_ref<bool()> stop) {
        take_points();
        for_chunks(faces_.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f) look_at(f);
                   });
        doubt_inner_faces();
        if (stop()) return std::nullopt;
        find_windings();
        auto inside = minimum_cut(disagreement(), stop);
        if (!inside) return std::nullopt;
        (*inside)[0] = 0;
        return counted(std::move(*inside));
    }

  private:
    /// As approximated, about the middle of the bounding box, in units of its longest side.
    void take_points() {
        const std::size_t given = cut_.given_points.size();
        points_.resize(given + cut_.constructed.size());
        std::copy(cut_.given_points.begin(), cut_.given_points.end(), points_.begin());
        for (std::size_t p = given; p < points_.size(); ++p)
            points_[p] = cut_.constructed[p - given].center();
        const auto box = bounding_box(points_);
        if (!box) return;
        unit_ = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            unit_ = std::max(unit_, box->max[k] / 2.0 - box->min[k] / 2.0);
        if (!(unit_ > 0.0)) unit_ = 1.0;
        for (point3& p : points_)
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = (p[k] - (box->min[k] / 2.0 + box->max[k] / 2.0)) / unit_;
    }

    void look_at(std::size_t f) {
        known_face& known = faces_[f];
        known.cells = cells_.cell_of_side[f];
        const auto [a, b, c] = base::triangle_of(points_, cut_.faces[f]);
        const point3 normal = base::cross(base::minus(b, a), base::minus(c, a));
        known.area = std::sqrt(base::dot(normal, normal)) / 2.0;
        for (const covering_face& cover : cut_.covers_of(f)) {
            if (is_filling_[cover.face] != 0) continue;
            known.is_given = true;
            known.times += cover.opposite ? -1 : 1;
        }
        const auto [front, behind] = known.cells;
        if (front == behind) known.times = 0.0;
        known.is_outer = front != behind && (front == 0 || behind == 0);
        if (known.is_given && known.is_outer)
            known.times = std::max(std::abs(known.times), 1.0) * (front == 0 ? 1.0 : -1.0);
    }

    /// Outer faces are balanced among themselves. Of the others, those of cavities and of shells
    /// that overlap are, and those of walls are not.
    void doubt_inner_faces() {
        std::vector<double> times(faces_.size());
        for (std::size_t f = 0; f < times.size(); ++f)
            times[f] = faces_[f].is_outer ? 0.0 : faces_[f].times;
        const auto is_doubted = find_unbalanced_patches(points_.size(), cut_.faces, times);
        for (std::size_t f = 0; f < times.size(); ++f)
            if (is_doubted[f] != 0) faces_[f].times *= share_doubted;
    }

    /// Calls `visit(cell, is_behind)` for the cells that a face bounds.
    template <class Visit>
    void for_each_side(std::size_t f, const Visit& visit) const {
        const auto [front, behind] = faces_[f].cells;
        if (front == behind) return;
        visit(front, false);
        visit(behind, true);
    }

    /// [F'] 1 for those that are among the largest of a cell.
    [[nodiscard]] std::vector<std::uint8_t> faces_to_ask() const {
        std::vector<std::size_t> begin(count_ + 1, 0);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for_each_side(f, [&](std::uint32_t cell, bool) { ++begin[cell]; });
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<std::uint32_t> faces_at(begin.back());
        for (std::size_t f = faces_.size(); f-- > 0;)
            for_each_side(f, [&](std::uint32_t cell, bool) {
                faces_at[--begin[cell]] = static_cast<std::uint32_t>(f);
            });
        std::vector<std::uint8_t> is_asked(faces_.size(), 0);
        for (std::size_t c = 1; c < count_; ++c) {
            const std::span<std::uint32_t> own{faces_at.data() + begin[c], begin[c + 1] - begin[c]};
            const std::size_t some = std::min(own.size(), faces_asked);
            std::ranges::partial_sort(
                own, own.begin() + static_cast<std::ptrdiff_t>(some), {},
                [&](std::uint32_t f) { return std::pair(-faces_[f].area, f); });
            for (const std::uint32_t f : own.first(some)) is_asked[f] = 1;
        }
        return is_asked;
    }

    void find_windings() {
        std::vector<double> times(faces_.size());
        for (std::size_t f = 0; f < times.size(); ++f) times[f] = faces_[f].times;
        const winding_sum sum({points_, cut_.faces}, times);
        const std::vector<std::uint8_t> is_asked = faces_to_ask();
        std::vector<double> around(faces_.size(), 0.0);
        constexpr std::size_t grain = 64;
        for_chunks(faces_.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t f = begin; f < end; ++f) {
                if (is_asked[f] == 0) continue;
                const auto [a, b, c] = base::triangle_of(points_, cut_.faces[f]);
                const point3 middle = base::scaled(base::plus(base::plus(a, b), c), 1.0 / 3.0);
                around[f] = sum.around(middle, static_cast<std::uint32_t>(f));
            }
        });
        std::vector<double> asked(count_, 0.0);
        area_.assign(count_, 0.0);
        winding_.assign(count_, 0.0);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for_each_side(f, [&](std::uint32_t cell, bool is_behind) {
                const known_face& known = faces_[f];
                area_[cell] += known.area;
                if (is_asked[f] == 0) return;
                asked[cell] += known.area;
                const double own = is_behind ? 0.5 : -0.5;
                winding_[cell] += known.area * (around[f] + own * known.times);
            });
        for (std::size_t c = 0; c < count_; ++c)
            winding_[c] = asked[c] > 0.0 ? std::min(std::abs(winding_[c] / asked[c]), 1.0) : 0.0;
    }

    /// The source stands for inside.
    [[nodiscard]] network disagreement() const {
        double all = 0.0;
        for (std::size_t c = 0; c < count_; ++c) all += area_[c];
        const double scale = all > 0.0 ? units / all : 0.0;
        const auto whole = [&](double area) {
            return static_cast<std::int64_t>(area * scale + 0.5);
        };
        network costs;
        costs.from_source.resize(count_);  // of being outside
        costs.to_sink.resize(count_);      // of being inside
        for (std::size_t c = 1; c < count_; ++c) {
            costs.from_source[c] = whole(area_[c] * winding_[c]);
            costs.to_sink[c] = whole(area_[c] * (1.0 - winding_[c]));
        }
        for (const known_face& known : faces_) {
            auto [out, in] = known.cells;
            if (out == in || (known.is_given && known.times == 0.0)) continue;
            if (!known.is_given) {
                costs.edges.push_back({in, out, whole(share_filling * known.area)});
                costs.edges.push_back({out, in, whole(share_filling * known.area)});
                continue;
            }
            if (known.is_outer) {
                costs.from_source[std::max(out, in)] += whole(known.area);
                continue;
            }
            // With x = 1 inside: s (1 + x_out - x_in) + (1 - 2 s) x_out (1 - x_in) for the share s
            // is 0 where it separates as it should, s where it does not, and 1 where it is turned.
            if (known.times < 0.0) std::swap(out, in);
            const double area = known.area * std::min(std::abs(known.times), 1.0);
            costs.to_sink[out] += whole(share_dropped * area);
            costs.from_source[in] += whole(share_dropped * area);
            costs.edges.push_back({out, in, whole((1.0 - 2.0 * share_dropped) * area)});
        }
        costs.from_source[0] = 0;
        costs.to_sink[0] = std::int64_t{1} << 60;  // more than all else together
        return costs;
    }

    [[nodiscard]] labeled_cells counted(std::vector<std::uint8_t> inside) const {
        labeled_cells result{.inside = std::move(inside)};
        for (const known_face& known : faces_) {
            const bool in_front = result.inside[known.cells[0]] != 0;
            const bool is_behind = result.inside[known.cells[1]] != 0;
            const double area = known.area * unit_ * unit_;
            if (!known.is_given) continue;
            if (in_front == is_behind)
                result.dropped_area += area;
            else if (known.times != 0.0 && in_front == (known.times > 0.0))
                result.turned_area += area;
        }
        return result;
    }

    const mesh_arrangement& cut_;
    const arrangement_cells& cells_;
    std::size_t count_;
    std::span<const std::uint32_t> is_filling_;
    std::vector<point3> points_{};
    double unit_ = 1.0;
    std::vector<known_face> faces_;
    std::vector<double> area_{};     ///< [C] around each cell
    std::vector<double> winding_{};  ///< [C] in [0, 1]
};

}  // namespace

std::optional<labeled_cells> label_cells(const mesh_arrangement& cut,
                                         const arrangement_cells& cells, std::size_t count,
                                         std::span<const std::uint32_t> is_filling,
                                         function_ref<bool()> stop) {
    return labeler(cut, cells, count, is_filling).run(stop);
}

}  // namespace treeform::detail::boolean
