#include <libmesh/assembly/moved_part.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::assembly {
namespace {

/// A face of one part and a corner of a face of the other that meets it.
struct face_and_corner {
    std::uint32_t face, corner, pair;
};

/// Joins pairs of one face with faces of the other part that have a corner in common.
void join_neighbors(std::vector<face_and_corner>& all, base::union_find& sets) {
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) {
        return std::array{x.face, x.corner, x.pair} < std::array{y.face, y.corner, y.pair};
    });
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].face == all[i - 1].face && all[i].corner == all[i - 1].corner)
            sets.join(all[i - 1].pair, all[i].pair);
}

/// What the boxes of two faces have in common.
box3 common_box(mesh_view a, std::uint32_t f, mesh_view b, std::uint32_t g) {
    const auto s = base::triangle_of(a, f), t = base::triangle_of(b, g);
    box3 box;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low_s, high_s] = std::minmax({s[0][k], s[1][k], s[2][k]});
        const auto [low_t, high_t] = std::minmax({t[0][k], t[1][k], t[2][k]});
        box.min[k] = std::max(low_s, low_t);
        box.max[k] = std::min(high_s, high_t);
    }
    return box;
}

void include(box3& box, const box3& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], other.min[k]);
        box.max[k] = std::max(box.max[k], other.max[k]);
    }
}

void keep_first(std::vector<std::uint32_t>& faces, std::size_t limit) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (faces.size() > limit) faces.resize(limit);
}

/// Regions in the order of their first pairs; see `contact_region`. Corners with the same number
/// are the same point.
/// \pre `pairs` are pairs of a face of `a` and a face of `b`, ascending
std::vector<contact_region> regions_of(mesh_view a, mesh_view b, std::span<const face_pair> pairs,
                                       std::size_t limit) {
    base::union_find sets(pairs.size());
    for (const bool of_a : {true, false}) {
        std::vector<face_and_corner> all;
        all.reserve(3 * pairs.size());
        for (std::uint32_t i = 0; i < pairs.size(); ++i)
            for (const std::uint32_t corner : of_a ? b.faces[pairs[i].b] : a.faces[pairs[i].a])
                all.push_back({of_a ? pairs[i].a : pairs[i].b, corner, i});
        join_neighbors(all, sets);
    }
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> region_of(pairs.size(), none);
    std::vector<contact_region> regions;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const auto& pair = pairs[i];
        const box3 box = common_box(a, pair.a, b, pair.b);
        std::size_t& number = region_of[sets.root(i)];
        if (number == none) {
            number = regions.size();
            regions.push_back({.box = box});
        }
        contact_region& region = regions[number];
        include(region.box, box);
        ++region.face_pairs;
        region.faces_a.push_back(pair.a);
        region.faces_b.push_back(pair.b);
    }
    for (contact_region& region : regions) {
        keep_first(region.faces_a, limit);
        keep_first(region.faces_b, limit);
    }
    return regions;
}

}  // namespace
}  // namespace treeform::detail::assembly

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
        if (how.relation == mesh_relation::disjoint) {
            enter_distance(a, b, found);
            return found;
        }
        found.relation = how.relation == mesh_relation::touching ? mesh_relation::touching
                                                                 : mesh_relation::penetrating;
        face_pair_options all;
        all.progress = asking_;
        const auto meeting =
            detail::intersect::mesh_intersections(a.mesh(), a.faces(), b.mesh(), b.faces(), all);
        found.face_pairs = meeting.pairs.size();
        found.regions =
            detail::assembly::regions_of(a.joined(), b.joined(), meeting.pairs, options_.limit);
        if (meeting.pairs.empty()) enter_surface_distance(a, b, found);
        if (found.relation == mesh_relation::penetrating) enter_extent(a, b, found);
        if (work_.cancelled()) return std::nullopt;
        return found;
    }

  private:
    /// Of disjoint parts.
    void enter_distance(const shape& a, const shape& b, part_clash& found) const {
        found.relation = mesh_relation::disjoint;
        if (options_.clearance == 0.0) return;
        found.relation = mesh_relation::clear;
        const auto near = detail::nearness::closest_pair(a.mesh(), a.faces(), b.mesh(), b.faces(),
                                                         options_.clearance);
        if (!near || !(near->distance < options_.clearance)) return;
        found.relation = mesh_relation::closer_than_clearance;
        found.distance = near->distance;
        found.nearest = {near->on_a, near->on_b};
    }

    /// Of a part inside the other.
    void enter_surface_distance(const shape& a, const shape& b, part_clash& found) const {
        const auto near = detail::nearness::closest_pair(a.mesh(), a.faces(), b.mesh(), b.faces());
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
        detail::place::check_operand("clash", "part " + std::to_string(i), parts[i].indexed_view());
}

void count(clash_result& result, const part_clash& one, double clearance) {
    ++result.counts[static_cast<std::size_t>(one.relation)];
    const bool counts = one.relation == mesh_relation::penetrating ||
                        one.relation == mesh_relation::closer_than_clearance ||
                        (one.relation == mesh_relation::touching && clearance > 0.0);
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
        if (one->relation != mesh_relation::disjoint && one->relation != mesh_relation::clear)
            result.pairs.push_back(std::move(*one));
    }
    const std::uint64_t n = parts.size();
    result.boxes_apart = n * (n - std::min<std::uint64_t>(n, 1)) / 2 - near.size();
    result.ignored = near.size() - pairs.size();
    for (const prepared_mesh& part : parts) result.parts_indexed += part.indexes_built() > 0;
    return result;
}

}  // namespace treeform
