#include <libmesh/round/face_pieces.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

TEST_CASE("face pieces: a piece that repeats a corner stays when diagonals are exchanged") {
    const std::vector<tf::point3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3, 0}, {2, 2, 0}};
    const std::vector<tf::face> faces{{0, 1, 2}, {3, 4, 3}, {4, 0, 4}};
    tf::detail::round::face_pieces pieces(faces, points);
    CHECK(pieces.flip({}, 1.0) == 0.0);
    CHECK(pieces.all() == faces);
}

TEST_CASE("face pieces: the longer diagonal of a flat quadrangle gives way to the shorter") {
    const std::vector<tf::point3> points{{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}};
    tf::detail::round::face_pieces pieces({{0, 1, 2}, {0, 2, 3}}, points);
    CHECK(pieces.flip({}, 1.0) == 0.0);
    CHECK(pieces.all() == std::vector<tf::face>{{2, 3, 1}, {3, 0, 1}});
    const std::vector<std::array<std::uint32_t, 2>> kept{{1, 3}};
    CHECK(pieces.flip(kept, 1.0) == 0.0);
    CHECK(pieces.all().size() == 2);
}
