#pragma once
/// \file
/// Selects the kept point that represents a dropped one.

#include <libmesh/weld/reach.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::weld {

/// The nearest of the points considered; ties: the lowest number. Every implementation of the rule
/// `first` uses it (lists of pairs, cubes, tiles and their borders).
class nearest_kept {
  public:
    explicit nearest_kept(const point3& p) : p_(p) {}

    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] std::uint64_t id() const { return id_; }
    [[nodiscard]] const point3& at() const { return at_; }

    void consider(std::uint64_t id, const point3& at) {
        if (any_ && !precedes(id, at)) return;
        any_ = true;
        id_ = id;
        at_ = at;
    }
    /// Whether the given point is preferred to the current nearest one. \pre any()
    [[nodiscard]] bool precedes(std::uint64_t id, const point3& at) const {
        const int order = reach::compare(p_, at, at_);
        return order < 0 || (order == 0 && id < id_);
    }

  private:
    point3 p_;
    point3 at_{};
    std::uint64_t id_ = 0;
    bool any_ = false;
};

}  // namespace treeform::detail::weld
