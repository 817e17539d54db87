#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/cut/layer_loops.hpp>
#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace treeform {
namespace {

using detail::cut::crossing;
using detail::cut::plane_levels;

/// A value at vertices, and its levels, ascending.
class valued_mesh {
  public:
    valued_mesh(const char* function, const mesh_ref& given, std::span<const double> values,
                std::span<const double> levels)
        : mesh_(given.view()), values_(values), given_(levels.begin(), levels.end()) {
        const std::string name = std::string("treeform::") + function;
        detail::base::check_faces(function, mesh_.points.size(), mesh_.faces);
        detail::base::check_finite_faces(function, mesh_);
        if (values.size() != mesh_.points.size())
            throw std::invalid_argument(name + ": " + std::to_string(values.size()) +
                                        " values for " + std::to_string(mesh_.points.size()) +
                                        " vertices");
        for (const face& f : mesh_.faces)
            for (const std::uint32_t v : f)
                if (!std::isfinite(values[v]))
                    throw std::invalid_argument(name + ": the value of vertex " +
                                                std::to_string(v) + " is not finite");
        for (const double level : levels)
            if (!std::isfinite(level))
                throw std::invalid_argument(name + ": a level is not finite");
        levels_ = given_;
        std::ranges::sort(levels_);
        levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
        of_.level.resize(values.size());
        of_.on.resize(values.size());
        for (std::size_t v = 0; v < values.size(); ++v) {
            const auto above = std::ranges::upper_bound(levels_, values[v]);
            of_.level[v] = static_cast<std::uint32_t>(above - levels_.begin());
            of_.on[v] = above != levels_.begin() && *(above - 1) == values[v] ? 1 : 0;
        }
        joined_ = detail::weld::join_faces(mesh_);
        faces_ = mesh_.faces;
        if (!joined_.changed) return;
        kept_.assign(mesh_.faces.begin(), mesh_.faces.end());
        for (std::size_t f = 0; f < kept_.size(); ++f)  // a step of the value keeps vertices apart
            for (std::size_t i = 0; i < 3; ++i)
                if (const std::uint32_t one = joined_.faces[f][i];
                    values[one] == values[kept_[f][i]])
                    kept_[f][i] = one;
        faces_ = kept_;
    }

    /// Faces with vertices of equal coordinates and values joined.
    [[nodiscard]] mesh_view joined() const { return {mesh_.points, faces_}; }
    [[nodiscard]] mesh_view mesh() const { return mesh_; }
    [[nodiscard]] const plane_levels& of() const { return of_; }
    [[nodiscard]] const std::vector<double>& levels() const { return levels_; }

    /// Which of `levels` the given one is.
    [[nodiscard]] std::uint32_t rank(double level) const {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(levels_, level) -
                                          levels_.begin());
    }

    [[nodiscard]] point3 point(std::uint32_t k, const crossing& c) const {
        const point3 &p = mesh_.points[c.low], &q = mesh_.points[c.high];
        if (c.low == c.high) return p;
        // Halves, so that no difference of two doubles is beyond their range.
        const double low = values_[c.low] / 2, high = values_[c.high] / 2;
        const double t = std::clamp((levels_[k] / 2 - low) / (high - low), 0.0, 1.0);
        point3 result;
        for (std::size_t i = 0; i < 3; ++i) result[i] = std::lerp(p[i], q[i], t);
        return result;
    }

  private:
    mesh_view mesh_;
    std::span<const double> values_;
    std::vector<double> given_, levels_;
    plane_levels of_;
    detail::weld::joined_faces joined_;
    std::vector<face> kept_;
    std::span<const face> faces_;
};

void add_lines(isolines_result& result, const valued_mesh& of, std::uint32_t k,
               std::span<const std::uint32_t> met) {
    const detail::cut::layer_loops traced = detail::cut::loops_of(of.joined(), of.of(), k, met);
    for (const auto& [first, count, closed, oriented] : traced.loops) {
        isoline line{of.levels()[k], result.points.size(), count, closed, oriented};
        for (std::size_t i = first; i < first + count; ++i) {
            result.points.push_back(of.point(k, traced.points[i]));
            result.faces.push_back(traced.faces[i]);
        }
        const std::span all = std::span(result.points).subspan(line.first_point, count);
        for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
            const point3 &p = all[i], &q = all[i + 1 == count ? 0 : i + 1];
            line.length += std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
        }
        result.lines.push_back(line);
    }
}

/// Faces cut along lines, with one vertex for each place where a line meets an edge.
class along_lines {
  public:
    explicit along_lines(const valued_mesh& of)
        : of_(of), pieces_(of.levels().size() + 1), number_(of.levels().size() + 1) {
        const mesh_view mesh = of.joined();
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) add(f, of.mesh().faces[f]);
    }

    [[nodiscard]] std::vector<cut_piece> take() { return std::move(pieces_); }

  private:
    /// A corner of what a face has between two lines.
    struct place {
        std::uint32_t k;
        crossing at;
        friend bool operator==(const place& a, const place& b) {
            return a.at == b.at && (a.at.low == a.at.high || a.k == b.k);
        }
    };

    /// Where line k meets an edge; an end of the edge, where rounding puts it there.
    [[nodiscard]] place met(std::uint32_t k, std::uint32_t low, std::uint32_t high) const {
        const crossing at{low, high};
        if (of_.of().is_on(high, k)) return {k, {high, high}};
        const point3 rounded = of_.point(k, at);
        for (const std::uint32_t end : {low, high})
            if (rounded == of_.mesh().points[end]) return {k, {end, end}};
        return {k, at};
    }

    void add(std::uint32_t number, const face& f) {
        const std::vector<std::uint32_t>& level = of_.of().level;
        const auto [least, most] = std::minmax({level[f[0]], level[f[1]], level[f[2]]});
        for (std::uint32_t band = least; band <= most; ++band) {
            std::vector<place> corners;
            const auto put = [&](const place& p) {
                if (corners.empty() || !(corners.back() == p)) corners.push_back(p);
            };
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = f[i], b = f[i == 2 ? 0 : i + 1];
                if (level[a] == band) put({band, {a, a}});
                const auto cross = [&](std::uint32_t k) {
                    if (std::min(level[a], level[b]) <= k && k < std::max(level[a], level[b]))
                        put(level[a] < level[b] ? met(k, a, b) : met(k, b, a));
                };
                const bool up = level[a] < level[b];
                if (band > 0 && up) cross(band - 1);
                cross(band);
                if (band > 0 && !up) cross(band - 1);
            }
            while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
            if (least == most)  // as it is, even if it repeats a corner
                corners = {{band, {f[0], f[0]}}, {band, {f[1], f[1]}}, {band, {f[2], f[2]}}};
            for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
                cut_piece& piece = pieces_[band];
                piece.mesh.faces.push_back({vertex(band, corners[0]), vertex(band, corners[i]),
                                            vertex(band, corners[i + 1])});
                piece.face_source.push_back(number);
                piece.cap.push_back(cut_piece::none);
            }
        }
    }

    std::uint32_t vertex(std::uint32_t band, const place& p) {
        cut_piece& piece = pieces_[band];
        const bool given = p.at.low == p.at.high;
        const std::uint64_t line = given ? 0 : p.k + std::uint64_t{1};
        const auto next = static_cast<std::uint32_t>(piece.mesh.points.size());
        const auto [at, fresh] =
            number_[band][line].try_emplace(std::uint64_t{p.at.low} << 32 | p.at.high, next);
        if (fresh) {
            piece.mesh.points.push_back(of_.point(given ? 0 : p.k, p.at));
            piece.vertex_source.push_back(given ? p.at.low : cut_piece::none);
        }
        return at->second;
    }

    const valued_mesh& of_;
    std::vector<cut_piece> pieces_;
    /// By piece and line (0: vertices of the mesh): the vertex at each edge.
    std::vector<std::unordered_map<std::uint64_t, std::unordered_map<std::uint64_t, std::uint32_t>>>
        number_;
};

}  // namespace

isolines_result isolines(const mesh_ref& mesh, std::span<const double> values,
                         std::span<const double> levels, const progress_callback& report) {
    const valued_mesh of("isolines", mesh, values, levels);
    detail::base::work_progress progress(report);
    const std::size_t count = of.levels().size();
    const detail::cut::met_faces met = detail::cut::faces_met(of.joined(), of.of(), count);
    std::vector<isolines_result> of_level(count);
    for_chunks(count, 1, [&](std::size_t begin, std::size_t, std::size_t) {
        if (progress.cancelled()) return;
        const auto k = static_cast<std::uint32_t>(begin);
        add_lines(of_level[k], of, k, met.of(k));
        progress.reach(0.0);
    });
    isolines_result result;
    for (const double level : levels) {
        const isolines_result& one = of_level[of.rank(level)];
        for (isoline line : one.lines) {
            line.first_point += result.points.size();
            result.lines.push_back(line);
        }
        result.points.insert(result.points.end(), one.points.begin(), one.points.end());
        result.faces.insert(result.faces.end(), one.faces.begin(), one.faces.end());
    }
    if (progress.reach(1.0)) return result;
    return {.status = status::cancelled};
}

cut_result cut_along(const mesh_ref& mesh, std::span<const double> values,
                     std::span<const double> levels, const cut_options& options) {
    cut_result result;
    result.pieces = along_lines(valued_mesh("cut_along", mesh, values, levels)).take();
    std::vector<mesh_view> views;
    for (const cut_piece& piece : result.pieces) views.push_back(piece.mesh);
    const treeform::mesh whole = concatenate(views);
    const face_pair_result met = self_intersections(whole, {.progress = options.progress});
    certificate& known = result.certificate;
    if (met.status == status::cancelled) {
        result.pieces.clear();
        known.status = status::cancelled;
        return result;
    }
    if (!met.pairs.empty()) detail::base::refuse_meeting(known, met.pairs, whole);
    for (cut_piece& piece : result.pieces) piece.certificate = known;
    return result;
}

}  // namespace treeform
