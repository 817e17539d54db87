#pragma once
/// \file
/// Arithmetic on the features of a triangle, and the list in which contacts are collected.

#include <treeform/mesh/predicates.hpp>

#include <array>
#include <cassert>
#include <cstdint>

namespace treeform::detail::geometry {

constexpr const point3& at(const triangle3& t, int i) { return t[static_cast<std::size_t>(i)]; }

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }
constexpr int previous(int i) { return i == 0 ? 2 : i - 1; }

constexpr triangle_feature corner(int i) { return static_cast<triangle_feature>(i); }
constexpr triangle_feature edge(int i) { return static_cast<triangle_feature>(3 + i); }
constexpr bool is_corner(triangle_feature f) { return f <= triangle_feature::v2; }
constexpr bool is_edge(triangle_feature f) {
    return f >= triangle_feature::e0 && f <= triangle_feature::e2;
}
constexpr int index_of(triangle_feature f) { return static_cast<int>(f) % 3; }

/// Whether the closed edge `i` contains the points of feature `f`.
constexpr bool holds(int i, triangle_feature f) {
    return f == edge(i) || f == corner(i) || f == corner(next(i));
}

/// The ends found so far, without duplicates: for one pair of triangles, equal names are equal
/// points.
class contact_list {
  public:
    void add(triangle_feature on_a, triangle_feature on_b) {
        const feature_pair found{on_a, on_b};
        for (int i = 0; i < size_; ++i)
            if (items_[static_cast<std::size_t>(i)] == found) return;
        assert(size_ < capacity);
        items_[static_cast<std::size_t>(size_++)] = found;
    }
    template <class Predicate>
    void drop_if(Predicate drop) {
        int kept = 0;
        for (int i = 0; i < size_; ++i) {
            const feature_pair c = items_[static_cast<std::size_t>(i)];
            if (!drop(c)) items_[static_cast<std::size_t>(kept++)] = c;
        }
        size_ = kept;
    }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] feature_pair operator[](int i) const {
        return items_[static_cast<std::size_t>(i)];
    }

  private:
    static constexpr int capacity = 8;
    std::array<feature_pair, capacity> items_;
    int size_ = 0;
};

/// The contact with the given ends: a point, a segment or an area, by their number.
inline triangle_contact contact_of(const contact_list& ends, bool coplanar) {
    assert(ends.size() <= 6);
    triangle_contact result;
    result.coplanar = coplanar;
    result.count = static_cast<std::uint8_t>(ends.size());
    for (int i = 0; i < ends.size(); ++i) result.ends[static_cast<std::size_t>(i)] = ends[i];
    return result;
}

}  // namespace treeform::detail::geometry
