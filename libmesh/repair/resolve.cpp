#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/require_share.hpp>
#include <libmesh/boolean/resolve_operand.hpp>
#include <libmesh/repair/loss.hpp>
#include <libmesh/repair/remove_faces.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform {
namespace {

/// A mesh without self-intersections, and what is left of each face of the input.
struct resolved_mesh {
    repair_result result{};
    std::vector<std::uint8_t> is_kept{};  ///< [F]
};

resolved_mesh from(detail::boolean::resolved_operand&& resolved) {
    boolean_result& made = resolved.made;
    repair_result result;
    result.mesh = std::move(made.mesh);
    for (const operand_element& e : made.face_source) result.face_source.push_back(e.index);
    for (const operand_element& e : made.vertex_source) result.vertex_source.push_back(e.index);
    result.certificate = std::move(made.certificate);
    result.statistics.pairs = made.statistics.pairs;
    result.statistics.resolved = made.statistics.pairs > 0;
    result.statistics.covered = made.statistics.covered;
    result.statistics.exact_faces = made.statistics.exact_faces;
    result.statistics.split_vertices = made.statistics.split_vertices;
    return {std::move(result), std::move(resolved.is_kept)};
}

resolved_mesh from(mesh_view mesh, repair_result&& result) {
    std::vector<std::uint8_t> is_kept(mesh.faces.size(), 0);
    for (const std::uint32_t f : result.face_source)
        if (f != repair_result::none) is_kept[f] = 1;
    return {std::move(result), std::move(is_kept)};
}

void count_losses(mesh_view mesh, std::span<const std::uint8_t> is_kept, repair_result& result) {
    const std::vector<std::uint32_t> component = face_components(mesh.points.size(), mesh.faces);
    std::uint32_t components = 0;
    for (const std::uint32_t c : component) components = std::max(components, c + 1);
    std::vector<std::uint8_t> has_face(components);
    for (std::size_t f = 0; f < is_kept.size(); ++f)
        if (is_kept[f] != 0) has_face[component[f]] = 1;
    result.statistics.filled =
        static_cast<std::uint64_t>(std::ranges::count(result.face_source, repair_result::none));
    const auto gone = static_cast<std::uint64_t>(std::ranges::count(is_kept, 0));
    result.statistics.removed = gone - std::min(gone, result.statistics.covered);
    result.statistics.vanished_components =
        static_cast<std::uint64_t>(std::ranges::count(has_face, 0));
    if (result.certificate && result.mesh.faces.empty() && !mesh.faces.empty())
        result.certificate.status = status::vanished;
}

/// `split` loses nothing; neither does `outer` where no component is inward.
void check_loss(mesh_view mesh, resolve_mode mode, const resolve_options& options,
                std::span<const std::uint8_t> is_kept, repair_result& result) {
    if (!result.certificate || mode == resolve_mode::split || options.max_loss >= 1.0) return;
    if (mode == resolve_mode::outer && !detail::repair::has_inward_component(mesh)) return;
    bool is_cancelled = false;
    const detail::repair::loss loss =
        detail::repair::find_loss(mesh, is_kept, result.mesh, [&](double) {
            is_cancelled = options.progress && !options.progress(1.0);
            return !is_cancelled;
        });
    if (is_cancelled) {
        result = {};
        result.certificate.status = status::cancelled;
        return;
    }
    if (!loss.is_beyond(options.max_loss)) return;
    result.certificate.status = status::excessive_loss;
    result.certificate.size_before = loss.before;
    result.certificate.size_after = loss.after;
    result.certificate.size_is_volume = loss.is_volume;
}

resolved_mesh by_mode(mesh_view mesh, resolve_mode mode, const resolve_options& options) {
    if (mode == resolve_mode::remove) {
        detail::base::check_faces("resolve_self_intersections", mesh.points.size(), mesh.faces);
        detail::base::check_finite_faces("resolve_self_intersections", mesh);
        detail::base::refuse_cloud("resolve_self_intersections", mesh);
        return from(mesh, detail::repair::remove_faces(mesh, options));
    }
    const boolean_options as_boolean{.fill_rule = options.fill_rule,
                                     .precision = options.precision,
                                     .max_displacement = options.max_displacement,
                                     .keep_cuts = options.keep_cuts,
                                     .progress = options.progress};
    return mode == resolve_mode::split ? from(detail::boolean::resolve_by_split(mesh, as_boolean))
                                       : from(detail::boolean::resolve_by_union(mesh, as_boolean));
}

}  // namespace

repair_result resolve_self_intersections(const mesh_ref& given, resolve_mode mode,
                                         const resolve_options& options) {
    const mesh_view mesh = given.view();
    using detail::base::require_limit;
    require_limit("resolve_self_intersections", options.max_loss, "the largest loss");
    require_limit("resolve_self_intersections", options.max_displacement,
                  "the largest displacement");
    auto [result, is_kept] = by_mode(mesh, mode, options);
    detail::base::describe(result.certificate, result.mesh, options.precision);
    const bool is_there = result.certificate.status != status::cancelled &&
                          result.certificate.status != status::open_input;
    if (is_there) {
        count_losses(mesh, is_kept, result);
        check_loss(mesh, mode, options, is_kept, result);
    }
    return std::move(result);
}

}  // namespace treeform
