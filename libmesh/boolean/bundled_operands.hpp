#pragma once
/// \file
/// Operands as they are cut: which meshes, what is known of each, and what of them matters.

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

/// One or two operands as they are, more as one mesh; of operands that hide each other, the part
/// that can be on the surface of the result.
class bundled_operands {
  public:
    /// At most two, as they are.
    explicit bundled_operands(std::span<const mesh_ref> operands);
    /// Any number, which may be open.
    explicit bundled_operands(std::span<const mesh_view> operands);
    /// Number `sheet`, and all others as one mesh.
    bundled_operands(std::span<const mesh_view> operands, std::uint32_t sheet);
    /// Several that are closed, as one mesh. \param part of them, or null where all matter
    bundled_operands(joined_operands&& joined, std::unique_ptr<const undecided_part> part);
    bundled_operands(const bundled_operands&) = delete;
    bundled_operands& operator=(const bundled_operands&) = delete;

    [[nodiscard]] const bundles& all() const { return all_; }
    /// Null where all of them matters.
    [[nodiscard]] const undecided_part* part() const { return part_.get(); }
    /// Whether nothing that is prepared will be asked for again.
    [[nodiscard]] bool once() const { return once_; }

    /// Whether few of the faces of each bundle meet each other.
    [[nodiscard]] bool have_few_pairs(const progress_callback& progress) const;
    /// Has each bundle know the pairs of its own faces that meet where it matters; of those beside
    /// a sheet, what is near tells later.
    void find_pairs(const progress_callback& progress);

  private:
    void take(std::size_t k, const cut_operand& known, const prepared_mesh& given);
    void take_joined(std::size_t k, joined_operands&& joined, bool is_closed);

    std::array<prepared_mesh, 2> own_{};
    std::optional<cut_operand> joined_{};
    std::unique_ptr<const undecided_part> part_{};
    std::vector<face_pair> pairs_within_{};
    bundles all_{};
    bool once_ = false;
};

/// Faces where they meet, cut along each other.
struct cut_faces {
    interaction_zone near{};
    arrange_faces_result arranged{};
    std::array<std::optional<far_faces>, 2> far{};  ///< where asked for
};

enum class cut_what : std::uint8_t {
    near,             ///< and the others stay as they are
    near_beside_far,  ///< these are labeled in sets
    all
};

/// \same on any number of threads
[[nodiscard]] cut_faces cut_near(const bundled_operands& operands, cut_what what,
                                 const progress_callback& progress);

/// The same for all faces of both bundles that are not near.
[[nodiscard]] buffer<disposition> dispositions_of(const bundles& operands,
                                                  const interaction_zone& near,
                                                  disposition of_rest);

}  // namespace treeform::detail::boolean
