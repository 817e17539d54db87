#pragma once
/// \file
/// The result of two operands, from faces that were cut and faces that need not be.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace treeform::detail::boolean {

struct pair_result {
    boolean_result result{};
    bool is_manifold = false;  ///< the faces at every vertex are certainly one closed fan

    /// Whether to go on. Where `progress` asks to stop, the result says so.
    [[nodiscard]] bool goes_on(const progress_callback& progress, double done) {
        if (!progress || progress(done)) return true;
        result.certificate.status = status::cancelled;
        return false;
    }
};

/// What becomes of a face of an operand.
enum class fate : std::uint8_t { cut, dropped, kept, turned };

/// Whether 32 bits number the faces and points of both operands, and what is made of them.
[[nodiscard]] bool can_be_counted_through(const prepared_pair& operands);

/// The chosen faces of an arrangement, rounded, and between them the faces that were not cut, as
/// they were; in the order of the operands' faces.
///
/// \param near     all but the points and pairs of `local`
/// \param arranged of `near.local`; is used up
/// \param fates    of all faces of both operands, counted through; `cut` are those of `near`
/// \pre   each operand has one closed fan of faces at each vertex, and no two equal points
/// \return none where rounding has broken something
/// \same  on any number of threads
[[nodiscard]] std::optional<pair_result> surface_of_pair(
    const prepared_pair& operands, const near_faces& near, arrange_faces_result& arranged,
    round::solid_faces chosen, const buffer<fate>& fates, const boolean_options& options);

}  // namespace treeform::detail::boolean
