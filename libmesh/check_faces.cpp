#include <libmesh/detail/check_faces.hpp>
#include <libtree/parallel.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace tf::detail {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

[[noreturn]] void refuse(const char* function, const std::string& why) {
    throw std::invalid_argument("tf::" + std::string(function) + ": " + why);
}

}  // namespace

void check_faces(const char* function, std::size_t point_count, std::span<const face> faces) {
    if (faces.size() > std::numeric_limits<std::uint32_t>::max())
        refuse(function, "more than 2^32 - 1 faces");
    const std::size_t none = faces.size();
    std::vector<std::size_t> first(chunk_count(faces.size(), grain), none);
    for_chunks(faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end && first[chunk] == none; ++i)
            if (std::max({faces[i][0], faces[i][1], faces[i][2]}) >= point_count) first[chunk] = i;
    });
    for (const std::size_t bad : first)
        if (bad != none)
            refuse(function, "face " + std::to_string(bad) + " has a corner that is no point");
}

}  // namespace tf::detail
