#pragma once
/// \file
/// Operands as they are cut: which meshes, what is known of each, and what of them matters.

#include <libmesh/boolean/active_part.hpp>
#include <libmesh/boolean/cut_operand.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/prepared_mesh.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>

namespace treeform::detail::boolean {

/// One or two operands as they are, more as one mesh; of operands that hide each other, the part that
/// can be on the surface of the result.
class bundled_operands {
  public:
    /// At most two, as they are.
    explicit bundled_operands(std::span<const mesh_operand> operands);
    /// Several that are closed, as one mesh. \param part of them, or null where all matter
    bundled_operands(joined_operands&& joined, std::unique_ptr<const active_part> part);
    bundled_operands(const bundled_operands&) = delete;
    bundled_operands& operator=(const bundled_operands&) = delete;

    [[nodiscard]] const bundles& all() const { return all_; }
    /// Null where all of them matters.
    [[nodiscard]] const active_part* part() const { return part_.get(); }
    /// Whether nothing that is prepared will be asked for again.
    [[nodiscard]] bool once() const { return once_; }

    /// Where the surfaces of at most two end.
    [[nodiscard]] open_input_edges open() const;
    /// Whether few of the faces of each bundle meet each other.
    [[nodiscard]] bool have_few_pairs(const progress_callback& progress) const;
    /// Has each bundle know the pairs of its own faces that meet where it matters.
    void find_pairs(const progress_callback& progress);

  private:
    void take(std::size_t k, const cut_operand& known, const prepared_mesh& given);

    std::array<prepared_mesh, 2> own_{};
    std::optional<cut_operand> joined_{};
    std::unique_ptr<const active_part> part_{};
    std::vector<face_pair> pairs_within_{};
    bundles all_{};
    bool once_ = false;
};

}  // namespace treeform::detail::boolean
