#include <libmesh/detail/nearest_float.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/repair/detail/fill_hole.hpp>
#include <libmesh/repair/detail/remove_faces.hpp>
#include <libmesh/validate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace tf::detail {
namespace {

constexpr std::size_t listed_pairs = 100;

class remover {
  public:
    remover(mesh_view given, const repair_options& options)
        : options_(options), now_{{given.points.begin(), given.points.end()}, {}} {
        now_.faces.assign(given.faces.begin(), given.faces.end());
        if (options.to_float) to_floats();
        result_.face_of.resize(now_.faces.size());
        std::iota(result_.face_of.begin(), result_.face_of.end(), 0U);
        remember_open_edges();
    }

    repaired_mesh run() {
        if (!std::isfinite(result_.max_move)) return finished();  // beyond the range of float
        const int rounds = std::max(options_.removal_rounds, 0);
        for (int round = 0; look() && round < rounds; ++round) {
            widen(1 + round / 2);
            take_away();
            close();
        }
        return finished();
    }

  private:
    void to_floats() {
        for (point3& p : now_.points) {
            const point3 rounded{nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
            for (std::size_t k = 0; k < 3; ++k)
                result_.max_move = std::max(result_.max_move, std::abs(rounded[k] - p[k]));
            p = rounded;
        }
    }

    void remember_open_edges() {
        const directed_edges edges(now_.faces);
        for (const face& f : now_.faces)
            for (std::size_t i = 0; i < 3; ++i)
                if (!edges.has(f[(i + 1) % 3], f[i])) was_open_.push_back({f[(i + 1) % 3], f[i]});
        std::sort(was_open_.begin(), was_open_.end());
    }
    [[nodiscard]] bool was_open(std::uint32_t from, std::uint32_t to) const {
        return std::binary_search(was_open_.begin(), was_open_.end(), std::array{from, to});
    }

    /// Marks the faces that meet others, are degenerate, or end at a hole that could not be closed;
    /// whether there are any.
    bool look() {
        result_.meeting.clear();
        result_.meeting_count = 0;
        marked_.assign(now_.faces.size(), 0);
        const auto found = self_intersections(now_, {.progress = options_.progress});
        result_.cancelled = found.cancelled;
        if (found.cancelled) return false;
        for (const std::uint32_t f : find_defects(now_).degenerate_faces) complain(f, f);
        for (const face_pair& pair : found.pairs) complain(pair.a, pair.b);
        const bool holes = mark_new_holes();
        return result_.meeting_count > 0 || holes;
    }
    /// Marks the faces at open edges that were not open at the beginning.
    bool mark_new_holes() {
        const directed_edges edges(now_.faces);
        has_new_hole_ = false;
        for (std::size_t f = 0; f < now_.faces.size(); ++f)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = now_.faces[f][(i + 1) % 3], to = now_.faces[f][i];
                if (edges.has(from, to) || was_open(from, to)) continue;
                marked_[f] = 1;
                has_new_hole_ = true;
            }
        return has_new_hole_;
    }
    void complain(std::uint32_t f, std::uint32_t g) {
        marked_[f] = marked_[g] = 1;
        ++result_.meeting_count;
        if (result_.meeting.size() < listed_pairs) result_.meeting.push_back({f, g});
    }

    /// Marks the faces at the points of marked faces, `rings` times.
    void widen(int rings) {
        std::vector<char> at_point(now_.points.size());
        for (int ring = 0; ring < rings; ++ring) {
            for (std::size_t f = 0; f < marked_.size(); ++f)
                if (marked_[f] != 0)
                    for (const std::uint32_t c : now_.faces[f]) at_point[c] = 1;
            for (std::size_t f = 0; f < marked_.size(); ++f)
                for (const std::uint32_t c : now_.faces[f])
                    if (at_point[c] != 0) marked_[f] = 1;
        }
    }

    void take_away() {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < marked_.size(); ++f) {
            if (marked_[f] != 0) continue;
            now_.faces[kept] = now_.faces[f];
            result_.face_of[kept++] = result_.face_of[f];
        }
        now_.faces.resize(kept);
        result_.face_of.resize(kept);
    }

    /// Fills the holes no edge of which was open at the beginning.
    void close() {
        const directed_edges edges(now_.faces);
        for (const auto& rim : find_rims(now_.faces, edges)) {
            bool was_hole = false;
            for (std::size_t i = 0; i < rim.size(); ++i)
                was_hole = was_hole || was_open(rim[i], rim[(i + 1) % rim.size()]);
            if (was_hole) continue;
            for (const face& f : fill(now_.points, rim, edges)) {
                now_.faces.push_back(f);
                result_.face_of.push_back(repaired_mesh::none);
            }
        }
    }

    /// Without the points that no face uses.
    repaired_mesh finished() {
        result_.certified = std::isfinite(result_.max_move) && !result_.cancelled &&
                            result_.meeting_count == 0 && !has_new_hole_;
        std::vector<std::uint32_t> number(now_.points.size(), repaired_mesh::none);
        for (const face& f : now_.faces)
            for (const std::uint32_t c : f) number[c] = 0;
        for (std::uint32_t p = 0; p < number.size(); ++p) {
            if (number[p] == repaired_mesh::none) continue;
            number[p] = static_cast<std::uint32_t>(result_.point_of.size());
            result_.point_of.push_back(p);
            result_.surface.points.push_back(now_.points[p]);
        }
        for (face& f : now_.faces)
            for (std::uint32_t& c : f) c = number[c];
        result_.surface.faces = std::move(now_.faces);
        return std::move(result_);
    }

    const repair_options& options_;
    mesh now_;
    std::vector<std::array<std::uint32_t, 2>> was_open_;  ///< as a hole runs along them
    std::vector<char> marked_;                            ///< by face: to be deleted
    bool has_new_hole_ = false;
    repaired_mesh result_{};
};

}  // namespace

repaired_mesh remove_faces(mesh_view mesh, const repair_options& options) {
    return remover(mesh, options).run();
}

}  // namespace tf::detail
