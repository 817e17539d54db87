#pragma once
/// \file
/// Operands prepared for cutting: their meshes, what is known about each, and the part of them that
/// can be on the result.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/cut_operand.hpp>
#include <libmesh/boolean/far_faces.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <libmesh/boolean/undecided_part.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>

namespace treeform::detail::boolean {

/// One or two operands unchanged, or more operands joined to one mesh; for operands that hide each
/// other, only the part that can be on the surface of the result.
class bundled_operands {
  public:
    /// At most two operands, unchanged.
    explicit bundled_operands(std::span<const mesh_ref> operands);
    /// Any number of operands, which may be open.
    explicit bundled_operands(std::span<const mesh_view> operands);
    /// Operand `sheet`, and all others as one mesh.
    bundled_operands(std::span<const mesh_view> operands, std::uint32_t sheet);
    /// Several closed operands, as one mesh. \param part the part of them that matters; null: all
    bundled_operands(joined_operands&& joined, std::unique_ptr<const undecided_part> part);
    bundled_operands(const bundled_operands&) = delete;
    bundled_operands& operator=(const bundled_operands&) = delete;

    [[nodiscard]] const bundles& all() const { return all_; }
    /// Null if all of the operands matters.
    [[nodiscard]] const undecided_part* part() const { return part_.get(); }
    /// Whether the index of some operand, which the caller did not prepare, is used only once.
    [[nodiscard]] bool has_single_use_index() const { return has_single_use_index_; }

    /// Whether only few faces within each bundle meet.
    [[nodiscard]] bool have_few_pairs(const progress_callback& progress) const;
    /// Finds, for each bundle, the pairs of its own faces that meet where it matters. For solids
    /// beside a sheet, they are found later, from the interaction zone.
    void find_pairs(const progress_callback& progress);

  private:
    void take(std::size_t k, const cut_operand& known, const prepared_mesh& given);
    void take_joined(std::size_t k, joined_operands&& joined, bool is_closed);

    std::array<prepared_mesh, 2> own_{};
    std::optional<cut_operand> joined_{};
    std::unique_ptr<const undecided_part> part_{};
    std::vector<face_pair> pairs_within_{};
    bundles all_{};
    bool has_single_use_index_ = false;
};

/// The faces of the interaction zone, cut along each other.
struct cut_faces {
    interaction_zone near{};
    arrange_faces_result arranged{};
    std::array<std::optional<far_faces>, 2> far{};  ///< if requested
};

enum class cut_what : std::uint8_t {
    near,             ///< only the interaction zone; other faces do not change
    near_beside_far,  ///< the same, with sets of the other faces for labeling
    all
};

/// \same on any number of threads
[[nodiscard]] cut_faces cut_near(const bundled_operands& operands, cut_what what,
                                 const progress_callback& progress);

/// [faces of both bundles] `of_rest` for all faces that are not near.
[[nodiscard]] buffer<disposition> dispositions_of(const bundles& operands,
                                                  const interaction_zone& near,
                                                  disposition of_rest);

}  // namespace treeform::detail::boolean
