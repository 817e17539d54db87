#include <libmesh/base/certify.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/cut/slabs.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/cut.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

namespace cut_room = detail::cut;
using detail::base::work_progress;

constexpr std::uint32_t none = cut_piece::none;

/// A slab in rounded coordinates, with sources in the mesh that it is of.
cut_piece rounded_piece(cut_room::slab&& slab, std::size_t faces, const cut_options& options) {
    cut_piece piece;
    piece.certificate.precision = options.precision;
    if (slab.surface.faces.empty()) return piece;
    const auto given = static_cast<std::uint32_t>(slab.surface.given.size());
    rounded_surface made =
        round_surface(std::move(slab.surface), {.precision = options.precision,
                                                .solid = options.caps,
                                                .max_displacement = options.max_displacement});
    boolean_result result;
    result.mesh = std::move(made.surface);
    for (const std::uint32_t p : made.point_of)
        result.vertex_source.push_back(p < given ? operand_element{0, slab.point_of[p]}
                                                 : operand_element{});
    if (options.caps && made.certificate) detail::boolean::split_nonmanifold(result);
    for (const std::uint32_t f : made.face_of) {
        const std::uint32_t source = slab.face_of[f];
        piece.face_source.push_back(source < faces ? source : none);
        piece.cap.push_back(source < faces ? none : source - static_cast<std::uint32_t>(faces));
    }
    for (const operand_element& v : result.vertex_source) piece.vertex_source.push_back(v.index);
    piece.mesh = std::move(result.mesh);
    piece.certificate = std::move(made.certificate);
    return piece;
}

/// The pieces of a mesh that is known to be free of self-intersections.
std::vector<cut_piece> pieces_of(mesh_view mesh, const oriented_plane& plane,
                                 std::span<const double> heights, const cut_options& options,
                                 work_progress& progress, double from, double to) {
    const detail::weld::joined_faces joined = detail::weld::join_faces(mesh);
    const mesh_view merged = joined.of(mesh);
    const cut_room::plane_levels levels = cut_room::levels_of("cut", mesh.points, plane, heights);
    std::vector<cut_room::slab> slabs = cut_room::slabs_of(merged, levels, options.caps);
    std::vector<cut_piece> pieces(slabs.size());
    std::atomic<std::size_t> done{0};
    for_chunks(slabs.size(), 1, [&](std::size_t s, std::size_t, std::size_t) {
        if (progress.cancelled()) return;
        pieces[s] = rounded_piece(std::move(slabs[s]), mesh.faces.size(), options);
        progress.reach(from + (to - from) * static_cast<double>(++done) /
                                  static_cast<double>(slabs.size()));
    });
    return pieces;
}

/// Sources of what was made of a piece, in what that piece was made of.
void look_through(cut_piece& piece, const cut_piece& whole, std::uint32_t first_plane) {
    for (std::size_t f = 0; f < piece.cap.size(); ++f) {
        const std::uint32_t source = piece.face_source[f];
        if (source == none) {
            piece.cap[f] += first_plane;
            continue;
        }
        piece.cap[f] = whole.cap.empty() ? none : whole.cap[source];
        piece.face_source[f] = whole.face_source[source];
    }
    for (std::uint32_t& v : piece.vertex_source)
        if (v != none) v = whole.vertex_source[v];
}

/// The mesh as the solid that it winds around, or without caps as a surface that meets itself
/// nowhere.
cut_piece sound_whole(const mesh_ref& mesh, const cut_options& options, progress_callback progress,
                      bool& resolved) {
    const boolean_options how{.max_displacement = options.max_displacement,
                              .keep_cuts = options.keep_cuts,
                              .progress = std::move(progress)};
    boolean_result made = options.caps ? boolean(mesh, "a", how) : split(mesh, how);
    resolved = made.statistics.pairs > 0;
    cut_piece whole;
    whole.mesh = std::move(made.mesh);
    whole.certificate = std::move(made.certificate);
    detail::base::name_no_operand(whole.certificate);
    for (const operand_element& f : made.face_source) whole.face_source.push_back(f.index);
    for (const operand_element& v : made.vertex_source) whole.vertex_source.push_back(v.index);
    return whole;
}

void judge(cut_result& result, const work_progress& progress) {
    if (progress.cancelled()) {
        result.pieces.clear();
        result.certificate = {.status = status::cancelled};
        return;
    }
    for (const cut_piece& piece : result.pieces) {
        result.certificate.max_displacement =
            std::max(result.certificate.max_displacement, piece.certificate.max_displacement);
        if (piece.certificate) continue;
        result.certificate = piece.certificate;
        return;
    }
}

}  // namespace

const mesh& cut_piece::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh cut_piece::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

cut_result cut(const mesh_ref& mesh, const oriented_plane& plane, std::span<const double> heights,
               const cut_options& options) {
    cut_result result;
    result.certificate.precision = options.precision;
    (void)cut_room::levels_of("cut", {}, plane, heights);  // refuses what are no planes
    work_progress progress(options.progress);
    const cut_piece whole = sound_whole(mesh, options, progress.part(0.0, 0.5), result.resolved);
    if (!whole.certificate) {
        result.certificate = whole.certificate;
        return result;
    }
    result.pieces = pieces_of(whole.mesh, plane, heights, options, progress, 0.5, 1.0);
    for (cut_piece& piece : result.pieces) look_through(piece, whole, 0);
    judge(result, progress);
    return result;
}

cut_result cut_to_fit(const mesh_ref& mesh, const point3& size, const cut_options& options) {
    constexpr double most_planes = 0x1p16, most_pieces = 0x1p20;
    const std::optional<box3> box = bounding_box(mesh.view().points);
    std::array<std::vector<double>, 3> heights;
    double most = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = box ? box->min[axis] : 0.0, extent = box ? box->max[axis] - low : 0.0;
        const double count = std::ceil(extent / size[axis]);
        most *= std::max(count, 1.0);
        if (!(size[axis] > 0.0) || !(count <= most_planes) || most > most_pieces)
            throw std::invalid_argument(
                "treeform::cut_to_fit: a size is not positive, or would make more than 2^16 planes "
                "across an axis or 2^20 pieces");
        for (double i = 1.0; i < count; i += 1.0)
            heights[axis].push_back(low + extent * (i / count));
    }
    cut_result result;
    result.certificate.precision = options.precision;
    work_progress progress(options.progress);
    std::vector<cut_piece> pieces;
    pieces.push_back(sound_whole(mesh, options, progress.part(0.0, 0.4), result.resolved));
    if (!pieces[0].certificate) {
        result.certificate = pieces[0].certificate;
        return result;
    }
    std::uint32_t planes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // Also where nothing is cut, the last time, for the precision asked for.
        if (heights[axis].empty() && axis < 2) continue;
        oriented_plane plane{{}, {}};
        plane.normal[axis] = 1.0;
        std::vector<cut_piece> next;
        for (std::size_t i = 0; i < pieces.size() && !progress.cancelled(); ++i) {
            const double begin = 0.4 + 0.2 * static_cast<double>(axis), of = 0.2;
            const auto share = [&](std::size_t n) {
                return begin + of * static_cast<double>(n) / static_cast<double>(pieces.size());
            };
            for (cut_piece& made : pieces_of(pieces[i].mesh, plane, heights[axis], options,
                                             progress, share(i), share(i + 1))) {
                look_through(made, pieces[i], planes);
                if (!made.mesh.faces.empty() || !made.certificate) next.push_back(std::move(made));
            }
        }
        planes += static_cast<std::uint32_t>(heights[axis].size());
        pieces = std::move(next);
    }
    result.pieces = std::move(pieces);
    judge(result, progress);
    return result;
}

}  // namespace treeform
