#pragma once
/// \file
/// Clouds larger than memory, welded tile by tile with the groups that `group_points` finds.
///
/// A tile gets the points of its part of space, its own, and those of its halo: all others within
/// the tolerance of that part. It sees every neighbor of its own points, but not all of those of
/// its halo; what it says for certain is true of the whole cloud, and what hangs on its halo is
/// left to one pass over the borders of all tiles. There are no rounds, and tiles need not know of
/// each other: they may be done in any order, at any time, by any process.
///
/// Rule `first`. A tile goes through its points in their order and calls a point
/// - dropped when an earlier kept one is within the tolerance,
/// - kept when it is the tile's own and all earlier neighbors are dropped,
/// - open else.
/// By induction over the order, a point that is called kept or dropped is so in the whole cloud:
/// the neighbors of an own point are all here, and a kept one within the tolerance suffices to drop
/// any. A dropped own point leans on the nearest kept one; should an open one be nearer, it may
/// change sides. To the border pass go own points that are open or lean so, and kept ones that are
/// in the halo of another tile. It goes through these in their order and drops an open point when
/// an earlier kept one of them is within the tolerance, keeps it else. This is the rule's answer:
/// an earlier neighbor that is kept in the end was not called kept here, or it would have dropped
/// the point, nor dropped. So it is open in its own tile, or kept there and in our halo; both ways
/// it is in the border pass. For the same reason the leader of a provisional point is the one it
/// leans on, or one that the border pass has seen before it.
///
/// Open points are not kept apart from open ones within a fourth of the tolerance of them: one
/// stands for all, with a reach as much longer. More points may be called open then, none wrongly
/// kept or dropped, and what a tile remembers is bounded by its volume, not by its points.
///
/// Conditions. Points whose values do not agree are no neighbors, whatever is said above; one open
/// point stands for others of the same values only.
///
/// Rule `chain`. The points that are linked inside a tile are one component there. A component of
/// the cloud is one of tiles' components that share points, and shared are points of a tile that
/// are in the halo of another: the border pass joins what they name. How far its points are from
/// the lowest is known to no tile before; a tile names the points of components that may be larger,
/// each with the lowest it knows of, and they are measured when all are brought together.
///
/// The border pass may be taken in parts of space: one for some tiles each, and then one for what
/// these passes leave. A point is outer to a pass when it is in a tile that is not among its own,
/// or in the halo of one. With the rule first, a pass is to its tiles' points what a tile is to its
/// own, but it knows nothing of what is beyond its tiles: so it calls an outer point that no kept
/// one drops open, lets an outer one that is dropped lean, and hands on both, what is open because
/// of them, what may change sides to such, and outer kept ones. A pass with no outer points leaves
/// none. With the rule chain, a pass hands on the links of outer points, with the lowest of what it
/// has joined.
///
/// With the rule first, the border pass may have much to do: where points come row by row, what is
/// open along a border may leave all later points of the rows open. So that memory need not hold
/// them all, it may be taken in runs. A run has some slices of the numbers, which follow each
/// other, and a `border_weld` of its own. It has to know of those points of earlier runs that
/// decide the fate of its own. These are asked for: when an own point is open or leans, a tile
/// marks the open points near it that are of another slice with the bundle of its slice. What the
/// border pass has made of a marked point is handed over to each bundle that marked it, and so is
/// what it has made of those the point stands for. That is all a run needs: an earlier neighbor
/// that is kept in the end is open in the point's own tile, or dropped the point there. A run that
/// has a part of a bundle takes, of what the bundle gets, what is near its own points. A pass of
/// some tiles asks the next one likewise, for its own open points. It hands on what a tile asks for
/// when that is outer: a place within a fourth of the tolerance of a point of another tile is.

#include <libmesh/weld/agreement.hpp>
#include <libmesh/weld/number_slices.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// What a point is to a tile.
enum class tile_role : std::uint8_t {
    own,     ///< in its part of space, and in no other tile
    shared,  ///< in its part of space, and in the halo of others
    halo
};

/// A point as a tile gets it; its number, below 2^62, is that in the whole cloud.
struct tile_point {
    std::uint64_t tag = 0;  ///< number * 4 + role
    point3 at{};

    [[nodiscard]] static tile_point make(std::uint64_t id, tile_role role, const point3& at) {
        return {id << 2 | static_cast<std::uint64_t>(role), at};
    }
    [[nodiscard]] std::uint64_t id() const { return tag >> 2; }
    [[nodiscard]] tile_role role() const { return static_cast<tile_role>(tag & 3); }
};

/// A point that is dropped, and the one it belongs to.
struct tile_drop {
    std::uint64_t id = 0;
    std::uint64_t leader = 0;

    friend bool operator==(const tile_drop&, const tile_drop&) = default;
};

enum class border_kind : std::uint8_t {
    open,         ///< kept or dropped: the border pass says
    provisional,  ///< dropped, for `leader` or for a nearer one
    kept,         ///< for others to lean on
    link          ///< rule chain: a shared point and the lowest of its component in one tile
};

/// What one tile leaves to the border pass about a point.
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

/// A place near which the fate of points of a bundle may decide that of points in later slices.
struct asked_point {
    std::uint64_t bundle = 0;
    point3 at{};
    std::uint64_t asked_by = 0;  ///< a set of bundles
};

/// A point of a component that may be in several tiles, with the rule chain.
struct tile_member {
    point3 at{};
    std::uint64_t lowest = 0;  ///< that the tile knows of the component
    point3 lowest_at{};
};

/// The longest way from a dropped point to its leader.
class TREEFORM_API longest_move {
  public:
    /// Takes the one given when it is longer, decided exactly.
    void consider(const point3& from, const point3& to);
    void consider(const longest_move& other) { consider(other.from_, other.to_); }
    [[nodiscard]] const point3& from() const { return from_; }
    [[nodiscard]] const point3& to() const { return to_; }
    /// The least double that is no less than the length.
    [[nodiscard]] double length() const;

  private:
    point3 from_{};
    point3 to_{};
};

/// What a tile says of its own points.
struct tile_result {
    std::vector<tile_drop> dropped{};    ///< by ascending numbers; for good with the rule first
    std::vector<border_point> border{};  ///< by ascending numbers
    std::vector<std::uint64_t> border_values{};  ///< of these with the rule first, as for `add`
    std::vector<asked_point> asked{};            ///< with the rule first, by ascending bundles
    std::vector<std::uint64_t> asked_values{};   ///< of these
    std::vector<tile_member> members{};          ///< with the rule chain
    /// Of `dropped`, with the rule chain except for the `members`.
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

    /// Memory for that many points without moving those that are there. No promise.
    void reserve(std::size_t points);

    /// Takes the next points, whose numbers ascend over all calls, and appends what they lead to.
    /// With the rule first only points that are kept or open take memory from then on, some 60
    /// bytes each; with the rule chain all do, some 100 each, and `crowded_chain` is for more.
    ///
    /// \pre all coordinates are finite, and `values` are those of the agreement, point by point
    /// \cost O(1) a point with the rule first, expected, where those kept or open are not crowded
    void add(std::span<const tile_point> points, tile_result& out,
             std::span<const std::uint64_t> values = {});

    /// The end of the tile, a piece of the result at a time: call it until it returns false.
    /// \throws std::invalid_argument for the rule chain and more than 2^32 - 2 points
    /// \cost as `group_points` with the rule chain; with the rule first, O(1) an open point that is
    /// asked for and bundle
    [[nodiscard]] bool finish(tile_result& out);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// How far from a point an open one may be that matters to it. Where 1.26 tolerances leave the
/// doubles, open points stand for equal ones only.
[[nodiscard]] inline double reach_of_open(double tolerance) {
    return tolerance < 0x1p1000 ? 1.26 * tolerance : tolerance;
}

/// A border pass: what the `border` of tiles leads to.
class TREEFORM_API border_weld {
  public:
    /// \throws std::invalid_argument for a tolerance that is negative or not finite
    explicit border_weld(double tolerance, agreement agree = {}, const number_slices& slices = {});
    ~border_weld();
    border_weld(border_weld&&) noexcept;
    border_weld& operator=(border_weld&&) noexcept;

    /// Takes the next point, whose numbers ascend over all calls and tiles (those of links may be
    /// equal), and appends what it leads to: with the rule first a drop, or what the next pass has
    /// to know. Only kept points, open ones, and linked components take memory, some 60 bytes each,
    /// and 100 for a component.
    ///
    /// \pre `outer` is true if the point is, and `values` are those of the agreement
    void add(const border_point& p, std::span<const std::uint64_t> values, bool outer,
             tile_result& out);

    /// Rule first: takes what has been handed over by earlier runs, before any of its own, and each
    /// point once. Of an open one several runs may know for whom it stands (`leader`, a set of
    /// bundles): all of them. What is farther than `reach_of_open` from all of its own is not
    /// needed.
    void receive(const border_point& p, std::span<const std::uint64_t> values);
    /// Rule first: appends to `known` what is kept or open in a bundle within a fourth of the
    /// tolerance of that place, of the same values, except for what others have handed over.
    void hand_over(const asked_point& asked, std::span<const std::uint64_t> values,
                   std::vector<border_point>& known);
    /// Rule first: appends the open points that later bundles ask for, a piece at a time: call it
    /// until it returns false.
    [[nodiscard]] bool finish(tile_result& out);

    /// The end for the rule chain: links from what has been joined to the lowest, by ascending
    /// numbers. Such a number is that of a dropped point, which may be in a tile's `dropped` as
    /// well, with a leader that comes to the same.
    [[nodiscard]] std::vector<border_point> joined();
    /// The link with the lowest of what has been joined, as it is handed on.
    [[nodiscard]] border_point handed_on(const border_point& link) const;
    /// Takes what another pass has `joined`.
    void join(const border_point& link);

    /// The kept point that the leader named by a tile belongs to; itself with the rule first.
    [[nodiscard]] std::uint64_t leader_of(std::uint64_t leader) const;
    /// Considers the way from a member to the lowest point of its whole component.
    void measure(const tile_member& member, longest_move& longest) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::detail::weld
