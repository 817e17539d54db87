#include <libmesh/round/cancelled_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <tuple>

namespace treeform::detail::round {
namespace {

struct named_face {
    face corners;  ///< ascending
    std::uint32_t number;
    bool even;  ///< its own corners ascend except for a cyclic shift
};

named_face name_of(const face& f, std::uint32_t number) {
    named_face named{f, number, (f[0] < f[1]) + (f[1] < f[2]) + (f[2] < f[0]) == 2};
    std::sort(named.corners.begin(), named.corners.end());
    return named;
}

}  // namespace

std::vector<std::uint8_t> cancelled_faces(std::span<const face> faces, bool solid) {
    std::vector<named_face> named;
    named.reserve(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) named.push_back(name_of(faces[f], f));
    std::sort(named.begin(), named.end(), [](const named_face& x, const named_face& y) {
        return std::tie(x.corners, x.number) < std::tie(y.corners, y.number);
    });
    std::vector<std::uint8_t> gone(faces.size(), 0);
    for (std::size_t begin = 0, end = 0; begin < named.size(); begin = end) {
        int sum = 0;
        for (; end < named.size() && named[end].corners == named[begin].corners; ++end)
            sum += named[end].even ? 1 : -1;
        if (end - begin == 1) continue;
        int left = solid ? std::abs(sum) : 1;
        for (std::size_t i = begin; i < end; ++i) {
            const bool stays = left > 0 && (!solid || named[i].even == (sum > 0));
            left -= stays ? 1 : 0;
            gone[named[i].number] = stays ? 0 : 1;
        }
    }
    return gone;
}

}  // namespace treeform::detail::round
