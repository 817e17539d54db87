#pragma once
/// \file
/// The exact stage of the predicates of constructed points as separate functions, for loops that
/// inline the filter (implicit_filter.hpp) and call these only when it is undecided.
///
/// Counts the width used: one or two limbs for each coordinate, or any number, which is the last
/// class. The caller, which runs the filter, counts calls and undecided ones.

#include <libmesh/exact/dyadic.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>

namespace treeform::detail::exact {

[[nodiscard]] TREEFORM_API int compare_exact(int axis, const implicit_point& a,
                                             const implicit_point& b, predicate_counters* counters);
[[nodiscard]] TREEFORM_API bool equal_exact(const implicit_point& a, const implicit_point& b,
                                            predicate_counters* counters);
[[nodiscard]] TREEFORM_API int orient2d_exact(int axis, const implicit_point& a,
                                              const implicit_point& b, const implicit_point& c,
                                              predicate_counters* counters);
[[nodiscard]] TREEFORM_API int side_exact(const plane_points& p, const implicit_point& d,
                                          predicate_counters* counters);

/// The exact coordinates, each rounded to the format.
/// \throws std::invalid_argument when the lines or planes have not exactly one common point
[[nodiscard]] std::array<rounded_quotient, 3> rounded_exactly(const implicit_point& p,
                                                              const float_format& format);

}  // namespace treeform::detail::exact
