// Made by tools/bindings of files.h and the headers of C++: see its README.
#include <treeform/mesh/read.hpp>

#include <tools/c/files.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static_assert(TREEFORM_INT8 == static_cast<int>(tf::scalar_type::int8));
static_assert(TREEFORM_UINT8 == static_cast<int>(tf::scalar_type::uint8));
static_assert(TREEFORM_INT16 == static_cast<int>(tf::scalar_type::int16));
static_assert(TREEFORM_UINT16 == static_cast<int>(tf::scalar_type::uint16));
static_assert(TREEFORM_INT32 == static_cast<int>(tf::scalar_type::int32));
static_assert(TREEFORM_UINT32 == static_cast<int>(tf::scalar_type::uint32));
static_assert(TREEFORM_INT64 == static_cast<int>(tf::scalar_type::int64));
static_assert(TREEFORM_UINT64 == static_cast<int>(tf::scalar_type::uint64));
static_assert(TREEFORM_SCALAR_FLOAT32 == static_cast<int>(tf::scalar_type::float32));
static_assert(TREEFORM_SCALAR_FLOAT64 == static_cast<int>(tf::scalar_type::float64));

void glue::fill(keeper&, const tf::io_warning& from, treeform_warning& to) {
    to.code = from.code.c_str();
    to.text = from.text.c_str();
}

void glue::fill(keeper&, const tf::column& from, treeform_column& to) {
    to.name = from.name.c_str();
    to.type = static_cast<treeform_scalar>(from.type);
    to.is_list = from.list_length.has_value();
    to.is_stored_elsewhere = from.role != tf::column_role::data;
    to.values = from.values.data();
    to.value_count = from.size();
    if (from.list_length) to.list_begin = from.list_begin.data();
}

void glue::fill(keeper& kept, const tf::element& from, treeform_rows& to) {
    to.name = from.name.c_str();
    to.rows = from.rows;
    to.columns = list<treeform_column>(kept, from.columns);
    to.column_count = from.columns.size();
}

void glue::fill(keeper&, const tf::part& from, treeform_named_faces& to) {
    to.object = from.object.c_str();
    to.group = from.group.c_str();
    to.material = from.material.c_str();
    to.first_face = from.first_face;
}

void glue::fill(keeper& kept, const tf::mesh_file& from, treeform_file_view& to) {
    to.mesh = arrays(from.mesh);
    to.stored_face = or_null(from.stored_face);
    to.stored_faces = from.stored_faces;
    to.indexed = from.indexed;
    to.stored_as = static_cast<treeform_precision>(from.stored_as);
    to.format = from.format.c_str();
    to.warnings = list<treeform_warning>(kept, from.warnings);
    to.warning_count = from.warnings.size();
    to.elements = list<treeform_rows>(kept, from.attributes.elements);
    to.element_count = from.attributes.elements.size();
    to.texture = flat(from.attributes.corners.texture);
    to.texture_count = from.attributes.corners.texture.size();
    to.normals = flat(from.attributes.corners.normals);
    to.normal_count = from.attributes.corners.normals.size();
    to.texture_of_corner = flat(from.attributes.corners.texture_of_corner);
    to.normal_of_corner = flat(from.attributes.corners.normal_of_corner);
    to.parts = list<treeform_named_faces>(kept, from.attributes.parts);
    to.part_count = from.attributes.parts.size();
    to.material_files = words(kept, from.attributes.material_files);
    to.material_file_count = from.attributes.material_files.size();
    to.texture_files = words(kept, from.attributes.texture_files);
    to.texture_file_count = from.attributes.texture_files.size();
    to.comments = words(kept, from.attributes.comments);
    to.comment_count = from.attributes.comments.size();
    to.obj_info = words(kept, from.attributes.obj_info);
    to.obj_info_count = from.attributes.obj_info.size();
    to.is_las = from.las.has_value();
    if (from.las) std::copy(from.las->scale.begin(), from.las->scale.end(), to.las_scale);
    if (from.las) std::copy(from.las->offset.begin(), from.las->offset.end(), to.las_offset);
}

tf::read_options glue::read(const treeform_read_options* options) {
    return read(chosen(options, treeform_read_options_init));
}
tf::read_options glue::read(const treeform_read_options& o) {
    tf::read_options how;
    how.columns = columns_of(o.columns, o.column_count, "columns");

    how.drop_non_finite = o.drop_non_finite != 0;

    return how;
}

void treeform_read_options_init(treeform_read_options* options, size_t size) {
    treeform_read_options to{};
    const tf::read_options from;
    to.drop_non_finite = from.drop_non_finite;
    glue::init(options, size, to);
}

tf::write_options glue::read(const treeform_write_options* options) {
    return read(chosen(options, treeform_write_options_init));
}
tf::write_options glue::read(const treeform_write_options& o) {
    tf::write_options how;
    how.format = text(o.format);
    how.ascii = o.ascii != 0;
    if (o.precision != -1) how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.drop = texts(o.drop, o.drop_count, "drop");

    how.rename = columns_of(o.rename, o.rename_count, "rename");

    how.las_scale = axes(o.las_scale);
    how.las_offset = axes(o.las_offset);
    how.progress = progress(o);

    return how;
}

void treeform_write_options_init(treeform_write_options* options, size_t size) {
    treeform_write_options to{};
    const tf::write_options from;
    to.ascii = from.ascii;
    to.precision = -1;
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::write_result& from, treeform_written& to) {
    to.format = from.format.c_str();
    to.written_as = static_cast<treeform_precision>(from.written_as);
    to.max_displacement = from.max_displacement;
    to.warnings = list<treeform_warning>(kept, from.warnings);
    to.warning_count = from.warnings.size();
}

tf::part_options glue::read(const treeform_part_options* options) {
    return read(chosen(options, treeform_part_options_init));
}
tf::part_options glue::read(const treeform_part_options& o) {
    tf::part_options how;
    how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.tolerance = o.tolerance;
    how.box = box(o.box);
    how.details = o.details != 0;
    return how;
}

void treeform_part_options_init(treeform_part_options* options, size_t size) {
    treeform_part_options to{};
    const tf::part_options from;
    to.vertices = static_cast<treeform_vertices>(from.vertices);
    to.tolerance = from.tolerance;
    to.details = from.details;
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::usable_mesh& from, treeform_part& to) {
    to.mesh = arrays(from.mesh);
    to.triangle_of_face = or_null(from.triangle_of_face);
    to.non_finite = from.non_finite;
    to.component = or_null(from.component);
    to.degenerate = from.degenerate;
    to.joined = from.joined;
    to.face_in_file = faces_in_file(kept, from).data();
}

void glue::fill(keeper&, const tf::urdf_joint& from, treeform_robot_joint& to) {
    to.name = from.name.c_str();
    to.kind = static_cast<int32_t>(from.kind);
    to.parent = from.parent;
    to.child = from.child;
    to.lower = from.limits ? (*from.limits)[0] : not_known;
    to.upper = from.limits ? (*from.limits)[1] : not_known;
}

void glue::fill(keeper& kept, const tf::urdf_mesh& from, treeform_robot_mesh& to) {
    to.link = from.link;
    to.file = kept.keep(from.file.string()).c_str();
    copy(from.place, to.place);
    to.points = flat(from.shape.points);
    to.point_count = from.shape.points.size();
    to.faces = flat(from.shape.faces);
    to.face_count = from.shape.faces.size();
}

void glue::fill(keeper& kept, const tf::urdf_robot& from, treeform_robot_view& to) {
    to.name = from.name.c_str();
    to.links = words(kept, from.links);
    to.link_count = from.links.size();
    to.joints = list<treeform_robot_joint>(kept, from.joints);
    to.joint_count = from.joints.size();
    to.meshes = list<treeform_robot_mesh>(kept, from.meshes);
    to.mesh_count = from.meshes.size();
    const auto& adjacent = kept.keep(from.adjacent());
    to.adjacent = flat(adjacent);
    to.adjacent_count = adjacent.size();
}

treeform_code treeform_read(const char* path, const char* format, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::read(std::string(&glue::need(path, "path")), glue::text(format)),
                          file);
    });
}

treeform_code treeform_read_mesh(const char* path, treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        return glue::give(glue::read_mesh(std::string(&glue::need(path, "path"))), mesh);
    });
}

treeform_code treeform_read_as(const char* path, const treeform_read_options* options,
                               treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::read_as(std::string(&glue::need(path, "path")), options), file);
    });
}

treeform_code treeform_read_memory(const void* bytes, size_t size, const char* name,
                                   const char* format, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::read_memory(bytes, size, name, glue::text(format)), file);
    });
}

treeform_code treeform_file_create(const treeform_mesh* mesh, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::file_create(mesh), file);
    });
}

treeform_code treeform_file_copy(const treeform_file* file, treeform_file** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(glue::file_copy(glue::content(file, "file")), made);
    });
}

treeform_code treeform_file_look(const treeform_file* file, treeform_file_view** view) {
    return glue::guard([&] {
        glue::start(view);
        return glue::give(glue::file_look(glue::content(file, "file")), view);
    });
}

treeform_code treeform_file_set_points(treeform_file* file, const double* points, size_t count) {
    return glue::guard([&] {
        glue::file_set_points(glue::content(file, "file"), glue::points(points, count, "points"));
    });
}

treeform_code treeform_file_set_column(treeform_file* file, const char* element, const char* name,
                                       treeform_scalar type, const void* values, size_t rows) {
    return glue::guard([&] {
        glue::file_set_column(glue::content(file, "file"),
                              std::string(&glue::need(element, "element")),
                              std::string(&glue::need(name, "name")),
                              glue::choice<tf::scalar_type>(type, 10, "type"), values, rows);
    });
}

treeform_code treeform_file_set_texture(treeform_file* file, const double* texture,
                                        size_t texture_count, const uint32_t* of_corner) {
    return glue::guard([&] {
        glue::file_set_texture(glue::content(file, "file"), texture, texture_count, of_corner);
    });
}

treeform_code treeform_file_add_part(treeform_file* file, const char* object, const char* group,
                                     const char* material, uint32_t first_face) {
    return glue::guard([&] {
        glue::file_add_part(glue::content(file, "file"), object, group, material, first_face);
    });
}

treeform_code treeform_file_add_text(treeform_file* file, treeform_text what, const char* text) {
    return glue::guard([&] {
        glue::file_add_text(glue::content(file, "file"), what,
                            std::string(&glue::need(text, "text")));
    });
}

treeform_code treeform_file_split_polygons(treeform_file* file) {
    return glue::guard([&] { glue::file_split_polygons(glue::content(file, "file")); });
}

treeform_code treeform_file_round_to_las(treeform_file* file, double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::file_round_to_las(glue::content(file, "file"));
    });
}

treeform_code treeform_file_round_to_float32(treeform_file* file, double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::file_round_to_float32(glue::content(file, "file"));
    });
}

treeform_code treeform_file_transform(treeform_file* file, const double* matrix) {
    return glue::guard([&] { glue::file_transform(glue::content(file, "file"), matrix); });
}

treeform_code treeform_file_turn_normals(treeform_file* file, const double* matrix) {
    return glue::guard([&] { glue::file_turn_normals(glue::content(file, "file"), matrix); });
}

treeform_code treeform_write(const char* path, const treeform_file* file,
                             const treeform_write_options* options, treeform_written** written) {
    return glue::guard([&] {
        glue::give_written(
            [&] {
                return glue::write(std::string(&glue::need(path, "path")),
                                   glue::content(file, "file"), glue::read(options));
            },
            written);
    });
}

treeform_code treeform_write_mesh(const char* path, const treeform_mesh* mesh,
                                  const treeform_write_options* options,
                                  treeform_written** written) {
    return glue::guard([&] {
        glue::give_written(
            [&] { return glue::write_mesh(std::string(&glue::need(path, "path")), mesh, options); },
            written);
    });
}

treeform_code treeform_write_memory(const treeform_file* file,
                                    const treeform_write_options* options, treeform_bytes** bytes) {
    return glue::guard([&] {
        glue::start(bytes);
        return glue::give(glue::write_memory(glue::content(file, "file"), glue::read(options)),
                          bytes);
    });
}

treeform_code treeform_usable_part(const treeform_file* file, const treeform_part_options* options,
                                   treeform_part** part) {
    return glue::guard([&] {
        glue::start(part);
        return glue::give(glue::usable_part(glue::content(file, "file"), glue::read(options)),
                          part);
    });
}

treeform_code treeform_as_mesh(const treeform_file* file, treeform_part** part) {
    return glue::guard([&] {
        glue::start(part);
        return glue::give(glue::as_mesh(glue::content(file, "file")), part);
    });
}

treeform_code treeform_join_files(const treeform_file* const* files, const char* const* names,
                                  size_t count, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::join_files(files, names, count), file);
    });
}

treeform_code treeform_scene(const treeform_file* const* files, const char* const* names,
                             size_t count, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::scene(files, names, count), file);
    });
}

treeform_code treeform_split_parts(const treeform_file* file, treeform_scene_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        return glue::give(glue::split_parts(glue::content(file, "file")), parts);
    });
}

treeform_code treeform_read_urdf(const char* path, const char* const* package_folders, size_t count,
                                 int32_t visual, treeform_robot** robot) {
    return glue::guard([&] {
        glue::start(robot);
        return glue::give(
            tf::read_urdf(std::string(&glue::need(path, "path")),
                          glue::paths(package_folders, count, "package_folders"), visual != 0),
            robot);
    });
}

treeform_code treeform_robot_look(const treeform_robot* robot, treeform_robot_view** view) {
    return glue::guard([&] {
        glue::start(view);
        return glue::give(glue::robot_look(glue::content(robot, "robot")), view);
    });
}

treeform_code treeform_robot_parts_of(const treeform_robot* robot, treeform_robot_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        return glue::give(glue::robot_parts_of(glue::content(robot, "robot")), parts);
    });
}

treeform_code treeform_link_transforms(const treeform_robot* robot, const char* const* joints,
                                       const double* values, size_t count, double* places) {
    return glue::guard([&] {
        glue::link_transforms(glue::content(robot, "robot"), joints, values, count, places);
    });
}
