#include "tools/tf-selfintersect/marks.hpp"

#include <treeform/tf.hpp>

namespace tools {
namespace {

/// By `pair_kind`: faces in pairs of several kinds show the gravest.
constexpr std::array<int, tf::pair_kind_count> gravity{7, 5, 4, 3, 6, 2, 1};

void mark(std::uint8_t& present, tf::pair_kind kind) {
    const auto index = static_cast<std::size_t>(kind);
    if (present == 0 || gravity[present - 1U] < gravity[index])
        present = static_cast<std::uint8_t>(index + 1);
}

}  // namespace

face_marks mark_faces(const findings& result) {
    face_marks marks;
    marks.kind.assign(result.mesh.faces.size(), 0);
    marks.region.assign(result.mesh.faces.size(), -1);
    for (std::size_t i = 0; i < result.found.pairs.size(); ++i) {
        const tf::face_pair& pair = result.found.pairs[i];
        for (const std::uint32_t f : {pair.a, pair.b}) {
            mark(marks.kind[f], pair.kind);
            marks.region[f] = static_cast<std::int32_t>(result.regions.region_of_pair[i]);
        }
    }
    return marks;
}

}  // namespace tools
