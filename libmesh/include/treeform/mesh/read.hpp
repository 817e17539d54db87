#pragma once
/// \file
/// Reads mesh and point files of all formats, and robots from URDF files.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

/// Reads the file at `path`; "-" is standard input. `format` is an extension without its dot
/// ("stl", "obj", "ply", "off", "pcd", "xyz", "csv", "3mf", "glb", ...). If empty, the format is
/// detected by content first, then by extension.
///
/// Coordinates are as stored: float32 widened to double, decimal text rounded once to the nearest
/// double. NaN and infinity are kept, so that the caller can report them (`find_invalid_faces`).
///
/// - OBJ: `vt` and `vn` are in `attributes::corners`. Material files are read if they exist and the
///   OBJ has a path: the diffuse colors of its materials become columns red, green, blue and, where
///   one is not opaque (`d`), alpha of faces; faces without a material are white.
/// - STL: if a binary file has the size of whole triangles, a wrong count in its header is ignored.
///   Otherwise, bytes after the counted triangles are ignored. ASCII may have zero bytes between
///   words, and words after `endloop` and `endfacet`. `mesh_file::warnings` reports all of these.
/// - PLY: triangle strips, the element "tristrips", become faces, also those that repeat a vertex.
/// - PLY: the list "texcoord" of faces is in `attributes::corners` if each of these lists is empty
///   or has two numbers for each corner. Lines `comment TextureFile NAME` are in
///   `attributes::texture_files`.
/// - Text without a header (XYZ, CSV): the first line may name the columns. Then x, y and z may be
///   any columns; names such as easting, northing and elevation are accepted with a warning,
///   latitude and longitude are refused. `read_options::columns` assigns columns explicitly. An
///   empty cell, or one with text, is NaN. A column with an integer beyond 2^53 gets a 64-bit
///   integer type. Columns of colors have 8 or 16 bits if all values are integers in that range.
/// - PTS: as XYZ. If the first line is the number of points, 4 columns are x y z intensity, 6 are x
///   y z red green blue, and 7 have both. More points than announced are read with a warning; fewer
///   are an error. The format is reported as "xyz".
/// - PCD: a field of several values becomes columns "name[0]", "name[1]", ... WIDTH, HEIGHT and
///   VIEWPOINT of an organized cloud become lines of `attributes::obj_info`: "num_cols 640",
///   "num_rows 480", "viewpoint 0 0 0 1 0 0 0".
/// - LAS and LAZ: columns as in `las_header`. LAZ of LASzip 1 to 3, COPC included; extra bytes as
///   described in the file.
/// - 3MF: the items of the build. Each mesh of an item, directly or through components, is a part
///   with a unique name ("gear", "gear (2)"), transformed; faces of mirrored parts are flipped, so
///   that they are not inside out. Supports and surfaces are read like models; objects of type
///   "other" and objects outside the build are not read. Items and components may be in other model
///   parts of the package. Base materials are materials of parts, and their colors and those of
///   color groups become columns red, green, blue and alpha of faces, or of points where corners
///   have colors of their own. Texture coordinates are in `attributes::corners`; images are not
///   read. Coordinates are in the unit of the file, which is a line of `attributes::obj_info`:
///   "unit millimeter". Extensions that a file requires and that would change its shape are
///   refused.
/// - glTF 2.0 and GLB: the default scene. Draco compression is supported if treeform was built with
///   it. Each mesh of a node, also as an instance of EXT_mesh_gpu_instancing, is a part with a
///   unique name, from the node or the mesh, transformed by matrices composed in double; faces of
///   mirrored parts are flipped. Strips and fans are triangles. COLOR_0 becomes columns red, green,
///   blue and alpha of points, in the type and with the numbers of the file; NORMAL becomes nx, ny
///   and nz, rotated with the node. The texture coordinates of the material's base color, with
///   KHR_texture_transform applied, become s and t = 1 - v, since other formats count t from the
///   lower edge. Colors of materials become columns red, green, blue and alpha of faces, of 8 bits.
///   Textures, other attributes and lines are not read; morph targets and skins are not applied.
///   Files that a glTF refers to are read only from its folder and subfolders. Extensions that a
///   file requires are refused by name, except for KHR_mesh_quantization and those that only change
///   how a surface looks. glTF 1.0 is read by assimp.
///
/// \throws io_error naming path, line or byte, and reason
[[nodiscard]] TREEFORM_API mesh_file read(const std::filesystem::path& path,
                                          std::string_view format = {},
                                          const read_options& options = {});

/// The same for bytes in memory. Errors have `name` instead of the path.
[[nodiscard]] TREEFORM_API mesh_file read(std::span<const std::byte> bytes, std::string_view name,
                                          std::string_view format,
                                          const read_options& options = {});

/// Whether scene formats other than glTF and GLB (DAE, FBX, ...) can be read: true unless treeform
/// was built without assimp.
[[nodiscard]] TREEFORM_API bool reads_scenes();

enum class urdf_joint_kind : std::uint8_t { fixed, revolute, continuous, prismatic };

/// A joint: the frame of the child is that of the parent, times the fixed transform of the joint,
/// times its motion.
struct urdf_joint {
    std::string name{};
    urdf_joint_kind kind = urdf_joint_kind::fixed;
    std::uint32_t parent = 0;  ///< numbers of links
    std::uint32_t child = 0;
    transform<3> origin{};
    point3 axis{1.0, 0.0, 0.0};  ///< of length 1, in the joint's frame
    /// least and greatest value; of revolute and prismatic joints
    std::optional<std::array<double, 2>> limits{};
    /// The joint that this one mimics, or empty: its value is `mimic_multiplier` times the value of
    /// that joint, plus `mimic_offset`.
    std::string mimics{};
    double mimic_multiplier = 1.0;
    double mimic_offset = 0.0;
};

/// A mesh of a link, from a file or a geometric shape. `place` maps its points to the link's frame.
struct urdf_mesh {
    std::uint32_t link = 0;
    std::filesystem::path file{};  ///< empty for a box, a cylinder, a sphere
    transform<3> place{};          ///< the origin, and the scale of the mesh
    /// A box is exact. A cylinder or sphere is replaced by a triangle mesh that contains it, so
    /// that no clash is missed: a cylinder has 96 sides and exceeds the radius by at most 0.054%, a
    /// sphere has 5,120 triangles and exceeds it by at most 0.13%.
    mesh shape{};
};

/// A robot.
struct urdf_robot {
    std::string name{};
    std::vector<std::string> links{};  ///< [L] names, in the order of the file
    std::vector<urdf_joint> joints{};  ///< parents before their children
    std::vector<urdf_mesh> meshes{};   ///< ordered by link
    /// cylinders and spheres replaced by triangles, one sentence each
    std::vector<std::string> approximated{};
    std::vector<std::string> skipped{};  ///< geometry that is not read, one sentence each

    /// Pairs of links connected by a joint, or by joints and links without meshes; the lower number
    /// first, ascending.
    [[nodiscard]] TREEFORM_API std::vector<std::array<std::uint32_t, 2>> adjacent() const;

    /// The same pairs as numbers in `parts`; pairs with a link that has no part are omitted.
    [[nodiscard]] TREEFORM_API std::vector<std::array<std::uint32_t, 2>> adjacent(
        std::span<const urdf_mesh> parts) const;

    /// The robot as parts of an assembly: for each link that has faces, ascending, all its meshes
    /// as one, a `shape` in the frame of the link. `mesh_of_file` returns the mesh of a file; it is
    /// called in the order of `meshes`, once for each mesh with a file.
    [[nodiscard]] TREEFORM_API std::vector<urdf_mesh> parts(
        const std::function<mesh(const std::filesystem::path&)>& mesh_of_file) const;

    /// [L] The transform from each link's frame to the robot's frame. `values` maps names of joints
    /// to angles in radians, or lengths. Joints without a value are at 0; a joint that mimics
    /// another follows it unless it has a value of its own. Limits are not checked.
    ///
    /// \throws std::invalid_argument for a joint that does not exist or is fixed, or a value that
    ///         is not finite
    [[nodiscard]] TREEFORM_API std::vector<transform<3>> link_transforms(
        const std::map<std::string, double>& values) const;
};

/// Reads the robot at `path`. Joints are fixed, revolute, continuous or prismatic. Boxes, cylinders
/// and spheres become meshes. Mesh files are not read, but must exist. `package://name/rest`
/// resolves to FOLDER/name/rest or FOLDER/rest, where FOLDER is one of `package_folders`, else the
/// folder of the file or one above it. With `visual`, visual meshes are used instead of collision
/// meshes.
///
/// \throws io_error naming the path and the reason: not XML, no robot, an unsupported joint, a link
///         that is missing, has two parents or is its own ancestor, repeated names, invalid
///         numbers, sizes that are not positive, a missing mesh file
[[nodiscard]] TREEFORM_API urdf_robot
read_urdf(const std::filesystem::path& path,
          std::span<const std::filesystem::path> package_folders = {}, bool visual = false);

}  // namespace treeform
