#pragma once
/// \file
/// The sign of a polynomial: by the filter, and where that leaves it undecided, by integers.

#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/filter.hpp>
#include <treeform/mesh/predicates.hpp>

namespace treeform::detail::exact {

/// Counts a call, and whether the filter left it `open`.
inline void count_call(predicate_counters* counters, bool open) {
    if (!counters) return;
    ++counters->calls;
    counters->undecided += open;
}

/// The exact stage, called with references: the filter's caller stores no copies for it.
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
