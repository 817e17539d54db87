#include <libmesh/assembly/contact_regions.hpp>
#include <libmesh/assembly/part_boxes.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/nearness/closest_points.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

using detail::place::shape;

/// Looks at pairs of parts, several at a time.
class pair_inspection {
  public:
    pair_inspection(std::span<const prepared_mesh> parts, const clash_options& options,
                    detail::base::work_progress& work)
        : parts_(parts), options_(options), work_(work) {}

    /// None when it is to stop.
    [[nodiscard]] std::optional<part_clash> look_at(const part_pair& pair) const {
        part_clash found{.a = pair[0], .b = pair[1]};
        const shape a(parts_[pair[0]], options_.vertices), b(parts_[pair[1]], options_.vertices);
        const auto how = detail::place::relation_of(a, b, asking_);
        if (how.status == status::cancelled) return std::nullopt;
        found.a_inside_b = how.a_inside_b;
        found.b_inside_a = how.b_inside_a;
        if (how.relation == mesh_relation::separate) {
            enter_distance(a, b, found);
            return found;
        }
        found.how = how.relation == mesh_relation::touching ? mesh_relation::touching
                                                            : mesh_relation::penetrating;
        intersection_options all;
        all.progress = asking_;
        const auto meeting =
            detail::intersect::mesh_intersections(a.mesh(), a.faces(), b.mesh(), b.faces(), all);
        found.face_pairs = meeting.pairs.size();
        found.regions =
            detail::assembly::regions_of(a.joined(), b.joined(), meeting.pairs, options_.limit);
        if (meeting.pairs.empty()) enter_surface_distance(a, b, found);
        if (found.how == mesh_relation::penetrating) enter_extent(a, b, found);
        if (work_.cancelled()) return std::nullopt;
        return found;
    }

  private:
    /// Of separate parts.
    void enter_distance(const shape& a, const shape& b, part_clash& found) const {
        found.how = mesh_relation::separate;
        if (options_.clearance == 0.0) return;
        found.how = mesh_relation::clear;
        const auto near = detail::nearness::closest_points(a.mesh(), a.faces(), b.mesh(), b.faces(),
                                                           options_.clearance);
        if (!near || !(near->distance < options_.clearance)) return;
        found.how = mesh_relation::closer_than_clearance;
        found.distance = near->distance;
        found.nearest = {near->on_a, near->on_b};
    }

    /// Of a part inside the other.
    void enter_surface_distance(const shape& a, const shape& b, part_clash& found) const {
        const auto near =
            detail::nearness::closest_points(a.mesh(), a.faces(), b.mesh(), b.faces());
        if (near) found.distance = near->distance;
    }

    /// How much of the parts is in each other, and how deep.
    void enter_extent(const shape& a, const shape& b, part_clash& found) const {
        if (options_.volumes && a.closed() && b.closed()) {
            const boolean_options both{.volumes = true, .progress = asking_};
            const auto common = intersection(a.prepared(), b.prepared(), both);
            if (common.volumes) found.volume = common.volumes->both;
        }
        if (!options_.depths || work_.cancelled()) return;
        const auto deep = penetration_depth(
            a.prepared(), b.prepared(),
            {.vertices = options_.vertices, .effort = options_.effort, .progress = asking_});
        if (!deep || deep->status != status::ok) return;
        found.depth = deep->depth;
        found.move = deep->move;
        found.depth_effort = deep->effort;
    }

    std::span<const prepared_mesh> parts_;
    const clash_options& options_;
    detail::base::work_progress& work_;
    progress_callback asking_ = options_.progress
                                    ? progress_callback([this](double) { return work_.reach(0.0); })
                                    : progress_callback{};
};

/// Of those, what is left when the ignored are taken out; both are ascending.
std::vector<part_pair> without(const std::vector<part_pair>& pairs,
                               const std::vector<part_pair>& ignored) {
    std::vector<part_pair> left;
    std::set_difference(pairs.begin(), pairs.end(), ignored.begin(), ignored.end(),
                        std::back_inserter(left));
    return left;
}

void check_parts(std::span<const prepared_mesh> parts, const clash_options& options) {
    if (!(options.clearance >= 0.0) || !std::isfinite(options.clearance))
        throw std::invalid_argument("treeform::clash: the clearance is negative or not finite");
    for (std::size_t i = 0; i < parts.size(); ++i)
        detail::place::check_operand("clash", "part " + std::to_string(i), parts[i].view());
}

void count(clash_result& result, const part_clash& one, double clearance) {
    ++result.counts[static_cast<std::size_t>(one.how)];
    const bool counts = one.how == mesh_relation::penetrating ||
                        one.how == mesh_relation::closer_than_clearance ||
                        (one.how == mesh_relation::touching && clearance > 0.0);
    if (counts) ++result.clashes;
}

}  // namespace

clash_result clash(const mesh_refs& given_parts, const clash_options& options) {
    const detail::base::prepared_refs all_parts(given_parts);
    const std::span<const prepared_mesh> parts = all_parts;
    check_parts(parts, options);
    const auto ignored = detail::assembly::sorted_pairs("clash", options.ignored, parts.size());
    const auto near =
        detail::assembly::near_pairs(detail::assembly::boxes_of(parts), options.clearance);
    const auto pairs = without(near, ignored);
    detail::base::work_progress work(options.progress);
    const pair_inspection inspection(parts, options, work);
    std::vector<std::optional<part_clash>> found(pairs.size());
    std::atomic<std::size_t> done{0};
    for_chunks(pairs.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !work.cancelled(); ++i) {
            found[i] = inspection.look_at(pairs[i]);
            work.reach(static_cast<double>(++done) / static_cast<double>(pairs.size()));
        }
    });
    clash_result result;
    if (work.cancelled()) {
        result.status = treeform::status::cancelled;
        return result;
    }
    for (auto& one : found) {
        count(result, *one, options.clearance);
        if (one->how != mesh_relation::separate && one->how != mesh_relation::clear)
            result.pairs.push_back(std::move(*one));
    }
    const std::uint64_t n = parts.size();
    result.boxes_apart = n * (n - std::min<std::uint64_t>(n, 1)) / 2 - near.size();
    result.ignored = near.size() - pairs.size();
    for (const prepared_mesh& part : parts) result.parts_indexed += part.indexes_built() > 0;
    return result;
}

}  // namespace treeform
