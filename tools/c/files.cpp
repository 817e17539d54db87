#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>
#include <cstddef>

namespace tf = treeform;

namespace {

const tf::mesh_file& content(const treeform_file* file) { return glue::need(file, "file").content; }

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

std::vector<std::string> names_of(const char* const* names, std::size_t count) {
    if (names) return glue::texts(names, count, "names");
    std::vector<std::string> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back("input " + std::to_string(i));
    return result;
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

void glue::give_written(tf::write_result from, treeform_written** out) {
    check(from.status);
    if (!out) return;
    (void)give(std::move(from), out);
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

treeform_code treeform_file_look(const treeform_file* file, treeform_file_view** view) {
    return glue::guard([&] {
        glue::start(view);
        auto made = glue::make<treeform_file_view>();
        glue::fill(*made, content(file), made->value);
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

treeform_code treeform_file_transform(treeform_file* file, const double* matrix) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const tf::transform<3> by = glue::matrix(&glue::need(matrix, "matrix"));
        if (!by.finite()) throw std::invalid_argument("the matrix is not finite");
        to.move(by);
    });
}

treeform_code treeform_read_as(const char* path, const treeform_read_options* options,
                               treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        const auto o = glue::chosen(options, treeform_read_options_init);
        return glue::give(tf::read(&glue::need(path, "path"), glue::text(o.format), glue::read(o)),
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

treeform_code treeform_write(const char* path, const treeform_file* file,
                             const treeform_write_options* options, treeform_written** written) {
    return glue::guard([&] {
        if (written) *written = nullptr;
        glue::give_written(tf::write(&glue::need(path, "path"), content(file), glue::read(options)),
                           written);
    });
}

treeform_code treeform_write_mesh(const char* path, const treeform_mesh* mesh,
                                  const treeform_write_options* options,
                                  treeform_written** written) {
    return glue::guard([&] {
        if (written) *written = nullptr;
        const auto o = glue::chosen(options, treeform_write_options_init);
        const tf::write_options how = glue::read(o);
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
            made->keep(tf::write_to_memory(content(file), glue::read(options)));
        made->value.bytes = reinterpret_cast<const unsigned char*>(kept.data());
        made->value.count = kept.size();
        glue::give(std::move(made), bytes);
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
        return glue::give(tf::as_mesh(std::move(plain)), part);
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

int32_t treeform_reads_scenes(void) { return tf::reads_scenes(); }
