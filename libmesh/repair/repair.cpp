#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/require_share.hpp>
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
#include <libmesh/repair/own_vertices.hpp>
#include <libmesh/repair/tangle.hpp>
#include <libmesh/repair/tetrahedra.hpp>
#include <libmesh/repair/working_mesh.hpp>
#include <libmesh/topology/area.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <utility>

namespace treeform {
namespace {

using detail::base::part_of;
using detail::repair::closed_cracks;
using detail::repair::edge_tally;
using detail::repair::rim_edges;
using detail::repair::walls;
using detail::repair::working_mesh;
using detail::topology::area;

constexpr std::size_t listed_edges = 100;

/// How to find out what is inside.
enum class inside_by : std::uint8_t {
    rule,
    labels,
    labels_and_guesses  ///< with what fills holes along edges of several faces, if it helps
};

/// Of areas that are equal except for rounding.
double noise_of(const repair_result& made) { return 1e-9 * made.statistics.area_before; }

/// The steps of a repair, one after the other.
class repairer {
  public:
    repairer(mesh_view given, const repair_options& options, inside_by way)
        : given_(given), options_(options), way_(way) {
        take(given);
        result_.is_kept.assign(given.faces.size(), 0);
    }

    repair_result run() {
        join();
        orient();
        if (options_.fill && !options_.sheet) fill();
        closed_.emplace(mesh_, turned_as_one_, known_edges());
        // What is outer is outward by its label, and a cavity of what is open looks like no cavity.
        if (options_.orient && !is_by_labels()) did_.turned_outward = closed_->turn_outward();
        measure();
        if (is_by_labels())
            make_labeled_surface();
        else if (tally_.unbalanced > 0 && !options_.sheet)
            return open();
        else
            make_surface();
        finish();
        return std::move(result_);
    }

    /// Whether labels may do better than what was made: faces disagree, or walls that were dropped
    /// were not inside.
    [[nodiscard]] bool is_in_doubt(const repair_result& made) const {
        const bool is_complete = options_.join && options_.orient && options_.fill &&
                                 options_.resolve && !options_.sheet;
        if (!is_complete || options_.fill_rule) return false;
        progress_callback progress;
        if (options_.progress) progress = [this](double) { return options_.progress(1.0); };
        const double most = is_hopeless_ ? 0.1 : 2.0;  // pairs of each face
        if (made.certificate.status == status::open_input &&
            detail::repair::is_tangle(mesh_.view(), most, progress))
            return false;
        if (!made.certificate) {
            const status known = made.certificate.status;
            return (known == status::open_input || known == status::excessive_loss ||
                    known == status::vanished) &&
                   tally_.unbalanced + dropped_walls_.size() > 0;
        }
        if (dropped_walls_.empty()) return false;
        std::vector<std::uint8_t> is_kept(given_.faces.size(), 1);
        for (const std::uint32_t f : dropped_walls_) is_kept[f] = 0;
        return detail::repair::lost_area(given_, is_kept, made.mesh) > noise_of(made);
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
                    corner = equal->first_of_group[equal->group_of_point[corner]];
        const auto box = bounding_box(mesh_.points);
        diagonal_ = box ? box->diagonal() : 0.0;
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
        did_.degenerate = detail::repair::drop_degenerate_and_slivers(mesh_);
        is_manifold_ = detail::topology::is_manifold(mesh_.view());
        if (is_manifold_) return;  // nothing to tally
        tally_ = detail::repair::tally_edges(mesh_);
        if (tally_.unbalanced > 0) keep_boundary_of_tetrahedra();
        if (tally_.nonmanifold > 0 || tally_.misoriented > 0) {
            did_.repeated = detail::repair::drop_copies(mesh_);
            tally_ = detail::repair::tally_edges(mesh_);
        }
        if (tally_.border == 0) return;
        close_cracks();
        if (tally_.nonmanifold == 0) return;
        did_.repeated += detail::repair::drop_copies(mesh_);  // that were torn off
        tally_ = detail::repair::tally_edges(mesh_);
    }

    void keep_boundary_of_tetrahedra() {
        did_.tetrahedra = detail::repair::keep_boundary_of_tetrahedra(mesh_);
        if (did_.tetrahedra == 0) return;
        std::vector<std::uint32_t> kept = mesh_.source;  // ascending
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        inner_faces_ = given_.faces.size() - kept.size();
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
            did_.gap_limit = std::max(did_.gap_limit, gap);
            if (closed.open_edges >= fewest) continue;
            fewest = closed.open_edges;
            best = std::move(tried);
            did_.closed_edges = closed.closed_edges;
            did_.split_edges = closed.split_edges;
            did_.widest_closed = closed.widest;
        }
        if (fewest == tally_.border) return;
        mesh_ = std::move(best);
        did_.degenerate += detail::repair::drop_degenerate(mesh_);
        tally_ = detail::repair::tally_edges(mesh_);
    }

    void orient() {
        if (!options_.orient) return;
        if (tally_.misoriented > 0 || tally_.nonmanifold > 0)
            did_.flipped = detail::repair::make_faces_agree(mesh_);
        if (tally_.border > 0 || tally_.nonmanifold > 0) {
            detail::repair::dropped_strays dropped =
                detail::repair::drop_strays(mesh_, options_.stray_share, options_.sheet,
                                            is_by_labels() ? walls::keep : walls::drop);
            did_.strays = dropped.faces;
            dropped_walls_ = std::move(dropped.walls);
        }
        if (did_.strays > 0) did_.flipped += detail::repair::make_faces_agree(mesh_);
        if (did_.flipped + did_.strays > 0) tally_ = detail::repair::tally_edges(mesh_);
        is_hopeless_ = detail::repair::is_hopeless(tally_, mesh_.faces.size());
        if (tally_.nonmanifold == 0 || tally_.unbalanced == 0 || is_hopeless_) return;
        did_.flipped += detail::repair::balance_patches(mesh_);
        if (did_.flipped > 0) turned_as_one_ = detail::repair::turned_as_one::shell;
        tally_ = detail::repair::tally_edges(mesh_);
    }

    void fill() {
        if (tally_.unbalanced == 0 || is_hopeless_) return;
        const detail::repair::filled_holes filled =
            fill_rims(is_by_labels() ? rim_edges::free : rim_edges::open);
        count(filled);
        did_.degenerate += detail::repair::drop_degenerate(mesh_);
        tally_ = detail::repair::tally_edges(mesh_);
        if (way_ == inside_by::labels_and_guesses) guesses_ = fill_rims(rim_edges::open);
    }

    void count(const detail::repair::filled_holes& filled) {
        did_.holes += filled.holes;
        did_.hole_edges += filled.edges;
        did_.filled += filled.faces;
        did_.unfilled_rims += filled.sheets;
    }

    detail::repair::filled_holes fill_rims(rim_edges along) {
        using detail::repair::sheets_too;
        return detail::repair::fill_holes(
            mesh_, options_.largest_hole,
            options_.max_loss >= 1.0 ? sheets_too::yes : sheets_too::no, along);
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
            if (known.open_edges.size() == listed_edges) break;
            known.open_edges.push_back({mesh_.points[e.from], mesh_.points[e.to]});
            known.open_faces.push_back({operand_element::none, mesh_.source[e.face]});
        }
        result_.statistics = did_;
        return std::move(result_);
    }

    /// Whether the mesh is what it is to be, as it is.
    [[nodiscard]] bool is_clean() {
        if (!options_.resolve) return true;
        if (options_.precision == precision::float32 &&
            detail::max_displacement(mesh_.points, transform<3>{},
                                     rounded(mesh_.points, precision::float32)) > 0.0)
            return false;
        const auto found =
            self_intersections(mesh_.view(), {.vertices = vertex_identity::by_index,
                                              .first_only = true,
                                              .progress = part_of(options_.progress, 0.1, 0.4)});
        if (found.status == treeform::status::cancelled)
            result_.certificate.status = status::cancelled;
        return found.status != treeform::status::cancelled && found.pairs.empty();
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
        if (options_.fill_rule) return *options_.fill_rule;
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
        const boolean_options how = how_to_resolve();
        take(options_.sheet ? detail::boolean::resolve_by_split(mesh_.view(), how)
                            : detail::boolean::resolve_by_union(mesh_.view(), how));
    }

    [[nodiscard]] boolean_options how_to_resolve() {
        fillings_ = mesh_.fillings();
        return {.fill_rule = rule(),
                .precision = options_.precision,
                .max_displacement = options_.max_displacement,
                .keep_cuts = options_.keep_cuts,
                .face_groups = fillings_,
                .progress = part_of(options_.progress, 0.4, 0.95)};
    }

    /// What fills holes along edges of several faces is there for the labels to use or not.
    void make_labeled_surface() {
        did_.resolved = true;
        std::vector<std::uint32_t> is_guess(mesh_.faces.size(), 0);
        for (std::size_t f = mesh_.faces.size() - guesses_.faces; f < is_guess.size(); ++f)
            is_guess[f] = 1;
        detail::boolean::labeled_result labeled =
            detail::boolean::resolve_by_labels(mesh_.view(), is_guess, how_to_resolve());
        did_.labeled_cells = labeled.counts.cells;
        did_.dropped_area = labeled.counts.dropped_area;
        did_.flipped_area = labeled.counts.flipped_area;
        count(guesses_.used(labeled.resolved.is_kept));
        take(std::move(labeled.resolved));
    }

    void take(detail::boolean::resolved_operand&& resolved) {
        boolean_result& made = resolved.made;
        result_.certificate = std::move(made.certificate);
        for (operand_element& e : result_.certificate.open_faces) e.index = mesh_.source[e.index];
        result_.mesh = std::move(made.mesh);
        for (const operand_element& e : made.face_source)
            result_.face_source.push_back(mesh_.source[e.index]);
        for (std::size_t f = 0; f < resolved.is_kept.size(); ++f)
            if (resolved.is_kept[f] != 0) set_left(mesh_.source[f]);
        for (const operand_element& e : made.vertex_source)
            result_.vertex_source.push_back(source_of_point(e.index));
        did_.pairs = made.statistics.pairs;
        did_.split_vertices = made.statistics.split_vertices;
    }

    void set_left(std::uint32_t source) {
        if (source != repair_result::none) result_.is_kept[source] = 1;
    }

    /// What fills holes may have points of its own.
    [[nodiscard]] std::uint32_t source_of_point(std::uint32_t p) const {
        return p < given_.points.size() ? p : repair_result::none;
    }

    void keep_as_it_is() {
        is_kept_ = true;
        const std::vector<std::uint32_t> used =
            detail::base::used_points(mesh_.points.size(), mesh_.faces);
        result_.vertex_source.reserve(used.size());
        for (const std::uint32_t p : used) result_.vertex_source.push_back(source_of_point(p));
        for (const std::uint32_t f : mesh_.source) set_left(f);
        result_.face_source = std::move(mesh_.source);
        std::vector<std::uint32_t> number(mesh_.points.size());
        for (const std::uint32_t p : used) {
            number[p] = static_cast<std::uint32_t>(result_.mesh.points.size());
            result_.mesh.points.push_back(mesh_.points[p]);
        }
        for (const face& f : mesh_.faces)
            result_.mesh.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
        if (options_.sheet || !options_.resolve)  // else it is manifold
            detail::repair::give_own_vertices(given_, result_.mesh, result_.face_source,
                                              result_.vertex_source);
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
        // Of equal points, faces use one from the beginning: what was kept has no twins.
        if (!options_.detach || !options_.resolve || is_kept_) return;
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
        const std::vector<std::uint8_t>& is_kept = result_.is_kept;
        did_.removed = static_cast<std::uint64_t>(std::ranges::count(is_kept, 0));
        const std::uint64_t dropped = did_.degenerate + did_.repeated + did_.strays + inner_faces_;
        did_.removed -= std::min(did_.removed, dropped);
        const bool is_solid = known.status == status::ok;
        if (is_solid)
            did_.volume_after = is_as_measured ? did_.volume_before : signed_volume(result_.mesh);
        if (is_solid && !is_kept_) count_vanished(is_kept);
        did_.area_lost = detail::repair::lost_area(given_, is_kept, result_.mesh);
        if (options_.max_loss >= 1.0) return;
        if (did_.vanished_components > 0 || loses_too_much()) known.status = status::excessive_loss;
    }

    void count_vanished(const std::vector<std::uint8_t>& is_kept) {
        const auto gone = detail::repair::count_vanished(mesh_, is_kept, result_.mesh,
                                                         options_.stray_share * did_.area_before);
        if (did_.resolved) did_.vanished_components = gone.lost;
        did_.dropped_shells = gone.within;
    }

    bool loses_too_much() {
        certificate& known = result_.certificate;
        if (did_.area_lost == 0.0) return false;
        double before = detail::repair::area_of_distinct(given_);
        double after = before - std::min(did_.area_lost, before);
        if (after >= (1.0 - options_.max_loss) * before) return false;
        if (known.status == status::ok && did_.holes == 0 && !is_by_labels()) {
            // What was closed had a volume: a fin has area, but none of that.
            before = did_.volume_before;
            const boolean_result meant =
                detail::boolean::resolve_by_union(mesh_.view(), {.fill_rule = fill_rule::nonzero})
                    .made;
            if (meant.certificate) before = signed_volume(meant.mesh);
            after = did_.volume_after;
            if (after >= (1.0 - options_.max_loss) * before) return false;
            known.size_is_volume = true;
        }
        known.size_before = before;
        known.size_after = after;
        return true;
    }

    [[nodiscard]] bool is_by_labels() const { return way_ != inside_by::rule; }

    mesh_view given_;
    const repair_options& options_;
    inside_by way_;
    working_mesh mesh_{};
    double diagonal_ = 0.0;
    edge_tally tally_{};
    bool is_manifold_ = false;  ///< as it came, except for faces turned
    bool is_hopeless_ = false;
    bool is_kept_ = false;                        ///< nothing had to be cut
    std::uint64_t inner_faces_ = 0;               ///< of tetrahedra
    std::vector<std::uint32_t> dropped_walls_{};  ///< input faces
    detail::repair::filled_holes guesses_{};      ///< holes filled on trial: the last faces
    std::vector<std::uint32_t> fillings_{};       ///< of `mesh_`, while it is resolved
    std::optional<detail::repair::closed_components> closed_{};
    detail::repair::turned_as_one turned_as_one_ = detail::repair::turned_as_one::component;
    repair_statistics did_{};
    repair_result result_{};
};

}  // namespace

repair_result repair(const mesh_ref& given, const repair_options& options) {
    const mesh_view mesh = given.view();
    if (options.gap) detail::base::require_share("repair", *options.gap, "the gap");
    detail::base::require_share("repair", options.stray_share, "the share of strays");
    detail::base::require_share("repair", options.max_loss, "the largest loss");
    detail::base::require_limit("repair", options.max_displacement, "the largest displacement");
    detail::base::check_faces("repair", mesh.points.size(), mesh.faces);
    detail::base::check_finite_faces("repair", mesh);
    detail::base::refuse_cloud("repair", mesh);
    repairer by_rule(mesh, options, inside_by::rule);
    repair_result best = by_rule.run();
    if (!by_rule.is_in_doubt(best)) return best;
    repair_options again = options;
    if (options.progress) again.progress = [&](double) { return options.progress(1.0); };
    for (const inside_by way : {inside_by::labels, inside_by::labels_and_guesses}) {
        repair_result made = repairer(mesh, again, way).run();
        if (made.certificate.status == status::cancelled) return made;
        // A guess has to be a manifold also for programs that join equal coordinates.
        const bool is_better =
            made.statistics.touching <= best.statistics.touching &&
            (!best.certificate ||
             made.statistics.area_lost < best.statistics.area_lost - noise_of(best));
        if (made.certificate && is_better) best = std::move(made);
        if (best.certificate && best.statistics.area_lost <= noise_of(best)) break;
    }
    return best;
}

}  // namespace treeform
