#include <libmesh/base/work_progress.hpp>
#include <libmesh/boolean/bundled_operands.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace treeform::detail::boolean {

bundled_operands::bundled_operands(std::span<const mesh_operand> operands) {
    std::array<const prepared_mesh*, 2> meshes{};
    for (std::size_t k = 0; k < 2; ++k) {
        meshes[k] = k < operands.size() ? operands[k].prepared() : nullptr;
        if (meshes[k] != nullptr) continue;
        own_[k] = prepared_mesh::borrow(k < operands.size() ? operands[k].view() : mesh_view{});
        meshes[k] = &own_[k];
        once_ |= k < operands.size();
    }
    for_chunks(2, 1, [&](std::size_t k, std::size_t, std::size_t) {
        take(k, cut_operand_of(*meshes[k]), *meshes[k]);
    });
}

bundled_operands::bundled_operands(joined_operands&& joined,
                                   std::unique_ptr<const active_part> part)
    : joined_(cut_operand_of(part ? part->faces() : std::move(joined), true)),
      part_(std::move(part)),
      once_(true) {
    take(0, *joined_, own_[0]);
    take(1, cut_operand_of(own_[1]), own_[1]);
    all_[0].operand_of_face = joined_->joined.operand_of_face();
}

void bundled_operands::take(std::size_t k, const cut_operand& known, const prepared_mesh& given) {
    all_[k].known = &known;
    all_[k].mesh = &known.mesh(given);
    all_[k].operand = static_cast<std::uint32_t>(k);
}

open_input_edges bundled_operands::open() const {
    open_input_edges found = all_[0].known->open;
    const open_input_edges& more = all_[1].known->open;
    found.count += more.count;
    found.boundary_edges += more.boundary_edges;
    found.misoriented_edges += more.misoriented_edges;
    return found;
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
    for (bundle& b : all_) b.pairs = own_pairs(*b.mesh, progress);
    if (!part_) return;
    pairs_within_ = part_->pairs_within(all_[0].view(), all_[0].pairs);
    all_[0].pairs = pairs_within_;
}

}  // namespace treeform::detail::boolean
