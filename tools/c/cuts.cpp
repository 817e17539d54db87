#include <treeform/mesh/section.hpp>

#include <tools/c/glue.hpp>

#include <array>

namespace tf = treeform;

namespace {

tf::oriented_plane plane_of(const treeform_plane* plane) {
    if (!plane) return {};
    return {glue::point(plane->at, "at"), glue::point(plane->normal, "normal")};
}

/// An array of C as the structs that it mirrors.
template <class T, class C>
std::vector<T> copied_as(const C* values, std::size_t count, const char* name) {
    static_assert(sizeof(C) == sizeof(T) && alignof(C) == alignof(T));
    std::vector<T> made(glue::array(values, count, name).size());
    if (count != 0) std::memcpy(static_cast<void*>(made.data()), values, count * sizeof(T));
    return made;
}

}  // namespace

treeform_code treeform_section(const treeform_mesh* mesh, const treeform_plane* plane,
                               const double* heights, std::size_t count, treeform_progress progress,
                               void* progress_data, treeform_section_result** section) {
    return glue::guard([&] {
        glue::start(section);
        constexpr std::array<double, 1> itself{0.0};
        const std::span<const double> at =
            heights ? glue::array(heights, count, "heights") : std::span<const double>(itself);
        auto made = glue::make<treeform_section_result>();
        const tf::section_result& found = made->keep(glue::asked(mesh, [&](const auto& m) {
            return tf::section(m, plane_of(plane), at, {glue::progress(progress, progress_data)});
        }));
        glue::check(found.status);
        treeform_section_result& s = made->value;
        s.layers = glue::same<treeform_section_layer>(found.layers);
        s.layer_count = found.layers.size();
        s.loops = glue::same<treeform_section_loop>(found.loops);
        s.loop_count = found.loops.size();
        s.points = reinterpret_cast<const double*>(found.points.data());
        s.faces = found.faces.data();
        s.point_count = found.points.size();
        glue::copy(found.frame.x, s.x);
        glue::copy(found.frame.y, s.y);
        glue::copy(found.frame.normal, s.normal);
        glue::give(std::move(made), section);
    });
}

treeform_code treeform_layer_heights(const treeform_mesh* mesh, const treeform_plane* plane,
                                     double thickness, treeform_heights** heights) {
    return glue::guard([&] {
        glue::start(heights);
        auto made = glue::make<treeform_heights>();
        const auto& found =
            made->keep(tf::layer_heights(glue::view(mesh).points, plane_of(plane), thickness));
        made->value.heights = found.data();
        made->value.count = found.size();
        glue::give(std::move(made), heights);
    });
}

treeform_code treeform_write_section(const char* path, const treeform_section_result* section,
                                     const char* format) {
    return glue::guard([&] {
        const treeform_section_result& s = glue::need(section, "section");
        tf::section_result copy;
        copy.layers = copied_as<tf::section_layer>(s.layers, s.layer_count, "layers");
        copy.loops = copied_as<tf::section_loop>(s.loops, s.loop_count, "loops");
        copy.points = copied_as<tf::point2>(reinterpret_cast<const tf::point2*>(s.points),
                                            s.point_count, "points");
        copy.frame = {glue::point(s.x, "x"), glue::point(s.y, "y"),
                      glue::point(s.normal, "normal")};
        tf::write_section(&glue::need(path, "path"), copy, glue::text(format));
    });
}
