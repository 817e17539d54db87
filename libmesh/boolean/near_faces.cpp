#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

namespace treeform::detail::boolean {
namespace {

constexpr double largest_coordinate = 0x1p1000;

using box = aabb<double, 3>;
using ids = std::vector<std::uint32_t>;

bool can_be_used(const point3& p) {
    return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate &&
           std::abs(p.z) <= largest_coordinate;
}

/// What `make(begin, end)` gives for chunks, in order.
template <class T, class Make>
std::vector<T> by_chunks(std::size_t count, const Make& make) {
    std::vector<T> made(chunk_count(count, light_grain));
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        made[c] = make(begin, end);
    });
    return made;
}

box joined(const std::vector<box>& parts) {
    box all;
    for (const box& part : parts) all.include(part);
    return all;
}

/// Points that cannot be used apart: faces tell whether they matter.
box box_of(points_view points) {
    return joined(by_chunks<box>(points.size(), [&](std::size_t begin, std::size_t end) {
        box part;
        for (std::size_t i = begin; i < end; ++i)
            if (can_be_used(points[i])) part.include(points[i]);
        return part;
    }));
}

/// Where a point is: a bit for each side of a box that it is beyond.
using outcode = std::uint8_t;
constexpr outcode unusable = 64;

/// Faces of a mesh by whether their boxes meet another box: all corners of those that do not are
/// beyond one of its sides.
class reach_test {
  public:
    reach_test(mesh_view mesh, const box& reach) : mesh_(mesh), codes_(mesh.points.size()) {
        for_chunks(codes_.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           codes_[i] = code_of(mesh.points[i], reach);
                   });
    }

    [[nodiscard]] bool operator()(std::size_t f) const {
        const auto& [a, b, c] = mesh_.faces[f];
        return (codes_[a] & codes_[b] & codes_[c]) == 0;
    }
    [[nodiscard]] bool can_be_used(std::size_t f) const {
        const auto& [a, b, c] = mesh_.faces[f];
        return ((codes_[a] | codes_[b] | codes_[c]) & unusable) == 0;
    }

  private:
    static outcode code_of(const point3& p, const box& reach) {
        unsigned code = treeform::detail::boolean::can_be_used(p) ? 0 : unusable;
        for (std::size_t k = 0; k < 3; ++k)
            code |= (p[k] < reach.min[k] ? 1U : 0U) << 2 * k | (p[k] > reach.max[k] ? 2U : 0U)
                                                                   << 2 * k;
        return static_cast<outcode>(code);
    }

    mesh_view mesh_;
    buffer<outcode> codes_;
};

/// The box of the faces that reach into `reach`; none when a face cannot be used.
std::optional<box> box_within(mesh_view mesh, const box& reach) {
    const reach_test reaches(mesh, reach);
    std::atomic<bool> bad{false};
    const auto parts = by_chunks<box>(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        box part;
        for (std::size_t f = begin; f < end; ++f) {
            if (!reaches.can_be_used(f)) bad = true;
            if (!reaches(f)) continue;
            for (const std::uint32_t corner : mesh.faces[f]) part.include(mesh.points[corner]);
        }
        return part;
    });
    if (bad) return std::nullopt;
    return joined(parts);
}

ids faces_within(mesh_view mesh, const box& reach) {
    const reach_test reaches(mesh, reach);
    ids all;
    for (const ids& part :
         by_chunks<ids>(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
             ids found;
             for (std::size_t f = begin; f < end; ++f)
                 if (reaches(f)) found.push_back(static_cast<std::uint32_t>(f));
             return found;
         }))
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Appends the points of `faces`, ascending, and the faces in their numbers.
void append(mesh_view mesh, const ids& faces, std::uint32_t points_before,
            std::uint32_t faces_before, near_faces& result) {
    buffer<std::uint32_t> number(mesh.points.size());
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, 0U);
    });
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            for (const std::uint32_t corner : mesh.faces[faces[i]])
                std::atomic_ref(number[corner]).store(1, std::memory_order_relaxed);
    });
    const std::size_t points = result.local.points.size();
    base::compact(
        number.size(), [&](std::size_t p) { return number[p] != 0; },
        [&](std::size_t count) {
            result.local.points.resize(points + count);
            result.point_of.resize(points + count);
        },
        [&](std::size_t p, std::size_t place) {
            number[p] = static_cast<std::uint32_t>(points + place);
            result.local.points[points + place] = mesh.points[p];
            result.point_of[points + place] = points_before + static_cast<std::uint32_t>(p);
        });
    const std::size_t first = result.local.faces.size();
    result.local.faces.resize(first + faces.size());
    result.face_of.resize(first + faces.size());
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b, c] = mesh.faces[faces[i]];
            result.local.faces[first + i] = {number[a], number[b], number[c]};
            result.face_of[first + i] = faces_before + faces[i];
        }
    });
}

/// Points of the second operand become those of the first that they are equal to; false when two of
/// one operand are equal.
bool join_equal(const box& common, std::uint32_t points_of_a, near_faces& near) {
    mesh& local = near.local;
    ids inside;  // points that can equal one of the other operand
    std::vector<point3> at;
    base::compact(
        local.points.size(),
        [&](std::size_t p) {
            box point;
            point.include(local.points[p]);
            return overlaps(point, common);
        },
        [&](std::size_t count) {
            inside.resize(count);
            at.resize(count);
        },
        [&](std::size_t p, std::size_t place) {
            inside[place] = static_cast<std::uint32_t>(p);
            at[place] = local.points[p];
        });
    const auto equal = weld::few_equal_points(at);
    if (!equal) return true;
    ids same(local.points.size());
    for (std::uint32_t p = 0; p < same.size(); ++p) same[p] = p;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::uint32_t first = inside[equal->first_of_new[equal->new_of_old[i]]];
        if (first == inside[i]) continue;
        if (near.point_of[first] >= points_of_a || near.point_of[inside[i]] < points_of_a)
            return false;
        same[inside[i]] = first;
    }
    std::size_t left = 0;
    for (std::uint32_t p = 0; p < same.size(); ++p) {
        if (same[p] != p) {
            same[p] = same[same[p]];  // the first came before and has its number
            continue;
        }
        local.points[left] = local.points[p];
        near.point_of[left] = near.point_of[p];
        same[p] = static_cast<std::uint32_t>(left++);
    }
    local.points.resize(left);
    near.point_of.resize(left);
    for (face& f : local.faces) f = {same[f[0]], same[f[1]], same[f[2]]};
    return true;
}

}  // namespace

std::optional<near_faces> find_near_faces(std::span<const mesh_view, 2> operands) {
    near_faces result;
    for (const mesh_view& operand : operands)
        base::check_faces("boolean", operand.points.size(), operand.faces);
    for (std::size_t k = 0; k < 2; ++k) result.box[k] = box_of(operands[k].points);
    box reach;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto part = box_within(operands[k], result.box[1 - k]);
        if (!part) return std::nullopt;
        reach.include(*part);
    }
    const auto points_of_a = static_cast<std::uint32_t>(operands[0].points.size());
    const auto faces_of_a = static_cast<std::uint32_t>(operands[0].faces.size());
    append(operands[0], faces_within(operands[0], reach), 0, 0, result);
    result.first_of_b = static_cast<std::uint32_t>(result.local.faces.size());
    append(operands[1], faces_within(operands[1], reach), points_of_a, faces_of_a, result);
    if (!join_equal(common_box(result.box[0], result.box[1]), points_of_a, result))
        return std::nullopt;
    return result;
}

}  // namespace treeform::detail::boolean
