#pragma once
/// \file
/// Arguments and results of the placement functions (`slide`, `drop`, `mate`, `separate`).

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

/// Why a placement ended where it did.
enum class placement_end : std::uint8_t {
    contact,             ///< stopped by a fixed mesh, or at the clearance from it
    bed,                 ///< stopped by the bed, or at the clearance above it
    unchanged,           ///< it need not move
    moved_apart,         ///< for `separate`: it was moved out of the fixed meshes
    nothing_met,         ///< no place: it meets nothing, or nothing within `max_travel`
    too_far,             ///< no place: the place is further away than `max_travel`
    starts_penetrating,  ///< no place: it penetrates a fixed mesh at the start
    starts_too_near,     ///< no place: it is nearer than the clearance at the start
    starts_touching,     ///< no place: it touches at the start, and a clearance is given
    starts_below_bed,    ///< no place: it is below the bed at the start, and there are fixed meshes
    not_representable,   ///< no place in coordinates of the precision
    too_many_steps,      ///< undecided, for `turn`: it passes a fixed mesh too closely
    out_of_range,        ///< no place: coordinates overflow the precision
    cancelled            ///< stopped by `progress`; the rest is invalid
};

/// A pair of faces that meet, or are at the clearance, at the place.
struct placement_contact {
    point3 point{};
    point3 normal{};  ///< unit normal from the fixed to the moving mesh; 0 if there is none
    std::uint32_t moving = 0;                   ///< face of the moving mesh
    std::optional<std::uint32_t> fixed_face{};  ///< none for the bed
    std::size_t fixed = 0;                      ///< number of the fixed mesh
};

struct placement_statistics {
    unsigned backed_off = 0;          ///< steps back, since rounding made the mesh penetrate
    std::uint64_t fixed_culled = 0;   ///< fixed meshes skipped because of their box
    std::uint64_t pairs_tested = 0;   ///< pairs of faces, in motion
    std::uint64_t steps = 0;          ///< of `turn`
    predicate_counters predicates{};  ///< used for these
};

struct body_set;

/// The result of a placement. "The place" is the new position, or the present one if the mesh does
/// not move.
struct placement {
    /// ok: the mesh has a place, and `points` were checked exactly. Otherwise `no_placement`,
    /// `not_certified` (not_representable), `out_of_range` or `cancelled`. It lists no faces.
    treeform::certificate certificate{};
    placement_end end = placement_end::unchanged;
    std::vector<point3> points{};  ///< [V] at the place, as they are to be written
    /// new = M * old: a translation; of `turn` and `mate_features` a turn, too. `points` are moved
    /// by it and rounded once, except for those that are set on the bed.
    transform<3> matrix{};
    point3 direction{};           ///< unit direction of the travel; 0 if there is none
    double travel = 0.0;          ///< a length; for `too_far` the length needed
    double clearance = 0.0;       ///< the given clearance
    std::optional<double> bed{};  ///< least z allowed, rounded: the bed plus the clearance
    double below_bed = 0.0;       ///< how far the mesh was below `bed` at the start
    mesh_relation at_start = mesh_relation::separate;  ///< exact
    mesh_relation at_place = mesh_relation::separate;  ///< the same at the place
    /// How the mesh, as `a`, lies at the place to the fixed mesh that it penetrates, else to one
    /// that it touches, else to the nearest. None if all are too far away.
    std::optional<mesh_measure> nearest{};
    std::size_t nearest_fixed = 0;  ///< number of that mesh; the lowest if several qualify
    std::vector<placement_contact> contacts{};
    std::uint64_t contact_count = 0;     ///< number of all contacts, listed or not
    std::optional<double> max_travel{};  ///< the given limit
    /// For `separate`: the effort of its search. If `cut` is not 0, a shorter translation may
    /// exist; or, if no place was found, a place.
    search_effort effort{};
    double angle = 0.0;      ///< of `turn` and `mate_features`: in degrees, of the turn
    double tolerance = 0.0;  ///< of `turn`: the gap, beyond the clearance, that counts as contact
    /// Of `mate_features`: how far the center of the moving feature ended from that of the fixed
    /// one, along the direction of the fixed one. Of planes: their distance.
    double offset = 0.0;
    placement_statistics statistics{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// Why there is no place: a clause about the moving mesh, without a full stop. Empty if there
    /// is a place. `names` are those of the fixed meshes.
    [[nodiscard]] TREEFORM_API std::string message(std::span<const std::string> names = {}) const;
    /// The relation of the only body of `moving` to `fixed` at the place, in words: "touching
    /// bed.stl (1 pair of faces, the first 3 and 7)", "separate, 0.5 from bed.stl". Face numbers
    /// are those of the files.
    [[nodiscard]] TREEFORM_API std::string relation_in_words(const body_set& moving,
                                                             const body_set& fixed) const;

    /// How each face lies to the other meshes at the place: [0][F] of `moving`, then [1 + i][F] of
    /// each of `fixed`, empty if all are separate. Faces of `contacts`, and those on the bed, count
    /// as closer than the clearance or, without one, as touching, even if rounding left a gap.
    ///
    /// \pre    this is a placement of `moving` among `fixed`
    /// \cost   O(P) for the P pairs of faces within the clearance of each other
    /// \same   on any number of threads
    [[nodiscard]] TREEFORM_API std::vector<std::vector<mesh_relation>> face_relations(
        const mesh_ref& moving, const mesh_refs& fixed) const;

    /// Gives the rows of the element "face" of `file` (of a cloud, "vertex") the property tf_class,
    /// and the colors red, green and blue: 0 and gray for separate, 1 and red for penetrating, 2
    /// and yellow for touching, 3 and cyan for closer than the clearance. `keep_colors` leaves
    /// colors that the file has.
    ///
    /// Small faces around these have tints of them, so that contacts of a few small faces can be
    /// seen: faces with edges of at most twice `halo`, a length, and all corners within it of a
    /// face that is not separate. Their own number stays 0.
    ///
    /// `relations` has one entry for each triangle of `file.mesh`; for a cloud, for each point. A
    /// polygon has the gravest of its triangles; see `mesh_file::split_polygons`.
    ///
    /// \throws std::invalid_argument for another number of relations
    /// \cost   O(F)
    TREEFORM_API static void color(mesh_file& file, std::span<const mesh_relation> relations,
                                   double halo = 0.0, bool keep_colors = false);
};

/// A file with its names.
struct body_file {
    mesh_file content{};
    std::string label{};         ///< name in messages: its path
    std::string name{};          ///< name of its faces in a scene (`scene_of`)
    bool cloud = false;          ///< it has no faces
    std::size_t non_finite = 0;  ///< triangles, or points of a cloud, that are not finite
    std::optional<box3> box{};   ///< box of its bodies; none without a finite face or point
};

/// Files and their bodies, ready for placement. A body is the whole mesh of a file, a part of it,
/// or a cloud.
struct TREEFORM_API body_set {
    std::deque<body_file> files{};  ///< references stay valid when files are added
    /// [B] The mesh of each body: the finite triangles of the file, with equal corners joined, and
    /// only the points that they use. For a cloud, its finite points.
    std::vector<prepared_mesh> shapes{};

    /// Adds a file as one body, and returns it. Without a finite face or point it has no body.
    ///
    /// \cost O(V + F)
    body_file& add(mesh_file file, std::string label = {}, std::string name = {});
    /// The same with a body for each part of the file (as `split_parts` has them) where it has
    /// several.
    body_file& add_parts(mesh_file file, std::string label = {}, std::string name = {});
    /// The same with a body for each named part (OBJ o and g, nodes of a scene), or one body
    /// without names. Unlike in `add_parts`, parts with points in common are separate bodies, so
    /// that they may touch.
    body_file& add_named_parts(mesh_file file, std::string label = {}, std::string name = {});

    [[nodiscard]] const body_file& file_of(std::size_t body) const;
    [[nodiscard]] std::size_t file_number(std::size_t body) const;
    /// The name of a part; empty if the file is one body.
    [[nodiscard]] const std::string& part_name(std::size_t body) const;
    /// The triangle in its file's mesh (the point of a cloud) of a body's face `f`.
    [[nodiscard]] std::uint32_t triangle(std::size_t body, std::uint32_t f) const;
    /// The number of a body's face `f` in its file.
    [[nodiscard]] std::uint32_t stored_face(std::size_t body, std::uint32_t f) const;
    /// For messages: the file, and the part.
    [[nodiscard]] std::string label(std::size_t body) const;
    [[nodiscard]] std::vector<std::string> labels() const;  ///< [B] for `placement::message`

    /// Moves the points of a body's file: those of the body to `placed` (in the numbering of its
    /// shape), all others by `matrix`, rounded to float32 if `written_as` says so.
    void put_back(std::size_t body, points_view placed, const transform<3>& matrix,
                  precision written_as);

    /// The relations of all triangles of the files (of clouds, of all their points), for
    /// `placement::color`; `relations` [B] are those of the faces of each body, or empty. Without
    /// `clouds` these are omitted, as in `scene_of`.
    ///
    /// \cost O(V + F)
    [[nodiscard]] std::vector<mesh_relation> relations_in_files(
        std::span<const std::vector<mesh_relation>> relations, bool clouds) const;
    /// [V of its file] The distances of a body's points, `distances` by points of its shape; NaN
    /// for points that are not the body's.
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

/// "separate", "closer-than-clearance".
[[nodiscard]] TREEFORM_API const char* name_of(mesh_relation how);

}  // namespace treeform
