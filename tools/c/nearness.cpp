#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/pairs.hpp>

#include <algorithm>

namespace tf = treeform;

treeform_code treeform_closest_point(const treeform_mesh* mesh, const double* queries, size_t count,
                                     double radius, uint32_t* faces, double* distances,
                                     double* points) {
    return glue::guard([&] {
        const tf::points_view from = glue::points(queries, count, "queries");
        glue::asked_in_pieces(mesh, count, [&](const auto& m, std::size_t begin, std::size_t end) {
            const auto some = tf::closest_point(m, from.subspan(begin, end - begin), radius);
            for (std::size_t i = begin; i < end; ++i) {
                const auto& found = some[i - begin];
                if (faces) faces[i] = found ? found->face : TREEFORM_NONE;
                if (distances) distances[i] = found ? found->distance : glue::infinity;
                if (points)
                    glue::copy(found
                                   ? found->point
                                   : tf::point3{glue::not_known, glue::not_known, glue::not_known},
                               points + 3 * i);
            }
        });
    });
}

treeform_code treeform_closest_points(const treeform_mesh* a, const treeform_mesh* b,
                                      const double* move_a, const double* move_b, double radius,
                                      treeform_closest* closest) {
    return glue::guard([&] {
        treeform_closest& to = glue::need(closest, "closest");
        const tf::distance_options how{glue::matrix(move_a), glue::matrix(move_b), radius};
        const auto found = glue::asked(
            a, b, [&](const auto& x, const auto& y) { return tf::closest_points(x, y, how); });
        to = {TREEFORM_NONE,
              TREEFORM_NONE,
              glue::infinity,
              {glue::not_known, glue::not_known, glue::not_known},
              {glue::not_known, glue::not_known, glue::not_known}};
        if (!found) return;
        to.face_a = found->face_a;
        to.face_b = found->face_b;
        to.distance = found->distance;
        glue::copy(found->on_a, to.on_a);
        glue::copy(found->on_b, to.on_b);
    });
}

treeform_code treeform_distance_poses(const treeform_mesh* a, const treeform_mesh* b,
                                      const double* moves_a, const double* moves_b, size_t count,
                                      double radius, double* distances) {
    return glue::guard([&] {
        const std::span out = glue::array(distances, count, "distances");
        const auto where = glue::positions(moves_a, moves_b, count);
        glue::asked_in_pieces(
            a, b, count, [&](const auto& x, const auto& y, std::size_t begin, std::size_t end) {
                const std::vector<double> found =
                    tf::distance(x, y, std::span(where).subspan(begin, end - begin), radius);
                std::copy(found.begin(), found.end(), out.data() + begin);
            });
    });
}

treeform_code treeform_penetration_depth(const treeform_mesh* a, const treeform_mesh* b,
                                         const treeform_depth_options* options, double* depth,
                                         double move[3], treeform_search_effort* effort) {
    return glue::guard([&] {
        (void)glue::need(depth, "depth");
        (void)glue::need(move, "move");
        const tf::depth_options how = glue::read(options);
        const auto found = glue::asked(
            a, b, [&](const auto& x, const auto& y) { return tf::penetration_depth(x, y, how); });
        if (found) glue::check(found->status);
        *depth = found ? found->depth : 0.0;
        glue::copy(found ? found->move : tf::point3{}, move);
        if (effort)
            *effort = found ? glue::same<treeform_search_effort>(found->effort)
                            : treeform_search_effort{};
    });
}

treeform_code treeform_count_sides(const double* points, size_t count,
                                   const treeform_mesh* const* solids, size_t solid_count,
                                   uint64_t counts[3]) {
    return glue::guard([&] {
        (void)glue::need(counts, "counts");
        const tf::mesh_refs row = glue::refs(solids, solid_count, "solids");
        const tf::side_counts found = tf::count_sides(glue::points(points, count, "points"), row);
        counts[0] = found.inside;
        counts[1] = found.on;
        counts[2] = found.outside;
    });
}
