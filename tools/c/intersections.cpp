#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/curves.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/glue.hpp>
#include <tools/c/pairs.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

template <class Result>
void give_pairs(Result from, treeform_pairs** out) {
    if (from.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_pairs>();
    glue::fill(made->value, made->keep(std::move(from)));
    glue::give(std::move(made), out);
}

/// Pairs of faces of the mesh, all of them there.
std::vector<tf::face_pair> pairs_of(std::size_t face_count, const treeform_face_pair* pairs,
                                    std::size_t count) {
    std::vector<tf::face_pair> result;
    for (const treeform_face_pair& one : glue::array(pairs, count, "pairs")) {
        if (one.a >= face_count || one.b >= face_count)
            throw std::invalid_argument("pair " + std::to_string(result.size()) +
                                        " names a face of " + std::to_string(face_count) +
                                        " that is not there");
        result.push_back({one.a, one.b, glue::choice<tf::pair_kind>(one.kind, 7, "a kind")});
    }
    return result;
}

}  // namespace

tf::pair_kinds glue::kinds(std::uint32_t bits) {
    if (bits > TREEFORM_ALL_KINDS)
        throw std::invalid_argument("kinds is " + std::to_string(bits) + ", no sum of kinds");
    tf::pair_kinds result;
    for (std::uint32_t kind = 0; kind < tf::pair_kind_count; ++kind)
        if ((bits >> kind & 1U) != 0) result = result + static_cast<tf::pair_kind>(kind);
    return result;
}

void treeform_self_intersections_options_init(treeform_self_intersections_options* options,
                                              size_t size) {
    treeform_self_intersections_options defaults{};
    defaults.kinds = TREEFORM_ALL_KINDS;
    defaults.limit = UINT64_MAX;
    glue::init(options, size, defaults);
}

treeform_code treeform_self_intersections(const treeform_mesh* mesh,
                                          const treeform_self_intersections_options* options,
                                          treeform_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        const auto o = glue::chosen(options, treeform_self_intersections_options_init);
        tf::self_intersection_options how;
        how.vertices = glue::vertices(o.vertices);
        how.first_only = o.first_only != 0;
        how.kinds = glue::kinds(o.kinds);
        if (o.component_of_face)
            how.component_of_face = {o.component_of_face, glue::view(mesh).faces.size()};
        how.between = o.between != 0;
        how.within = o.within != 0;
        how.limit = glue::limit(o.limit);
        how.progress = glue::progress(o);
        give_pairs(glue::asked(mesh, [&](const auto& m) { return tf::self_intersections(m, how); }),
                   pairs);
    });
}

treeform_code treeform_group_pairs(const treeform_mesh* mesh, const treeform_face_pair* pairs,
                                   size_t count, treeform_regions** regions) {
    return glue::guard([&] {
        glue::start(regions);
        const tf::mesh_view view = glue::view(mesh);
        auto made = glue::make<treeform_regions>();
        const auto& found =
            made->keep(tf::group_pairs(view, pairs_of(view.faces.size(), pairs, count)));
        std::vector<treeform_region> all;
        for (const tf::intersection_region& one : found.regions) {
            treeform_region& r = all.emplace_back();
            r.faces = one.faces.data();
            r.face_count = one.faces.size();
            glue::copy(one.min, r.min);
            glue::copy(one.max, r.max);
            r.pairs = one.pairs;
        }
        made->value.count = all.size();
        made->value.regions = made->keep(std::move(all)).data();
        made->value.region_of_pair = found.region_of_pair.data();
        made->value.pair_count = found.region_of_pair.size();
        glue::give(std::move(made), regions);
    });
}

void treeform_intersections_options_init(treeform_intersections_options* options, size_t size) {
    treeform_intersections_options defaults{};
    defaults.kinds = TREEFORM_ALL_KINDS;
    defaults.limit = UINT64_MAX;
    glue::init(options, size, defaults);
}

treeform_code treeform_intersections(const treeform_mesh* a, const treeform_mesh* b,
                                     const treeform_intersections_options* options,
                                     treeform_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        const auto o = glue::chosen(options, treeform_intersections_options_init);
        tf::mesh_intersection_options how;
        how.move_a = glue::matrix(o.move_a);
        how.move_b = glue::matrix(o.move_b);
        how.first_only = o.first_only != 0;
        how.kinds = glue::kinds(o.kinds);
        how.limit = glue::limit(o.limit);
        how.progress = glue::progress(o);
        give_pairs(glue::asked(a, b,
                               [&](const auto& x, const auto& y) {
                                   return tf::mesh_intersections(x, y, how);
                               }),
                   pairs);
    });
}

treeform_code treeform_intersects(const treeform_mesh* a, const treeform_mesh* b,
                                  const double* move_a, const double* move_b, int32_t* meet) {
    return glue::guard([&] {
        (void)glue::need(meet, "meet");
        const tf::mesh_positions where{glue::matrix(move_a), glue::matrix(move_b)};
        *meet = glue::asked(
            a, b, [&](const auto& x, const auto& y) { return tf::intersects(x, y, where); });
    });
}

treeform_code treeform_intersects_poses(const treeform_mesh* a, const treeform_mesh* b,
                                        const double* moves_a, const double* moves_b, size_t count,
                                        uint8_t* meet) {
    return glue::guard([&] {
        const std::span out = glue::array(meet, count, "meet");
        const auto where = glue::positions(moves_a, moves_b, count);
        glue::asked_in_pieces(
            a, b, count, [&](const auto& x, const auto& y, std::size_t begin, std::size_t end) {
                const std::vector<bool> found =
                    tf::intersects(x, y, std::span(where).subspan(begin, end - begin));
                std::copy(found.begin(), found.end(), out.data() + begin);
            });
    });
}

treeform_code treeform_faces_in_box(const treeform_mesh* mesh, const treeform_box* box,
                                    treeform_indices** faces) {
    return glue::guard([&] {
        glue::start(faces);
        const tf::box3 in = glue::box(glue::need(box, "box"));
        const tf::mesh_view view = glue::view(mesh);
        if (const auto bad = tf::find_defects(view).nonfinite_faces; !bad.empty())
            throw std::invalid_argument("face " + std::to_string(bad[0]) +
                                        " has a corner that is not finite");
        auto made = glue::make<treeform_indices>();
        const auto& found = made->keep(tf::faces_in_box(view, in.min, in.max));
        made->value.values = found.data();
        made->value.count = found.size();
        glue::give(std::move(made), faces);
    });
}

treeform_code treeform_intersection_curves(const treeform_mesh* mesh,
                                           const treeform_face_pair* pairs, size_t count,
                                           treeform_segments** segments) {
    return glue::guard([&] {
        glue::start(segments);
        const tf::mesh_view view = glue::view(mesh);
        auto made = glue::make<treeform_segments>();
        const auto& found =
            made->keep(tf::intersection_curves(view, pairs_of(view.faces.size(), pairs, count)));
        made->value.segments = glue::same<treeform_segment>(found);
        made->value.count = found.size();
        glue::give(std::move(made), segments);
    });
}

treeform_code treeform_intersection_paths(const treeform_mesh* mesh,
                                          const treeform_face_pair* pairs, size_t count,
                                          treeform_paths** paths) {
    return glue::guard([&] {
        glue::start(paths);
        const tf::mesh_view view = glue::view(mesh);
        const auto of = pairs_of(view.faces.size(), pairs, count);
        auto made = glue::make<treeform_paths>();
        const auto& found = made->keep(tf::intersection_paths(view, of));
        std::vector<tf::point3> points;
        for (const tf::curve_point& one : found.points) points.push_back(one.position);
        std::vector<treeform_path> all;
        for (const tf::curve_path& one : found.paths)
            all.push_back({one.points.data(), one.points.size(), one.closed});
        made->value.point_count = points.size();
        made->value.points = glue::flat(made->keep(std::move(points)));
        made->value.path_count = all.size();
        made->value.paths = made->keep(std::move(all)).data();
        glue::give(std::move(made), paths);
    });
}

treeform_code treeform_write_curves(const char* path, const treeform_mesh* mesh,
                                    const treeform_face_pair* pairs, size_t count,
                                    const char* format) {
    return glue::guard([&] {
        (void)glue::need(path, "path");
        const tf::mesh_view view = glue::view(mesh);
        tf::write_curves(path, view, pairs_of(view.faces.size(), pairs, count), {},
                         glue::text(format));
    });
}

treeform_code treeform_color_pairs(treeform_file* file, const treeform_part* part,
                                   const treeform_face_pair* pairs, size_t count) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const treeform_part& p = glue::need(part, "part");
        const std::size_t faces = p.mesh.face_count;
        tf::usable_mesh looked_at;
        const tf::points_view points = glue::points(p.mesh.points, p.mesh.point_count, "points");
        const std::span corners = glue::faces(p.mesh.faces, faces, "faces");
        looked_at.mesh.points.assign(points.begin(), points.end());
        looked_at.mesh.faces.assign(corners.begin(), corners.end());
        if (p.triangle_of_face)
            looked_at.triangle_of_face.assign(p.triangle_of_face, p.triangle_of_face + faces);
        looked_at.stored_face = to.stored_face;
        for (std::uint32_t f = 0; f < faces; ++f)
            if (looked_at.triangle(f) >= to.mesh.faces.size())
                throw std::invalid_argument("the part is not of this file");
        const auto found = pairs_of(faces, pairs, count);
        tf::face_marks(faces, found, tf::group_pairs(looked_at.mesh, found)).color(to, looked_at);
    });
}
