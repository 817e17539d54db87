#include "tools/picture/sheet.hpp"

#include "tools/picture/drawing.hpp"
#include "tools/picture/legend.hpp"
#include "tools/picture/tiles.hpp"
#include "tools/picture/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace tools {
namespace {

constexpr double filled = 0.92;  // of a pane, by what is shown

std::vector<std::string> variants_of(const scene& shown) {
    std::vector<std::string> variants;
    for (const char* v : {"before", "after"})
        if (std::any_of(shown.meshes.begin(), shown.meshes.end(),
                        [&](const scene_mesh& m) { return m.variant == v; }))
            variants.emplace_back(v);
    if (variants.empty()) variants.emplace_back();
    return variants;
}

/// As many columns as make panes the most like squares.
std::size_t columns_for(std::size_t count, const area& room, std::size_t multiple) {
    std::size_t best = multiple;
    double most = 0.0;
    for (std::size_t columns = multiple; columns <= count; columns += multiple) {
        const std::size_t rows = (count + columns - 1) / columns;
        const double side = std::min(room.width / static_cast<double>(columns),
                                     room.height / static_cast<double>(rows));
        if (side > most) {
            most = side;
            best = columns;
        }
    }
    return best;
}

std::vector<pane> panes_of(const picture_options& options, const area& room,
                           const std::vector<std::string>& variants) {
    std::vector<pane> panes;
    for (const view v : options.views)
        for (const std::string& variant : variants) panes.push_back({{}, v, variant});
    const std::size_t columns = columns_for(panes.size(), room, variants.size());
    const std::size_t rows = (panes.size() + columns - 1) / columns;
    const auto cut = [](double size, std::size_t i, std::size_t count) {
        return std::floor(size * static_cast<double>(i) / static_cast<double>(count));
    };
    for (std::size_t i = 0; i < panes.size(); ++i) {
        const std::size_t column = i % columns, row = i / columns;
        const double left = cut(room.width, column, columns), top = cut(room.height, row, rows);
        panes[i].box = {room.x + left, room.y + top, cut(room.width, column + 1, columns) - left,
                        cut(room.height, row + 1, rows) - top};
    }
    return panes;
}

/// The frame of what is shown, to the right and up.
struct frame {
    static constexpr double huge = std::numeric_limits<double>::infinity();
    std::array<double, 2> low{huge, huge};
    std::array<double, 2> high{-huge, -huge};
    void add(const std::array<double, 3>& p) {
        for (std::size_t i = 0; i < 2; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    }
};

frame frame_of(const scene& shown, const eye& from, const tf::box3& all, const tf::box3& matters) {
    frame f;
    for (unsigned corner = 0; corner < 8 && matters != all; ++corner)
        f.add(from({(corner & 1U) != 0 ? matters.max.x : matters.min.x,
                    (corner & 2U) != 0 ? matters.max.y : matters.min.y,
                    (corner & 4U) != 0 ? matters.max.z : matters.min.z}));
    if (matters != all) return f;
    for (const scene_mesh& m : shown.meshes)
        for (std::size_t i = 0; i < m.mesh.faces.size(); ++i)
            if (class_of(shown, m.kind, i).shown)
                for (const std::uint32_t c : m.mesh.faces[i]) f.add(from(m.mesh.points[c]));
    for (const scene_lines& l : shown.lines)
        for (const auto& ends : l.ends)
            for (const tf::point3& p : ends)
                if (shown.classes[l.kind].shown) f.add(from(p));
    for (const scene_dots& d : shown.dots)
        for (std::size_t i = 0; i < d.points.size(); ++i)
            if (class_of(shown, d.kind, i).shown && is_finite(d.points[i]))
                f.add(from(d.points[i]));
    for (const scene_arrow& a : shown.arrows)
        for (const tf::point3& p : {a.from, a.to}) f.add(from(p));
    if (!(f.low[0] <= f.high[0])) f.add({0.0, 0.0, 0.0});
    return f;
}

/// Fits all panes, to one scale.
void fit(std::vector<pane>& panes, const scene& shown, const tf::box3& all) {
    const tf::box3 matters = box_that_matters(shown, all);
    double scale = 1e7;  // of a single point
    for (pane& p : panes) {
        const frame f = frame_of(shown, eye(p.from, shown.y_is_up, all), all, matters);
        for (std::size_t i = 0; i < 2; ++i) {
            p.middle[i] = 0.5 * (f.low[i] + f.high[i]);
            const double side = i == 0 ? p.box.width : p.box.height;
            const double size = f.high[i] - f.low[i];
            if (size > 0.0) scale = std::min(scale, filled * side / size);
        }
    }
    for (pane& p : panes) p.scale = scale;
}

double longest_side(const tf::box3& box) {
    double longest = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        longest = std::max(longest, box.max[axis] - box.min[axis]);
    return longest;
}

}  // namespace

picture draw(const scene& shown, const picture_options& options) {
    picture drawn(options.width, options.height);
    const auto width = static_cast<double>(options.width);
    const auto height = static_cast<double>(options.height);
    const lettering letters(options.width, options.height);
    const double top = std::floor(title_height(shown, letters));
    const double below = std::ceil(legend_height(shown, letters, width));
    const area room{0.0, top, width, std::max(1.0, height - top - below)};
    const tf::box3 all = box_of(shown, true);
    std::vector<pane> panes = panes_of(options, room, variants_of(shown));
    fit(panes, shown, all);
    for (const pane& at : panes) {
        const drawing made = make_drawing(shown, all, at);
        paint(drawn, made, at.box);
        std::string name = at.variant;
        if (panes.size() > 1 && options.views.size() > 1)
            name += (name.empty() ? "" : ", ") + std::string(view_names[std::size_t(at.from)]);
        draw_words(drawn, at, made.labels, letters, name);
    }
    draw_title(drawn, shown, letters);
    draw_legend(drawn, shown, letters, panes.front().scale / longest_side(all));
    return drawn;
}

}  // namespace tools
