#pragma once
/// \file
/// What is nearest to the eye in each sample of a tile.

#include "tools/picture/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tools {

inline constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

/// The nearest primitive of each sample.
struct layer {
    std::vector<float> z{};
    std::vector<std::uint32_t> id{};

    void clear(std::size_t size) {
        z.assign(size, -std::numeric_limits<float>::infinity());
        id.assign(size, nothing);
    }
    void put(std::size_t at, double depth, std::uint32_t number) {
        const auto d = static_cast<float>(depth);
        if (d > z[at] || (d == z[at] && number < id[at])) {
            z[at] = d;
            id[at] = number;
        }
    }
    [[nodiscard]] bool any(std::size_t at) const { return id[at] != nothing; }
};

/// Samples of a tile: `size` in a row, the first one at (x, y) of the picture's samples.
struct sample_grid {
    long x = 0;
    long y = 0;
    long size = 0;

    /// Those of a row or column whose middles lie from `low` to `high`: [begin, end).
    [[nodiscard]] std::array<long, 2> range(double low, double high, long first) const {
        const auto bound = [&](double at) {
            const double shifted = at - static_cast<double>(first);
            return static_cast<long>(std::clamp(shifted, 0.0, static_cast<double>(size)));
        };
        return {bound(std::ceil(low - 0.5)), bound(std::floor(high + 0.5))};
    }
};

/// The plane of a triangle as depth over the picture, kept within its corners.
struct depth_plane {
    explicit depth_plane(const std::array<sample_point, 3>& t, double twice_area) : origin(t[0]) {
        const double ux = t[1].x - t[0].x, uy = t[1].y - t[0].y, uz = t[1].z - t[0].z;
        const double vx = t[2].x - t[0].x, vy = t[2].y - t[0].y, vz = t[2].z - t[0].z;
        dx = (uz * vy - vz * uy) / twice_area;
        dy = (vz * ux - uz * vx) / twice_area;
        low = std::min({t[0].z, t[1].z, t[2].z});
        high = std::max({t[0].z, t[1].z, t[2].z});
    }
    [[nodiscard]] double at(double x, double y) const {
        return std::clamp(origin.z + dx * (x - origin.x) + dy * (y - origin.y), low, high);
    }
    sample_point origin;
    double dx, dy, low, high;
};

/// Twice the area, positive where the corners go round clockwise on the screen.
[[nodiscard]] inline double twice_area(const std::array<sample_point, 3>& t) {
    return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

/// Calls `put(sample, z)` for the samples in the triangle, its edges included. Both faces at an
/// edge compute the same numbers for it, so there is no gap between them.
template <class Put>
void for_samples(const std::array<sample_point, 3>& t, const sample_grid& grid, const Put& put);

/// The same for what lies within `reach` of a segment.
template <class Put>
void for_samples(const std::array<sample_point, 2>& ends, double reach, const sample_grid& grid,
                 const Put& put);

namespace picture_detail {

/// On which side of an edge a point is; computed from its lower end, whichever face asks.
struct edge_side {
    edge_side(const sample_point& a, const sample_point& b, double turn) {
        const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
        const sample_point &from = swapped ? b : a, &to = swapped ? a : b;
        x = from.x;
        y = from.y;
        const double sign = swapped ? -turn : turn;
        wx = sign * (to.x - from.x);
        wy = sign * (to.y - from.y);
    }
    [[nodiscard]] double row(double py) const { return wx * (py - y); }
    [[nodiscard]] double at(double px, double row_value) const { return row_value - wy * (px - x); }
    /// Leaves of a range of x what may be on the inner side, and a little more.
    void narrow(double row_value, double& low, double& high) const {
        if (std::abs(wy) < 1e-9) return;
        const double meets = x + row_value / wy;
        if (wy > 0.0)
            high = std::min(high, meets + 1.0);
        else
            low = std::max(low, meets - 1.0);
    }
    double x, y, wx, wy;
};

}  // namespace picture_detail

template <class Put>
void for_samples(const std::array<sample_point, 3>& t, const sample_grid& grid, const Put& put) {
    const double twice = twice_area(t);
    if (twice == 0.0) return;
    const auto [x0, x1] =
        grid.range(std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}), grid.x);
    const auto [y0, y1] =
        grid.range(std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}), grid.y);
    if (x0 >= x1 || y0 >= y1) return;
    const depth_plane plane(t, twice);
    const double turn = twice > 0.0 ? 1.0 : -1.0;
    const picture_detail::edge_side a(t[0], t[1], turn), b(t[1], t[2], turn), c(t[2], t[0], turn);
    for (long row = y0; row < y1; ++row) {
        const double y = static_cast<double>(grid.y + row) + 0.5;
        const double ra = a.row(y), rb = b.row(y), rc = c.row(y);
        long begin = x0, end = x1;
        if (x1 - x0 > 8) {  // long and thin ones are mostly not in their boxes
            double low = static_cast<double>(grid.x), high = low + static_cast<double>(grid.size);
            a.narrow(ra, low, high);
            b.narrow(rb, low, high);
            c.narrow(rc, low, high);
            const auto [first, last] = grid.range(low, high, grid.x);
            begin = std::max(x0, first);
            end = std::min(x1, last);
        }
        for (long column = begin; column < end; ++column) {
            const double x = static_cast<double>(grid.x + column) + 0.5;
            if (a.at(x, ra) >= 0.0 && b.at(x, rb) >= 0.0 && c.at(x, rc) >= 0.0)
                put(static_cast<std::size_t>(row * grid.size + column), plane.at(x, y));
        }
    }
}

template <class Put>
void for_samples(const std::array<sample_point, 2>& ends, double reach, const sample_grid& grid,
                 const Put& put) {
    const auto& [a, b] = ends;
    const auto [x0, x1] =
        grid.range(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, grid.x);
    const auto [y0, y1] =
        grid.range(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, grid.y);
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    for (long row = y0; row < y1; ++row) {
        const double py = static_cast<double>(grid.y + row) + 0.5 - a.y;
        // Of the segment, only what is at most `reach` above or below can be near enough.
        double from = 0.0, to = 1.0;
        if (std::abs(dy) > 1e-9) {
            from = std::clamp((dy > 0.0 ? py - reach : py + reach) / dy, 0.0, 1.0);
            to = std::clamp((dy > 0.0 ? py + reach : py - reach) / dy, 0.0, 1.0);
        }
        const double left = a.x + std::min(from * dx, to * dx) - reach - 1.0;
        const double right = a.x + std::max(from * dx, to * dx) + reach + 1.0;
        const auto [begin, end] = grid.range(left, right, grid.x);
        for (long column = std::max(begin, x0); column < std::min(end, x1); ++column) {
            const double px = static_cast<double>(grid.x + column) + 0.5 - a.x;
            const double t =
                square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
            const double ox = px - t * dx, oy = py - t * dy;
            if (ox * ox + oy * oy <= reach * reach)
                put(static_cast<std::size_t>(row * grid.size + column), a.z + t * (b.z - a.z));
        }
    }
}

}  // namespace tools
