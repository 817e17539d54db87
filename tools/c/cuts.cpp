#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/glue.hpp>

#include <utility>
#include <vector>

namespace tf = treeform;

namespace {

/// An array of C as the structs that it mirrors.
template <class T, class C>
std::vector<T> copied_as(const C* values, std::size_t count, const char* name) {
    static_assert(sizeof(C) == sizeof(T) && alignof(C) == alignof(T));
    std::vector<T> made(glue::array(values, count, name).size());
    if (count != 0) std::memcpy(static_cast<void*>(made.data()), values, count * sizeof(T));
    return made;
}

}  // namespace

treeform_code treeform_write_section(const char* path, const treeform_section_result* section,
                                     const char* format, const char* unit) {
    return glue::guard([&] {
        const treeform_section_result& s = glue::need(section, "section");
        tf::section_result copy;
        copy.layers = copied_as<tf::section_layer>(s.layers, s.layer_count, "layers");
        copy.loops = copied_as<tf::section_loop>(s.loops, s.loop_count, "loops");
        copy.points = copied_as<tf::point2>(reinterpret_cast<const tf::point2*>(s.points),
                                            s.point_count, "points");
        copy.frame = {glue::point(s.x, "x"), glue::point(s.y, "y"),
                      glue::point(s.normal, "normal")};
        tf::write_section(&glue::need(path, "path"), copy, glue::text(format), glue::text(unit));
    });
}

treeform_code treeform_write_isolines(const char* path, const treeform_isolines_result* lines,
                                      const double normal[3], const char* format,
                                      const char* unit) {
    return glue::guard([&] {
        const treeform_isolines_result& given = glue::need(lines, "lines");
        tf::isolines_result copy;
        copy.lines = copied_as<tf::isoline>(given.lines, given.line_count, "lines");
        copy.points = copied_as<tf::point3>(reinterpret_cast<const tf::point3*>(given.points),
                                            given.point_count, "points");
        tf::oriented_plane seen;
        if (normal != nullptr) seen.normal = glue::point(normal, "normal");
        tf::write_isolines(&glue::need(path, "path"), copy, seen.frame(), glue::text(format),
                           glue::text(unit));
    });
}

treeform_code treeform_concatenate(const treeform_mesh* const* meshes, std::size_t count,
                                   treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        const std::vector<tf::mesh_view> views = glue::views(meshes, count, "meshes");
        std::vector<std::uint32_t> mesh_of_face;
        for (std::size_t i = 0; i < count; ++i)
            mesh_of_face.insert(mesh_of_face.end(), views[i].faces.size(),
                                static_cast<std::uint32_t>(i));
        return glue::give(glue::made_mesh{tf::concatenate(views), std::move(mesh_of_face)}, made);
    });
}
