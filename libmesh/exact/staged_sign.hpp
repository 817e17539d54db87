#pragma once
/// \file
/// The sign of a polynomial: by the filter, and if that is undecided, by integers.

#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/filter.hpp>
#include <treeform/mesh/predicates.hpp>

namespace treeform::detail::exact {

/// Counts a call; `open`: the filter was undecided.
inline void count_call(predicate_counters* counters, bool open) {
    if (!counters) return;
    ++counters->calls;
    counters->undecided += open;
}

/// The exact stage, with arguments by reference, so that the caller of the filter stores no copies
/// for it.
template <class Polynomial, class... Points>
[[gnu::noinline]] int sign_by_integers(predicate_counters* counters, const Points&... points) {
    return exact_sign<Polynomial>({vector_of(points)...}, counters);
}

template <class Polynomial, class... Points>
int staged_sign(predicate_counters* counters, const Points&... points) {
    const int sign = filter_sign<Polynomial>(points...);
    count_call(counters, sign == undecided);
    return sign != undecided ? sign : sign_by_integers<Polynomial>(counters, points...);
}

}  // namespace treeform::detail::exact
