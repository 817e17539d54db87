#pragma once
/// \file
/// Files: reading, inspecting, changing, joining, splitting into parts, writing; robots.

#include <treeform/c/mesh.h>

/// The content of a mesh or point file: points, faces, all attributes.
typedef struct treeform_file treeform_file;

/// A column by the name that it gets.
typedef struct treeform_named_column {
    const char* name;    ///< "x", "intensity", ...
    const char* source;  ///< what the heading calls it, or its number, from 1
} treeform_named_column;

// made of the headers of C++:
//   read() read_mesh() read_options read_as() read_memory() file_create() file_copy()
//   scalar_type column element part io_warning mesh_file file_look() file_set_points()
//   file_set_column() file_set_texture() file_add_part()
/// Reads the file at `path`, UTF-8; "-" is standard input. `format` is an extension without its
/// dot ("stl", "ply", ...), or null: the content decides, then the extension. Coordinates are as
/// stored.
TREEFORM_C_API treeform_code treeform_read(const char* path, const char* format,
                                           treeform_file** file);

/// The mesh of the file at `path`, in one call: corners with equal coordinates are one vertex,
/// triangles that are not finite are left out. `treeform_read` and `treeform_as_mesh` tell which.
TREEFORM_C_API treeform_code treeform_read_mesh(const char* path, treeform_mesh** mesh);

/// How to read.
typedef struct treeform_read_options {
    size_t size;
    const char* format;  ///< null: by content
    /// [column_count] For XYZ, PTS and CSV: names of columns, as pairs of the new name and the
    /// name in the first line or the column number, from 1: {"x", "easting"}. Columns x, y and z
    /// are the coordinates.
    const treeform_named_column* columns;
    size_t column_count;
    /// call `mesh_file::drop_non_finite`, and add a warning; only for `treeform_read`
    int32_t drop_non_finite;
} treeform_read_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_read_options_init(treeform_read_options* options, size_t size);

/// Reads the file at `path` as `treeform_read` does; options may be null.
TREEFORM_C_API treeform_code treeform_read_as(const char* path,
                                              const treeform_read_options* options,
                                              treeform_file** file);

/// The same of bytes in memory. Errors say `name`.
TREEFORM_C_API treeform_code treeform_read_memory(const void* bytes, size_t size, const char* name,
                                                  const char* format, treeform_file** file);

/// A file without attributes, with copies of the points and faces of a mesh or cloud.
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
    int32_t is_list;  ///< each row is a list of values
    /// the values are those of points or faces, and stored there
    int32_t is_stored_elsewhere;
    const void* values;  ///< [value_count] of the type
    size_t value_count;
    /// [rows + 1] where the list of each row begins; null if there are no lists
    const uint64_t* list_begin;
} treeform_column;

/// A kind of row in a file, such as vertices, with its properties in the order of the file.
typedef struct treeform_rows {
    const char* name;  ///< "vertex", "face", "edge", ...
    size_t rows;
    const treeform_column* columns;  ///< [column_count]
    size_t column_count;
} treeform_rows;

/// Consecutive faces to which a file gives the same names. A part ends where the next one starts.
typedef struct treeform_named_faces {
    const char* object;    ///< OBJ `o`, the name of an STL solid or of a scene's node
    const char* group;     ///< OBJ `g`
    const char* material;  ///< OBJ `usemtl`
    uint32_t first_face;   ///< number in the file
} treeform_named_faces;

/// A remark about a file that was read or written.
typedef struct treeform_warning {
    const char* code;  ///< stable, for scripts: "trailing-bytes", "precision"
    const char* text;  ///< for people
} treeform_warning;

/// The content of a file. Points and faces have the order and numbers of the file: nothing is
/// joined, split, reordered or dropped.
typedef struct treeform_file_view {
    void* owner;
    treeform_arrays mesh;  ///< polygons are cut into a fan from their first corner
    /// [F] the number in the file of the face that each triangle comes from; empty if all faces
    /// are triangles.
    const uint32_t* stored_face;
    size_t stored_faces;  ///< faces in the file
    int32_t indexed;      ///< the format numbers its vertices (STL does not)
    /// float32 if every coordinate is a float32 value, or was one before its node's transform.
    treeform_precision stored_as;
    const char* format;                ///< "stl-binary", "ply-ascii", "obj", ...
    const treeform_warning* warnings;  ///< [warning_count]
    size_t warning_count;
    /// [element_count] In the order of the file. "vertex" has a row for each point, "face" one for
    /// each face as stored.
    const treeform_rows* elements;
    size_t element_count;
    /// [part_count] ascending by first face; empty if nothing is named
    const treeform_named_faces* parts;
    size_t part_count;
    const double* texture;  ///< [texture_count][3] u, v, w
    size_t texture_count;
    const double* normals;  ///< [normal_count][3]
    size_t normal_count;
    /// [F] numbers in `texture`; empty: no corner has any
    const uint32_t* texture_of_corner;
    /// [F] numbers in `normals`; empty: no corner has any
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

/// Looks into a file.
TREEFORM_C_API treeform_code treeform_file_look(const treeform_file* file,
                                                treeform_file_view** view);

/// Replaces the points [count][3], which must be as many as there are: what a placement returns.
TREEFORM_C_API treeform_code treeform_file_set_points(treeform_file* file, const double* points,
                                                      size_t count);

/// Sets a column of `treeform_rows` ("vertex", "face"), one value a row, `values` [rows] of
/// `type`. The rows of vertices and faces are those that the file has. Columns that stand for
/// coordinates or corners are refused.
TREEFORM_C_API treeform_code treeform_file_set_column(treeform_file* file, const char* element,
                                                      const char* name, treeform_scalar type,
                                                      const void* values, size_t rows);

/// Sets texture coordinates `texture` [texture_count][3] and their numbers at each corner of each
/// triangle `of_corner` [F][3], `TREEFORM_NONE` for none.
TREEFORM_C_API treeform_code treeform_file_set_texture(treeform_file* file, const double* texture,
                                                       size_t texture_count,
                                                       const uint32_t* of_corner);

/// Adds a name for the faces from `first_face` on; strings may be null. Names come by ascending
/// faces.
TREEFORM_C_API treeform_code treeform_file_add_part(treeform_file* file, const char* object,
                                                    const char* group, const char* material,
                                                    uint32_t first_face);
// end

/// The kind of a line of text in a file.
typedef int32_t treeform_text;
enum {
    TREEFORM_COMMENT = 0,
    TREEFORM_OBJ_INFO = 1,
    TREEFORM_MATERIAL_FILE = 2,
    TREEFORM_TEXTURE_FILE = 3
};
// made of the headers of C++:
//   file_add_text() file_split_polygons() file_round_to_las() file_round_to_float32()
//   file_transform() file_turn_normals() write_options write_result write() write_mesh()
/// Adds such a line.
TREEFORM_C_API treeform_code treeform_file_add_text(treeform_file* file, treeform_text what,
                                                    const char* text);

/// Makes each triangle a face of its own.
TREEFORM_C_API treeform_code treeform_file_split_polygons(treeform_file* file);

/// Moves the coordinates to those that a LAS file can hold; `moved` is the furthest that one went.
TREEFORM_C_API treeform_code treeform_file_round_to_las(treeform_file* file, double* result);

/// Moves the coordinates to 32-bit floats; `moved` is the furthest that one went.
TREEFORM_C_API treeform_code treeform_file_round_to_float32(treeform_file* file, double* result);

/// Moves all of the file by a matrix; where it mirrors, faces are turned over, so that they look
/// outward as before.
TREEFORM_C_API treeform_code treeform_file_transform(treeform_file* file, const double* matrix);

/// Turns the normals of the file as a matrix does; where it mirrors, for faces that are turned
/// over.
TREEFORM_C_API treeform_code treeform_file_turn_normals(treeform_file* file, const double* matrix);

/// How to write.
typedef struct treeform_write_options {
    size_t size;
    /// Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, las, laz, glb, 3mf. Empty:
    /// that of the path.
    const char* format;
    /// Write text if the format has text and binary. Binary PLY is little endian, unless the file
    /// was read from a big-endian file. PCD is compressed only if it was read from a compressed
    /// file.
    int32_t ascii;
    /// Precision of the coordinates; `TREEFORM_NONE`: the stored precision. Binary STL and GLB
    /// only hold float32. 3MF holds doubles, but most of its readers convert to float, so none
    /// means float32 there; a `treeform_precision`, or -1
    int32_t precision;
    /// the coordinates are certified: fail instead of rounding them. For `treeform_write_mesh`
    int32_t certified;
    /// Called with 0 at the start and during the writing, and with 1 before the file is renamed.
    /// If it returns false, nothing is written, and an existing file is unchanged.
    treeform_progress progress;
    void* progress_data;
    /// [drop_count] Columns of points to omit; "normal", "uv" or "color" for all columns of that
    /// kind, also of corners.
    const char* const* drop;
    size_t drop_count;
    /// [rename_count] Renamed columns of points, as pairs (new name, present name).
    const treeform_named_column* rename;
    size_t rename_count;
    /// [3] For LAS and LAZ; `TREEFORM_NONE`: those of the file, else chosen by `treeform_write`;
    /// or null
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
    const treeform_warning* warnings;  ///< [warning_count]
    size_t warning_count;
} treeform_written;

/// Writes a file to `path`, whole or not at all; "-" is standard output. What a format does not
/// hold is left out: `treeform_written` says what.
TREEFORM_C_API treeform_code treeform_write(const char* path, const treeform_file* file,
                                            const treeform_write_options* options,
                                            treeform_written** written);

/// The same of a mesh without attributes. `treeform_written` may be null.
TREEFORM_C_API treeform_code treeform_write_mesh(const char* path, const treeform_mesh* mesh,
                                                 const treeform_write_options* options,
                                                 treeform_written** written);
// end

/// Bytes.
typedef struct treeform_bytes {
    void* owner;
    const unsigned char* bytes;
    size_t count;
} treeform_bytes;

// made of the headers of C++:
//   write_memory() usable_mesh part_options usable_part() as_mesh() join_files() scene()
/// The bytes of the file, of the format that `options` name.
TREEFORM_C_API treeform_code treeform_write_memory(const treeform_file* file,
                                                   const treeform_write_options* options,
                                                   treeform_bytes** bytes);

/// A mesh without NaN or infinite coordinates, and the file's number of each face.
typedef struct treeform_part {
    void* owner;
    treeform_arrays mesh;
    /// [F] for each face, the number of its triangle in the file; null: the same number
    const uint32_t* triangle_of_face;
    const uint32_t* face_in_file;  ///< [F] the number in the file, counting polygons
    const uint32_t* component;     ///< [F] with `details`: the component; else null
    /// from `treeform_usable_part`: triangles that are a segment or a point
    uint64_t degenerate;
    uint64_t joined;      ///< from `treeform_usable_part`: points merged by tolerance
    uint64_t non_finite;  ///< triangles with a coordinate that is not finite
} treeform_part;

/// Options of `treeform_usable_part`.
typedef struct treeform_part_options {
    size_t size;
    /// Whether points with equal coordinates are one vertex.
    treeform_vertices vertices;
    /// If greater than 0, points within this distance are joined, as by `treeform_weld`, after
    /// equal points.
    double tolerance;
    const treeform_box* box;  ///< only faces that have a point in the box; or null
    int32_t details;          ///< also compute `component` and `distinct`
} treeform_part_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_part_options_init(treeform_part_options* options, size_t size);

/// The part of a file's mesh that can be used. Points that only faces left out use go, too.
TREEFORM_C_API treeform_code treeform_usable_part(const treeform_file* file,
                                                  const treeform_part_options* options,
                                                  treeform_part** part);

/// The whole mesh of a file: corners with equal coordinates become one vertex, triangles that are
/// not finite are left out. Points keep their numbers, so that attributes can be carried.
TREEFORM_C_API treeform_code treeform_as_mesh(const treeform_file* file, treeform_part** part);

/// One file with the points and faces of all. `names` [count] are for warnings; or null.
TREEFORM_C_API treeform_code treeform_join_files(const treeform_file* const* files,
                                                 const char* const* names, size_t count,
                                                 treeform_file** file);

/// All files in one scene, each under its name, with materials and textures.
TREEFORM_C_API treeform_code treeform_scene(const treeform_file* const* files,
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
//   split_parts()
/// The parts of a file by its objects, groups or nodes, each as a file of its own. Parts that have
/// points or open edges in common are one.
TREEFORM_C_API treeform_code treeform_split_parts(const treeform_file* file,
                                                  treeform_scene_parts** parts);
// end

/// Whether other scenes than glTF and GLB (DAE, FBX, ...) can be read: 0 if treeform was built
/// without assimp.
TREEFORM_C_API int32_t treeform_reads_scenes(void);

/// A robot.
typedef struct treeform_robot treeform_robot;

// made of the headers of C++:
//   read_urdf() urdf_mesh urdf_joint urdf_robot robot_look()
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
typedef struct treeform_robot_mesh {
    uint32_t link;
    const char* file;      ///< "" if it was generated
    double place[12];      ///< the origin, and the scale of the mesh
    const double* points;  ///< [point_count][3] of generated meshes
    size_t point_count;
    const uint32_t* faces;  ///< [face_count][3]
    size_t face_count;
} treeform_robot_mesh;

/// A joint: the child's frame is that of the parent, times `origin`, times the motion of the
/// joint.
typedef struct treeform_robot_joint {
    const char* name;
    int32_t kind;
    uint32_t parent;  ///< numbers of links
    uint32_t child;
    double lower;  ///< the limits; NaN: unlimited
    double upper;
} treeform_robot_joint;

/// A robot.
typedef struct treeform_robot_view {
    void* owner;
    const char* name;
    const char* const* links;  ///< [L] names, in the order of the file
    size_t link_count;
    /// [joint_count] parents before their children
    const treeform_robot_joint* joints;
    size_t joint_count;
    const treeform_robot_mesh* meshes;  ///< [mesh_count] ordered by link
    size_t mesh_count;
    /// [adjacent_count][2] pairs of links that are connected by a joint, and always touch
    const uint32_t* adjacent;
    size_t adjacent_count;
} treeform_robot_view;

/// Looks into a robot.
TREEFORM_C_API treeform_code treeform_robot_look(const treeform_robot* robot,
                                                 treeform_robot_view** view);
// end

/// A robot as parts of an assembly, for `treeform_check_poses`: its links that have faces.
typedef struct treeform_robot_parts {
    void* owner;
    const treeform_mesh* const* meshes;  ///< [count] all meshes of a link as one, in its frame
    const uint32_t* links;               ///< [count] ascending
    size_t count;
    const uint32_t* adjacent;  ///< [adjacent_count][2] pairs of parts that need not be compared
    size_t adjacent_count;
} treeform_robot_parts;

// made of the headers of C++:
//   robot_parts_of() link_transforms()
/// The parts of a robot; reads the files of its meshes.
TREEFORM_C_API treeform_code treeform_robot_parts_of(const treeform_robot* robot,
                                                     treeform_robot_parts** parts);

/// `places` [link_count][12]: where each link is when `joints` [count] have these `values`, in
/// radians or lengths. Joints without a value are at 0.
TREEFORM_C_API treeform_code treeform_link_transforms(const treeform_robot* robot,
                                                      const char* const* joints,
                                                      const double* values, size_t count,
                                                      double* places);
// end
