#include <libmesh/assembly/contact_regions.hpp>
#include <libmesh/base/point_math.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>

namespace treeform::detail::assembly {
namespace {

/// Sets of pairs that hang together, each named by its lowest member.
class pair_sets {
  public:
    explicit pair_sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t set_of(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t i, std::size_t j) {
        i = set_of(i);
        j = set_of(j);
        parent_[std::max(i, j)] = std::min(i, j);
    }

  private:
    std::vector<std::size_t> parent_;
};

/// A face of one part and a corner of a face of the other that meets it.
struct face_and_corner {
    std::uint32_t face, corner;
    std::size_t pair;
};

/// Joins pairs of one face with faces of the other part that have a corner in common.
void join_neighbors(std::vector<face_and_corner>& all, pair_sets& sets) {
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) {
        return std::array{std::size_t{x.face}, std::size_t{x.corner}, x.pair} <
               std::array{std::size_t{y.face}, std::size_t{y.corner}, y.pair};
    });
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].face == all[i - 1].face && all[i].corner == all[i - 1].corner)
            sets.join(all[i - 1].pair, all[i].pair);
}

/// What the boxes of two faces have in common.
box3 common_box(mesh_view a, std::uint32_t f, mesh_view b, std::uint32_t g) {
    const auto s = base::triangle_of(a, f), t = base::triangle_of(b, g);
    box3 box;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low_s, high_s] = std::minmax({s[0][k], s[1][k], s[2][k]});
        const auto [low_t, high_t] = std::minmax({t[0][k], t[1][k], t[2][k]});
        box.min[k] = std::max(low_s, low_t);
        box.max[k] = std::min(high_s, high_t);
    }
    return box;
}

void include(box3& box, const box3& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], other.min[k]);
        box.max[k] = std::max(box.max[k], other.max[k]);
    }
}

void keep_first(std::vector<std::uint32_t>& faces, std::size_t limit) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (faces.size() > limit) faces.resize(limit);
}

}  // namespace

std::vector<contact_region> regions_of(mesh_view a, mesh_view b, std::span<const face_pair> pairs,
                                       std::size_t limit) {
    pair_sets sets(pairs.size());
    for (const bool of_a : {true, false}) {
        std::vector<face_and_corner> all;
        all.reserve(3 * pairs.size());
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (const std::uint32_t corner : of_a ? b.faces[pairs[i].b] : a.faces[pairs[i].a])
                all.push_back({of_a ? pairs[i].a : pairs[i].b, corner, i});
        join_neighbors(all, sets);
    }
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> region_of(pairs.size(), none);
    std::vector<contact_region> regions;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& pair = pairs[i];
        const box3 box = common_box(a, pair.a, b, pair.b);
        std::size_t& number = region_of[sets.set_of(i)];
        if (number == none) {
            number = regions.size();
            regions.push_back({.box = box});
        }
        contact_region& region = regions[number];
        include(region.box, box);
        ++region.face_pairs;
        region.faces_a.push_back(pair.a);
        region.faces_b.push_back(pair.b);
    }
    for (contact_region& region : regions) {
        keep_first(region.faces_a, limit);
        keep_first(region.faces_b, limit);
    }
    return regions;
}

}  // namespace treeform::detail::assembly
