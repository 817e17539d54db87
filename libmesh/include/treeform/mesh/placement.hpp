#pragma once
/// \file
/// Results of the placement functions (`slide`, `drop`, `mate`, `separate`, `turn`). Files as sets
/// of bodies for placements.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// The reason why a placement ended.
enum class placement_outcome : std::uint8_t {
    contact,             ///< stopped by a fixed mesh, or at the clearance from it
    bed,                 ///< stopped by the bed, or at the clearance above it
    unchanged,           ///< no motion is needed
    moved_apart,         ///< for `separate`: moved out of the fixed meshes
    nothing_met,         ///< no place: nothing is in the way, at least not within `max_travel`
    too_far,             ///< no place: the necessary motion is longer than `max_travel`
    starts_penetrating,  ///< no place: penetrates a fixed mesh at the start
    starts_too_near,     ///< no place: nearer than the clearance at the start
    starts_touching,     ///< no place: touches a fixed mesh at the start, and a clearance is given
    starts_below_bed,    ///< no place: below the bed at the start, and there are fixed meshes
    not_representable,   ///< no place in coordinates of the precision
    too_many_steps,      ///< for `turn`: undecided, since the mesh passes a fixed mesh too closely
    out_of_range,        ///< no place: coordinates overflow the precision
    cancelled            ///< stopped by `progress`; the rest is invalid
};
template <>
inline constexpr auto detail::names_of<placement_outcome> = std::array{"contact",
                                                                       "bed",
                                                                       "unchanged",
                                                                       "moved-apart",
                                                                       "nothing-met",
                                                                       "too-far",
                                                                       "starts-penetrating",
                                                                       "starts-too-near",
                                                                       "starts-touching",
                                                                       "starts-below-bed",
                                                                       "not-representable",
                                                                       "too-many-steps",
                                                                       "out-of-range",
                                                                       "cancelled"};

/// A pair of faces that meet, or are at the clearance, at the place.
struct placement_contact {
    point3 point{};
    point3 normal{};  ///< unit normal from the fixed to the moving mesh; 0 if there is none
    std::uint32_t moving = 0;                   ///< face of the moving mesh
    std::optional<std::uint32_t> fixed_face{};  ///< none for the bed
    std::size_t fixed = 0;                      ///< number of the fixed mesh
};

struct placement_statistics {
    unsigned backed_off = 0;  ///< number of steps back, since rounding made the mesh penetrate
    std::uint64_t fixed_culled = 0;   ///< fixed meshes skipped because of their box
    std::uint64_t pairs_tested = 0;   ///< pairs of faces tested in motion
    std::uint64_t steps = 0;          ///< of `turn`
    predicate_counters predicates{};  ///< used for these
};

struct body_set;

/// A mesh at its place: `write` refuses to round the points that were checked.
struct placed_mesh {
    treeform::mesh mesh{};  ///< empty if there is no place
    treeform::certificate certificate{};
    std::string reason{};  ///< why there is no place: `placement::message`

    /// \throws not_certified_error unless the certificate's status is ok; it says the reason
    [[nodiscard]] TREEFORM_API const treeform::mesh& value() const&;
    [[nodiscard]] TREEFORM_API treeform::mesh value() &&;
};

/// The result of a placement. "The place" is the new position of the moving mesh, or the present
/// one if it does not move.
struct placement {
    /// ok: the mesh has a place, and `points` were checked exactly. Otherwise `no_placement`,
    /// `out_of_range` or `cancelled`. It lists no faces.
    treeform::certificate certificate{};
    placement_outcome outcome = placement_outcome::unchanged;
    std::vector<point3> points{};  ///< [V] at the place, as they are to be written
    /// new = M * old: a translation; for `turn` and `mate_features` also a rotation. `points` are
    /// moved by it and rounded once, except for points that are set on the bed.
    transform<3> matrix{};
    point3 direction{};           ///< unit direction of the travel; 0 if there is none
    double travel = 0.0;          ///< distance moved; for `too_far` the distance needed
    double clearance = 0.0;       ///< the given clearance
    std::optional<double> bed{};  ///< least z allowed, rounded: the bed plus the clearance
    double below_bed = 0.0;       ///< how far the mesh was below `bed` at the start
    mesh_relation relation_at_start = mesh_relation::disjoint;  ///< exact
    mesh_relation relation = mesh_relation::disjoint;           ///< relation at the place
    /// The relation, at the place, of the moving mesh (`a`) to the fixed mesh that it penetrates,
    /// else to one that it touches, else to the nearest. None if all are too far away.
    std::optional<relation_result> nearest{};
    std::size_t nearest_fixed = 0;  ///< fixed mesh of `nearest`; the lowest if several qualify
    std::vector<placement_contact> contacts{};
    std::uint64_t contact_count = 0;     ///< number of all contacts, listed or not
    std::optional<double> max_travel{};  ///< the given limit
    /// For `separate`: the effort of its search. If `skipped_candidates` is not 0, there may be a
    /// shorter translation, or a place although none was found.
    search_effort effort{};
    double angle = 0.0;      ///< for `turn` and `mate_features`: angle of the rotation, in degrees
    double tolerance = 0.0;  ///< for `turn`: the gap, beyond the clearance, that counts as contact
    /// For `mate_features`: the distance of the moving feature's center from the fixed feature's
    /// center at the place, along the direction of the fixed feature. For planes, their distance.
    double offset = 0.0;
    placement_statistics statistics{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// The mesh that was placed, with `points`: `write("low.stl", low.moved(part))`.
    /// \throws std::invalid_argument if the numbers of points differ
    [[nodiscard]] TREEFORM_API placed_mesh moved(const mesh_ref& placed) const;
    /// The reason why there is no place: a clause about the moving mesh, without a full stop. Empty
    /// if there is a place. `names` has the names of the fixed meshes.
    [[nodiscard]] TREEFORM_API std::string message(std::span<const std::string> names = {}) const;
    /// The relation of the only body of `moving` to `fixed` at the place, in words: "touching
    /// bed.stl (1 pair of faces, the first 3 and 7)", "disjoint, 0.5 from bed.stl". Face numbers
    /// are numbers in the files.
    [[nodiscard]] TREEFORM_API std::string relation_in_words(const body_set& moving,
                                                             const body_set& fixed) const;

    /// The relation of each face to the other meshes at the place: [0][F] for `moving`, then [1 +
    /// i][F] for each of `fixed`; such a list may be empty if all its faces are disjoint. Faces of
    /// `contacts`, and those on the bed, count as closer than the clearance or, without one, as
    /// touching, even if rounding left a gap.
    ///
    /// \pre    this is a placement of `moving` among `fixed`
    /// \cost   O(P) for the P pairs of faces within the clearance of each other
    /// \same   on any number of threads
    [[nodiscard]] TREEFORM_API std::vector<std::vector<mesh_relation>> face_relations(
        const mesh_ref& moving, const mesh_refs& fixed) const;

    /// Gives the rows of the element "face" of `file` (for a cloud, "vertex") the property
    /// tf_class, and the colors red, green and blue: 0 and gray for disjoint, 1 and red for
    /// penetrating, 2 and yellow for touching, 3 and cyan for closer than the clearance. With
    /// `keep_colors`, colors that the file has are not changed.
    ///
    /// Small disjoint faces near the others get a tint of their color, so that contacts of a few
    /// small faces can be seen. These are faces with edges of at most twice `halo`, a length, and
    /// all corners within `halo` of a face that is not disjoint. Their tf_class stays 0.
    ///
    /// `relations` has one entry for each triangle of `file.mesh`; for a cloud, for each point. A
    /// polygon gets the worst relation of its triangles; see `mesh_file::split_polygons`.
    ///
    /// \throws std::invalid_argument unless `relations` has this size
    /// \cost   O(F)
    TREEFORM_API static void color(mesh_file& file, std::span<const mesh_relation> relations,
                                   double halo = 0.0, bool keep_colors = false);
};

/// A file with its names.
struct body_file {
    mesh_file content{};
    std::string label{};         ///< name in messages: its path
    std::string name{};          ///< name of its part in a scene (`scene_of`)
    bool cloud = false;          ///< whether the file has no faces
    std::size_t non_finite = 0;  ///< number of triangles, or points of a cloud, that are not finite
    std::optional<box3> box{};   ///< box of its bodies; none without a finite face or point
};

/// Files and their bodies, ready for placement. A body is the whole mesh of a file, a part of it,
/// or a cloud.
struct TREEFORM_API body_set {
    std::deque<body_file> files{};  ///< references stay valid when files are added
    /// [B] The mesh of each body: the finite triangles of the file, with equal corners joined, and
    /// only the points that they use. For a cloud, its finite points.
    std::vector<prepared_mesh> shapes{};

    /// Adds a file as one body, and returns the file. A file without a finite face or point has no
    /// body.
    ///
    /// \cost O(V + F)
    body_file& add(mesh_file file, std::string label = {}, std::string name = {});
    /// The same with one body for each part of the file (`file_parts`), if it has several.
    body_file& add_parts(mesh_file file, std::string label = {}, std::string name = {});
    /// The same with one body for each named part (OBJ o and g, nodes of a scene), or one body if
    /// there are no names. Unlike in `add_parts`, parts with common points are separate bodies, so
    /// that they may touch.
    body_file& add_named_parts(mesh_file file, std::string label = {}, std::string name = {});

    [[nodiscard]] const body_file& file_of(std::size_t body) const;
    [[nodiscard]] std::size_t file_number(std::size_t body) const;
    /// The name of a part; empty if the file is one body.
    [[nodiscard]] const std::string& part_name(std::size_t body) const;
    /// The number of a body's face `f` among the triangles (for a cloud, the points) of its file's
    /// mesh.
    [[nodiscard]] std::uint32_t triangle(std::size_t body, std::uint32_t f) const;
    /// The number of a body's face `f` among the faces of its file.
    [[nodiscard]] std::uint32_t face_in_file(std::size_t body, std::uint32_t f) const;
    /// For messages: the labels of the file and the part.
    [[nodiscard]] std::string label(std::size_t body) const;
    [[nodiscard]] std::vector<std::string> labels() const;  ///< [B] for `placement::message`

    /// Moves the points of a body's file: points of the body to `placed` [V of its shape], all
    /// others by `matrix`, rounded to `written_as`.
    void move_in_file(std::size_t body, points_view placed, const transform<3>& matrix,
                      precision written_as);

    /// The relations of all triangles of the files (for clouds, of all their points), for
    /// `placement::color`. `relations` [B] has, for each body, the relations of its faces, or an
    /// empty list. If `clouds` is false, clouds are omitted, as in `scene_of`.
    ///
    /// \cost O(V + F)
    [[nodiscard]] std::vector<mesh_relation> relations_in_files(
        std::span<const std::vector<mesh_relation>> relations, bool clouds) const;
    /// [V of its file] The distances of a body's points in the numbering of the file; NaN for other
    /// points. `distances` is [V of its shape].
    [[nodiscard]] std::vector<double> distances_in_file(std::size_t body,
                                                        std::span<const double> distances) const;

  private:
    struct body {
        std::size_t file = 0;
        std::string part{};
        std::vector<std::uint32_t> triangle_of_face{};  ///< [F]; empty: the same number
    };
    std::vector<body> bodies_{};  ///< [B]
};

}  // namespace treeform
