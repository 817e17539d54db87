#pragma once
/// \file
/// What placement verbs take and return.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// How a mesh lies to all that is fixed. Without a clearance the last two do not occur.
enum class standing : std::uint8_t {
    separate,
    touching,
    penetrating,
    closer_than_clearance,
    clear  ///< separate, by the clearance or more
};

/// What has ended a placement.
enum class placement_end : std::uint8_t {
    contact,             ///< something fixed, or the clearance from it
    bed,                 ///< the bed, or the clearance over it
    stays,               ///< nothing: it may be where it is
    moved_apart,         ///< of `separate`: it is out of what was in its way
    nothing_met,         ///< no place: nothing is in the way, or within the largest travel
    too_far,             ///< no place: it is further away than the largest travel
    starts_penetrating,  ///< no place: it penetrates something where it is
    starts_too_near,     ///< no place: it is nearer than the clearance to something where it is
    starts_touching,     ///< no place: it touches something where it is, and a clearance is asked
    starts_below_bed,    ///< no place: it would have to go up to the bed, past what is fixed
    no_coordinates,      ///< no place in coordinates that can be written
    out_of_range,        ///< no place: coordinates are beyond the range of the numbers asked for
    cancelled            ///< `progress` said stop; the rest means nothing
};

/// A pair of faces that meet at the place, or keep the clearance there.
struct placement_contact {
    point3 point{};
    point3 normal{};  ///< of length 1, from what is fixed to what moves; 0 where there is none
    std::uint32_t moving = 0;                   ///< face of the mesh that moves
    std::optional<std::uint32_t> fixed_face{};  ///< none: it is the bed
    std::size_t fixed = 0;                      ///< number of the fixed mesh
};

/// The fixed mesh that matters most to another one: one that it penetrates, else one that it
/// touches, else the nearest.
struct nearest_fixed {
    std::size_t fixed = 0;  ///< its number; of several the lowest
    mesh_measure how{};     ///< `a` is the mesh that moves
};

struct placement_statistics {
    unsigned backed_off = 0;          ///< steps taken back from what rounding made penetrate
    std::uint64_t fixed_culled = 0;   ///< fixed meshes whose box told that they cannot matter
    std::uint64_t pairs_tested = 0;   ///< of faces in motion
    predicate_counters predicates{};  ///< that these took
};

/// "At the place" is where the mesh goes, or where it is if it goes nowhere.
struct placement {
    /// ok: the mesh has a place; `points` were looked at there, exactly, as they are. Else it is
    /// `no_place`, `not_certified` (no_coordinates), `out_of_range` or `cancelled`.
    treeform::status status = treeform::status::ok;
    placement_end end = placement_end::stays;
    std::vector<point3> points{};  ///< [V] at the place, as they are to be written
    /// new = M * old: a translation. `points` are that, rounded once, except for what is put on the
    /// bed.
    transform<3> matrix{};
    point3 direction{};           ///< of the travel, of length 1; 0 when there is none
    double travel = 0.0;          ///< a length; of `too_far` the one that it would take
    double clearance = 0.0;       ///< that was asked for
    std::optional<double> bed{};  ///< z of what it may rest on, as written; with the clearance
    double below_bed = 0.0;       ///< how far it reached below that at the start
    bool on_bed = false;          ///< it was the bed that stopped it
    standing at_start = standing::separate;
    standing at_place = standing::separate;
    std::optional<nearest_fixed> nearest{};  ///< at the place; none too far away to matter
    std::vector<placement_contact> contacts{};
    std::uint64_t contact_count = 0;                               ///< of all, listed or not
    std::optional<double> max_travel{};                            ///< that was allowed
    treeform::precision precision = treeform::precision::float64;  ///< of the points
    placement_statistics statistics{};

    explicit operator bool() const { return status == treeform::status::ok; }
    /// Why there is no place: half a sentence about the mesh that moves, without a stop at its end.
    /// `names` are those of the fixed meshes. Empty when there is one.
    [[nodiscard]] TREEFORM_API std::string message(std::span<const std::string> names = {}) const;
};

struct measure_among_options {
    double clearance = 0.0;    ///< distances below it are `closer_than_clearance`
    std::size_t limit = 1000;  ///< contacts listed of each fixed mesh
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// How `moving` lies to all of `fixed` where it is: a placement that moves nothing.
///
/// \throws std::invalid_argument as `slide`
/// \cost   `measure` for the fixed meshes that may be the nearest, and the pairs of faces that meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement measure_among(const prepared_mesh& moving,
                                                   std::span<const prepared_mesh> fixed,
                                                   const measure_among_options& options = {});

/// What a face has to do with the other meshes, the gravest first.
enum class contact_class : std::uint8_t {
    none,
    penetrating,
    touching,
    near  ///< closer than the clearance, or where the mesh stopped at it
};

struct contact_classes {
    std::vector<contact_class> moving{};              ///< [F] of its faces
    std::vector<std::vector<contact_class>> fixed{};  ///< by mesh: [F], or empty: none of them
};

/// The class of each face, with `moving` at the place. The contacts of the placement count, also
/// where rounding has left a gap.
///
/// \pre    `at` is what a placement of `moving` among `fixed` has returned
/// \cost   all pairs of faces within the clearance of each other
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API contact_classes classify_contacts(const prepared_mesh& moving,
                                                             std::span<const prepared_mesh> fixed,
                                                             const placement& at);

/// A file's mesh, or a part of it, or a cloud.
struct file_body {
    std::string name{};  ///< of the part; empty where the file has no other
    /// [F] The triangle in the file's mesh, or the point of a cloud, of each face; empty: the same.
    std::vector<std::uint32_t> triangle_of_face{};

    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t stored_face(const mesh_file& file, std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return file.stored_face.empty() ? t : file.stored_face[t];
    }
};

struct file_bodies {
    std::vector<file_body> bodies{};  ///< [B]; none when there is nothing to compute with
    /// [B] Faces are finite triangles of the file; equal corners are one point, and only points
    /// that faces use are there. Those of a cloud are its finite points.
    std::vector<prepared_mesh> shapes{};
    bool cloud = false;        ///< the file has no faces
    std::size_t left_out = 0;  ///< its triangles, or points, with a coordinate that is not finite
};

/// All of `file` as one body.
///
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API file_bodies whole_body(const mesh_file& file);

/// The parts of `file` as `scene_parts` has them, each a body; the whole where it has one.
[[nodiscard]] TREEFORM_API file_bodies bodies_of(const mesh_file& file);

/// Gives the points of `file` that `body` stands for the places of `placed`, which is by the points
/// of `shape`; all other points are moved by `matrix`, and rounded to float32 if asked for.
TREEFORM_API void put_back(mesh_file& file, const file_body& body, const prepared_mesh& shape,
                           points_view placed, const transform<3>& matrix, precision written_as);

/// Rounds every point of the file to float32; how far a coordinate has moved at most.
TREEFORM_API double round_to_float32(mesh_file& file);

/// A body of a file, and the classes of its faces: none, or [F].
struct classified_body {
    const mesh_file* file = nullptr;
    const file_body* body = nullptr;
    std::span<const contact_class> classes{};
};

/// The classes of all triangles of the files that bodies are of, of one cloud of all its points;
/// for `color_contacts`. Bodies of a file follow each other, and of several files clouds are left
/// out, as in `scene_of`.
///
/// \cost O(V + F)
[[nodiscard]] TREEFORM_API std::vector<contact_class> classes_in_files(
    std::span<const classified_body> bodies);

struct contact_color_options {
    /// A picture: each triangle becomes a face of its own. Otherwise polygons stay, and have the
    /// gravest class of their triangles.
    bool split_polygons = false;
    bool keep_colors = false;  ///< where the file has some
};

/// Gives the rows of the element "face" of `file` (of a cloud, "vertex") the property tf_class, a
/// number of `contact_class`, and the colors red, green and blue: gray for none, red for
/// penetrating, yellow for touching, cyan for near.
///
/// `classes` is by triangle of `file.mesh`, of a cloud by point.
///
/// \throws std::invalid_argument for another number of classes
/// \cost   O(F)
TREEFORM_API void color_contacts(mesh_file& file, std::span<const contact_class> classes,
                                 const contact_color_options& options = {});

}  // namespace treeform
