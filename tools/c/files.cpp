#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <tools/c/files.hpp>

#include <algorithm>
#include <cstddef>

namespace tf = treeform;

namespace {

const tf::mesh_file& content(const treeform_file* file) { return glue::need(file, "file").content; }

template <class C>
const treeform_rows* elements_of(glue::answer<C>& owner, const std::vector<tf::element>& from) {
    std::vector<treeform_rows> elements;
    for (const tf::element& e : from) {
        std::vector<treeform_column> columns;
        for (const tf::column& c : e.columns)
            columns.push_back({c.name.c_str(), static_cast<treeform_scalar>(c.type),
                               c.list_length.has_value(), c.role != tf::column_role::data,
                               c.values.data(), c.size(),
                               c.list_length ? c.list_begin.data() : nullptr});
        elements.push_back(
            {e.name.c_str(), e.rows, owner.keep(std::move(columns)).data(), e.columns.size()});
    }
    return owner.keep(std::move(elements)).data();
}

void describe(glue::answer<treeform_file_view>& owner, const tf::attributes& a) {
    treeform_file_view& v = owner.value;
    v.elements = elements_of(owner, a.elements);
    v.element_count = a.elements.size();
    std::vector<treeform_named_faces> parts;
    for (const tf::part& p : a.parts)
        parts.push_back({p.object.c_str(), p.group.c_str(), p.material.c_str(), p.first_face});
    v.parts = owner.keep(std::move(parts)).data();
    v.part_count = a.parts.size();
    v.texture = a.corners.texture.empty() ? nullptr : a.corners.texture.data()->data();
    v.texture_count = a.corners.texture.size();
    v.normals = glue::flat(a.corners.normals);
    v.normal_count = a.corners.normals.size();
    if (!a.corners.texture_of_corner.empty())
        v.texture_of_corner = a.corners.texture_of_corner.data()->data();
    if (!a.corners.normal_of_corner.empty())
        v.normal_of_corner = a.corners.normal_of_corner.data()->data();
    v.material_files = glue::words(owner, a.material_files);
    v.material_file_count = a.material_files.size();
    v.texture_files = glue::words(owner, a.texture_files);
    v.texture_file_count = a.texture_files.size();
    v.comments = glue::words(owner, a.comments);
    v.comment_count = a.comments.size();
    v.obj_info = glue::words(owner, a.obj_info);
    v.obj_info_count = a.obj_info.size();
}

template <class T>
tf::column column_of(const char* name, const void* values, std::size_t rows) {
    const auto* const first = static_cast<const T*>(values);
    return tf::column::of<T>(name, glue::array(first, rows, "values"));
}

std::size_t rows_in(const tf::mesh_file& file, std::string_view element) {
    if (element == "vertex") return file.mesh.points.size();
    if (element == "face")
        return file.stored_face.empty() ? file.mesh.faces.size() : file.stored_faces;
    const tf::element* const found = file.attributes.find(element);
    return found ? found->rows : static_cast<std::size_t>(-1);
}

/// A certified mesh as `write` takes it.
struct certified_mesh {
    tf::certificate certificate{};
    tf::mesh mesh{};
    [[nodiscard]] const tf::mesh& value() const { return mesh; }
};

void give_part(tf::usable_mesh from, treeform_part** out) {
    auto made = glue::make<treeform_part>();
    const tf::usable_mesh& kept = made->keep(std::move(from));
    std::vector<std::uint32_t> in_file(kept.mesh.faces.size());
    for (std::uint32_t f = 0; f < in_file.size(); ++f) in_file[f] = kept.face_in_file(f);
    treeform_part& p = made->value;
    p.mesh = glue::arrays(kept.mesh);
    p.triangle_of_face = kept.triangle_of_face.empty() ? nullptr : kept.triangle_of_face.data();
    p.face_in_file = made->keep(std::move(in_file)).data();
    p.component = kept.component.empty() ? nullptr : kept.component.data();
    p.dropped = kept.dropped;
    p.degenerate = kept.degenerate;
    p.joined = kept.joined;
    glue::give(std::move(made), out);
}

std::vector<std::string> names_of(const char* const* names, std::size_t count) {
    if (names) return glue::texts(names, count, "names");
    std::vector<std::string> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back("input " + std::to_string(i));
    return result;
}

std::optional<std::array<double, 3>> axes_of(const double* axes) {
    if (!axes) return std::nullopt;
    return std::array{axes[0], axes[1], axes[2]};
}

}  // namespace

std::vector<tf::named_column> glue::columns_of(const treeform_named_column* columns,
                                               std::size_t count, const char* what) {
    std::vector<tf::named_column> all;
    if (count > 0) (void)glue::need(columns, what);
    for (std::size_t i = 0; i < count; ++i)
        all.push_back({&glue::need(columns[i].name, what), &glue::need(columns[i].source, what)});
    return all;
}

tf::write_options glue::write_options_of(const treeform_write_options* options) {
    const auto o = chosen(options, treeform_write_options_init);
    tf::write_options result;
    result.format = text(o.format);
    result.ascii = o.ascii != 0;
    if (o.precision != -1) result.precision = precision(o.precision);
    result.progress = progress(o);
    if (o.drop_count > 0) result.drop = texts(o.drop, o.drop_count, "drop");
    result.rename = glue::columns_of(o.rename, o.rename_count, "rename");
    result.las_scale = axes_of(o.las_scale);
    result.las_offset = axes_of(o.las_offset);
    return result;
}

void glue::give_written(tf::write_result from, treeform_written** out) {
    if (from.status == tf::status::cancelled) throw cancelled{};
    if (!out) return;
    auto made = make<treeform_written>();
    const tf::write_result& kept = made->keep(std::move(from));
    made->value.format = kept.format.c_str();
    made->value.written_as = static_cast<treeform_precision>(kept.written_as);
    made->value.max_displacement = kept.max_displacement;
    made->value.warnings = keep(*made, kept.warnings);
    made->value.warning_count = kept.warnings.size();
    give(std::move(made), out);
}

treeform_code treeform_read(const char* path, const char* format, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        glue::give(tf::read(&glue::need(path, "path"), glue::text(format)), file);
    });
}

treeform_code treeform_read_memory(const void* bytes, size_t size, const char* name,
                                   const char* format, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        const std::span all = glue::array(static_cast<const std::byte*>(bytes), size, "bytes");
        glue::give(tf::read(all, name ? name : "memory", glue::text(format)), file);
    });
}

treeform_code treeform_file_create(const treeform_mesh* mesh, treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        const tf::mesh_view view = glue::view(mesh);
        tf::mesh_file made;
        made.mesh.points.assign(view.points.begin(), view.points.end());
        if (!mesh->prepared->is_cloud())
            made.mesh.faces.assign(view.faces.begin(), view.faces.end());
        made.stored_faces = made.mesh.faces.size();
        glue::give(std::move(made), file);
    });
}

treeform_code treeform_file_copy(const treeform_file* file, treeform_file** copy) {
    return glue::guard([&] {
        glue::start(copy);
        glue::give(tf::mesh_file(content(file)), copy);
    });
}

treeform_code treeform_file_look(const treeform_file* file, treeform_file_view** view) {
    return glue::guard([&] {
        glue::start(view);
        const tf::mesh_file& from = content(file);
        auto made = glue::make<treeform_file_view>();
        treeform_file_view& v = made->value;
        v.mesh = glue::arrays(from.mesh);
        v.stored_face = from.stored_face.empty() ? nullptr : from.stored_face.data();
        v.stored_faces = from.stored_faces;
        v.indexed = from.indexed;
        v.stored_as = static_cast<treeform_precision>(from.stored_as);
        v.format = from.format.c_str();
        v.warnings = glue::keep(*made, from.warnings);
        v.warning_count = from.warnings.size();
        describe(*made, from.attributes);
        v.is_las = from.las.has_value();
        if (from.las) {
            std::copy(from.las->scale.begin(), from.las->scale.end(), v.las_scale);
            std::copy(from.las->offset.begin(), from.las->offset.end(), v.las_offset);
        }
        glue::give(std::move(made), view);
    });
}

treeform_code treeform_file_set_points(treeform_file* file, const double* points, size_t count) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const tf::points_view all = glue::points(points, count, "points");
        if (count != to.mesh.points.size())
            throw std::invalid_argument(std::to_string(count) + " points for a file of " +
                                        std::to_string(to.mesh.points.size()));
        to.mesh.points.assign(all.begin(), all.end());
        if (!tf::fits_single(to.mesh.points)) to.stored_as = tf::precision::float64;
    });
}

treeform_code treeform_file_set_column(treeform_file* file, const char* element, const char* name,
                                       treeform_scalar type, const void* values, size_t rows) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const std::string of = &glue::need(element, "element");
        (void)glue::need(name, "name");
        const std::size_t wanted = rows_in(to, of);
        if (wanted != static_cast<std::size_t>(-1) && wanted != rows)
            throw std::invalid_argument(std::to_string(rows) + " values of \"" + name + "\" for " +
                                        std::to_string(wanted) + " rows of \"" + of + "\"");
        if (const tf::element* const rows_of = to.attributes.find(of))
            if (const tf::column* const before = rows_of->find(name);
                before && before->role != tf::column_role::data)
                throw std::invalid_argument("\"" + std::string(name) +
                                            "\" stands for what points and faces hold");
        tf::column column =
            tf::with_type(glue::choice<tf::scalar_type>(type, 10, "type"),
                          [&](auto one) { return column_of<decltype(one)>(name, values, rows); });
        if (of == "face" && to.stored_face.empty()) to.stored_faces = to.mesh.faces.size();
        to.attributes.obtain(of, rows).set(std::move(column));
    });
}

treeform_code treeform_file_set_texture(treeform_file* file, const double* texture,
                                        size_t texture_count, const uint32_t* of_corner) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const std::span uvw = glue::array(texture, 3 * texture_count, "texture");
        const std::span corners = glue::faces(of_corner, to.mesh.faces.size(), "of_corner");
        tf::corner_values made = to.attributes.corners;
        made.texture.resize(texture_count);
        made.has_w = false;
        for (std::size_t i = 0; i < texture_count; ++i) {
            made.texture[i] = {uvw[3 * i], uvw[3 * i + 1], uvw[3 * i + 2]};
            made.has_w = made.has_w || made.texture[i][2] != 0.0;
        }
        made.texture_of_corner.assign(corners.begin(), corners.end());
        if (const std::string fault = made.fault(to.mesh.faces.size()); !fault.empty())
            throw std::invalid_argument(fault);
        to.attributes.corners = std::move(made);
    });
}

treeform_code treeform_file_add_part(treeform_file* file, const char* object, const char* group,
                                     const char* material, uint32_t first_face) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        std::vector<tf::part>& parts = to.attributes.parts;
        const std::size_t faces = rows_in(to, "face");
        if (first_face > faces || (!parts.empty() && first_face < parts.back().first_face))
            throw std::invalid_argument("a part cannot begin at face " +
                                        std::to_string(first_face));
        parts.push_back({glue::text(object), glue::text(group), glue::text(material), first_face});
    });
}

treeform_code treeform_file_add_text(treeform_file* file, treeform_text what, const char* text) {
    return glue::guard([&] {
        tf::attributes& a = glue::need(file, "file").content.attributes;
        std::vector<std::string>* const lists[] = {&a.comments, &a.obj_info, &a.material_files,
                                                   &a.texture_files};
        const auto which = glue::choice<std::uint32_t>(what, 4, "what");
        lists[which]->emplace_back(&glue::need(text, "text"));
    });
}

treeform_code treeform_file_split_polygons(treeform_file* file) {
    return glue::guard([&] { glue::need(file, "file").content.split_polygons(); });
}

treeform_code treeform_file_round_to_las(treeform_file* file, double* moved) {
    return glue::guard([&] {
        (void)glue::need(moved, "moved");
        *moved = tf::round_to_las(glue::need(file, "file").content);
    });
}

treeform_code treeform_file_round_to_float32(treeform_file* file, double* moved) {
    return glue::guard([&] {
        (void)glue::need(moved, "moved");
        *moved = glue::need(file, "file").content.round_to_float32();
    });
}

treeform_code treeform_file_transform(treeform_file* file, const double* matrix) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const tf::transform<3> by = glue::matrix(&glue::need(matrix, "matrix"));
        if (!by.finite()) throw std::invalid_argument("the matrix is not finite");
        to.move(by);
    });
}

void treeform_read_options_init(treeform_read_options* options, size_t size) {
    glue::init(options, size, treeform_read_options{});
}

treeform_code treeform_read_as(const char* path, const treeform_read_options* options,
                               treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        const auto o = glue::chosen(options, treeform_read_options_init);
        glue::give(tf::read(&glue::need(path, "path"), glue::text(o.format),
                            {.columns = glue::columns_of(o.columns, o.column_count, "columns"),
                             .drop_nan = o.drop_nan != 0}),
                   file);
    });
}

treeform_code treeform_file_turn_normals(treeform_file* file, const double* matrix) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const tf::transform<3> by = glue::matrix(&glue::need(matrix, "matrix"));
        if (!by.finite()) throw std::invalid_argument("the matrix is not finite");
        to.turn_normals(by);
    });
}

void treeform_write_options_init(treeform_write_options* options, size_t size) {
    treeform_write_options defaults{};
    defaults.precision = -1;
    glue::init(options, size, defaults);
}

treeform_code treeform_write(const char* path, const treeform_file* file,
                             const treeform_write_options* options, treeform_written** written) {
    return glue::guard([&] {
        if (written) *written = nullptr;
        glue::give_written(
            tf::write(&glue::need(path, "path"), content(file), glue::write_options_of(options)),
            written);
    });
}

treeform_code treeform_write_mesh(const char* path, const treeform_mesh* mesh,
                                  const treeform_write_options* options,
                                  treeform_written** written) {
    return glue::guard([&] {
        if (written) *written = nullptr;
        const auto o = glue::chosen(options, treeform_write_options_init);
        const tf::write_options how = glue::write_options_of(&o);
        (void)glue::need(path, "path");
        const tf::mesh_view view = glue::view(mesh);
        certified_mesh copy;
        copy.mesh.points.assign(view.points.begin(), view.points.end());
        if (!mesh->prepared->is_cloud())
            copy.mesh.faces.assign(view.faces.begin(), view.faces.end());
        glue::give_written(o.certified != 0 ? tf::write(path, copy, how)
                                            : tf::write(path, std::move(copy.mesh), how),
                           written);
    });
}

treeform_code treeform_write_memory(const treeform_file* file,
                                    const treeform_write_options* options, treeform_bytes** bytes) {
    return glue::guard([&] {
        glue::start(bytes);
        auto made = glue::make<treeform_bytes>();
        const std::string& kept =
            made->keep(tf::write_to_memory(content(file), glue::write_options_of(options)));
        made->value.bytes = reinterpret_cast<const unsigned char*>(kept.data());
        made->value.count = kept.size();
        glue::give(std::move(made), bytes);
    });
}

void treeform_part_options_init(treeform_part_options* options, size_t size) {
    glue::init(options, size, treeform_part_options{});
}

treeform_code treeform_usable_part(const treeform_file* file, const treeform_part_options* options,
                                   treeform_part** part) {
    return glue::guard([&] {
        glue::start(part);
        const auto o = glue::chosen(options, treeform_part_options_init);
        const tf::mesh_file& from = content(file);
        tf::part_options how;
        how.vertices = glue::vertices(o.vertices);
        how.tolerance = o.tolerance;
        if (o.box) how.box = glue::box(*o.box);
        how.details = o.details != 0;
        give_part(tf::usable_part(from.mesh, from.stored_face, how), part);
    });
}

treeform_code treeform_as_mesh(const treeform_file* file, treeform_part** part) {
    return glue::guard([&] {
        glue::start(part);
        const tf::mesh_file& from = content(file);
        tf::mesh_file plain;
        plain.mesh = from.mesh;
        plain.stored_face = from.stored_face;
        plain.stored_faces = from.stored_faces;
        plain.indexed = from.indexed;
        give_part(tf::as_mesh(std::move(plain)), part);
    });
}

treeform_code treeform_join_files(const treeform_file* const* files, const char* const* names,
                                  size_t count, treeform_file** joined) {
    return glue::guard([&] {
        glue::start(joined);
        std::vector<tf::mesh_file> all;
        for (const treeform_file* one : glue::array(files, count, "files"))
            all.push_back(content(one));
        if (all.empty()) throw std::invalid_argument("no files to join");
        const std::vector<std::string> labels = names_of(names, count);
        glue::give(tf::join(std::move(all), labels), joined);
    });
}

treeform_code treeform_scene(const treeform_file* const* files, const char* const* names,
                             size_t count, treeform_file** scene) {
    return glue::guard([&] {
        glue::start(scene);
        const std::span all = glue::array(files, count, "files");
        if (all.empty()) throw std::invalid_argument("no files for the scene");
        const std::vector<std::string> labels = names_of(names, count);
        std::vector<tf::scene_member> members;
        for (std::size_t i = 0; i < count; ++i)
            members.push_back({&content(all[i]), labels[i], labels[i]});
        glue::give(tf::scene_of(members), scene);
    });
}

treeform_code treeform_split_parts(const treeform_file* file, treeform_scene_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        auto made = glue::make<treeform_scene_parts>();
        std::vector<treeform_scene_part> all;
        auto& found = made->keep(tf::split_parts({.file = &content(file)}));
        for (tf::file_part& one : found) {
            const std::size_t faces = one.stored_face.size();
            all.push_back({one.name.c_str(), glue::keep(*made, std::move(one.file)),
                           one.stored_face.data(), faces});
        }
        made->value.count = all.size();
        made->value.parts = made->keep(std::move(all)).data();
        glue::give(std::move(made), parts);
    });
}

treeform_code treeform_files_of(const char* const* paths, size_t count,
                                treeform_file_content content, treeform_strings** files) {
    return glue::guard([&] {
        glue::start(files);
        auto made = glue::make<treeform_strings>();
        const auto& found =
            made->keep(tf::files_of(glue::texts(paths, count, "paths"),
                                    glue::choice<tf::file_content>(content, 2, "content")));
        made->value.values = glue::words(*made, found);
        made->value.count = found.size();
        glue::give(std::move(made), files);
    });
}

int32_t treeform_reads_scenes(void) { return tf::reads_scenes(); }
