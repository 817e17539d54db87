#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/glue.hpp>

#include <utility>
#include <vector>

namespace tf = treeform;

namespace {

tf::oriented_plane plane_of(const treeform_plane* plane) {
    if (!plane) return {};
    return {glue::point(plane->at, "at"), glue::point(plane->normal, "normal")};
}

/// Heights of C: without any, the plane itself.
std::vector<double> heights_of(const double* heights, std::size_t count) {
    if (!heights) return {0.0};
    const std::span<const double> all = glue::array(heights, count, "heights");
    return {all.begin(), all.end()};
}

tf::cut_options options_of(const treeform_cut_options* options) {
    const auto o = glue::chosen(options, treeform_cut_options_init);
    return {.precision = glue::precision(o.precision),
            .max_displacement = o.max_displacement,
            .caps = o.open == 0,
            .keep_cuts = o.keep_cuts != 0,
            .progress = glue::progress(o)};
}

treeform_code give_pieces(tf::cut_result&& found, treeform_cut_result** out) {
    auto made = glue::make<treeform_cut_result>();
    const tf::cut_result& kept = made->keep(std::move(found));
    const treeform_code code = glue::code_of(kept.certificate);
    std::vector<treeform_cut_piece> pieces;
    for (const tf::cut_piece& piece : kept.pieces)
        pieces.push_back({glue::arrays(piece.mesh), piece.face_source.data(),
                          piece.vertex_source.data(), piece.cap.data(),
                          glue::keep(*made, piece.certificate)});
    made->value.count = pieces.size();
    made->value.pieces = made->keep(std::move(pieces)).data();
    made->value.certificate = glue::keep(*made, kept.certificate);
    glue::give(std::move(made), out);
    return code;
}

treeform_code give_mesh(tf::mesh&& mesh, std::vector<std::uint32_t>&& index,
                        treeform_made_mesh** out) {
    auto made = glue::make<treeform_made_mesh>();
    made->value.mesh = glue::arrays(made->keep(std::move(mesh)));
    made->value.index_count = index.size();
    if (!index.empty()) made->value.index = made->keep(std::move(index)).data();
    glue::give(std::move(made), out);
    return TREEFORM_OK;
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
        const std::vector<double> at = heights_of(heights, count);
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

void treeform_cut_options_init(treeform_cut_options* options, std::size_t size) {
    treeform_cut_options defaults{};
    defaults.precision = TREEFORM_FLOAT64;
    defaults.max_displacement = glue::infinity;
    glue::init(options, size, defaults);
}

treeform_code treeform_cut(const treeform_mesh* mesh, const treeform_plane* plane,
                           const double* heights, std::size_t count,
                           const treeform_cut_options* options, treeform_cut_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return give_pieces(glue::asked(mesh,
                                       [&](const auto& m) {
                                           return tf::cut(m, plane_of(plane),
                                                          heights_of(heights, count),
                                                          options_of(options));
                                       }),
                           result);
    });
}

treeform_code treeform_cut_to_fit(const treeform_mesh* mesh, const double size[3],
                                  const treeform_cut_options* options,
                                  treeform_cut_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return give_pieces(
            tf::cut_to_fit(glue::view(mesh), glue::point(size, "size"), options_of(options)),
            result);
    });
}

treeform_code treeform_components(const treeform_mesh* mesh, double min_volume, std::size_t largest,
                                  treeform_mesh_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        tf::components_options options{.min_volume = min_volume};
        if (largest != 0) options.largest = largest;
        auto made = glue::make<treeform_mesh_parts>();
        std::vector<treeform_mesh_part> all;
        for (const tf::mesh_part& part : made->keep(tf::components(glue::view(mesh), options)))
            all.push_back({glue::arrays(part.mesh), part.face_source.data(),
                           part.vertex_source.data(), part.volume, part.area});
        made->value.count = all.size();
        made->value.parts = made->keep(std::move(all)).data();
        glue::give(std::move(made), parts);
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
        return give_mesh(tf::concatenate(views), std::move(mesh_of_face), made);
    });
}

treeform_code treeform_transform_mesh(const treeform_mesh* mesh, const double* matrix,
                                      treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return give_mesh(tf::transform_mesh(glue::view(mesh), glue::matrix(matrix)), {}, made);
    });
}
