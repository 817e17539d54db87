#include "tools/picture/drawing.hpp"

#include "tools/picture/words.hpp"
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace tools {
namespace {

constexpr double samples = 2.0;  // a pixel, each way
constexpr std::size_t most_labels = 200;

std::vector<rgb> ramp_of(const std::vector<std::string>& colors) {
    constexpr std::size_t steps = 256;
    std::vector<rgb> ramp(steps);
    for (std::size_t i = 0; i < steps; ++i) {
        const std::size_t at = i * (colors.size() - 1);
        const std::size_t low = at / (steps - 1), rest = at % (steps - 1);
        ramp[i] =
            blended(color_of(colors[low]), color_of(colors[std::min(low + 1, colors.size() - 1)]),
                    static_cast<unsigned>(256 * rest / (steps - 1)));
    }
    return ramp;
}

class maker {
  public:
    maker(const scene& shown, const tf::box3& all, const pane& at)
        : shown_(shown), at_(at), eye_(at.from, shown.y_is_up, all) {
        made_.source = &shown;
        for (const scene_class& c : shown.classes) made_.colors.push_back(color_of(c.color));
        if (shown.map) made_.ramp = ramp_of(shown.map->colors);
        scale_ = samples * std::max({at.box.width, at.box.height, 300.0}) / 2000.0;
        scale_ = std::max(scale_, 1.0);
    }

    void add(const scene_mesh& m);
    void add(const scene_lines& l);
    void add(const scene_dots& d);
    void add(const scene_arrow& a);
    void add(const scene_label& l) {
        if (shown_.classes[l.kind].shown) label(place_of(l.at), l.text, l.kind);
    }
    drawing finish();

  private:
    [[nodiscard]] bool here(const std::string& variant) const {
        return variant.empty() || variant == at_.variant;
    }
    [[nodiscard]] sample_point place_of(const tf::point3& p) const {
        const auto [right, up, toward] = eye_(p);
        const area& box = at_.box;
        return {samples * (box.x + 0.5 * box.width + (right - at_.middle[0]) * at_.scale),
                samples * (box.y + 0.5 * box.height - (up - at_.middle[1]) * at_.scale),
                samples * toward * at_.scale};
    }
    void segment(const sample_point& a, const sample_point& b, double width, std::uint8_t kind) {
        const bool context = shown_.classes[kind].context;
        made_.strokes.push_back({{a, b}, 0.5 * width * scale_, made_.colors[kind], false, context});
    }
    void label(const sample_point& p, const std::string& text, std::uint8_t kind) {
        made_.labels.push_back({p, text, blended(made_.colors[kind], ink, 96)});
    }

    const scene& shown_;
    const pane& at_;
    eye eye_;
    double scale_;  // of widths: samples a pixel of a page
    drawing made_{};
};

void maker::add(const scene_mesh& m) {
    if (!here(m.variant)) return;
    const auto first = static_cast<std::uint32_t>(made_.points.size());
    made_.meshes.push_back({&m, static_cast<std::uint32_t>(made_.corners.size()), first});
    made_.points.resize(first + m.mesh.points.size());
    tf::for_chunks(m.mesh.points.size(), tf::light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           made_.points[first + i] = place_of(m.mesh.points[i]);
                   });
    for (std::uint32_t f = 0; f < m.mesh.faces.size(); ++f) {
        const std::uint8_t kind = m.kind[m.kind.size() == 1 ? 0 : f];
        if (!shown_.classes[kind].shown) continue;
        const tf::face& corner = m.mesh.faces[f];
        made_.corners.push_back({first + corner[0], first + corner[1], first + corner[2]});
        made_.face.push_back(f);
        made_.kind.push_back(kind);
    }
}

void maker::add(const scene_lines& l) {
    if (!here(l.variant) || !shown_.classes[l.kind].shown) return;
    for (std::size_t i = 0; i < l.ends.size(); ++i) {
        const sample_point a = place_of(l.ends[i][0]), b = place_of(l.ends[i][1]);
        segment(a, b, l.width, l.kind);
        if (l.labeled.empty() || i >= most_labels) continue;
        const tf::point3 &p = l.ends[i][0], &q = l.ends[i][1];
        const std::string text =
            l.labeled == "length"
                ? with_unit(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z), shown_.unit)
                : std::to_string(l.number.empty() ? i : l.number[i]);
        label({0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)}, text, l.kind);
    }
}

void maker::add(const scene_dots& d) {
    if (!here(d.variant)) return;
    const double width = d.width * (d.points.size() < 3000 ? 1.6 : 1.0);
    for (std::size_t i = 0; i < d.points.size(); ++i) {
        const scene_class& own = class_of(shown_, d.kind, i);
        if (!own.shown || !is_finite(d.points[i])) continue;
        const std::uint8_t kind = d.kind[d.kind.size() == 1 ? 0 : i];
        const sample_point at = place_of(d.points[i]);
        rgb color = made_.colors[kind];
        if (!d.value.empty()) color = made_.mapped(d.value[i]).value_or(color);
        made_.strokes.push_back({{at, at}, 0.5 * width * scale_, color, true, own.context});
        if (d.normal.empty()) continue;
        const double reach = 0.06 * samples * at_.scale;
        const auto [right, up, toward] = eye_.turned(d.normal[i]);
        segment(at, {at.x + reach * right, at.y - reach * up, at.z + reach * toward}, 2.0, kind);
    }
}

void maker::add(const scene_arrow& a) {
    if (!shown_.classes[a.kind].shown) return;
    const sample_point from = place_of(a.from), to = place_of(a.to);
    segment(from, to, 3.0, a.kind);
    const double x = to.x - from.x, y = to.y - from.y, way = std::sqrt(x * x + y * y);
    const double head = std::min(0.4 * way, 16.0 * scale_);
    for (const double side : {-0.5, 0.5})
        if (way > 0.0)
            segment(to,
                    {to.x - head * (x - side * y) / way, to.y - head * (y + side * x) / way, to.z},
                    3.0, a.kind);
    label({0.5 * (from.x + to.x), 0.5 * (from.y + to.y), to.z}, a.text, a.kind);
}

drawing maker::finish() {
    using box = tf::aabb<double, 2>;
    std::vector<std::uint32_t> numbers(made_.corners.size() + made_.strokes.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
    made_.tree = tf::build(numbers, [&](std::uint32_t i) {
        if (i < made_.corners.size()) {
            const auto [a, b, c] = made_.triangle(i);
            return box{{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
                       {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
        }
        const drawn_stroke& s = made_.strokes[i - made_.corners.size()];
        const double reach = s.reach + 1.0;
        return box{{std::min(s.ends[0].x, s.ends[1].x) - reach,
                    std::min(s.ends[0].y, s.ends[1].y) - reach},
                   {std::max(s.ends[0].x, s.ends[1].x) + reach,
                    std::max(s.ends[0].y, s.ends[1].y) + reach}};
    });
    return std::move(made_);
}

}  // namespace

const drawn_mesh& drawing::mesh_of(std::uint32_t face_number) const {
    const auto after = std::upper_bound(
        meshes.begin(), meshes.end(), face_number,
        [](std::uint32_t number, const drawn_mesh& m) { return number < m.first_face; });
    return *(after - 1);
}

bool drawing::is_finding(std::uint32_t face_number) const {
    return !source->classes[kind[face_number]].context;
}

std::optional<rgb> drawing::mapped(double value) const {
    if (ramp.empty() || std::isnan(value)) return {};
    const scene_map& map = *source->map;
    if (map.band && value >= (*map.band)[0] && value <= (*map.band)[1]) return in_band;
    const double share = (value - map.low) / std::max(map.high - map.low, 1e-300);
    return ramp[static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5)];
}

drawing make_drawing(const scene& shown, const tf::box3& all, const pane& at) {
    maker drawn(shown, all, at);
    for (const scene_mesh& m : shown.meshes) drawn.add(m);
    for (const scene_lines& l : shown.lines) drawn.add(l);
    for (const scene_dots& d : shown.dots) drawn.add(d);
    for (const scene_arrow& a : shown.arrows) drawn.add(a);
    for (const scene_label& l : shown.labels) drawn.add(l);
    return drawn.finish();
}

}  // namespace tools
