#include <libmesh/assembly/moved_part.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/distance.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace treeform {
namespace {

using detail::assembly::moved_part;
using detail::assembly::resting_part;

constexpr std::size_t positions_per_chunk = 8;

/// Of one pose.
struct pose_check {
    std::vector<pose_clash> clashes;
    std::uint64_t boxes_apart = 0;
};

bool is_clash(const pose_clash& one, double clearance) {
    return one.relation != mesh_relation::touching || clearance > 0.0;
}

class pose_inspection {
  public:
    pose_inspection(std::span<const prepared_mesh> parts, const clash_options& options)
        : options_(options),
          ignored_(detail::assembly::sorted_pairs("check_poses", options.ignored, parts.size())) {
        parts_.reserve(parts.size());
        for (const prepared_mesh& part : parts) parts_.emplace_back(part, options.vertices);
    }

    [[nodiscard]] pose_check check_pose(std::span<const transform<3>> pose) const {
        pose_check found;
        std::vector<moved_part> moved;
        moved.reserve(parts_.size());
        for (std::size_t i = 0; i < parts_.size(); ++i) moved.emplace_back(parts_[i], pose[i]);
        for (std::uint32_t i = 0; i < moved.size(); ++i)
            for (std::uint32_t j = i + 1; j < moved.size(); ++j) {
                if (!moved[i].near(moved[j], options_.clearance)) {
                    ++found.boxes_apart;
                    continue;
                }
                if (std::binary_search(ignored_.begin(), ignored_.end(), part_pair{i, j})) continue;
                const auto how = moved[i].relation_to(moved[j], options_.clearance);
                if (how.relation == mesh_relation::disjoint || how.relation == mesh_relation::clear)
                    continue;
                const pose_clash one{i, j, how.relation, how.distance};
                if (options_.first_only && !is_clash(one, options_.clearance)) continue;
                found.clashes.push_back(one);
                if (options_.first_only) return found;
            }
        return found;
    }

  private:
    const clash_options& options_;
    std::vector<part_pair> ignored_;
    std::vector<resting_part> parts_;
};

void check_pose_input(std::span<const prepared_mesh> parts, std::span<const transform<3>> poses,
                      const clash_options& options) {
    const std::string name = "treeform::check_poses: ";
    if (!(options.clearance >= 0.0) || !std::isfinite(options.clearance))
        throw std::invalid_argument(name + "the clearance is negative or not finite");
    if (parts.empty() ? !poses.empty() : poses.size() % parts.size() != 0)
        throw std::invalid_argument(name + std::to_string(poses.size()) +
                                    " transforms are not a multiple of " +
                                    std::to_string(parts.size()) + " parts");
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (!poses[i].finite())
            throw std::invalid_argument(name + "pose " + std::to_string(i / parts.size()) +
                                        ": the transform of part " +
                                        std::to_string(i % parts.size()) + " is not finite");
    for (std::size_t i = 0; i < parts.size(); ++i)
        detail::place::check_operand("check_poses", "part " + std::to_string(i), parts[i]);
}

/// What `ask` says of the meshes at each of the positions.
template <class Answer, class Ask>
std::vector<Answer> at_positions(const mesh_ref& given_a, const mesh_ref& given_b,
                                 std::span<const mesh_pair_options> positions, const Ask& ask) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    std::vector<Answer> found(positions.size());
    detail::base::for_numbers(positions.size(), positions_per_chunk,
                              [&](std::size_t i) { found[i] = ask(*a, *b, positions[i]); });
    return found;
}

}  // namespace

pose_result check_poses(const mesh_refs& given_parts, std::span<const transform<3>> poses,
                        const clash_options& options) {
    const detail::base::prepared_refs all_parts(given_parts);
    const std::span<const prepared_mesh> parts = all_parts;
    check_pose_input(parts, poses, options);
    const std::size_t count = parts.empty() ? 0 : poses.size() / parts.size();
    const pose_inspection inspection(parts, options);
    detail::base::work_progress work(options.progress);
    std::vector<pose_check> found(count);
    std::atomic<std::size_t> done{0};
    for_chunks(count, positions_per_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end && !work.cancelled(); ++p) {
            found[p] = inspection.check_pose(poses.subspan(p * parts.size(), parts.size()));
            work.reach(static_cast<double>(++done) / static_cast<double>(count));
        }
    });
    pose_result result;
    if (work.cancelled()) {
        result.status = treeform::status::cancelled;
        return result;
    }
    for (pose_check& one : found) {
        result.in_collision.push_back(std::any_of(
            one.clashes.begin(), one.clashes.end(),
            [&](const pose_clash& clash) { return is_clash(clash, options.clearance); }));
        result.clashing += result.in_collision.back();
        result.boxes_apart += one.boxes_apart;
        result.poses.push_back(std::move(one.clashes));
    }
    return result;
}

std::vector<bool> intersects(const mesh_ref& a, const mesh_ref& b,
                             std::span<const mesh_pair_options> positions) {
    const auto found = at_positions<std::uint8_t>(
        a, b, positions, [](const auto&... at) { return std::uint8_t{intersects(at...)}; });
    return {found.begin(), found.end()};
}

std::vector<double> distance(const mesh_ref& a, const mesh_ref& b,
                             std::span<const mesh_pair_options> positions) {
    return at_positions<double>(a, b, positions, [](const auto&... at) { return distance(at...); });
}

}  // namespace treeform
