#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/resolve_operand.hpp>
#include <libmesh/repair/balance_patches.hpp>
#include <libmesh/repair/border_edges.hpp>
#include <libmesh/repair/close_cracks.hpp>
#include <libmesh/repair/detach.hpp>
#include <libmesh/repair/drop_copies.hpp>
#include <libmesh/repair/drop_strays.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/repair/fill_holes.hpp>
#include <libmesh/repair/loss.hpp>
#include <libmesh/repair/orient_faces.hpp>
#include <libmesh/repair/working_mesh.hpp>
#include <libmesh/topology/area.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::base::part_of;
using detail::repair::closed_cracks;
using detail::repair::edge_tally;
using detail::repair::working_mesh;
using detail::topology::area;

constexpr std::size_t listed_edges = 100;

void require_share(double value, const char* what) {
    if (!(value >= 0.0) || !std::isfinite(value))
        throw std::invalid_argument("treeform::repair: " + std::string(what) +
                                    " is negative or not finite");
}

/// The steps of a repair, one after the other.
class repairer {
  public:
    repairer(mesh_view given, const repair_options& options) : given_(given), options_(options) {
        take(given);
    }

    repair_result run() {
        join();
        orient();
        if (options_.fill && !options_.sheet) fill();
        closed_.emplace(mesh_, turned_as_one_, known_edges());
        if (options_.orient) did_.turned = closed_->turn_outward();
        measure();
        if (tally_.unbalanced > 0 && !options_.sheet) return open();
        make_surface();
        finish();
        return std::move(result_);
    }

  private:
    /// Points that no face uses may be anything, also NaN; of equal points, faces use the lowest.
    void take(mesh_view given) {
        mesh_.points.resize(given.points.size());
        for (const std::uint32_t p : detail::base::used_points(given.points.size(), given.faces))
            mesh_.points[p] = given.points[p];
        mesh_.faces.assign(given.faces.begin(), given.faces.end());
        mesh_.source.resize(given.faces.size());
        for (std::uint32_t f = 0; f < given.faces.size(); ++f) mesh_.source[f] = f;
        if (const auto equal = detail::weld::few_equal_points(mesh_.points))
            for (face& f : mesh_.faces)
                for (std::uint32_t& corner : f)
                    corner = equal->first_of_new[equal->new_of_old[corner]];
        diagonal_ = 0.0;
        if (const auto box = bounding_box(mesh_.points)) diagonal_ = diagonal(*box);
    }

    void join() {
        if (!options_.join) {
            // Faces without area have no edges to speak of, whatever is asked for.
            did_.degenerate = mesh_.drop([&](std::uint32_t f) {
                const auto [a, b, c] = mesh_.faces[f];
                return a == b || b == c || c == a;
            });
            tally_ = detail::repair::tally_edges(mesh_);
            return;
        }
        did_.degenerate = detail::repair::drop_degenerate(mesh_);
        is_manifold_ = detail::topology::is_manifold(mesh_.view());
        if (is_manifold_) return;  // nothing to tally
        tally_ = detail::repair::tally_edges(mesh_);
        if (tally_.crowded > 0 || tally_.disagreeing > 0) {
            did_.repeated = detail::repair::drop_copies(mesh_);
            tally_ = detail::repair::tally_edges(mesh_);
        }
        if (tally_.border == 0) return;
        close_cracks();
        if (tally_.crowded == 0) return;
        did_.repeated += detail::repair::drop_copies(mesh_);  // that were torn off
        tally_ = detail::repair::tally_edges(mesh_);
    }

    /// Of the gaps tried, the narrowest that leaves the fewest open edges.
    void close_cracks() {
        std::vector<double> gaps;
        if (options_.gap)
            gaps = {*options_.gap};
        else
            gaps = {0.0,
                    coordinate_step(mesh_.points, precision::float32),
                    1e-6 * diagonal_,
                    1e-5 * diagonal_,
                    1e-4 * diagonal_,
                    1e-3 * diagonal_ * (1.0 + 1e-6)};  // cracks as wide as that, however rounded
        std::uint64_t fewest = tally_.border;
        working_mesh best;
        for (const double gap : gaps) {
            if (fewest == 0) break;
            working_mesh tried = mesh_;
            const closed_cracks closed = detail::repair::close_cracks(tried, gap);
            did_.gap = std::max(did_.gap, gap);
            if (closed.open_edges >= fewest) continue;
            fewest = closed.open_edges;
            best = std::move(tried);
            did_.closed_edges = closed.closed_edges;
            did_.split_edges = closed.split_edges;
            did_.widest = closed.widest;
        }
        if (fewest == tally_.border) return;
        mesh_ = std::move(best);
        did_.degenerate += detail::repair::drop_degenerate(mesh_);
        tally_ = detail::repair::tally_edges(mesh_);
    }

    /// Whether faces disagree at so many edges of more than two that what they bound is anybody's
    /// guess: half of the faces of tetrahedra, say.
    [[nodiscard]] bool is_hopeless() const {
        constexpr std::uint64_t most = 10;  // faces for each such edge
        const std::uint64_t simple =
            std::min(tally_.unbalanced, tally_.border + tally_.disagreeing);
        return most * (tally_.unbalanced - simple) > mesh_.faces.size() &&
               mesh_.faces.size() > 1000;
    }

    void orient() {
        if (!options_.orient) return;
        if (tally_.disagreeing > 0 || tally_.crowded > 0)
            did_.flipped = detail::repair::make_faces_agree(mesh_);
        if (tally_.border > 0 || tally_.crowded > 0)
            did_.strays = detail::repair::drop_strays(mesh_, options_.strays, options_.sheet);
        if (did_.strays > 0) did_.flipped += detail::repair::make_faces_agree(mesh_);
        if (did_.flipped + did_.strays > 0) tally_ = detail::repair::tally_edges(mesh_);
        is_hopeless_ = is_hopeless();
        if (tally_.crowded == 0 || tally_.unbalanced == 0 || is_hopeless_) return;
        did_.flipped += detail::repair::balance_patches(mesh_);
        if (did_.flipped > 0) turned_as_one_ = detail::repair::turned_as_one::shell;
        tally_ = detail::repair::tally_edges(mesh_);
    }

    void fill() {
        if (tally_.unbalanced == 0 || is_hopeless_) return;
        using detail::repair::sheets_too;
        const detail::repair::filled_holes filled =
            detail::repair::fill_holes(mesh_, options_.largest_hole,
                                       options_.max_loss >= 1.0 ? sheets_too::yes : sheets_too::no);
        did_.holes = filled.holes;
        did_.hole_edges = filled.edges;
        did_.filled = filled.faces;
        did_.degenerate += detail::repair::drop_degenerate(mesh_);
        tally_ = detail::repair::tally_edges(mesh_);
    }

    void measure() {
        did_.open_edges = tally_.unbalanced;
        did_.area_before = area(mesh_.view());
        if (tally_.unbalanced == 0) did_.volume_before = closed_->volume();
    }

    /// Where the surface ends, in the numbers of the input.
    repair_result open() {
        certificate& known = result_.certificate;
        known.status = status::open_input;
        known.open_count = tally_.unbalanced;
        for (const auto& e : detail::repair::border_edges(mesh_.points.size(), mesh_.faces)) {
            if (known.open.size() == listed_edges) break;
            known.open.push_back(
                {{0, mesh_.source[e.face]}, {mesh_.points[e.from], mesh_.points[e.to]}});
        }
        result_.statistics = did_;
        return std::move(result_);
    }

    /// Whether the mesh is what it is to be, as it is.
    [[nodiscard]] bool is_clean() {
        if (!options_.resolve) return true;
        if (options_.precision == precision::float32 &&
            max_displacement(mesh_.points, transform<3>{},
                             rounded(mesh_.points, precision::float32)) > 0.0)
            return false;
        const auto found =
            self_intersections(mesh_.view(), {.vertices = vertex_identity::by_index,
                                              .first_only = true,
                                              .progress = part_of(options_.progress, 0.1, 0.4)});
        if (found.cancelled) result_.certificate.status = status::cancelled;
        return !found.cancelled && found.pairs.empty();
    }

    [[nodiscard]] detail::repair::edge_facts known_edges() const {
        using enum detail::repair::edge_facts;
        return is_manifold_ ? manifold : tally_.unbalanced == 0 ? closed : unknown;
    }

    /// Of a mesh no two faces of which meet.
    [[nodiscard]] bool is_solid() {
        if (!is_manifold_ && !detail::topology::is_manifold(mesh_.view())) return false;
        using detail::repair::turned_as_one;
        if (turned_as_one_ == turned_as_one::shell)
            closed_.emplace(mesh_, turned_as_one::component, known_edges());
        return closed_->is_well_nested();
    }

    [[nodiscard]] fill_rule rule() const {
        switch (options_.inside) {
            case repair_rule::nonzero:
                return fill_rule::nonzero;
            case repair_rule::odd:
                return fill_rule::odd;
            case repair_rule::positive:
                return fill_rule::positive;
            case repair_rule::automatic:
                break;
        }
        return closed_->is_outward() ? fill_rule::positive : fill_rule::nonzero;
    }

    void make_surface() {
        const bool clean = is_clean();
        if (result_.certificate.status == status::cancelled) return;
        if (clean && (options_.sheet || !options_.resolve || is_solid())) {
            keep_as_it_is();
            return;
        }
        did_.resolved = !clean;
        const boolean_options how{.inside = rule(),
                                  .precision = options_.precision,
                                  .rounding_steps = options_.rounding_steps,
                                  .max_displacement = options_.max_displacement,
                                  .progress = part_of(options_.progress, 0.4, 0.95)};
        boolean_result made = options_.sheet ? detail::boolean::resolve_by_split(mesh_.view(), how)
                                             : detail::boolean::resolve_by_union(mesh_.view(), how);
        result_.certificate = std::move(made.certificate);
        for (open_edge& e : result_.certificate.open) e.face.index = mesh_.source[e.face.index];
        result_.mesh = std::move(made.mesh);
        for (const operand_element& e : made.face_source)
            result_.face_source.push_back(e.index == operand_element::none ? repair_result::none
                                                                           : mesh_.source[e.index]);
        for (const operand_element& e : made.vertex_source)
            result_.vertex_source.push_back(source_of_point(e.index));
        did_.pairs = made.statistics.pairs;
        did_.split_vertices = made.statistics.split_vertices;
    }

    /// What fills holes may have points of its own.
    [[nodiscard]] std::uint32_t source_of_point(std::uint32_t p) const {
        return p < given_.points.size() ? p : repair_result::none;
    }

    void keep_as_it_is() {
        is_kept_ = true;
        std::vector<std::uint32_t> number(mesh_.points.size(), repair_result::none);
        for (const std::uint32_t p : detail::base::used_points(mesh_.points.size(), mesh_.faces)) {
            number[p] = static_cast<std::uint32_t>(result_.mesh.points.size());
            result_.mesh.points.push_back(mesh_.points[p]);
            result_.vertex_source.push_back(source_of_point(p));
        }
        for (const face& f : mesh_.faces)
            result_.mesh.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
        result_.face_source = std::move(mesh_.source);
    }

    void finish() {
        certificate& known = result_.certificate;
        if (known && options_.sheet && tally_.unbalanced > 0) known.status = status::sheet;
        if (known) detach();
        if (known && result_.mesh.faces.empty() && !given_.faces.empty())
            known.status = status::vanished;
        count_losses();
        detail::base::describe(known, result_.mesh, options_.precision);
        result_.statistics = did_;
    }

    void detach() {
        if (!options_.detach || !options_.resolve) return;
        const detail::repair::detached done =
            detail::repair::detach(result_.mesh, options_.precision, options_.max_displacement);
        did_.detached = done.moved;
        did_.touching = done.touching;
        result_.certificate.max_displacement =
            std::max(result_.certificate.max_displacement, done.max_displacement);
    }

    void count_losses() {
        certificate& known = result_.certificate;
        if (known.status != status::ok && known.status != status::sheet) return;
        const bool is_as_measured = is_kept_ && did_.detached == 0;
        did_.area_after = is_as_measured ? did_.area_before : area(result_.mesh);
        std::vector<std::uint8_t> is_left(given_.faces.size(), 0);
        for (const std::uint32_t f : result_.face_source)
            if (f != repair_result::none) is_left[f] = 1;
        did_.removed = static_cast<std::uint64_t>(std::ranges::count(is_left, 0));
        did_.removed -= std::min(did_.removed, did_.degenerate + did_.repeated + did_.strays);
        const bool is_solid = known.status == status::ok;
        if (is_solid)
            did_.volume_after = is_as_measured ? did_.volume_before : signed_volume(result_.mesh);
        if (did_.resolved && is_solid) count_vanished(is_left);
        did_.area_lost = detail::repair::lost_area(given_, is_left, result_.mesh);
        if (options_.max_loss >= 1.0) return;
        if (did_.vanished_components > 0 || loses_too_much()) known.status = status::excessive_loss;
    }

    bool loses_too_much() {
        certificate& known = result_.certificate;
        if (did_.area_lost == 0.0) return false;
        double before = detail::repair::area_of_distinct(given_);
        double after = before - std::min(did_.area_lost, before);
        if (after >= (1.0 - options_.max_loss) * before) return false;
        if (known.status == status::ok && did_.holes == 0) {
            // What was closed had a volume: a fin has area, but none of that.
            before = did_.volume_before;
            const boolean_result meant =
                detail::boolean::resolve_by_union(mesh_.view(), {.inside = fill_rule::nonzero});
            if (meant.certificate) before = signed_volume(meant.mesh);
            after = did_.volume_after;
            if (after >= (1.0 - options_.max_loss) * before) return false;
            known.size_is_volume = true;
        }
        known.size_before = before;
        known.size_after = after;
        return true;
    }

    /// Components that are too large to go and of which nothing is left, not because they were
    /// inside of others but because they bounded nothing.
    void count_vanished(const std::vector<std::uint8_t>& is_left) {
        const std::vector<std::uint32_t> part = detail::repair::parts_by_edges(mesh_);
        std::vector<std::uint8_t> has_face(part.size(), 0);
        std::vector<double> area_of(part.size(), 0.0);
        for (std::uint32_t f = 0; f < part.size(); ++f) {
            area_of[part[f]] += area({mesh_.points, {&mesh_.faces[f], 1}});
            if (mesh_.source[f] != repair_result::none && is_left[mesh_.source[f]] != 0)
                has_face[part[f]] = 1;
        }
        std::optional<prepared_mesh> solid;
        for (std::uint32_t f = 0; f < part.size(); ++f) {
            if (part[f] != f || has_face[f] != 0) continue;
            if (!(area_of[f] > options_.strays * did_.area_before)) continue;
            if (!solid) solid.emplace(prepared_mesh::borrow(result_.mesh));
            if (locate(*solid, mesh_.points[mesh_.faces[f][0]]).where == location::outside)
                ++did_.vanished_components;
        }
    }

    mesh_view given_;
    const repair_options& options_;
    working_mesh mesh_{};
    double diagonal_ = 0.0;
    edge_tally tally_{};
    bool is_manifold_ = false;  ///< as it came, but for faces turned
    bool is_hopeless_ = false;
    bool is_kept_ = false;  ///< nothing had to be cut
    std::optional<detail::repair::closed_components> closed_{};
    detail::repair::turned_as_one turned_as_one_ = detail::repair::turned_as_one::component;
    repair_statistics did_{};
    repair_result result_{};
};

}  // namespace

repair_result repair(mesh_view mesh, const repair_options& options) {
    if (options.gap) require_share(*options.gap, "the gap");
    require_share(options.strays, "the share of strays");
    require_share(options.max_loss, "the largest loss");
    detail::base::check_faces("repair", mesh.points.size(), mesh.faces);
    detail::base::check_finite_faces("repair", mesh);
    return repairer(mesh, options).run();
}

const mesh& repair_result::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh repair_result::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

}  // namespace treeform
