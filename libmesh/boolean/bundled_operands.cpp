#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/boolean/bundled_operands.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {

bundled_operands::bundled_operands(std::span<const mesh_ref> operands) {
    std::array<const prepared_mesh*, 2> meshes{};
    for (std::size_t k = 0; k < 2; ++k) {
        meshes[k] = k < operands.size() ? operands[k].prepared() : nullptr;
        if (meshes[k] != nullptr) continue;
        own_[k] =
            base::prepared_slots::of_faces(k < operands.size() ? operands[k].view() : mesh_view{});
        meshes[k] = &own_[k];
        has_single_use_index_ |= k < operands.size();
    }
    for_chunks(2, 1, [&](std::size_t k, std::size_t, std::size_t) {
        take(k, cut_operand_of(*meshes[k]), *meshes[k]);
    });
}

bundled_operands::bundled_operands(std::span<const mesh_view> operands)
    : has_single_use_index_(true) {
    const bool join = operands.size() > 2;
    if (join) take_joined(0, join_operands(operands), true);
    for (std::size_t k = join ? 1 : 0; k < 2; ++k) {
        own_[k] = base::prepared_slots::of_faces(!join && k < operands.size() ? operands[k]
                                                                              : mesh_view{});
        take(k, cut_operand_of(own_[k]), own_[k]);
    }
}

bundled_operands::bundled_operands(std::span<const mesh_view> operands, std::uint32_t sheet)
    : has_single_use_index_(true) {
    own_[0] = base::prepared_slots::of_faces(operands[sheet]);
    take(0, cut_operand_of(own_[0]), own_[0]);
    all_[0].operand = sheet;
    std::vector<mesh_view> others(operands.begin(), operands.end());
    others[sheet] = {};
    take_joined(1, join_operands(others), false);
    all_[1].has_pairs = false;
}

bundled_operands::bundled_operands(joined_operands&& joined,
                                   std::unique_ptr<const undecided_part> part)
    : part_(std::move(part)), has_single_use_index_(true) {
    take_joined(0, part_ ? part_->faces() : std::move(joined), true);
    take(1, cut_operand_of(own_[1]), own_[1]);
}

void bundled_operands::take(std::size_t k, const cut_operand& known, const prepared_mesh& given) {
    all_[k].known = &known;
    all_[k].mesh = &known.mesh(given);
    all_[k].operand = static_cast<std::uint32_t>(k);
}

void bundled_operands::take_joined(std::size_t k, joined_operands&& joined, bool is_closed) {
    joined_ = cut_operand_of(std::move(joined), is_closed);
    take(k, *joined_, own_[k]);
    all_[k].operand = 0;
    all_[k].operand_of_face = joined_->joined.operand_of_face();
}

bool bundled_operands::have_few_pairs(const progress_callback& progress) const {
    base::work_progress both(progress);
    std::array<bool, 2> are_few{};
    for_chunks(2, 1, [&](std::size_t k, std::size_t, std::size_t) {
        const double from = k == 0 ? 0.0 : 0.3;
        are_few[k] = few_own_pairs(*all_[k].mesh, both.part(from, from + 0.3)).has_value();
    });
    return are_few[0] && are_few[1];
}

void bundled_operands::find_pairs(const progress_callback& progress) {
    const progress_callback first = base::part_of(progress, 0.0, 0.5);
    if (part_) {
        const auto wanted = [&](const face_pair& pair) {
            return part_->is_undecided(all_[0].view(), pair);
        };
        pairs_within_ = own_pairs(*all_[0].mesh, wanted, first);
        all_[0].pairs = pairs_within_;
    } else {
        all_[0].pairs = own_pairs(*all_[0].mesh, first);
    }
    if (all_[1].has_pairs)
        all_[1].pairs = own_pairs(*all_[1].mesh, base::part_of(progress, 0.5, 1.0));
}

cut_faces cut_near(const bundled_operands& operands, cut_what what,
                   const progress_callback& progress) {
    const auto stops = [&](double done) { return progress && !progress(done); };
    cut_faces result;
    result.arranged.cancelled = true;
    if (stops(0.0)) return result;
    result.near = find_interaction_zone(operands.all(), operands.has_single_use_index(),
                                        what == cut_what::all);
    if (stops(0.5)) return result;
    const auto find_far = [&](std::size_t k) {
        if (what == cut_what::near_beside_far)
            result.far[k].emplace(*operands.all()[k].mesh, result.near.is_near[k]);
    };
    base::parallel_invoke(
        [&] {
            result.arranged = arrange::arrange_pairs(result.near.local, result.near.pairs, {},
                                                     base::part_of(progress, 0.5, 1.0));
        },
        [&] { find_far(0); }, [&] { find_far(1); });
    return result;
}

buffer<disposition> dispositions_of(const bundles& operands, const interaction_zone& near,
                                    disposition of_rest) {
    buffer<disposition> dispositions(operands[0].view().faces.size() +
                                     operands[1].view().faces.size());
    std::fill_n(dispositions.data(), dispositions.size(), of_rest);
    for (const std::uint32_t f : near.face_of) dispositions[f] = disposition::cut;
    return dispositions;
}

}  // namespace treeform::detail::boolean
