#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/prepared_slots.hpp>

namespace treeform::detail::base {

prepared_refs::prepared_refs(const mesh_refs& given) {
    const prepared_mesh* const first = given.empty() ? nullptr : given[0].prepared_;
    bool is_in_order = first != nullptr;
    for (std::size_t i = 0; i < given.size() && is_in_order; ++i)
        is_in_order = given[i].prepared_ == first + i;
    if (is_in_order) {
        all_ = {first, given.size()};
        return;
    }
    own_.reserve(given.size());
    for (const mesh_ref& mesh : given)
        own_.push_back(mesh.prepared_ != nullptr ? prepared_slots::shared(*mesh.prepared_)
                                                 : prepared_mesh::borrow(mesh.view()));
    all_ = own_;
}

}  // namespace treeform::detail::base
