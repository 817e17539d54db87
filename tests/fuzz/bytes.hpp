#pragma once
/// \file
/// Geometry out of a fuzzer's bytes, with shapes that matter within reach of few of them: corners
/// that are equal, on a line or in a plane, or off by an ulp.

#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace treeform::fuzz {

/// Ends the program when what a target promises does not hold.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "not so: %s\n", what);
    std::abort();
}

class bytes {
  public:
    bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    [[nodiscard]] bool empty() const { return size_ == 0; }

    /// 0 when there is none left.
    std::uint8_t byte() {
        if (empty()) return 0;
        --size_;
        return *data_++;
    }
    /// 0 to n - 1.
    std::size_t below(std::size_t n) { return byte() % n; }

    /// Finite. The first byte says how it is made; 7 stands for the eight bytes of any double.
    double coordinate() {
        switch (below(8)) {
            case 0:
            case 1:
                return small();
            case 2:
                return small() / 8;
            case 3:
                return 0.1 * small();
            case 4: {
                const double whole = small();
                return whole + std::ldexp(small(), -46);  // near, with all digits
            }
            case 5: {
                const double whole = small();
                return std::ldexp(whole, static_cast<std::int8_t>(byte()));
            }
            case 6: {
                const double whole = small();
                return std::ldexp(whole, 8 * static_cast<int>(static_cast<std::int8_t>(byte())));
            }
            default:
                return any_double();
        }
    }

    /// Finite. The first byte says whether it is new (below 4, so that a coordinate's own bytes
    /// follow), one from before, or made from those before.
    point3 point() {
        point3 p;
        const std::size_t how = below(8);
        if (how < 4 || points_.empty()) {
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = coordinate();
        } else if (how == 4) {
            p = before();
        } else {
            const point3 a = before();
            const point3 b = before();
            const point3 c = how == 5 ? a : before();
            const double s = small() / 8;
            const double t = small() / 8;
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] = finite(a[axis] + s * (b[axis] - a[axis]) + t * (c[axis] - a[axis]));
            if (how == 7) by_ulps(p);
        }
        points_.push_back(p);
        return p;
    }

    /// At most so many points and faces, any corners.
    mesh shape(std::size_t most_points, std::size_t most_faces) {
        mesh made;
        const std::size_t points = 1 + below(most_points);
        for (std::size_t i = 0; i < points; ++i) made.points.push_back(point());
        const std::size_t faces = below(most_faces + 1);
        for (std::size_t i = 0; i < faces && !empty(); ++i) {
            const auto corner = [&] { return static_cast<std::uint32_t>(below(points)); };
            const std::uint32_t a = corner();
            const std::uint32_t b = corner();
            made.faces.push_back({a, b, corner()});
        }
        return made;
    }

    /// A closed surface: a tetrahedron, a box or an octahedron, either way round, perhaps flat.
    mesh solid() {
        mesh made;
        const std::size_t kind = below(3);
        const auto add_points = [&](int count) {
            for (int i = 0; i < count; ++i) made.points.push_back(point());
        };
        if (kind == 0) {
            add_points(4);
            made.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        } else if (kind == 1) {
            const point3 p = point();
            const point3 q = point();
            for (int i = 0; i < 8; ++i)
                made.points.push_back(
                    {(i & 1) != 0 ? q.x : p.x, (i & 2) != 0 ? q.y : p.y, (i & 4) != 0 ? q.z : p.z});
            made.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        } else {
            add_points(6);
            made.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                          {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
        }
        return made;
    }

  private:
    double small() { return static_cast<double>(static_cast<std::int8_t>(byte())); }
    static double finite(double x) { return std::isfinite(x) ? x : 0.0; }
    double any_double() {
        std::uint64_t bits = 0;
        for (int shift = 0; shift < 64; shift += 8) bits |= std::uint64_t{byte()} << shift;
        return finite(std::bit_cast<double>(bits));
    }
    const point3& before() { return points_[below(points_.size())]; }
    void by_ulps(point3& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t which = below(3);
            if (which != 0) p[axis] = finite(std::nextafter(p[axis], which == 1 ? 1e308 : -1e308));
        }
    }

    const std::uint8_t* data_;
    std::size_t size_;
    std::vector<point3> points_;
};

}  // namespace treeform::fuzz
