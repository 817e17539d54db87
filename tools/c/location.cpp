#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>
#include <limits>

namespace tf = treeform;

namespace {

void answer(std::span<const tf::point_location> found, std::uint8_t* where, std::int32_t* winding,
            std::uint32_t* on) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (where) where[i] = static_cast<std::uint8_t>(found[i].where);
        if (winding) winding[i] = found[i].winding;
        if (on) on[i] = found[i].where == tf::location::boundary ? found[i].on : TREEFORM_NONE;
    }
}

template <class T>
T* from(T* array, std::size_t begin) {
    return array ? array + begin : nullptr;
}

void locate(const treeform_mesh* mesh, const double* points, std::size_t count, std::uint8_t* where,
            std::int32_t* winding, std::uint32_t* on) {
    const tf::points_view all = glue::points(points, count, "points");
    glue::asked_in_pieces(mesh, count, [&](const auto& m, std::size_t begin, std::size_t end) {
        answer(tf::locate(m, all.subspan(begin, end - begin)), from(where, begin),
               from(winding, begin), from(on, begin));
    });
}

std::vector<tf::ray3> rays_of(const treeform_ray* rays, std::size_t count) {
    std::vector<tf::ray3> result;
    for (const treeform_ray& one : glue::array(rays, count, "rays")) {
        tf::ray3& ray = result.emplace_back();
        std::copy(one.origin, one.origin + 3, ray.origin.begin());
        std::copy(one.direction, one.direction + 3, ray.direction.begin());
        ray.t_min = one.t_min;
        ray.t_max = one.t_max;
    }
    return result;
}

treeform_hit hit_of(const std::optional<tf::mesh_hit>& from) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!from) return {TREEFORM_NONE, 0, 0, nan, nan};
    return {from->face, static_cast<std::uint8_t>(from->at), from->coplanar, from->t, from->t_end};
}

}  // namespace

treeform_code treeform_locate(const treeform_mesh* mesh, const double* points, size_t count,
                              uint8_t* where, int32_t* winding, uint32_t* on) {
    return glue::guard([&] { locate(mesh, points, count, where, winding, on); });
}

treeform_code treeform_contains(const treeform_mesh* mesh, const double* points, size_t count,
                                uint8_t* inside) {
    return glue::guard([&] {
        const std::span out = glue::array(inside, count, "inside");
        locate(mesh, points, count, inside, nullptr, nullptr);
        for (std::uint8_t& one : out) one = one == TREEFORM_OUTSIDE ? 0 : 1;
    });
}

treeform_code treeform_winding_number(const treeform_mesh* mesh, const double* points, size_t count,
                                      int32_t* winding) {
    return glue::guard([&] {
        (void)glue::array(winding, count, "winding");
        locate(mesh, points, count, nullptr, winding, nullptr);
    });
}

treeform_code treeform_locate_in_curves(const double* points, size_t point_count,
                                        const uint32_t* edges, size_t edge_count,
                                        const double* queries, size_t count, uint8_t* where,
                                        int32_t* winding) {
    return glue::guard([&] {
        static_assert(sizeof(tf::point2) == 2 * sizeof(double));
        static_assert(sizeof(tf::curve_edge) == 2 * sizeof(std::uint32_t));
        (void)glue::array(points, point_count, "points");
        (void)glue::array(edges, edge_count, "edges");
        (void)glue::array(queries, count, "queries");
        const tf::curve_view curves{{reinterpret_cast<const tf::point2*>(points), point_count},
                                    {reinterpret_cast<const tf::curve_edge*>(edges), edge_count}};
        const tf::curve_locator locator(curves);
        const std::span all(reinterpret_cast<const tf::point2*>(queries), count);
        glue::in_pieces(count, [&](std::size_t begin, std::size_t end) {
            answer(locator.locate(all.subspan(begin, end - begin)), from(where, begin),
                   from(winding, begin), nullptr);
        });
    });
}

treeform_code treeform_raycast(const treeform_mesh* mesh, const treeform_ray* rays, size_t count,
                               treeform_hit* hits) {
    return glue::guard([&] {
        const std::span out = glue::array(hits, count, "hits");
        const std::vector<tf::ray3> all = rays_of(rays, count);
        glue::asked_in_pieces(mesh, count, [&](const auto& m, std::size_t begin, std::size_t end) {
            const auto found = tf::raycast(m, std::span(all).subspan(begin, end - begin));
            std::transform(found.begin(), found.end(), out.data() + begin, hit_of);
        });
    });
}

treeform_code treeform_raycast_any(const treeform_mesh* mesh, const treeform_ray* rays,
                                   size_t count, uint8_t* hit) {
    return glue::guard([&] {
        const std::span out = glue::array(hit, count, "hit");
        const std::vector<tf::ray3> all = rays_of(rays, count);
        glue::asked_in_pieces(mesh, count, [&](const auto& m, std::size_t begin, std::size_t end) {
            const auto found = tf::raycast_any(m, std::span(all).subspan(begin, end - begin));
            std::copy(found.begin(), found.end(), out.data() + begin);
        });
    });
}

treeform_code treeform_raycast_all(const treeform_mesh* mesh, const treeform_ray* rays,
                                   size_t count, treeform_hits** hits) {
    return glue::guard([&] {
        glue::start(hits);
        const std::vector<tf::ray3> all = rays_of(rays, count);
        auto made = glue::make<treeform_hits>();
        auto& found = made->keep(tf::mesh_hits{{0}, {}});
        glue::asked_in_pieces(mesh, count, [&](const auto& m, std::size_t begin, std::size_t end) {
            auto some = tf::raycast_all(m, std::span(all).subspan(begin, end - begin));
            glue::append(found.begin, found.hits, std::move(some.begin), std::move(some.hits));
        });
        made->value.begin = found.begin.data();
        made->value.hits = glue::same<treeform_hit>(found.hits);
        made->value.count = count;
        glue::give(std::move(made), hits);
    });
}
