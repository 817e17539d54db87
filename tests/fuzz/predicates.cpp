/// \file
/// Every predicate against GMP's integers.

#include "bytes.hpp"
#include <treeform/tf.hpp>

#include <support/gmp_predicates.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tf::fuzz::bytes in(data, size);
    std::vector<tf::point3> points(9);
    for (tf::point3& p : points) p = in.point();
    for (const auto& predicate : tf::test::gmp_predicates) {
        const std::vector<tf::point3> of(points.end() - static_cast<int>(predicate.points),
                                         points.end());
        const int truth = predicate.truth(tf::test::whole(of));
        tf::fuzz::require(predicate.ours(of, nullptr) == (truth > 0) - (truth < 0), predicate.name);
    }
    return 0;
}
