#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>

#include <tools/c/pairs.hpp>
#include <tools/c/relations.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

void fill(treeform_deviation_result& r, const tf::deviation_result& d) {
    r.distances = d.distances.data();
    r.faces = d.faces.data();
    r.count = d.distances.size();
    r.is_signed = d.is_signed;
    r.mean = d.mean;
    r.mean_absolute = d.mean_absolute;
    r.rms = d.rms;
    r.p50 = d.p50;
    r.p95 = d.p95;
    r.p99 = d.p99;
    r.max = d.max;
    r.worst = d.worst;
    r.lowest = d.lowest;
    r.highest = d.highest;
    r.there_sampled = d.there.sampled;
    r.there_at_most = d.there.at_most;
    r.back_sampled = d.back ? d.back->sampled : glue::not_known;
    r.back_at_most = d.back ? d.back->at_most : glue::not_known;
    r.histogram_low = d.histogram.low;
    r.histogram_high = d.histogram.high;
    r.histogram = d.histogram.counts.data();
    r.bins = d.histogram.counts.size();
    if (d.band) {
        r.below = d.band->below;
        r.within = d.band->within;
        r.above = d.band->above;
    }
    if (d.sides) {
        r.sides[0] = d.sides->inside;
        r.sides[1] = d.sides->on;
        r.sides[2] = d.sides->outside;
    }
}

}  // namespace

treeform_relation glue::relation_of(const tf::mesh_measure& from) {
    treeform_relation r{};
    r.how = static_cast<treeform_standing>(from.relation.relation);
    r.face_a = from.relation.face_a;
    r.face_b = from.relation.face_b;
    r.a_inside_b = from.relation.a_inside_b;
    r.b_inside_a = from.relation.b_inside_a;
    r.distance = from.distance;
    r.surface_distance = from.surface_distance;
    r.nearest_a = from.on_a.face;
    r.nearest_b = from.on_b.face;
    copy(from.on_a.point, r.on_a);
    copy(from.on_b.point, r.on_b);
    std::copy(from.on_a.barycentric.begin(), from.on_a.barycentric.end(), r.barycentric_a);
    std::copy(from.on_b.barycentric.begin(), from.on_b.barycentric.end(), r.barycentric_b);
    return r;
}

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

treeform_code treeform_distance(const treeform_mesh* a, const treeform_mesh* b,
                                const double* move_a, const double* move_b, double* distance) {
    return glue::guard([&] {
        const tf::distance_options how{glue::matrix(move_a), glue::matrix(move_b)};
        glue::need(distance, "distance") = glue::asked(
            a, b, [&](const auto& x, const auto& y) { return tf::distance(x, y, how); });
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

void treeform_measure_options_init(treeform_measure_options* options, size_t size) {
    treeform_measure_options defaults{};
    defaults.radius = glue::infinity;
    glue::init(options, size, defaults);
}

treeform_code treeform_measure(const treeform_mesh* a, const treeform_mesh* b,
                               const treeform_measure_options* options,
                               treeform_relation** relation) {
    return glue::guard([&] {
        glue::start(relation);
        const auto o = glue::chosen(options, treeform_measure_options_init);
        tf::measure_options how;
        how.radius = o.radius;
        how.vertices = glue::vertices(o.vertices);
        how.progress = glue::progress(o);
        const auto found =
            glue::asked(a, b, [&](const auto& x, const auto& y) { return tf::measure(x, y, how); });
        if (!found) return;
        glue::check(found->relation.status);
        auto made = glue::make<treeform_relation>();
        void* const owner = made->value.owner;
        made->value = glue::relation_of(*found);
        made->value.owner = owner;
        glue::give(std::move(made), relation);
    });
}

treeform_code treeform_relate(const treeform_mesh* a, const treeform_mesh* b,
                              treeform_vertices vertices, treeform_standing* how) {
    return glue::guard([&] {
        (void)glue::need(how, "how");
        tf::relation_options options;
        options.vertices = glue::vertices(vertices);
        *how = static_cast<treeform_standing>(glue::asked(a, b, [&](const auto& x, const auto& y) {
            return tf::relation(x, y, options).relation;
        }));
    });
}

void treeform_depth_options_init(treeform_depth_options* options, size_t size) {
    treeform_depth_options defaults{};
    defaults.directions = tf::depth_options{}.directions;
    glue::init(options, size, defaults);
}

treeform_code treeform_penetration_depth(const treeform_mesh* a, const treeform_mesh* b,
                                         const treeform_depth_options* options, double* depth,
                                         double move[3], treeform_search_effort* effort) {
    return glue::guard([&] {
        (void)glue::need(depth, "depth");
        (void)glue::need(move, "move");
        const auto o = glue::chosen(options, treeform_depth_options_init);
        tf::depth_options how;
        how.directions = glue::limit(o.directions);
        how.effort = o.effort;
        how.vertices = glue::vertices(o.vertices);
        how.progress = glue::progress(o);
        const auto found = glue::asked(
            a, b, [&](const auto& x, const auto& y) { return tf::penetration_depth(x, y, how); });
        if (found) glue::check(found->status);
        *depth = found ? found->depth : 0.0;
        glue::copy(found ? found->move : tf::point3{}, move);
        if (effort) *effort = found ? glue::copied(found->effort) : treeform_search_effort{};
    });
}

treeform_code treeform_count_inside_out(const treeform_mesh* mesh, uint64_t* count) {
    return glue::guard([&] {
        (void)glue::need(count, "count");
        *count = glue::asked(mesh, [](const auto& m) { return tf::count_inside_out(m); });
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

void treeform_deviation_options_init(treeform_deviation_options* options, size_t size) {
    const tf::deviation_options from;
    treeform_deviation_options defaults{};
    defaults.band_low = defaults.band_high = glue::not_known;
    defaults.bins = from.bins;
    defaults.both_ways = from.both_ways;
    glue::init(options, size, defaults);
}

treeform_code treeform_deviation(const treeform_mesh* a, const treeform_mesh* const* fixed,
                                 size_t fixed_count, const treeform_deviation_options* options,
                                 treeform_deviation_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const auto o = glue::chosen(options, treeform_deviation_options_init);
        tf::deviation_options how;
        if (!std::isnan(o.band_low) || !std::isnan(o.band_high))
            how.band = {o.band_low, o.band_high};
        how.bins = glue::limit(o.bins);
        how.both_ways = o.both_ways != 0;
        how.progress = glue::progress(o);
        const tf::mesh_refs row = glue::refs(fixed, fixed_count, "fixed");
        auto found = tf::deviation(*glue::need(a, "a").prepared, row, how);
        if (!found) return;
        if (found->status == tf::status::cancelled) throw glue::cancelled{};
        auto made = glue::make<treeform_deviation_result>();
        fill(made->value, made->keep(std::move(*found)));
        glue::give(std::move(made), result);
    });
}
