#pragma once
/// \file
/// Transfers attributes of input files to results of operations. Repairs files, and returns their
/// parts. Marks the faces that meet.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/export.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

/// An input of an operation. If faces of `file->mesh` were dropped after reading,
/// `triangle_of_face` has the numbers of the others in the file. Points have the numbers of the
/// file.
struct attribute_source {
    const mesh_file* file = nullptr;
    /// [F] the number of each face of `file->mesh` among the triangles of the file; empty: the same
    /// numbers.
    std::span<const std::uint32_t> triangle_of_face{};

    /// The number of face `f` among the triangles of the file.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t f) const {
        return triangle_of_face.empty() ? f : triangle_of_face[f];
    }
    /// The number of face `f` in the file.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t f) const {
        const std::uint32_t t = triangle(f);
        return file->face_of_triangle.empty() ? t : file->face_of_triangle[t];
    }
    /// Gives the corners of caps (`cut_piece::cap`) planar texture coordinates, if this source, the
    /// mesh that was cut, has texture coordinates. The axes are those of `oriented_plane::axes` for
    /// the mean normal of a cap, with the sign that makes its largest component positive. So both
    /// sides of a cut have the same axes. The scale is the average of this source, in texture units
    /// per length.
    ///
    /// \pre `cap` has a number for each face of `piece`, or is empty
    TREEFORM_API void texture_caps(mesh_file& piece, std::span<const std::uint32_t> cap) const;
};

/// The inputs of an operation; its result gets their attributes. Files are not copied; they must
/// outlive this object.
class attribute_sources {
  public:
    attribute_sources(const attribute_source& one) : all_{one} {}  // NOLINT: one is many, too
    attribute_sources(std::vector<attribute_source> all)
        : all_(std::move(all)) {}  // NOLINT: as above

    [[nodiscard]] const std::vector<attribute_source>& all() const { return all_; }

    /// Gives `file`, whose mesh is the result, the attributes of the inputs: columns of vertices
    /// and faces with one value a row, texture coordinates and normals of corners, materials and
    /// the files of materials and textures; from a single input, also the names of its parts.
    ///
    /// A face gets the values of its source face, a vertex those of its source vertex. For a new
    /// vertex on a cut, values are interpolated between the corners of the face that contains it
    /// (`face_of_cut_vertex`, or else the lowest source of its faces). Values of corners are
    /// transferred in the same way. The value is 0 or NaN if an input lacks the column, or a face
    /// has no source. Normals are flipped with the surface, and interpolated normals scaled to
    /// length 1. Lists and other elements are not transferred.
    ///
    /// \pre  sources are in range
    /// \cost O(V + F) for each column
    TREEFORM_API void transfer(mesh_file& file, std::span<const operand_element> face_source,
                               std::span<const operand_element> vertex_source,
                               std::span<const operand_element> face_of_cut_vertex = {}) const;

    /// The same for a result of a single input, with sources as in `repair_result`:
    /// `operand_element::none` stands for no source.
    ///
    /// With sources of `simplify_result`, faces may reach beyond their sources. Values of corners
    /// are those of `corner_source`; at new vertices they are interpolated. A face whose source has
    /// equal normals at its corners gets its own normal.
    TREEFORM_API void transfer(mesh_file& file, std::span<const std::uint32_t> face_source,
                               std::span<const std::uint32_t> vertex_source,
                               std::span<const std::uint32_t> face_of_new_vertex = {},
                               std::span<const std::uint32_t> corner_source = {}) const;

    /// [3 F] Groups for `simplify_options::corner_groups`, of a single input. Two corners at a
    /// point are in one group if neighboring faces link them. Such faces must have one material and
    /// equal values in all transferred columns; at both ends of each edge between them, texture
    /// coordinates and normals must be equal. Normals of two flat-shaded faces count as equal.
    /// Empty if all corners at each point would be in one group.
    /// \cost O(V log V + F log F), and O(F) for each column
    [[nodiscard]] TREEFORM_API std::vector<std::uint32_t> corner_groups() const;

    /// [F of all inputs, in order] A group for each face, for `boolean_options::face_groups`. With
    /// `by_values`, a group has one material and equal values in all transferred columns; a face
    /// whose corners differ in texture coordinates or normals is a group by itself. With
    /// `by_input`, a group has faces of one input only. Empty if all faces would be in one group.
    /// \cost O(V + F) for each column
    [[nodiscard]] TREEFORM_API std::vector<std::uint32_t> face_groups(bool by_values,
                                                                      bool by_input) const;

    /// Whether vertices of an input have values that are transferred.
    [[nodiscard]] TREEFORM_API bool has_vertex_values() const;

    /// Whether merging faces (see `boolean_options::keep_cuts`) may mix transferred values:
    /// vertices have values, or faces have different ones.
    /// \cost as `face_groups`
    [[nodiscard]] TREEFORM_API bool merging_mixes_values() const;

    /// Whether an input has values that `transfer` leaves out.
    [[nodiscard]] TREEFORM_API bool has_values_left_out() const;

    /// Names of materials, ascending, that occur in inputs with different material files. An OBJ
    /// made of these inputs can have only one material of that name.
    [[nodiscard]] TREEFORM_API std::vector<std::string> ambiguous_materials() const;

  private:
    std::vector<attribute_source> all_;
};

/// Gives faces the uint32 columns NAME_mesh and NAME_face: the operand and the face number of each
/// source. A comment names the input for each operand number. Replaces columns and comments of an
/// earlier result; without `inputs`, only removes them.
///
/// \pre `face_source` has an element for each face, unless `inputs` is empty
TREEFORM_API void set_source_columns(mesh_file& file, const std::string& name,
                                     std::span<const operand_element> face_source,
                                     std::span<const std::string> inputs);

/// A part of a scene as a separate file.
struct file_part {
    std::string name{};                         ///< "object", "object/group", "group" or empty
    mesh_file file{};                           ///< with the attributes of its faces and points
    std::vector<std::uint32_t> face_in_file{};  ///< [F] the number of each face in the given file
};

/// The parts of a file, by its objects, groups or nodes, each with its own points and faces and
/// their attributes (`attribute_sources`). With `combine_patches`, parts with a common point, or
/// whose open edges coincide, are patches of one surface, and are combined into one part; solids
/// that touch are not combined.
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(V log V + F log F), and O(V + F) for each part and column
[[nodiscard]] TREEFORM_API std::vector<file_part> file_parts(const attribute_source& whole,
                                                             bool combine_patches = false);

/// A repaired part of a file.
struct repaired_part {
    std::string name{};  ///< "object", "object/group", "group" or empty
    /// number of its first face in the repaired mesh; its faces are consecutive
    std::uint32_t first_face = 0;
    std::uint32_t faces = 0;
    /// Face numbers are those of the repaired mesh; in `open_faces`, those of the input file.
    treeform::certificate certificate{};
    repair_statistics statistics{};
};

/// A repaired file.
struct repaired_file {
    mesh_file file{};  ///< in the format of the input, with its attributes (`attribute_sources`)
    /// [F'] the number in the input file of the source of each face, or `repair_result::none`.
    std::vector<std::uint32_t> face_source{};
    std::vector<std::uint8_t> is_kept{};  ///< [F of the input's mesh] as in `repair_result`
    /// The certificate of the first part that failed; if none failed, of all parts together.
    /// Numbers in `open_faces` are those of the input file.
    treeform::certificate certificate{};
    repair_statistics statistics{};      ///< sums over all parts
    std::vector<repaired_part> parts{};  ///< empty if all was repaired as one mesh

    /// The file.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const mesh_file& value() const {
        if (!certificate) throw not_certified_error(certificate);
        return file;
    }
};

/// `repair` of each part of a file; with `repair_options::as_one`, of all parts as one mesh.
///
/// Each part becomes a solid; parts may overlap before and after. Parts are the objects, groups or
/// nodes of the file, with its vertex numbers; those whose open edges coincide are patches of one
/// surface, and are combined into one part. Limits in `repair_options`, such as `max_loss`, apply
/// to each part. Within a part, cuts are kept where merging faces would mix values
/// (`attribute_sources::merging_mixes_values`).
///
/// \throws std::invalid_argument as `repair`
/// \cost   as `repair` and `attribute_sources::transfer`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API repaired_file repair_file(const attribute_source& input,
                                                     const repair_options& options = {});

/// The total defects of all parts; parts are defined as in `repair_file`. Each part is checked by
/// itself, so pairs of faces of different parts do not count. Faces of the file that are not in
/// `input` do not count, either.
///
/// \throws std::invalid_argument as `self_intersections`
/// \cost   as `find_solid_defects` of a mesh
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_defects find_solid_defects(const attribute_source& input,
                                                            const progress_callback& progress = {});

/// Gives all `files` one common list of texture files, and their faces int32 indices into it
/// ("texnumber"). The list begins with the list of the first file, followed by additional names of
/// the other files. `names` has one name for each file, for the warnings.
///
/// Faces of a file without indices get the index of its first texture file, or -1 if it has none.
/// Faces without a texture file get -1; a warning names other indices out of range. No indices are
/// added if there is only one name in all files, no file has indices, and no file has texture
/// coordinates without a name. Nothing changes for a single file, or if no file has a name.
[[nodiscard]] TREEFORM_API std::vector<io_warning> unite_textures(
    std::span<mesh_file* const> files, std::span<const std::string> names);

/// "#rrggbb" of each mark: gray for faces in no pair, then by `pair_kind`.
inline constexpr std::array<const char*, 1 + pair_kind_count> mark_colors{
    "#b4bac2", "#e02020", "#f08c00", "#ecd000", "#d81fbf", "#7432d6", "#00a0c0", "#6b4a2b"};

/// Marks of faces that meet, by kind of pair and by region.
struct face_marks {
    std::vector<std::uint8_t> kind{};    ///< [F] 0: in no pair; else 1 + the worst `pair_kind`
    std::vector<std::int32_t> region{};  ///< [F] -1: in no pair

    face_marks() = default;
    /// The marks of `face_count` faces. The worst kind of a face is crossing, then pierce, overlap,
    /// fold, duplicate, touching, degenerate: not the order of the enumerators.
    ///
    /// \pre `regions` are those of `pairs`, whose faces are in range
    TREEFORM_API face_marks(std::size_t face_count, std::span<const face_pair> pairs,
                            std::span<const intersection_region> regions);

    /// Writes the marks of the faces of `searched` to `file`: colors of faces and vertices (a
    /// vertex gets the color of its first face in a pair), and the properties tf_class and
    /// tf_region of faces. Polygons become triangles. A file that does not number its vertices is
    /// indexed, and its other properties are dropped.
    ///
    /// \pre    `searched` is a part of `file`, and the marks are those of its faces
    /// \cost O(V + F)
    TREEFORM_API void color(mesh_file& file, const usable_mesh& searched) const;

    /// Number of faces in at least one pair.
    [[nodiscard]] std::uint64_t marked() const {
        return kind.size() - static_cast<std::uint64_t>(std::count(kind.begin(), kind.end(), 0));
    }
};

}  // namespace treeform
