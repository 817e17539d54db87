#pragma once
/// \file
/// Files, scenes and robots in C.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <tools/bindings/linked_files.hpp>
#include <tools/c/made/structs.hpp>
#include <tools/c/mesh.hpp>

struct treeform_robot {
    void* owner;
    treeform::urdf_robot content;
};

namespace glue {

// ---- reading ----

/// Reads the file at `path`, UTF-8; "-" is standard input. `format` is an extension without its dot
/// ("stl", "ply", ...), or null: detected by content, then by extension. Coordinates are as stored.
/// Names of material and texture files get the folder, "/models/./a.mtl". Writing makes them
/// relative to the folder of the output.
inline tf::mesh_file read(const std::filesystem::path& path, std::string_view format) {
    return tools::read_linked(path, format, {});
}

/// The mesh of the file at `path`: corners with equal coordinates are one vertex; triangles that
/// are not finite are dropped, as are such points of a cloud. `dropped`, or null, is their number.
/// `treeform_read` and `treeform_as_mesh` tell which ones, and what else is wrong with the file.
inline answer_of<treeform_mesh> read_mesh(const std::filesystem::path& path,
                                          std::uint64_t* dropped) {
    tf::usable_mesh read = tf::read_mesh(path);
    if (dropped) *dropped = read.non_finite;
    tf::mesh own = std::move(read.mesh);
    const std::span<const tf::face> faces = own.faces;  // stay where they are when moved
    return mesh_of(std::move(own), {}, faces, 0);
}

/// Reads the file at `path` as `treeform_read` does; options may be null.
inline tf::mesh_file read_as(const std::filesystem::path& path,
                             const treeform_read_options* options) {
    const auto o = chosen(options, treeform_read_options_init);
    return tools::read_linked(path, text(o.format), read(o));
}

/// The same for bytes in memory. Errors have `name` instead of the path.
inline tf::mesh_file read_memory(const void* bytes, std::size_t size, const char* name,
                                 std::string_view format) {
    return tf::read(array(static_cast<const std::byte*>(bytes), size, "bytes"),
                    name ? name : "memory", format);
}

/// Creates a file without attributes, with copies of the points and faces of a mesh or cloud.
inline tf::mesh_file file_create(const treeform_mesh* mesh) {
    tf::mesh_file made;
    made.mesh = copy_of(mesh);
    made.stored_faces = made.mesh.faces.size();
    return made;
}

/// A copy of a file.
inline tf::mesh_file file_copy(const tf::mesh_file& file) { return file; }

/// The content of a file, as arrays that the file owns.
inline answer_of<treeform_file_view> file_content(const tf::mesh_file& file) {
    auto made = make<treeform_file_view>();
    fill(*made, file, made->value);
    return made;
}

// ---- changing ----

inline std::size_t rows_in(const tf::mesh_file& file, std::string_view element) {
    if (element == "vertex") return file.mesh.points.size();
    if (element == "face")
        return file.face_of_triangle.empty() ? file.mesh.faces.size() : file.stored_faces;
    const tf::element* const found = file.attributes.find(element);
    return found ? found->rows : static_cast<std::size_t>(-1);
}

/// Replaces the points [count][3], for example by the points of a placement; `count` must be the
/// number of points. Place with `TREEFORM_FLOAT32` for a file of floats, such as STL: points of a
/// placement with `TREEFORM_FLOAT64` are rounded there, and may be below the bed.
inline void file_set_points(tf::mesh_file& file, std::span<const tf::point3> points) {
    if (points.size() != file.mesh.points.size())
        throw std::invalid_argument(std::to_string(points.size()) + " points for a file of " +
                                    std::to_string(file.mesh.points.size()));
    file.mesh.points.assign(points.begin(), points.end());
    if (!tf::fits_float32(file.mesh.points)) file.stored_as = tf::precision::float64;
}

/// Sets a column of `element` ("vertex", "face") with one value for each row: `values` [rows] of
/// `type`. For vertices and faces, `rows` must be their number in the file. The columns of
/// coordinates and corners cannot be set: their names are an error.
inline void file_set_column(tf::mesh_file& file, const std::string& element,
                            const std::string& name, tf::scalar_type type, const void* values,
                            std::size_t rows) {
    const std::size_t wanted = rows_in(file, element);
    if (wanted != static_cast<std::size_t>(-1) && wanted != rows)
        throw std::invalid_argument(std::to_string(rows) + " values of \"" + name + "\" for " +
                                    std::to_string(wanted) + " rows of \"" + element + "\"");
    if (const tf::element* const of = file.attributes.find(element))
        if (const tf::column* const before = of->find(name);
            before && before->role != tf::column_role::data)
            throw std::invalid_argument("\"" + name +
                                        "\" stands for the points or faces of the file and "
                                        "cannot be set");
    tf::column column = tf::with_type(type, [&]<class T>(T) {
        return tf::column::of<T>(name, array(static_cast<const T*>(values), rows, "values"));
    });
    if (element == "face" && file.face_of_triangle.empty())
        file.stored_faces = file.mesh.faces.size();
    file.attributes.find_or_add(element, rows).set(std::move(column));
}

/// Sets texture coordinates `texture` [texture_count][3], and the number of those at each corner of
/// each triangle, `of_corner` [F][3]; `TREEFORM_NONE` for none.
inline void file_set_texture(tf::mesh_file& file, const double* texture, std::size_t texture_count,
                             const std::uint32_t* of_corner) {
    const std::span corners = faces(of_corner, file.mesh.faces.size(), "of_corner");
    tf::corner_values made = file.attributes.corners;
    const auto uvw = rows_of<std::array<double, 3>>(texture, texture_count, "texture");
    made.texture.assign(uvw.begin(), uvw.end());
    made.has_w = std::any_of(uvw.begin(), uvw.end(), [](const auto& at) { return at[2] != 0.0; });
    made.texture_of_corner.assign(corners.begin(), corners.end());
    if (const std::string fault = made.fault(file.mesh.faces.size()); !fault.empty())
        throw std::invalid_argument(fault);
    file.attributes.corners = std::move(made);
}

/// Names the faces from `first_face` on; strings may be null. Call it in ascending order of faces.
inline void file_add_part(tf::mesh_file& file, const char* object, const char* group,
                          const char* material, std::uint32_t first_face) {
    std::vector<tf::named_faces>& parts = file.attributes.parts;
    if (first_face > rows_in(file, "face") ||
        (!parts.empty() && first_face < parts.back().first_face))
        throw std::invalid_argument("a part cannot begin at face " + std::to_string(first_face));
    parts.push_back({text(object), text(group), text(material), first_face});
}

/// Adds a line of text, by `kind`: a comment, a line `obj_info` of PLY, or the name of a material
/// or texture file.
inline void file_add_text(tf::mesh_file& file, treeform_text_kind kind, const std::string& text) {
    tf::attributes& a = file.attributes;
    const std::array lists{&a.comments, &a.obj_info, &a.material_files, &a.texture_files};
    lists[choice<std::size_t>(kind, lists.size(), "kind")]->push_back(text);
}

/// Makes each triangle a face of its own.
inline void file_split_polygons(tf::mesh_file& file) { file.split_polygons(); }

/// Rounds the coordinates to those of a LAS file; `result` is the largest change of a coordinate.
inline double file_round_to_las(tf::mesh_file& file) { return tf::round_to_las(file); }

/// Rounds the coordinates to 32-bit floats; `result` is the largest change of a coordinate.
inline double file_round_to_float32(tf::mesh_file& file) { return file.round_to_float32(); }

/// Transforms the points and normals of the file by a matrix. If it mirrors, faces are flipped, so
/// that they still point outward.
inline void file_transform(tf::mesh_file& file, const double* matrix) {
    file.move(finite_matrix(matrix));
}

/// Transforms the normals of the file by a matrix. If it mirrors, outward normals stay outward, as
/// for flipped faces.
inline void file_transform_normals(tf::mesh_file& file, const double* matrix) {
    file.transform_normals(finite_matrix(matrix));
}

// ---- writing ----

/// Writes a file to `path`, completely or not at all; "-" is standard output. Data that the format
/// cannot store is omitted; `written` lists it.
inline tf::write_result write(const std::filesystem::path& path, const tf::mesh_file& file,
                              const tf::write_options& options) {
    return tools::write_linked(
        path, file, [&](const tf::mesh_file& linked) { return tf::write(path, linked, options); });
}

/// The same for a mesh without attributes. `written` may be null.
inline tf::write_result write_mesh(const std::filesystem::path& path, const treeform_mesh* mesh,
                                   const tf::write_options& options) {
    return tf::write(path, copy_of(mesh), options);
}

/// Writes the mesh of a result in its certified coordinates. Fails if the format would round them,
/// or if the certificate's status is not ok. `written` may be null.
inline tf::write_result write_result(const std::filesystem::path& path, const treeform_arrays* mesh,
                                     const treeform_certificate* certificate,
                                     const tf::write_options& options) {
    struct certified_mesh {  // as `write` takes one
        tf::certificate certificate{};
        tf::mesh mesh{};
        [[nodiscard]] const tf::mesh& value() const { return mesh; }
    };
    if (need(certificate, "certificate").status != TREEFORM_STATUS_OK)
        throw std::invalid_argument(certificate->message);
    const treeform_arrays& of = need(mesh, "mesh");
    const auto points = glue::points(of.points, of.point_count, "points");
    const auto faces = glue::faces(of.faces, of.face_count, "faces");
    certified_mesh whole;
    whole.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
    return tf::write(path, whole, options);
}

/// The bytes of the file, in the format in `options`.
inline answer_of<treeform_bytes> write_memory(const tf::mesh_file& file,
                                              const tf::write_options& options) {
    auto made = make<treeform_bytes>();
    const std::string& kept = made->keep(tools::write_linked(
        "-", file, [&](const tf::mesh_file& at) { return tf::write_to_memory(at, options); }));
    made->value.bytes = reinterpret_cast<const unsigned char*>(kept.data());
    made->value.count = kept.size();
    return made;
}

// ---- meshes and scenes ----

/// The usable part of a file's mesh. Points that only dropped faces use are dropped as well.
inline tf::usable_mesh usable_faces(const tf::mesh_file& file, const tf::usable_options& options) {
    return tf::usable_faces(file.mesh, file.face_of_triangle, options);
}

/// The whole mesh of a file: corners with equal coordinates become one vertex, triangles that are
/// not finite are dropped. Points keep their numbers, so that attributes can be transferred.
inline tf::usable_mesh as_mesh(const tf::mesh_file& file) {
    tf::mesh_file plain;
    plain.mesh = file.mesh;
    plain.face_of_triangle = file.face_of_triangle;
    plain.stored_faces = file.stored_faces;
    plain.indexed = file.indexed;
    return tf::as_mesh(std::move(plain));
}

/// The names as strings; if null, the numbers of the inputs.
inline std::vector<std::string> names_of(const char* const* names, std::size_t count) {
    if (names) return texts(names, count, "names");
    std::vector<std::string> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back("input " + std::to_string(i));
    return result;
}

/// Concatenates files: one file with all points and faces. `names` [count], or null, are for
/// warnings.
inline tf::mesh_file concatenate_files(const treeform_file* const* files, const char* const* names,
                                       std::size_t count) {
    std::vector<tf::mesh_file> all;
    for (const treeform_file* one : array(files, count, "files"))
        all.push_back(content(one, "files"));
    if (all.empty()) throw std::invalid_argument("no files to join");
    return tf::concatenate_files(std::move(all), names_of(names, count));
}

/// One scene of all files, each under its name, with materials and textures.
inline tf::mesh_file scene_of(const treeform_file* const* files, const char* const* names,
                              std::size_t count) {
    const std::span all = array(files, count, "files");
    if (all.empty()) throw std::invalid_argument("no files for the scene");
    const std::vector<std::string> labels = names_of(names, count);
    std::vector<const tf::mesh_file*> members;
    for (const treeform_file* one : all) members.push_back(&content(one, "files"));
    return tools::scene_of(members, labels);
}

/// The parts of a file, by its objects, groups or nodes, each as a file of its own. With
/// `combine_patches`, parts with a common point, or whose open edges coincide, are combined.
inline answer_of<treeform_scene_parts> file_parts(const tf::mesh_file& file, bool combine_patches) {
    auto made = make<treeform_scene_parts>();
    auto& all = made->keep(std::vector<treeform_scene_part>());
    for (tf::file_part& one : made->keep(tf::file_parts({.file = &file}, combine_patches)))
        all.push_back({one.name.c_str(), keep(*made, std::move(one.file)), one.face_in_file.data(),
                       one.face_in_file.size()});
    made->value.count = all.size();
    made->value.parts = all.data();
    return made;
}

// ---- robots ----

/// The content of a robot, as arrays that the robot owns.
inline answer_of<treeform_robot_view> robot_content(const tf::urdf_robot& robot) {
    auto made = make<treeform_robot_view>();
    fill(*made, robot, made->value);
    return made;
}

/// The parts of a robot: one mesh for each link with faces. Reads the files of its meshes.
inline answer_of<treeform_robot_parts> robot_parts_of(const tf::urdf_robot& robot) {
    auto made = make<treeform_robot_parts>();
    auto& from = made->keep(robot.parts(
        [](const std::filesystem::path& file) { return tf::as_mesh(tf::read(file)).mesh; }));
    auto& shapes = made->keep(std::vector<tf::prepared_mesh>());
    auto& links = made->keep(std::vector<std::uint32_t>());
    for (tf::urdf_mesh& part : from) {
        shapes.emplace_back(std::move(part.shape));
        links.push_back(part.link);
    }
    const auto& adjacent = made->keep(robot.adjacent(from));
    made->value.meshes = handles(*made, shapes);
    made->value.links = links.data();
    made->value.count = links.size();
    made->value.adjacent = flat(adjacent);
    made->value.adjacent_count = adjacent.size();
    return made;
}

/// `places` [link_count][12]: the matrix from each link's frame to the robot's frame, if `joints`
/// [count] have these `values`, in radians or lengths. Joints without a value are at 0.
inline void link_transforms(const tf::urdf_robot& robot, const char* const* joints,
                            const double* values, std::size_t count, double* places) {
    const std::vector<std::string> names = texts(joints, count, "joints");
    const std::span all = array(values, count, "values");
    std::map<std::string, double> given;
    for (std::size_t i = 0; i < count; ++i) given[names[i]] = all[i];
    const auto found = robot.link_transforms(given);
    (void)array(places, 12 * found.size(), "places");
    for (std::size_t i = 0; i < found.size(); ++i) copy(found[i], places + 12 * i);
}

}  // namespace glue
