#pragma once
/// \file
/// CGAL's exact numbers as those of GMP, whichever type CGAL was configured to use. For the sources
/// of its peers alone.

#include <gmp.h>

namespace treeform::bench {

/// The rational inside of an exact number of the kernel EPECK, for as long as that lives.
template <class Number>
[[nodiscard]] mpq_srcptr raw_rational(const Number& number) {
    if constexpr (requires { number.mpq(); })
        return number.mpq();  // CGAL::Gmpq
    else if constexpr (requires { number.get_mpq_t(); })
        return number.get_mpq_t();  // mpq_class
    else
        return number.backend().data();  // boost's
}

}  // namespace treeform::bench
