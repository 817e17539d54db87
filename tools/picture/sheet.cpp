#include "tools/picture/sheet.hpp"

#include "tools/picture/canvas.hpp"
#include "tools/picture/drawing.hpp"
#include "tools/picture/font.hpp"
#include "tools/picture/scene.hpp"
#include "tools/picture/view.hpp"
#include "tools/picture/words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace tools {
namespace {

/// Sizes of all words, for a picture of this size.
struct lettering {
    lettering(std::size_t width, std::size_t height);
    bool any = true;    ///< whether there is room for words
    double size = 0.0;  ///< of capitals, in pixels
    double margin = 0.0;
    double line = 0.0;  ///< from one line to the next
};

constexpr rgb soft{0x5c, 0x64, 0x70};
constexpr rgb good{0x14, 0x7a, 0x3c};
constexpr rgb bad{0xb3, 0x16, 0x1b};
constexpr std::size_t most_rows = 4;

/// Of each class, whether it is listed. A ghost in the color of another class says nothing more.
std::vector<bool> listed_classes(const scene& shown) {
    std::vector<bool> listed = used_classes(shown), ghosts(listed.size(), false);
    for (const scene_mesh& m : shown.meshes)
        for (const std::uint8_t kind : m.kind) ghosts[kind] = m.ghost;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        if (!shown.classes[i].shown) listed[i] = false;
        for (std::size_t k = 0; k < i && ghosts[i]; ++k)
            if (listed[k] && shown.classes[k].color == shown.classes[i].color) listed[i] = false;
    }
    return listed;
}

/// An entry of the legend, where it stands.
struct entry {
    pixel_position at{};
    std::size_t kind = 0;
    std::string text{};
};

struct layout {
    std::vector<entry> entries{};
    std::size_t rows = 0;  ///< those of the map and the scale are one more
};

layout lay_out(const scene& shown, const lettering& letters, double width) {
    layout made;
    const std::vector<bool> listed = listed_classes(shown);
    const double right = width - letters.margin, indent = 1.8 * letters.size;
    pixel_position at{letters.margin, 0.0};
    for (std::size_t k = 0; k < listed.size(); ++k) {
        if (!listed[k]) continue;
        const scene_class& c = shown.classes[k];
        const std::string text = shortened(c.name + (c.count.empty() ? "" : ": " + c.count),
                                           letters.size, right - letters.margin - indent);
        const double needs = indent + text_width(text, letters.size);
        if (at.x > letters.margin && at.x + needs > right) at = {letters.margin, at.y + 1.0};
        if (at.y >= static_cast<double>(most_rows)) {  // no room: the page lists them all
            made.entries.back().text += " ...";
            break;
        }
        made.entries.push_back({at, k, text});
        at.x += needs + 2.2 * letters.size;
        made.rows = static_cast<std::size_t>(at.y) + 1;
    }
    return made;
}

/// The longest of 1, 2, 5, 10 ... that is no more than `most`.
double round_length(double most) {
    double power = 1.0;
    while (power > most && power > 1e-300) power /= 10.0;
    while (power * 10.0 <= most && power < 1e300) power *= 10.0;
    return power * (5.0 * power <= most ? 5.0 : 2.0 * power <= most ? 2.0 : 1.0);
}

/// The colors of the map, from left to right.
void fill(picture& on, const area& box, const scene_map& map) {
    const std::size_t steps = map.colors.size() - 1;
    const auto columns = static_cast<std::size_t>(std::max(box.width, 1.0));
    for (std::size_t i = 0; i < columns; ++i) {
        const std::size_t share = 256 * steps * i / columns;
        const rgb color = blended(color_of(map.colors[share / 256]),
                                  color_of(map.colors[std::min(share / 256 + 1, steps)]),
                                  static_cast<unsigned>(share % 256));
        fill(on, {box.x + static_cast<double>(i), box.y, 1.0, box.height}, color);
    }
}

void draw_scale(picture& on, const lettering& letters, double y, double pixels,
                const std::string& unit) {
    const double most = 0.16 * static_cast<double>(on.width);
    if (!(pixels > 0.0) || !(most / pixels < 1e300)) return;
    const double length = round_length(most / pixels);
    const std::string text = with_unit(length, unit);
    const double right = static_cast<double>(on.width) - letters.margin - letters.size;
    const double left = right - length * pixels;
    const double high = 0.4 * letters.size;
    const std::array<std::array<pixel_position, 2>, 3> bar{
        {{{{left, y}, {right, y}}},
         {{{left, y - high}, {left, y + high}}},
         {{{right, y - high}, {right, y + high}}}}};
    stroke(on, bar, std::max(1.0, 0.16 * letters.size), ink);
    draw_text(on, {left - text_width(text, letters.size) - letters.size, y + 0.5 * letters.size},
              text, letters.size, ink);
}

void draw_map(picture& on, const scene_map& map, const lettering& letters, double y,
              const std::string& unit) {
    const double base = y + 0.5 * letters.size;
    pixel_position at{letters.margin, base};
    const auto write = [&](const std::string& text) {
        draw_text(on, at, text, letters.size, ink);
        at.x += text_width(text, letters.size) + letters.size;
    };
    write(map.name);
    write(with_unit(map.low, unit));
    const double width = 0.2 * static_cast<double>(on.width);
    fill(on, {at.x, y - 0.5 * letters.size, width, letters.size}, map);
    at.x += width + letters.size;
    write(with_unit(map.high, unit));
    if (!map.band) return;
    fill(on, {at.x, y - 0.5 * letters.size, letters.size, letters.size}, in_band);
    at.x += 1.8 * letters.size;
    write("within " + with_unit((*map.band)[0], "") + " to " + with_unit((*map.band)[1], unit));
}

lettering::lettering(std::size_t width, std::size_t height) {
    any = width >= 320 && height >= 240;
    if (!any) return;
    const double side =
        std::min(static_cast<double>(width), static_cast<double>(height) * 4.0 / 3.0);
    size = std::clamp(side / 115.0, 6.5, 60.0);
    margin = 1.5 * size;
    line = 2.1 * size;
}

/// The height that the title needs above, and the legend below.
double title_height(const scene& shown, const lettering& letters) {
    if (!letters.any) return 0.0;
    return letters.margin + letters.line * (shown.verdict.empty() ? 1.2 : 2.2);
}

double legend_height(const scene& shown, const lettering& letters, double width) {
    if (!letters.any) return 0.0;
    const auto rows = static_cast<double>(lay_out(shown, letters, width).rows + 1);
    return rows * letters.line + 0.5 * letters.margin;
}

void draw_title(picture& on, const scene& shown, const lettering& letters) {
    if (!letters.any) return;
    const double room = static_cast<double>(on.width) - 2.0 * letters.margin;
    double y = letters.margin + letters.size;
    const double large = 1.25 * letters.size;
    draw_text(on, {letters.margin, y}, shortened(shown.title, large, room), large, ink);
    y += letters.line;
    draw_text(on, {letters.margin, y}, shortened(shown.verdict, letters.size, room), letters.size,
              shown.good ? good : bad);
}

/// Swatches with names and counts, the map, and a bar as long as it says: `pixels` are one unit of
/// the file.
void draw_legend(picture& on, const scene& shown, const lettering& letters, double pixels) {
    if (!letters.any) return;
    const auto width = static_cast<double>(on.width);
    const double top = static_cast<double>(on.height) - legend_height(shown, letters, width);
    const layout made = lay_out(shown, letters, width);
    const std::vector<bool> mapped = mapped_classes(shown);
    const auto row = [&](double r) { return top + letters.line * (r + 0.5); };
    for (const entry& e : made.entries) {
        const double y = row(e.at.y);
        const area swatch{e.at.x, y - 0.55 * letters.size, 1.1 * letters.size, 1.1 * letters.size};
        if (mapped[e.kind])
            fill(on, swatch, *shown.map);
        else
            fill(on, swatch, color_of(shown.classes[e.kind].color));
        draw_text(on, {e.at.x + 1.8 * letters.size, y + 0.5 * letters.size}, e.text, letters.size,
                  ink);
    }
    const double last = row(static_cast<double>(made.rows));
    draw_scale(on, letters, last, pixels, shown.unit);
    if (shown.map) draw_map(on, *shown.map, letters, last, shown.unit);
}

/// The name of a view in its corner, and the labels of things, those that are in the way of an
/// earlier one left out.
void draw_words(picture& on, const pane& at, const std::vector<drawn_label>& labels,
                const lettering& letters, const std::string& name) {
    if (!letters.any) return;
    std::vector<area> taken;
    for (const drawn_label& l : labels) {
        const double x = 0.5 * l.at.x + 0.5 * letters.size, y = 0.5 * l.at.y - 0.4 * letters.size;
        const area own{x, y - letters.size, text_width(l.text, letters.size), 1.3 * letters.size};
        const bool inside = own.x >= at.box.x && own.x + own.width <= at.box.x + at.box.width &&
                            own.y >= at.box.y && own.y + own.height <= at.box.y + at.box.height;
        const bool in_the_way = std::any_of(taken.begin(), taken.end(), [&](const area& other) {
            return own.x < other.x + other.width && other.x < own.x + own.width &&
                   own.y < other.y + other.height && other.y < own.y + own.height;
        });
        if (!inside || in_the_way) continue;
        taken.push_back(own);
        draw_label(on, {x, y}, l.text, letters.size, l.color);
    }
    draw_text(on, {at.box.x + letters.margin, at.box.y + 1.3 * letters.size}, name, letters.size,
              soft);
}

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
