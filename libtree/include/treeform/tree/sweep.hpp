#pragma once
/// \file
/// Searches two trees while one moves in a straight line, for the pairs that meet first.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace treeform {

namespace detail {

template <std::size_t D>
TREEFORM_API void sweep(const transformed<D>& a, const transformed<D>& b,
                        const std::array<double, D>& motion, double latest,
                        function_ref<double(std::uint32_t, std::uint32_t)> visit);

}  // namespace detail

/// Calls `visit(i, j)` for every pair of a primitive i of `a` and j of `b` whose boxes may have a
/// common point at some time t in [0, latest], when `a` is moved by t times `motion` (anything with
/// []). Pairs that may meet early usually come first. `visit` returns the time after which it wants
/// no more pairs; a later time than before has no effect. Pairs that may meet exactly then are
/// still visited.
///
/// Either side may be `transformed{tree, map}`. Only boxes are swept: `visit` has to find out
/// whether and when two primitives meet.
///
/// \throws std::invalid_argument for a motion that is zero or not finite, or a time that is
///         negative or NaN
/// \cost   in most cases as the nearest pair of the trees; serial. Less for a motion along an axis,
///         more for one across all axes, since swept boxes are then much larger than what is in
///         them
/// \same   order and pairs, on every machine
/// \source slabs: Kay and Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986, for the ray from 0
///         along the motion and the box of differences of two boxes
template <placed_tree A, placed_tree B, class Motion, class Visit>
requires std::is_invocable_r_v<double, const Visit&, std::uint32_t, std::uint32_t>
void visit_swept(const A& a, const B& b, const Motion& motion, const Visit& visit,
                 double latest = std::numeric_limits<double>::infinity()) {
    constexpr std::size_t D = A::dimensions;
    std::array<double, D> along;
    for (std::size_t k = 0; k < D; ++k) along[k] = static_cast<double>(motion[k]);
    detail::sweep<D>(a, b, along, latest, visit);
}

}  // namespace treeform
