#include "tools/picture/scene.hpp"

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>

namespace tools {
namespace {

/// Calls `see(kind, valued)` for each face and dot that is drawn; `valued`: the map colors it.
template <class See>
void for_items(const scene& shown, const See& see) {
    const auto kind_of = [](const std::vector<std::uint8_t>& kind, std::size_t i) {
        return kind[kind.size() == 1 ? 0 : i];
    };
    for (const scene_mesh& m : shown.meshes)
        for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
            const std::uint8_t kind = kind_of(m.kind, f);
            const bool valued = !m.value.empty() && !m.ghost && shown.classes[kind].context;
            see(kind, valued && std::ranges::none_of(m.mesh.faces[f], [&](std::uint32_t corner) {
                          return std::isnan(m.value[corner]);
                      }));
        }
    for (const scene_dots& d : shown.dots)
        for (std::size_t i = 0; i < d.points.size(); ++i)
            if (is_finite(d.points[i]))
                see(kind_of(d.kind, i), !d.value.empty() && !std::isnan(d.value[i]));
}

struct side {
    std::uint32_t a, b, face;  ///< a < b
    friend auto operator<=>(const side&, const side&) = default;
};

/// All sides of faces, those of an edge beside each other.
std::vector<side> sides_of(tf::mesh_view mesh) {
    std::vector<side> sides;
    sides.reserve(3 * mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]);
            if (a != b) sides.push_back({a, b, f});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

}  // namespace

std::string scene_color(std::size_t number) {
    static constexpr std::array<const char*, 10> first{"#4e79a7", "#f28e2b", "#59a14f", "#b07aa1",
                                                       "#edc948", "#76b7b2", "#ff9da7", "#9c755f",
                                                       "#e15759", "#3d5a80"};
    if (number < first.size()) return first[number];
    // Hues a golden angle apart, in 360ths of 1,000; brighter and darker in turn.
    const std::size_t hue = number * 137'508 % 360'000;
    const std::array<std::size_t, 3> high{225, 150, 190};
    const std::size_t top = high[number % 3], low = top * 3 / 10;
    const std::size_t rise = low + (top - low) * (hue % 60'000) / 60'000, fall = top + low - rise;
    const std::array<std::array<std::size_t, 3>, 6> sixth{{{top, rise, low},
                                                           {fall, top, low},
                                                           {low, top, rise},
                                                           {low, fall, top},
                                                           {rise, low, top},
                                                           {top, low, fall}}};
    const auto [red, green, blue] = sixth[hue / 60'000];
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(red & 255U),
                  static_cast<unsigned>(green & 255U), static_cast<unsigned>(blue & 255U));
    return text;
}

bool is_finite(const tf::point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

tf::box3 box_of(const scene& shown, bool shown_alone) {
    std::optional<tf::box3> all;
    const auto add = [&](const tf::point3& p, std::uint8_t kind) {
        if (shown_alone && !shown.classes[kind].shown) return;
        if (!all) all = {p, p};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            all->min[axis] = std::min(all->min[axis], p[axis]);
            all->max[axis] = std::max(all->max[axis], p[axis]);
        }
    };
    for (const scene_mesh& m : shown.meshes)
        for (std::size_t f = 0; f < m.mesh.faces.size(); ++f)
            for (const std::uint32_t corner : m.mesh.faces[f])
                add(m.mesh.points[corner], m.kind[m.kind.size() == 1 ? 0 : f]);
    for (const scene_lines& l : shown.lines)
        for (const auto& ends : l.ends)
            for (const tf::point3& p : ends) add(p, l.kind);
    for (const scene_dots& d : shown.dots)
        for (std::size_t i = 0; i < d.points.size(); ++i)
            if (is_finite(d.points[i])) add(d.points[i], d.kind[d.kind.size() == 1 ? 0 : i]);
    for (const scene_arrow& a : shown.arrows)
        for (const tf::point3& p : {a.from, a.to}) add(p, a.kind);
    return all.value_or(tf::box3{});
}

std::vector<bool> used_classes(const scene& shown) {
    std::vector<bool> used(shown.classes.size(), false);
    for_items(shown, [&](std::uint8_t kind, bool) { used[kind] = true; });
    for (const scene_lines& l : shown.lines)
        if (!l.ends.empty()) used[l.kind] = true;
    for (const scene_label& l : shown.labels) used[l.kind] = true;
    for (const scene_arrow& a : shown.arrows) used[a.kind] = true;
    return used;
}

std::vector<bool> mapped_classes(const scene& shown) {
    std::vector<bool> mapped(shown.classes.size(), false), plain(shown.classes.size(), false);
    if (!shown.map) return mapped;
    for_items(shown, [&](std::uint8_t kind, bool valued) {
        mapped[kind] = mapped[kind] || valued;
        plain[kind] = plain[kind] || !valued;
    });
    for (std::size_t k = 0; k < mapped.size(); ++k) mapped[k] = mapped[k] && !plain[k];
    return mapped;
}

open_edges find_open_edges(tf::mesh_view given) {
    const tf::mesh mesh = tf::join_meshes({&given, 1});
    const std::vector<side> sides = sides_of(mesh);
    std::vector<side> open;
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b)
            ++end;
        if (end - i == 1) open.push_back(sides[i]);
    }
    std::sort(open.begin(), open.end(),
              [](const side& x, const side& y) { return x.face < y.face; });
    std::vector<std::uint32_t> root(mesh.points.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](std::uint32_t p) {
        while (root[p] != p) p = root[p] = root[root[p]];
        return p;
    };
    for (const side& s : open) root[find(s.a)] = find(s.b);
    open_edges result;
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (const side& s : open) {
        std::uint32_t& hole = number[find(s.a)];
        if (hole == none) hole = result.holes++;
        result.ends.push_back({mesh.points[s.a], mesh.points[s.b]});
        result.hole.push_back(hole);
    }
    return result;
}

}  // namespace tools
