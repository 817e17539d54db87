#pragma once
/// \file
/// Welds clouds larger than memory tile by tile, with the same groups as `group_points`.
///
/// A tile gets the points of its part of space (its own points) and those of its halo: all others
/// within the tolerance of that part. It has all neighbors of its own points, but not all neighbors
/// of its halo. What a tile decides holds for the whole cloud; what depends on the neighbors of its
/// halo is left to one pass over the borders of all tiles. There is no iteration, and tiles are
/// independent: they can be processed in any order, at any time, by any process.
///
/// Rule `first`. A tile classifies its points in order. A point is
/// - dropped when an earlier kept one is within the tolerance,
/// - kept when it is an own point and all earlier neighbors are dropped,
/// - open otherwise. By induction over the order, a point classified as kept or dropped is so in
/// the whole cloud: the tile has all neighbors of an own point, and one kept point within the
/// tolerance suffices to drop any point. The leader of a dropped own point is the nearest kept one.
/// If an open point is nearer, the leader is provisional, since the open point may be kept. The
/// border pass gets the own points that are open or have a provisional leader, and the kept ones in
/// the halo of another tile. It processes these in order, and drops an open point if an earlier
/// kept one of them is within the tolerance; otherwise it keeps the point. This conforms to the
/// rule: an earlier neighbor that is kept in the end was not classified as kept here (it would have
/// dropped the point), nor as dropped. So it is open in its own tile, or kept there and in the halo
/// of this one; in both cases the border pass has it. For the same reason the final leader of a
/// provisional point is its provisional leader, or a point that the border pass has processed
/// before it.
///
/// One open point represents all later open points within a fourth of the tolerance of it, with a
/// reach longer by that much. So more points may be classified as open, but none wrongly as kept or
/// dropped, and the memory of a tile is bounded by its volume, not by its number of points.
///
/// Conditions. Points whose values do not agree are never neighbors. An open point represents only
/// others with the same values.
///
/// Rule `chain`. The points that are linked inside a tile form a component there. A component of
/// the cloud is the union of components of tiles that share points: points of a tile in the halo of
/// another. The border pass joins these components. No tile has the distances of points to the
/// lowest point of a component that extends beyond it; so a tile lists the points of components
/// that may be larger, each with the lowest point in the tile, and distances are measured after all
/// components are joined.
///
/// The border pass can be divided by space: one pass for each set of tiles, and then one for what
/// these passes leave. A point is outer to a pass when it is in a tile that is not in the set, or
/// in the halo of one. With the rule first, a pass treats the points of its tiles as a tile treats
/// its own points, but it has no points beyond its tiles. So it classifies an outer point that no
/// kept point drops as open, and gives an outer point that is dropped a provisional leader. It
/// passes on both of these, points that are open because of them, points with a provisional leader
/// because of them, and outer kept points. A pass without outer points leaves none. With the rule
/// chain, a pass passes on the links of outer points, with the lowest point of the joined
/// component.
///
/// With the rule first, the border pass may be large: if points are stored row by row, open points
/// along a border may leave all later points of the rows open. To limit its memory, it can be
/// divided into runs. A run has consecutive slices of the point numbers and its own `border_weld`.
/// It needs those points of earlier runs that decide the state of its own points. These are
/// requested: when an own point is open or has a provisional leader, a tile marks the open points
/// near it that are in another slice with the bundle of its slice. The final state of a marked
/// point, and that of the points that it represents, is handed over to each bundle that marked it.
/// A run needs no more: an earlier neighbor that is kept in the end is open in the point's own
/// tile, or dropped the point there. A run with only part of a bundle takes those points handed
/// over to the bundle that are near its own points. A pass for a set of tiles requests points from
/// the next pass in the same way, for its own open points. It passes on a request of a tile that is
/// outer: a position within a fourth of the tolerance of a point of another tile is.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// The points of a cloud by their numbers, cut into slices of equal size: all of one come before
/// those of the next. They follow each other in bundles; one of all numbers, unless said otherwise.
/// A set of bundles is a number with a bit for each.
class number_slices {
  public:
    static constexpr std::size_t bundles = 64;
    /// Smaller slices save little memory, and more points have neighbors in other slices.
    static constexpr unsigned bits_of_slice = 15;

    number_slices() = default;
    /// Divides the numbers below `count` into at most 64 bundles. A bundle of more than `1 <<
    /// least_bits` numbers is divided into slices of at least that many; there are at most 1024
    /// slices.
    explicit number_slices(std::uint64_t count, unsigned least_bits = bits_of_slice)
        : bundle_bits_(bits_for(count, 6)),
          slice_bits_(std::min(bundle_bits_, std::max(least_bits, bits_for(count, 10)))) {}

    [[nodiscard]] std::uint64_t slice_of(std::uint64_t number) const {
        return number >> slice_bits_;
    }
    [[nodiscard]] std::size_t bundle_of(std::uint64_t number) const {
        return static_cast<std::size_t>(number >> bundle_bits_);
    }
    /// The first number of a slice; `bundle_begin`: of a bundle.
    [[nodiscard]] std::uint64_t slice_begin(std::uint64_t slice) const {
        return slice << slice_bits_;
    }
    [[nodiscard]] std::uint64_t bundle_begin(std::uint64_t bundle) const {
        return bundle << bundle_bits_;
    }

    /// The set with the bundle of `number` only.
    [[nodiscard]] std::uint64_t bit_of(std::uint64_t number) const {
        return std::uint64_t{1} << bundle_of(number);
    }
    [[nodiscard]] static bool has(std::uint64_t set, std::size_t bundle) {
        return (set >> bundle & 1) != 0;
    }
    /// The bundles in `set` that have a slice after the first slice of `bundle`.
    [[nodiscard]] std::uint64_t after(std::size_t bundle, std::uint64_t set) const {
        return bundle_bits_ > slice_bits_ ? set >> bundle << bundle
                                          : set >> bundle >> 1 << bundle << 1;
    }
    /// The bundles in `set` that have a slice at or after `number`, which is the first number of a
    /// slice.
    [[nodiscard]] std::uint64_t from(std::uint64_t number, std::uint64_t set) const {
        const std::size_t bundle = bundle_of(number);
        return bundle < bundles ? set >> bundle << bundle : 0;
    }

  private:
    /// Bits of a number within a part, for at most `1 << part_bits` parts.
    [[nodiscard]] static unsigned bits_for(std::uint64_t count, unsigned part_bits) {
        return static_cast<unsigned>(
            std::bit_width((std::max<std::uint64_t>(count, 1) - 1) >> part_bits));
    }

    unsigned bundle_bits_ = 63;
    unsigned slice_bits_ = 63;
};

/// The role of a point in a tile.
enum class tile_role : std::uint8_t {
    own,     ///< in the tile's part of space, and in no halo
    shared,  ///< in the tile's part of space, and in the halo of others
    halo
};

/// A point as input of a tile. Its number is that in the whole cloud, less than 2^62.
struct tile_point {
    std::uint64_t tag = 0;  ///< number * 4 + role
    point3 at{};

    [[nodiscard]] static tile_point make(std::uint64_t id, tile_role role, const point3& at) {
        return {id << 2 | static_cast<std::uint64_t>(role), at};
    }
    [[nodiscard]] std::uint64_t id() const { return tag >> 2; }
    [[nodiscard]] tile_role role() const { return static_cast<tile_role>(tag & 3); }
};

/// A dropped point, and the point that represents it (its leader).
struct tile_drop {
    std::uint64_t id = 0;
    std::uint64_t leader = 0;

    friend bool operator==(const tile_drop&, const tile_drop&) = default;
};

enum class border_kind : std::uint8_t {
    open,         ///< kept or dropped: the border pass decides
    provisional,  ///< dropped; represented by `leader` or a nearer point
    kept,         ///< kept; may be the leader of others
    link          ///< rule chain: a shared point, and the lowest point of its component in one tile
};

/// A point that a tile leaves to the border pass.
struct border_point {
    std::uint64_t tag = 0;  ///< number * 4 + kind
    point3 at{};
    std::uint64_t leader = 0;
    point3 leader_at{};

    [[nodiscard]] static border_point make(std::uint64_t id, border_kind kind) {
        return {id << 2 | static_cast<std::uint64_t>(kind), {}, 0, {}};
    }
    [[nodiscard]] std::uint64_t id() const { return tag >> 2; }
    [[nodiscard]] border_kind kind() const { return static_cast<border_kind>(tag & 3); }
};

/// A position near which the state of points of a bundle may decide that of points in later slices.
struct asked_point {
    std::uint64_t bundle = 0;
    point3 at{};
    std::uint64_t asked_by = 0;  ///< set of bundles
};

/// Rule chain: a point of a component that may extend over several tiles.
struct tile_member {
    point3 at{};
    std::uint64_t lowest = 0;  ///< lowest point of the component in the tile
    point3 lowest_at{};
};

/// The longest distance from a dropped point to its leader.
class TREEFORM_API longest_move {
  public:
    /// Replaces the current pair of points if the given one is farther apart, decided exactly.
    void consider(const point3& from, const point3& to);
    void consider(const longest_move& other) { consider(other.from_, other.to_); }
    [[nodiscard]] const point3& from() const { return from_; }
    [[nodiscard]] const point3& to() const { return to_; }
    /// The least double that is not below the exact distance.
    [[nodiscard]] double length() const;

  private:
    point3 from_{};
    point3 to_{};
};

/// The results of a tile for its own points.
struct tile_result {
    std::vector<tile_drop> dropped{};    ///< by ascending numbers; final with the rule first
    std::vector<border_point> border{};  ///< by ascending numbers
    std::vector<std::uint64_t> border_values{};  ///< rule first: values of `border`, as for `add`
    std::vector<asked_point> asked{};            ///< rule first: requests, by ascending bundles
    std::vector<std::uint64_t> asked_values{};   ///< values of `asked`
    std::vector<tile_member> members{};          ///< rule chain only
    /// Longest move of `dropped`; with the rule chain, without the `members`.
    longest_move move{};
};

/// One tile.
class TREEFORM_API tile_weld {
  public:
    /// \throws std::invalid_argument for a tolerance that is negative or not finite
    tile_weld(bool chain, double tolerance, agreement agree = {}, const number_slices& slices = {});
    ~tile_weld();
    tile_weld(tile_weld&&) noexcept;
    tile_weld& operator=(tile_weld&&) noexcept;

    /// Reserves memory for that many points, to avoid reallocation. A hint only.
    void reserve(std::size_t points);

    /// Adds the next points, whose numbers ascend over all calls, and appends their results to
    /// `out`. With the rule first, only kept and open points are stored, in about 60 bytes each.
    /// With the rule chain, all points are, in about 100 bytes each; use `crowded_chain` for more
    /// points than fit into memory.
    ///
    /// \pre all coordinates are finite; `values` has the values of the agreement, point by point
    /// \cost expected O(1) a point with the rule first, if kept and open points are not dense
    void add(std::span<const tile_point> points, tile_result& out,
             std::span<const std::uint64_t> values = {});

    /// Finishes the tile; each call appends a piece of the result. Call it until it returns false.
    /// \throws std::invalid_argument for the rule chain and more than 2^32 - 2 points
    /// \cost with the rule chain as `group_points`; with the rule first O(1) for each requested
    /// open point and bundle
    [[nodiscard]] bool finish(tile_result& out);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// The maximum distance of an open point that matters to a point. If 1.26 tolerances overflow, open
/// points represent only equal ones.
[[nodiscard]] inline double reach_of_open(double tolerance) {
    return tolerance < 0x1p1000 ? 1.26 * tolerance : tolerance;
}

/// A border pass, which decides the `border` points of tiles.
class TREEFORM_API border_weld {
  public:
    /// \throws std::invalid_argument for a tolerance that is negative or not finite
    explicit border_weld(double tolerance, agreement agree = {}, const number_slices& slices = {});
    ~border_weld();
    border_weld(border_weld&&) noexcept;
    border_weld& operator=(border_weld&&) noexcept;

    /// Adds the next point, and appends its result to `out`: with the rule first, a drop or a point
    /// for the next pass. Numbers ascend over all calls and tiles (those of links may be equal).
    /// Only kept points, open points and linked components are stored: about 60 bytes for a point,
    /// 100 for a component.
    ///
    /// \pre `outer` tells whether the point is outer; `values` are those of the agreement
    void add(const border_point& p, std::span<const std::uint64_t> values, bool outer,
             tile_result& out);

    /// Rule first: adds a point handed over by earlier runs; before any own point, and each point
    /// once. If several runs hand over an open point, `leader` (the set of bundles that it
    /// represents) must be the union of theirs. Points farther than `reach_of_open` from all own
    /// points are not needed.
    void receive(const border_point& p, std::span<const std::uint64_t> values);
    /// Rule first: appends to `known` the kept and open points of the bundle `asked.bundle`, with
    /// the same values, within a fourth of the tolerance of `asked.at`, except for those received
    /// from others.
    void hand_over(const asked_point& asked, std::span<const std::uint64_t> values,
                   std::vector<border_point>& known);
    /// Rule first: appends the open points that later bundles request, a piece in each call. Call
    /// it until it returns false.
    [[nodiscard]] bool finish(tile_result& out);

    /// Finishes the rule chain: links from joined components to the lowest point, by ascending
    /// numbers. Each number is that of a dropped point, which may also be in `dropped` of a tile,
    /// with an equivalent leader.
    [[nodiscard]] std::vector<border_point> joined();
    /// `link` with the lowest point of its joined component, for the next pass.
    [[nodiscard]] border_point handed_on(const border_point& link) const;
    /// Adds a link that another pass returned from `joined`.
    void join(const border_point& link);

    /// The final leader for a leader reported by a tile; with the rule first, `leader` itself.
    [[nodiscard]] std::uint64_t leader_of(std::uint64_t leader) const;
    /// Updates `longest` by the distance of a member to the lowest point of its whole component.
    void measure(const tile_member& member, longest_move& longest) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// The component of a point inside a tile.
struct chain_component {
    std::uint64_t lowest;  ///< its lowest point number
    point3 at;             ///< coordinates of that point
    bool elsewhere;        ///< some of its points are also in other tiles
};

inline void append_chain_point(const tile_point& p, const chain_component& c, tile_result& out) {
    if (p.role() != tile_role::halo) {
        if (p.id() != c.lowest) out.dropped.push_back({p.id(), c.lowest});
        if (c.elsewhere)
            out.members.push_back({p.at, c.lowest, c.at});
        else
            out.move.consider(p.at, c.at);
    }
    if (p.role() == tile_role::own) return;
    border_point link = border_point::make(p.id(), border_kind::link);
    link.at = p.at;
    link.leader = c.lowest;
    link.leader_at = c.at;
    out.border.push_back(link);
}

}  // namespace treeform::detail::weld
