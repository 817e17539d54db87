/// \file
/// What two triangles have in common, against clipping in GMP's integers and against the library's
/// integers alone.

#include "bytes.hpp"
#include <treeform/tf.hpp>

#include <support/gmp_lattice.hpp>
#include <support/unfiltered.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::fuzz::require;
    tf::fuzz::bytes in(data, size);
    tf::test::triangle_pair pair{};
    for (tf::point3& p : pair.a) p = in.point();
    for (tf::point3& p : pair.b) p = in.point();
    const auto found = tf::intersect(pair.a, pair.b);
    const auto swapped = tf::intersect(pair.b, pair.a);
    require(found.count == swapped.count && found.coplanar == swapped.coplanar &&
                found.crossing == swapped.crossing,
            "the order of the triangles does not matter");
    if (const auto truth = tf::test::unfiltered_contacts::of(pair.a, pair.b))
        require(truth->agrees(found), "as integers say");
    const auto lattice = tf::test::on_lattice(pair);
    require(agrees(found, tf::test::gmp_reference(lattice.a, lattice.b).answer()), "as GMP says");
    return 0;
}
