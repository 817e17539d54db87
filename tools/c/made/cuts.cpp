// Made by tools/bindings of cuts.h and the headers of C++: see its README.
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/cuts.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static_assert(sizeof(treeform_section_loop) == sizeof(tf::section_loop));
static_assert(offsetof(treeform_section_loop, first_point) ==
              offsetof(tf::section_loop, first_point));
static_assert(offsetof(treeform_section_loop, point_count) ==
              offsetof(tf::section_loop, point_count));
static_assert(offsetof(treeform_section_loop, closed) == offsetof(tf::section_loop, closed));
static_assert(offsetof(treeform_section_loop, oriented) == offsetof(tf::section_loop, oriented));
static_assert(offsetof(treeform_section_loop, parent) == offsetof(tf::section_loop, parent));
static_assert(offsetof(treeform_section_loop, depth) == offsetof(tf::section_loop, depth));
static_assert(offsetof(treeform_section_loop, area) == offsetof(tf::section_loop, area));
static_assert(offsetof(treeform_section_loop, length) == offsetof(tf::section_loop, length));

static_assert(sizeof(treeform_section_layer) == sizeof(tf::section_layer));
static_assert(offsetof(treeform_section_layer, height) == offsetof(tf::section_layer, height));
static_assert(offsetof(treeform_section_layer, at) == offsetof(tf::section_layer, at));
static_assert(offsetof(treeform_section_layer, first_loop) ==
              offsetof(tf::section_layer, first_loop));
static_assert(offsetof(treeform_section_layer, loop_count) ==
              offsetof(tf::section_layer, loop_count));
static_assert(offsetof(treeform_section_layer, open_count) ==
              offsetof(tf::section_layer, open_count));
static_assert(offsetof(treeform_section_layer, area) == offsetof(tf::section_layer, area));
static_assert(offsetof(treeform_section_layer, length) == offsetof(tf::section_layer, length));

void glue::fill(keeper&, const tf::section_result& from, treeform_section_result& to) {
    to.layers = same<treeform_section_layer>(from.layers);
    to.layer_count = from.layers.size();
    to.loops = same<treeform_section_loop>(from.loops);
    to.loop_count = from.loops.size();
    to.points = flat(from.points);
    to.point_count = from.points.size();
    to.faces = or_null(from.faces);
    std::memcpy(to.axes, from.axes.data(), sizeof to.axes);
}

tf::cut_options glue::read(const treeform_cut_options* options) {
    return read(chosen(options, treeform_cut_options_init));
}
tf::cut_options glue::read(const treeform_cut_options& o) {
    tf::cut_options how;
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.max_displacement = o.max_displacement;
    how.caps = o.caps != 0;
    how.keep_cuts = o.keep_cuts != 0;
    how.progress = progress(o);

    return how;
}

void treeform_cut_options_init(treeform_cut_options* options, size_t size) {
    treeform_cut_options to{};
    const tf::cut_options from;
    to.precision = static_cast<treeform_precision>(from.precision);
    to.max_displacement = from.max_displacement;
    to.caps = from.caps;
    to.keep_cuts = from.keep_cuts;
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::cut_piece& from, treeform_cut_piece& to) {
    to.mesh = arrays(from.mesh);
    to.face_source = or_null(from.face_source);
    to.vertex_source = or_null(from.vertex_source);
    to.cap = or_null(from.cap);
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
}

void glue::fill(keeper& kept, const tf::cut_result& from, treeform_cut_result& to) {
    to.pieces = list<treeform_cut_piece>(kept, from.pieces);
    to.count = from.pieces.size();
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.resolved = from.resolved;
}

void glue::fill(keeper&, const tf::mesh_part& from, treeform_mesh_part& to) {
    to.mesh = arrays(from.mesh);
    to.face_source = or_null(from.face_source);
    to.vertex_source = or_null(from.vertex_source);
    to.volume = from.volume;
    to.area = from.area;
}

void glue::fill(keeper& kept, const std::vector<tf::mesh_part>& from, treeform_mesh_parts& to) {
    to.parts = list<treeform_mesh_part>(kept, from);
    to.count = from.size();
}

void glue::fill(keeper&, const std::vector<double>& from, treeform_heights& to) {
    to.heights = from.data();
    to.count = from.size();
}

treeform_code treeform_section(const treeform_mesh* mesh, const treeform_plane* plane,
                               const double* heights, size_t count, treeform_progress progress,
                               void* progress_data, treeform_section_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::section(glue::ref(mesh, "mesh"), glue::plane(plane), glue::heights(heights, count),
                        glue::progress(progress, progress_data)),
            result);
    });
}

treeform_code treeform_layer_heights(const treeform_mesh* mesh, const treeform_plane* plane,
                                     double thickness, treeform_heights** heights) {
    return glue::guard([&] {
        glue::start(heights);
        return glue::give(glue::layer_heights(glue::view(mesh), glue::plane(plane), thickness),
                          heights);
    });
}

treeform_code treeform_write_section(const char* path, const treeform_section_result* section,
                                     const char* format, const char* unit) {
    return glue::guard([&] {
        glue::write_section(std::string(&glue::need(path, "path")), section, glue::text(format),
                            glue::text(unit));
    });
}

treeform_code treeform_cut(const treeform_mesh* mesh, const treeform_plane* plane,
                           const double* heights, size_t count, const treeform_cut_options* options,
                           treeform_cut_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::cut(glue::ref(mesh, "mesh"), glue::plane(plane),
                                  glue::heights(heights, count), glue::read(options)),
                          result);
    });
}

treeform_code treeform_cut_to_fit(const treeform_mesh* mesh, const double size[3],
                                  const treeform_cut_options* options,
                                  treeform_cut_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::cut_to_fit(glue::ref(mesh, "mesh"), glue::finite(size, "size"),
                                         glue::read(options)),
                          result);
    });
}

treeform_code treeform_components(const treeform_mesh* mesh, double min_volume, size_t largest,
                                  treeform_mesh_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        return glue::give(glue::components(glue::ref(mesh, "mesh"), min_volume, largest), parts);
    });
}

treeform_code treeform_concatenate(const treeform_mesh* const* meshes, size_t count,
                                   treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(glue::concatenate(meshes, count), made);
    });
}

treeform_code treeform_transform_mesh(const treeform_mesh* mesh, const double* by,
                                      treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(tf::transform_mesh(glue::ref(mesh, "mesh"), glue::matrix(by)), made);
    });
}
