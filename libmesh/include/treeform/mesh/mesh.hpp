#pragma once
/// \file
/// Points, triangle meshes, views and boxes; prepared meshes, which cache the indexes of queries;
/// and the parameter types `mesh_ref` and `mesh_refs`. In all headers, [V] and [F] mean one element
/// for each point or face; the lowest of several points or faces has the lowest number.

#include <treeform/tree/detail/export.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifdef __clang__
#define TREEFORM_LIFETIMEBOUND [[clang::lifetimebound]]
#else
#define TREEFORM_LIFETIMEBOUND
#endif

namespace treeform {

/// A point or vector of the plane.
struct point2 {
    double x = 0.0;
    double y = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : y; }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : y; }
    friend constexpr bool operator==(const point2&, const point2&) = default;
};

/// A point or vector of space. Equality is that of doubles: -0 equals +0.
struct point3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    [[nodiscard]] constexpr double operator[](std::size_t axis) const {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    operator std::array<double, 3>() const { return {x, y, z}; }  // NOLINT: for rays and boxes
    friend constexpr bool operator==(const point3&, const point3&) = default;
};

using points_view = std::span<const point3>;  ///< [V]

/// The corners of a triangle: numbers of points, counter-clockwise seen from outside.
using face = std::array<std::uint32_t, 3>;

namespace detail {
template <class Row, class... Number, class Rows>
[[nodiscard]] std::span<const Row> as_rows(Rows&& rows) {
    using given = std::ranges::range_value_t<Rows>;
    static_assert(std::ranges::contiguous_range<Rows> && std::ranges::borrowed_range<Rows>,
                  "the array must be contiguous, and must not be a temporary");
    static_assert((std::same_as<given, Row> || ... ||
                   (std::same_as<given, Number> || std::same_as<given, std::array<Number, 3>>)),
                  "points are doubles; corners of faces are 32-bit integers: convert others first");
    constexpr std::size_t per_row = sizeof(Row) / sizeof(given);
    const std::size_t count = std::ranges::size(rows);
    if (count % per_row != 0)
        throw std::invalid_argument("treeform::mesh_view::of: " + std::to_string(count) +
                                    " numbers are not rows of three");
    return {reinterpret_cast<const Row*>(std::ranges::data(rows)), count / per_row};
}
}  // namespace detail

/// A mesh that refers to the caller's arrays. Every corner is less than `points.size()`.
/// Points without faces are a point cloud. It can be measured, moved, welded and aligned like a
/// mesh. Queries take each point as a degenerate face, so face numbers are point numbers. A cloud
/// bounds no solid: it penetrates a mesh if a point is strictly inside the solid that the mesh
/// bounds, and touches it if a point is on a face.
struct mesh_view {
    std::span<const point3> points{};  ///< [V]
    std::span<const face> faces{};     ///< [F]

    /// Refers to arrays of other types with the same layout: x, y, z, x, y, z, ... as doubles, and
    /// three point numbers for each face, as 32-bit integers; or each as `std::array` of three.
    /// \throws std::invalid_argument unless the counts of numbers are multiples of 3
    template <class Points, class Faces = std::span<const face>>
    [[nodiscard]] static mesh_view of(Points&& points, Faces&& faces = {}) {
        return {detail::as_rows<point3, double>(std::forward<Points>(points)),
                detail::as_rows<face, std::uint32_t, std::int32_t>(std::forward<Faces>(faces))};
    }
};

/// The floating-point format of coordinates.
enum class precision : std::uint8_t {
    float32,  ///< 32-bit floats, as in binary STL
    float64   ///< doubles
};

/// Which corners of faces are the same vertex. This decides whether a mesh is closed, and which of
/// its faces are neighbors.
enum class vertex_identity : std::uint8_t {
    by_coordinates,  ///< corners with equal coordinates; suits files that repeat points (STL)
    by_index         ///< corners with the same point number
};

/// A triangle mesh or point cloud that owns its arrays; otherwise like `mesh_view`.
struct mesh {
    std::vector<point3> points{};  ///< [V]
    std::vector<face> faces{};     ///< [F]

    operator mesh_view() const TREEFORM_LIFETIMEBOUND { return {points, faces}; }  // NOLINT
    friend bool operator==(const mesh&, const mesh&) = default;
};

/// A closed axis-aligned box.
struct box3 {
    point3 min;
    point3 max;

    /// Length of the diagonal, rounded; the largest double if it overflows.
    [[nodiscard]] TREEFORM_API double diagonal() const;
    /// The box as a solid of 8 points and 12 faces.
    [[nodiscard]] TREEFORM_API treeform::mesh mesh() const;
    friend bool operator==(const box3&, const box3&) = default;
};

/// The smallest box around all finite points; empty if there is no finite point.
/// \cost O(V) time
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::optional<box3> bounding_box(points_view points);

struct usable_mesh;

namespace detail::base {
class prepared_slots;
class prepared_ref;
class prepared_refs;
}  // namespace detail::base

/// A mesh for many queries. Every function that takes a mesh also takes a prepared mesh, with the
/// same results. The first query that needs an index (a tree over the faces, triangles in the order
/// of that tree, joined corners, whether the mesh is closed) builds it; later queries reuse it.
///
/// Queries are const and may run on several threads at once. One thread builds an index; others
/// that need it at the same time help. A build that is cancelled or throws leaves no partial index.
/// Move-only. A moved-from object may only be destroyed or assigned to.
class TREEFORM_API prepared_mesh {
  public:
    /// No faces.
    prepared_mesh();
    /// Owns the arrays.
    explicit prepared_mesh(mesh&& owned);
    explicit prepared_mesh(usable_mesh&& owned);
    explicit prepared_mesh(const mesh&) = delete;  // std::move it, or `borrow` it
    explicit prepared_mesh(const usable_mesh&) = delete;
    /// Refers to the caller's arrays, which must stay unchanged during the lifetime of the result.
    [[nodiscard]] static prepared_mesh borrow(mesh_view view);
    template <std::same_as<mesh> Temporary>
    static prepared_mesh borrow(Temporary&&) = delete;  // it would dangle: let this own it

    ~prepared_mesh();
    prepared_mesh(prepared_mesh&&) noexcept;
    prepared_mesh& operator=(prepared_mesh&&) noexcept;

    /// The mesh that queries see: a cloud has a degenerate face for each point.
    [[nodiscard]] mesh_view indexed_view() const { return is_cloud() ? view_of_cloud() : view_; }
    operator mesh_view() const { return view_; }            // NOLINT: as given
    [[nodiscard]] bool is_cloud() const { return cloud_; }  ///< points without faces
    /// Number of indexes built so far. It does not grow when a query reuses its indexes.
    [[nodiscard]] std::uint64_t indexes_built() const;

  private:
    friend class detail::base::prepared_slots;
    friend class mesh_ref;
    struct state;
    [[nodiscard]] mesh_view view_of_cloud() const;

    mesh_view view_{};  // as given
    bool cloud_ = false;
    std::shared_ptr<state> state_;
};

/// Refers to a mesh, a prepared mesh, a view, a result of `as_mesh`, or points and faces. For
/// parameters only; arguments convert implicitly. A temporary mesh lives until the call returns, so
/// `unite(as_mesh(f), as_mesh(g))` is safe.
/// A prepared mesh keeps the indexes that a function builds; for any other mesh they are discarded
/// after the call.
class mesh_ref {
  public:
    mesh_ref(const mesh& mesh TREEFORM_LIFETIMEBOUND) : view_(mesh) {}  // NOLINT: all are implicit
    mesh_ref(mesh_view mesh) : view_(mesh) {}                           // NOLINT
    mesh_ref(points_view points, std::span<const face> faces) : view_{points, faces} {}
    /// A point cloud: no faces.
    template <std::ranges::contiguous_range Points>
    requires std::same_as<std::ranges::range_value_t<const Points&>, point3> mesh_ref(
        const Points& points TREEFORM_LIFETIMEBOUND)
        : view_{points, {}} {}                                  // NOLINT
    mesh_ref(const prepared_mesh& mesh TREEFORM_LIFETIMEBOUND)  // NOLINT
        : view_(mesh.view_), prepared_(&mesh) {}
    TREEFORM_API mesh_ref(const usable_mesh& mesh TREEFORM_LIFETIMEBOUND);  // NOLINT

    /// The mesh as given: a cloud has no faces.
    [[nodiscard]] mesh_view view() const { return view_; }
    [[nodiscard]] bool is_cloud() const { return view_.faces.empty() && !view_.points.empty(); }
    /// Null for a mesh that is not prepared, and for a cloud.
    [[nodiscard]] const prepared_mesh* prepared() const { return is_cloud() ? nullptr : prepared_; }

  private:
    friend class detail::base::prepared_ref;
    friend class detail::base::prepared_refs;

    mesh_view view_;
    const prepared_mesh* prepared_ = nullptr;
};

/// Refers to several meshes of any type: `{a, b}`, a vector or span of meshes, prepared meshes or
/// views, or a single mesh.
class mesh_refs {
  public:
    mesh_refs() = default;
    mesh_refs(std::initializer_list<mesh_ref> meshes TREEFORM_LIFETIMEBOUND)  // NOLINT
        : refs_(meshes) {}
    template <class One>
    requires std::convertible_to<const One&, mesh_ref> mesh_refs(
        const One& mesh TREEFORM_LIFETIMEBOUND)
        : refs_{mesh_ref(mesh)} {}  // NOLINT
    template <std::ranges::sized_range Many>
    requires std::convertible_to<std::ranges::range_reference_t<const Many&>, mesh_ref> &&
        (!std::convertible_to<const Many&, mesh_ref>)
            mesh_refs(const Many& meshes TREEFORM_LIFETIMEBOUND)  // NOLINT
        : refs_(std::ranges::begin(meshes), std::ranges::end(meshes)) {}

    [[nodiscard]] std::span<const mesh_ref> all() const { return refs_; }
    [[nodiscard]] std::size_t size() const { return refs_.size(); }
    [[nodiscard]] bool empty() const { return refs_.empty(); }
    [[nodiscard]] const mesh_ref& operator[](std::size_t i) const { return refs_[i]; }
    [[nodiscard]] auto begin() const { return refs_.begin(); }
    [[nodiscard]] auto end() const { return refs_.end(); }

  private:
    std::vector<mesh_ref> refs_{};
};

}  // namespace treeform
