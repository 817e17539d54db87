#include <treeform/mesh/repair.hpp>

#include <utility>

namespace treeform {

const mesh& repair_result::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh repair_result::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

}  // namespace treeform
