#pragma once
/// \file
/// Files: reading, inspecting, changing, joining, splitting into parts, writing; robots.

#include <treeform/c/mesh.h>

/// The content of a mesh or point file: points, faces, all attributes.
typedef struct treeform_file treeform_file;

/// A new name for a column.
typedef struct treeform_named_column {
    const char* name;    ///< "x", "intensity", ...
    const char* source;  ///< its name in the first line, or its number, from 1
} treeform_named_column;

// made of the headers of C++:
//   read() read_mesh() read_options read_as() read_memory() file_create() file_copy()
//   scalar_type column element named_faces io_warning mesh_file file_content()
//   file_set_points() file_set_column() file_set_texture() file_add_part()
/// Reads the file at `path`, UTF-8; "-" is standard input. `format` is an extension without its
/// dot ("stl", "ply", ...), or null: detected by content, then by extension. Coordinates are as
/// stored. Names of material and texture files get the folder, "/models/./a.mtl". Writing makes
/// them relative to the folder of the output.
TREEFORM_C_API treeform_code treeform_read(const char* path, const char* format,
                                           treeform_file** file);

/// The mesh of the file at `path`: corners with equal coordinates are one vertex; triangles that
/// are not finite are dropped, as are such points of a cloud. `dropped`, or null, is their number.
/// `treeform_read` and `treeform_as_mesh` tell which ones, and what else is wrong with the file.
TREEFORM_C_API treeform_code treeform_read_mesh(const char* path, uint64_t* dropped,
                                                treeform_mesh** mesh);

/// How to read.
typedef struct treeform_read_options {
    size_t struct_size;
    const char* format;  ///< null: determined by the content
    /// [column_count] For XYZ, PTS and CSV: names of columns, as pairs of the new name and the
    /// name in the first line or the column number, from 1: {"x", "easting"}. Columns x, y and z
    /// are the coordinates.
    const treeform_named_column* columns;
    size_t column_count;
    /// Drop points with a coordinate that is not finite, and their faces, and add a warning. Only
    /// for `treeform_read`.
    int32_t drop_non_finite;
} treeform_read_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_read_options_init(treeform_read_options* options, size_t size);

/// Reads the file at `path` as `treeform_read` does; options may be null.
TREEFORM_C_API treeform_code treeform_read_as(const char* path,
                                              const treeform_read_options* options,
                                              treeform_file** file);

/// The same for bytes in memory. Errors have `name` instead of the path.
TREEFORM_C_API treeform_code treeform_read_memory(const void* bytes, size_t size, const char* name,
                                                  const char* format, treeform_file** file);

/// Creates a file without attributes, with copies of the points and faces of a mesh or cloud.
TREEFORM_C_API treeform_code treeform_file_create(const treeform_mesh* mesh, treeform_file** file);

/// A copy of a file.
TREEFORM_C_API treeform_code treeform_file_copy(const treeform_file* file, treeform_file** made);

/// The type of the values of a column.
typedef int32_t treeform_scalar;
enum {
    TREEFORM_INT8 = 0,
    TREEFORM_UINT8 = 1,
    TREEFORM_INT16 = 2,
    TREEFORM_UINT16 = 3,
    TREEFORM_INT32 = 4,
    TREEFORM_UINT32 = 5,
    TREEFORM_INT64 = 6,
    TREEFORM_UINT64 = 7,
    TREEFORM_SCALAR_FLOAT32 = 8,
    TREEFORM_SCALAR_FLOAT64 = 9
};

/// One named property: a value, or a list of values, for each row of its element.
typedef struct treeform_column {
    const char* name;
    treeform_scalar type;
    int32_t is_list;  ///< whether each row has a list of values
    /// whether the values are stored in the points, faces or corners of the file, not in `values`
    int32_t is_stored_elsewhere;
    const void* values;  ///< [value_count] values of `type`
    size_t value_count;
    const uint64_t* list_begin;  ///< [rows + 1] first value of each list; else null
} treeform_column;

/// A kind of row in a file, such as vertices, with its properties in the order of the file.
typedef struct treeform_element {
    const char* name;  ///< "vertex", "face", "edge", ...
    size_t rows;
    const treeform_column* columns;  ///< [column_count]
    size_t column_count;
} treeform_element;

/// Consecutive faces to which a file gives the same names. A part ends where the next one starts.
typedef struct treeform_named_faces {
    const char* object;    ///< OBJ `o`, the name of an STL solid or of a scene's node
    const char* group;     ///< OBJ `g`
    const char* material;  ///< OBJ `usemtl`
    uint32_t first_face;   ///< number in the file
} treeform_named_faces;

/// A remark about a file that was read or written.
typedef struct treeform_io_warning {
    const char* code;  ///< stable, for scripts: "trailing-bytes", "precision"
    const char* text;  ///< for people
} treeform_io_warning;

/// The content of a file. Points and faces have the order and numbers of the file: nothing is
/// joined, split, reordered or dropped.
typedef struct treeform_file_view {
    void* owner;
    treeform_arrays mesh;  ///< polygons become triangle fans from their first corner
    /// [F] the number in the file of the face that each triangle comes from; empty if all faces
    /// are triangles.
    const uint32_t* face_of_triangle;
    size_t stored_faces;  ///< faces in the file
    int32_t indexed;      ///< the format numbers its vertices (STL does not)
    /// float32 if every coordinate is a float32 value, or was one before its node's transform.
    treeform_precision stored_as;
    const char* format;                   ///< "stl-binary", "ply-ascii", "obj", ...
    const treeform_io_warning* warnings;  ///< [warning_count]
    size_t warning_count;
    /// [element_count] In the order of the file. "vertex" has a row for each point, "face" one for
    /// each face as stored.
    const treeform_element* elements;
    size_t element_count;
    /// [part_count] ascending by first face; empty if nothing is named
    const treeform_named_faces* parts;
    size_t part_count;
    const double* texture;  ///< [texture_count][3] u, v, w
    size_t texture_count;
    const double* normals;  ///< [normal_count][3]
    size_t normal_count;
    /// [F][3] numbers in `texture`; empty: no corner has any
    const uint32_t* texture_of_corner;
    /// [F][3] numbers in `normals`; empty: no corner has any
    const uint32_t* normal_of_corner;
    /// [material_file_count] OBJ `mtllib`, as in the file
    const char* const* material_files;
    size_t material_file_count;
    /// [texture_file_count] PLY: the names in the lines `comment TextureFile NAME`. The property
    /// "texnumber" of faces is a number in this list, from 0; without it, faces use the first.
    const char* const* texture_files;
    size_t texture_file_count;
    /// [comment_count] PLY: one line each, without those of texture files
    const char* const* comments;
    size_t comment_count;
    const char* const* obj_info;  ///< [obj_info_count] PLY: one line each
    size_t obj_info_count;
    int32_t is_las;
    double las_scale[3];
    double las_offset[3];
} treeform_file_view;

/// The content of a file, as arrays that the file owns.
TREEFORM_C_API treeform_code treeform_file_content(const treeform_file* file,
                                                   treeform_file_view** view);

/// Replaces the points [count][3], for example by the points of a placement; `count` must be the
/// number of points. Place with `TREEFORM_FLOAT32` for a file of floats, such as STL: points of a
/// placement with `TREEFORM_FLOAT64` are rounded there, and may be below the bed.
TREEFORM_C_API treeform_code treeform_file_set_points(treeform_file* file, const double* points,
                                                      size_t count);

/// Sets a column of `element` ("vertex", "face") with one value for each row: `values` [rows] of
/// `type`. For vertices and faces, `rows` must be their number in the file. The columns of
/// coordinates and corners cannot be set: their names are an error.
TREEFORM_C_API treeform_code treeform_file_set_column(treeform_file* file, const char* element,
                                                      const char* name, treeform_scalar type,
                                                      const void* values, size_t rows);

/// Sets texture coordinates `texture` [texture_count][3], and the number of those at each corner
/// of each triangle, `of_corner` [F][3]; `TREEFORM_NONE` for none.
TREEFORM_C_API treeform_code treeform_file_set_texture(treeform_file* file, const double* texture,
                                                       size_t texture_count,
                                                       const uint32_t* of_corner);

/// Names the faces from `first_face` on; strings may be null. Call it in ascending order of faces.
TREEFORM_C_API treeform_code treeform_file_add_part(treeform_file* file, const char* object,
                                                    const char* group, const char* material,
                                                    uint32_t first_face);
// end

/// The kind of a line of text in a file.
typedef int32_t treeform_text_kind;
enum {
    TREEFORM_COMMENT = 0,
    TREEFORM_OBJ_INFO = 1,
    TREEFORM_MATERIAL_FILE = 2,
    TREEFORM_TEXTURE_FILE = 3
};
// made of the headers of C++:
//   file_add_text() file_split_polygons() file_round_to_las() file_round_to_float32()
//   file_transform() file_transform_normals() write_options write_result write() write_mesh()
//   write_result()
/// Adds a line of text, by `kind`: a comment, a line `obj_info` of PLY, or the name of a material
/// or texture file.
TREEFORM_C_API treeform_code treeform_file_add_text(treeform_file* file, treeform_text_kind kind,
                                                    const char* text);

/// Makes each triangle a face of its own.
TREEFORM_C_API treeform_code treeform_file_split_polygons(treeform_file* file);

/// Rounds the coordinates to those of a LAS file; `result` is the largest change of a coordinate.
TREEFORM_C_API treeform_code treeform_file_round_to_las(treeform_file* file, double* result);

/// Rounds the coordinates to 32-bit floats; `result` is the largest change of a coordinate.
TREEFORM_C_API treeform_code treeform_file_round_to_float32(treeform_file* file, double* result);

/// Transforms the points and normals of the file by a matrix. If it mirrors, faces are flipped, so
/// that they still point outward.
TREEFORM_C_API treeform_code treeform_file_transform(treeform_file* file, const double* matrix);

/// Transforms the normals of the file by a matrix. If it mirrors, outward normals stay outward, as
/// for flipped faces.
TREEFORM_C_API treeform_code treeform_file_transform_normals(treeform_file* file,
                                                             const double* matrix);

/// How to write.
typedef struct treeform_write_options {
    size_t struct_size;
    /// Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, las, laz, glb, 3mf. Empty:
    /// the extension of the path.
    const char* format;
    /// Write text if the format has text and binary. Binary PLY is little endian, unless the file
    /// was read from a big-endian file. PCD is compressed only if it was read from a compressed
    /// file.
    int32_t ascii;
    /// Precision of the coordinates (a `treeform_precision`); -1: the stored precision, but
    /// float32 in 3MF, since most of its readers convert to float. Binary STL and GLB only hold
    /// float32.
    int32_t precision;
    /// Called with numbers below 1 while writing, and with 1 before the file is renamed. If it
    /// returns other than 0, nothing is written, and an existing file is unchanged.
    treeform_progress progress;
    void* progress_data;
    /// [drop_count] Columns of points to omit; "normal", "uv" or "color" for all columns of that
    /// kind, also of corners.
    const char* const* drop;
    size_t drop_count;
    /// [rename_count] Renamed columns of points, as pairs (new name, present name).
    const treeform_named_column* rename;
    size_t rename_count;
    /// [3] For LAS and LAZ: coordinates are multiples of this, plus the offset. By default those
    /// of the file that was read, else chosen by `treeform_write`; or null
    const double* las_scale;
    const double* las_offset;  ///< [3]; or null
} treeform_write_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_write_options_init(treeform_write_options* options, size_t size);

/// The result of `treeform_write`.
typedef struct treeform_written {
    void* owner;
    const char* format;  ///< "stl-binary", "ply-ascii", "obj", ...
    treeform_precision written_as;
    /// Largest change of a coordinate by rounding to `written_as`.
    double max_displacement;
    const treeform_io_warning* warnings;  ///< [warning_count]
    size_t warning_count;
} treeform_written;

/// Writes a file to `path`, completely or not at all; "-" is standard output. Data that the format
/// cannot store is omitted; `written` lists it.
TREEFORM_C_API treeform_code treeform_write(const char* path, const treeform_file* file,
                                            const treeform_write_options* options,
                                            treeform_written** written);

/// The same for a mesh without attributes. `written` may be null.
TREEFORM_C_API treeform_code treeform_write_mesh(const char* path, const treeform_mesh* mesh,
                                                 const treeform_write_options* options,
                                                 treeform_written** written);

/// Writes the mesh of a result in its certified coordinates. Fails if the format would round them,
/// or if the certificate's status is not ok. `written` may be null.
TREEFORM_C_API treeform_code treeform_write_result(const char* path, const treeform_arrays* mesh,
                                                   const treeform_certificate* certificate,
                                                   const treeform_write_options* options,
                                                   treeform_written** written);
// end

/// An array of bytes.
typedef struct treeform_bytes {
    void* owner;
    const unsigned char* bytes;
    size_t count;
} treeform_bytes;

// made of the headers of C++:
//   write_memory() usable_mesh usable_options usable_faces() as_mesh() concatenate_files()
//   scene_of()
/// The bytes of the file, in the format in `options`.
TREEFORM_C_API treeform_code treeform_write_memory(const treeform_file* file,
                                                   const treeform_write_options* options,
                                                   treeform_bytes** bytes);

/// A mesh without NaN or infinite coordinates, and the file's number of each face.
typedef struct treeform_usable_mesh {
    void* owner;
    treeform_arrays mesh;
    /// [F] number of each face's triangle in the file; null: the same numbers
    const uint32_t* triangle_of_face;
    /// Number of triangles with a coordinate that is not finite; for a cloud, number of such
    /// points.
    uint64_t non_finite;
    /// [F] with `details`: component of each face; else null
    const uint32_t* component;
    /// from `treeform_usable_faces`: triangles that are a segment or a point
    uint64_t degenerate;
    uint64_t joined;  ///< from `treeform_usable_faces`: points merged by tolerance
    /// [F] number of each face in the file, counting polygons
    const uint32_t* face_in_file;
    /// [warning_count] from `treeform_as_mesh`: those of the file
    const treeform_io_warning* warnings;
    size_t warning_count;
} treeform_usable_mesh;

/// Options of `treeform_usable_faces`.
typedef struct treeform_usable_options {
    size_t struct_size;
    /// Whether points with equal coordinates are one vertex.
    treeform_vertex_identity vertices;
    /// If greater than 0, points within this distance are joined, as by `treeform_weld`, after
    /// equal points.
    double tolerance;
    const treeform_box* box;  ///< only faces that have a point in the box; or null
    int32_t details;          ///< also compute `component`, and count different points
} treeform_usable_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_usable_options_init(treeform_usable_options* options, size_t size);

/// The usable part of a file's mesh. Points that only dropped faces use are dropped as well.
TREEFORM_C_API treeform_code treeform_usable_faces(const treeform_file* file,
                                                   const treeform_usable_options* options,
                                                   treeform_usable_mesh** mesh);

/// The whole mesh of a file: corners with equal coordinates become one vertex, triangles that are
/// not finite are dropped. Points keep their numbers, so that attributes can be transferred.
TREEFORM_C_API treeform_code treeform_as_mesh(const treeform_file* file,
                                              treeform_usable_mesh** mesh);

/// Concatenates files: one file with all points and faces. `names` [count], or null, are for
/// warnings.
TREEFORM_C_API treeform_code treeform_concatenate_files(const treeform_file* const* files,
                                                        const char* const* names, size_t count,
                                                        treeform_file** file);

/// One scene of all files, each under its name, with materials and textures.
TREEFORM_C_API treeform_code treeform_scene_of(const treeform_file* const* files,
                                               const char* const* names, size_t count,
                                               treeform_file** file);
// end

/// A part of a scene.
typedef struct treeform_scene_part {
    const char* name;
    const treeform_file* file;     ///< with the attributes of its faces and points
    const uint32_t* face_in_file;  ///< [F] the number of each face in the whole file
    size_t face_count;
} treeform_scene_part;

/// The parts of a scene.
typedef struct treeform_scene_parts {
    void* owner;
    const treeform_scene_part* parts;  ///< [count]
    size_t count;
} treeform_scene_parts;

// made of the headers of C++:
//   file_parts()
/// The parts of a file, by its objects, groups or nodes, each as a file of its own. With
/// `combine_patches`, parts with a common point, or whose open edges coincide, are combined.
TREEFORM_C_API treeform_code treeform_file_parts(const treeform_file* file, int32_t combine_patches,
                                                 treeform_scene_parts** parts);
// end

/// Whether scene formats other than glTF and GLB (DAE, FBX, ...) can be read: 0 if treeform was
/// built without assimp.
TREEFORM_C_API int32_t treeform_reads_scenes(void);

/// A robot.
typedef struct treeform_robot treeform_robot;

// made of the headers of C++:
//   read_urdf() urdf_mesh urdf_joint urdf_robot robot_content()
/// Reads the robot at `path`. Joints are fixed, revolute, continuous or prismatic. Boxes,
/// cylinders and spheres become meshes. Mesh files are not read, but must exist.
/// `package://name/rest` resolves to FOLDER/name/rest or FOLDER/rest, where FOLDER is one of
/// `package_folders`, else the folder of the file or one above it. With `visual`, visual meshes
/// are used instead of collision meshes.
TREEFORM_C_API treeform_code treeform_read_urdf(const char* path,
                                                const char* const* package_folders, size_t count,
                                                int32_t visual, treeform_robot** robot);

/// A mesh of a link, from a file or a geometric shape. `place` maps its points to the link's
/// frame.
typedef struct treeform_urdf_mesh {
    uint32_t link;
    const char* file;      ///< empty for a box, a cylinder or a sphere
    double place[12];      ///< the origin, and the scale of the mesh
    const double* points;  ///< [point_count][3] points of a box, cylinder or sphere
    size_t point_count;
    const uint32_t* faces;  ///< [face_count][3]
    size_t face_count;
} treeform_urdf_mesh;

/// A joint: the frame of the child is that of the parent, times the fixed transform of the joint,
/// times its motion.
typedef struct treeform_urdf_joint {
    const char* name;
    int32_t kind;     ///< 0 fixed, 1 revolute, 2 continuous, 3 prismatic
    uint32_t parent;  ///< numbers of links
    uint32_t child;
    double lower;  ///< least value; NaN without limits
    double upper;  ///< greatest value
} treeform_urdf_joint;

/// A robot.
typedef struct treeform_robot_view {
    void* owner;
    const char* name;
    const char* const* links;  ///< [L] names, in the order of the file
    size_t link_count;
    const treeform_urdf_joint* joints;  ///< [joint_count] parents before their children
    size_t joint_count;
    const treeform_urdf_mesh* meshes;  ///< [mesh_count] ordered by link
    size_t mesh_count;
    /// [adjacent_count][2] pairs of links connected by a joint, which need not be compared
    const uint32_t* adjacent;
    size_t adjacent_count;
} treeform_robot_view;

/// The content of a robot, as arrays that the robot owns.
TREEFORM_C_API treeform_code treeform_robot_content(const treeform_robot* robot,
                                                    treeform_robot_view** view);
// end

/// A robot as parts of an assembly, for `treeform_check_poses`: its links that have faces.
typedef struct treeform_robot_parts {
    void* owner;
    const treeform_mesh* const* meshes;  ///< [count] one mesh for each link, in its frame
    const uint32_t* links;               ///< [count] numbers of the links, ascending
    size_t count;
    const uint32_t* adjacent;  ///< [adjacent_count][2] pairs of parts that need not be compared
    size_t adjacent_count;
} treeform_robot_parts;

// made of the headers of C++:
//   robot_parts_of() link_transforms()
/// The parts of a robot: one mesh for each link with faces. Reads the files of its meshes.
TREEFORM_C_API treeform_code treeform_robot_parts_of(const treeform_robot* robot,
                                                     treeform_robot_parts** parts);

/// `places` [link_count][12]: the matrix from each link's frame to the robot's frame, if `joints`
/// [count] have these `values`, in radians or lengths. Joints without a value are at 0.
TREEFORM_C_API treeform_code treeform_link_transforms(const treeform_robot* robot,
                                                      const char* const* joints,
                                                      const double* values, size_t count,
                                                      double* places);
// end
