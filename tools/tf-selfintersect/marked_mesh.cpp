#include "tools/common/class_colors.hpp"
#include "tools/common/console.hpp"
#include "tools/tf-selfintersect/marks.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tools {
namespace {

/// The marks of the faces searched, for all triangles of the file.
face_marks marks_of_file(const findings& result, std::size_t triangles) {
    const face_marks searched = mark_faces(result);
    face_marks all{std::vector<std::uint8_t>(triangles, 0),
                   std::vector<std::int32_t>(triangles, -1)};
    for (std::uint32_t f = 0; f < searched.kind.size(); ++f) {
        all.kind[result.triangle(f)] = searched.kind[f];
        all.region[result.triangle(f)] = searched.region[f];
    }
    return all;
}

/// A vertex shows the mark of a face at it that is in a pair, of the first one if there are more.
std::vector<std::uint8_t> marks_of_vertices(const tf::mesh& mesh,
                                            const std::vector<std::uint8_t>& faces) {
    std::vector<std::uint8_t> vertices(mesh.points.size(), 0);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f])
            if (vertices[corner] == 0) vertices[corner] = faces[f];
    return vertices;
}

void add_marks(tf::mesh_file& file, const face_marks& marks) {
    tf::element& vertices = tf::obtain_element(file.attributes, "vertex", file.mesh.points.size());
    set_colors(vertices, marks_of_vertices(file.mesh, marks.kind), mark_colors);
    tf::element& faces = tf::obtain_element(file.attributes, "face", file.mesh.faces.size());
    set_colors(faces, marks.kind, mark_colors);
    const std::vector<std::int32_t> classes(marks.kind.begin(), marks.kind.end());
    tf::set_column(faces, tf::make_column<std::int32_t>("tf_class", classes));
    tf::set_column(faces, tf::make_column<std::int32_t>("tf_region", marks.region));
}

void enter_output(job& work, const std::filesystem::path& path, const tf::write_result& written) {
    work.entry["output"] = {
        {"file", path.string()},
        {"format", written.format},
        {"precision_out", written.written_as == tf::precision::float32 ? "float" : "double"},
        {"max_move", written.max_displacement}};
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
    if (written.max_displacement > 0.0)
        work.warn("rounded", "the marked copy is in single precision: coordinates move by up to " +
                                 shortest(written.max_displacement));
}

}  // namespace

void write_marked(job& work, tf::mesh_file& file, const findings& result,
                  const std::filesystem::path& path) {
    const common_options& o = work.options;
    const std::string format = mesh_format(o, path);
    const face_marks marks = marks_of_file(result, file.mesh.faces.size());
    if (!file.stored_face.empty()) tf::split_polygons(file);
    if (!file.indexed) {  // a soup becomes a mesh; where vertices have numbers they keep them
        file.mesh = tf::join_equal_points(file.mesh);
        file.attributes = {};
        file.indexed = true;
    }
    add_marks(file, marks);
    tf::write_options options{.format = format, .ascii = o.ascii};
    if (o.precision == "float") options.precision = tf::precision::float32;
    if (o.precision == "double") options.precision = tf::precision::float64;
    output_place place(path, o.force, work.keeper);
    try {
        enter_output(work, path, tf::write(place.writable(), file, options));
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
}

}  // namespace tools
