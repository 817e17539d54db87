#include "tools/picture/canvas.hpp"
#include "tools/picture/drawing.hpp"
#include "tools/picture/layers.hpp"
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tools {
namespace {

constexpr unsigned halo_share = 140;  // of 256

/// `found` [height][width]: the class of what was found at each pixel, plus 1; 0 where nothing was.
/// Where few pixels of it are together, those around have its color, too.
void add_halos(picture& on, const std::vector<std::uint8_t>& found,
               const std::vector<rgb>& colors) {
    if (std::all_of(found.begin(), found.end(), [](std::uint8_t f) { return f == 0; })) return;
    const std::size_t reach = std::clamp<std::size_t>(on.width / 300, 1, 8);
    // sums[y][x]: pixels found above and to the left, for the count in any box by four of them.
    const std::size_t row = on.width + 1;
    std::vector<std::uint32_t> sums(row * (on.height + 1), 0);
    for (std::size_t y = 0; y < on.height; ++y)
        for (std::size_t x = 0; x < on.width; ++x)
            sums[(y + 1) * row + x + 1] = (found[y * on.width + x] != 0 ? 1U : 0U) +
                                          sums[y * row + x + 1] + sums[(y + 1) * row + x] -
                                          sums[y * row + x];
    std::vector<std::uint8_t> halo(found.size(), 0);
    for (std::size_t y = 0; y < on.height; ++y)
        for (std::size_t x = 0; x < on.width; ++x) {
            const std::uint8_t kind = found[y * on.width + x];
            if (kind == 0) continue;
            const std::size_t x0 = x - std::min(x, reach), x1 = std::min(x + reach + 1, on.width);
            const std::size_t y0 = y - std::min(y, reach), y1 = std::min(y + reach + 1, on.height);
            const std::uint32_t near = sums[y1 * row + x1] - sums[y0 * row + x1] -
                                       sums[y1 * row + x0] + sums[y0 * row + x0];
            if (near > 2 * reach + 1) continue;
            for (std::size_t j = y0; j < y1; ++j)
                for (std::size_t i = x0; i < x1; ++i) {
                    const std::size_t dx = i > x ? i - x : x - i, dy = j > y ? j - y : y - j;
                    std::uint8_t& there = halo[j * on.width + i];
                    if (dx * dx + dy * dy <= reach * reach && there == 0) there = kind;
                }
        }
    for (std::size_t i = 0; i < halo.size(); ++i)
        if (halo[i] != 0 && found[i] == 0)
            on.pixels[i] = blended(on.pixels[i], colors[halo[i] - 1U], halo_share);
}

constexpr long tile_pixels = 64;
constexpr long rim = 4;                  // samples around a tile, for its contours
constexpr unsigned faint = 77;           // of 256: what shines through
constexpr unsigned glass = 60;           // of 256: ghosts
constexpr double step_of_contour = 5.0;  // samples: a nearer step in depth is none
constexpr double crease = 0.82;          // cosine of the angle between faces that make one

/// How a face looks at the eye.
struct face_look {
    std::array<float, 3> normal{};  ///< of length 1: right, up, toward the eye
    float height = 0.0F;            ///< the least, on the screen
    bool inside = false;            ///< one sees its back
};

face_look look_of(const std::array<sample_point, 3>& t) {
    const double ux = t[1].x - t[0].x, uy = t[0].y - t[1].y, uz = t[1].z - t[0].z;
    const double vx = t[2].x - t[0].x, vy = t[0].y - t[2].y, vz = t[2].z - t[0].z;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
    face_look look;
    if (!(length > 0.0)) return look;
    look.inside = nz < 0.0;
    const double turn = look.inside ? -1.0 / length : 1.0 / length;
    look.normal = {static_cast<float>(nx * turn), static_cast<float>(ny * turn),
                   static_cast<float>(nz * turn)};
    const double wx = vx - ux, wy = vy - uy;
    const double longest = std::max({ux * ux + uy * uy, vx * vx + vy * vy, wx * wx + wy * wy});
    look.height = static_cast<float>(std::abs(nz) / std::sqrt(std::max(longest, 1e-300)));
    return look;
}

/// Soft light from everywhere, some from the eye, most from above on the left.
double light_of(const face_look& look) {
    const auto& [x, y, z] = look.normal;
    const double lamp = std::max(0.0, -0.36 * double{x} + 0.56 * double{y} + 0.745 * double{z});
    const double light = 0.48 + 0.36 * lamp + 0.18 * double{z};
    return look.inside ? 0.72 * light : light;
}

rgb lit(const rgb& color, double light) {
    rgb result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = static_cast<std::uint8_t>(std::min(255.0, color[i] * light + 0.5));
    return result;
}

class tile {
  public:
    tile(const drawing& drawn, const std::vector<face_look>& looks, long contour)
        : drawn_(drawn), looks_(looks), contour_(contour) {}

    /// Paints pixels [x0, x1) x [y0, y1), and names the class of what was found there, plus 1.
    void paint(picture& on, std::vector<std::uint8_t>& found, long x0, long y0, long x1, long y1);

  private:
    [[nodiscard]] bool is_face(std::uint32_t id) const { return id < drawn_.corners.size(); }
    [[nodiscard]] const drawn_stroke& stroke_of(std::uint32_t id) const {
        return drawn_.strokes[id - drawn_.corners.size()];
    }
    void put_face(std::uint32_t id);
    void put_sliver(std::uint32_t id, const std::array<sample_point, 3>& t);
    void put_stroke(std::uint32_t id);
    [[nodiscard]] rgb sample(std::size_t at) const;
    [[nodiscard]] rgb plain_color(std::uint32_t id, std::size_t at) const;
    [[nodiscard]] rgb stroke_color(std::uint32_t id, std::size_t at) const;
    [[nodiscard]] double contour(std::size_t at) const;
    [[nodiscard]] double contour_towards(std::size_t at, std::size_t next, double dx,
                                         double dy) const;
    [[nodiscard]] sample_point middle_of(std::size_t at) const {
        const auto column = static_cast<long>(at) % grid_.size;
        const auto row = static_cast<long>(at) / grid_.size;
        return {static_cast<double>(grid_.x + column) + 0.5,
                static_cast<double>(grid_.y + row) + 0.5, 0.0};
    }

    const drawing& drawn_;
    const std::vector<face_look>& looks_;
    long contour_;  // reach of contours, in samples
    sample_grid grid_{};
    layer base_{}, found_{}, ghosts_{}, marks_{};
};

void tile::put_face(std::uint32_t id) {
    const auto t = drawn_.triangle(id);
    const bool ghost = drawn_.mesh_of(id).source->ghost;
    layer& to = ghost ? ghosts_ : base_;
    const bool finding = !ghost && drawn_.is_finding(id);
    for_samples(t, grid_, [&](std::size_t at, double z) {
        to.put(at, z, id);
        if (finding) found_.put(at, z, id);
    });
    if (finding) put_sliver(id, t);
}

/// What was found may lie between the samples: then its longest edge stands for it.
void tile::put_sliver(std::uint32_t id, const std::array<sample_point, 3>& t) {
    std::array<sample_point, 2> longest{};
    double most = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const sample_point &a = t[i], &b = t[(i + 1) % 3];
        const double square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
        if (square > most) {
            most = square;
            longest = {a, b};
        }
    }
    constexpr double thin = 2.0;
    if (std::abs(twice_area(t)) > thin * std::sqrt(most)) return;
    for_samples(longest, 0.5 * thin, grid_,
                [&](std::size_t at, double z) { found_.put(at, z, id); });
}

void tile::put_stroke(std::uint32_t id) {
    const drawn_stroke& s = stroke_of(id);
    layer& to = s.context ? base_ : marks_;
    for_samples(s.ends, s.reach, grid_, [&](std::size_t at, double z) { to.put(at, z, id); });
}

rgb tile::plain_color(std::uint32_t id, std::size_t at) const {
    const rgb& own = drawn_.colors[drawn_.kind[id]];
    const drawn_mesh& from = drawn_.mesh_of(id);
    if (from.source->value.empty() || drawn_.is_finding(id) || from.source->ghost) return own;
    auto t = drawn_.triangle(id);
    for (std::size_t i = 0; i < 3; ++i) {
        t[i].z = from.source->value[drawn_.corners[id][i] - from.first_point];
        if (std::isnan(t[i].z)) return own;
    }
    const sample_point p = middle_of(at);
    return drawn_.mapped(depth_plane(t, twice_area(t)).at(p.x, p.y)).value_or(own);
}

rgb tile::stroke_color(std::uint32_t id, std::size_t at) const {
    const drawn_stroke& s = stroke_of(id);
    if (!s.round) return s.color;
    const sample_point p = middle_of(at);
    const double dx = p.x - s.ends[0].x, dy = p.y - s.ends[0].y;
    return lit(s.color, 1.0 - 0.35 * (dx * dx + dy * dy) / (s.reach * s.reach));
}

/// How dark a contour is between a sample and one that is (dx, dy) from it, right and up.
double tile::contour_towards(std::size_t at, std::size_t next, double dx, double dy) const {
    const std::uint32_t a = base_.id[at], b = base_.id[next];
    if (a == b) return 0.0;
    if (b == nothing) return 0.7;
    if (!is_face(b)) return 0.0;
    const face_look &own = looks_[a], &other = looks_[b];
    const double nz = std::max(0.08, double{own.normal[2]});
    const double expected =
        double{base_.z[at]} - (dx * double{own.normal[0]} + dy * double{own.normal[1]}) / nz;
    if (double{base_.z[next]} < expected - step_of_contour) return 0.7;
    const double cosine = double{own.normal[0]} * double{other.normal[0]} +
                          double{own.normal[1]} * double{other.normal[1]} +
                          double{own.normal[2]} * double{other.normal[2]};
    if (cosine < crease || own.inside != other.inside) return 0.4;
    const double height = double{std::min(own.height, other.height)};
    return 0.16 * std::clamp((height - 12.0) / 40.0, 0.0, 1.0);
}

double tile::contour(std::size_t at) const {
    const auto step = static_cast<std::size_t>(contour_);
    const auto row = static_cast<std::size_t>(grid_.size) * step;
    const auto far = static_cast<double>(contour_);
    return std::max(std::max(contour_towards(at, at - step, -far, 0.0),
                             contour_towards(at, at + step, far, 0.0)),
                    std::max(contour_towards(at, at - row, 0.0, far),
                             contour_towards(at, at + row, 0.0, -far)));
}

rgb tile::sample(std::size_t at) const {
    rgb color = paper;
    const std::uint32_t id = base_.id[at];
    const bool on_face = id != nothing && is_face(id);
    if (on_face)
        color = lit(plain_color(id, at), light_of(looks_[id]) * (1.0 - contour(at)));
    else if (id != nothing)
        color = stroke_color(id, at);
    if (const std::uint32_t ghost = ghosts_.id[at];
        ghost != nothing && ghosts_.z[at] > base_.z[at]) {
        const bool edge = !ghosts_.any(at - 1) || !ghosts_.any(at + 1);
        color = blended(color, lit(plain_color(ghost, at), light_of(looks_[ghost])),
                        edge ? 2 * glass : glass);
    }
    if (const std::uint32_t hidden = found_.id[at];
        hidden != nothing && !(on_face && drawn_.is_finding(id))) {
        const rgb& own = drawn_.colors[drawn_.kind[hidden]];
        color = blended(color, own, found_.z[at] + 2.0F >= base_.z[at] ? 256 : faint);
    }
    if (const std::uint32_t mark = marks_.id[at]; mark != nothing) {
        const double bias = 2.0 * stroke_of(mark).reach + 4.0;
        const bool front = double{marks_.z[at]} + bias >= double{base_.z[at]};
        color = blended(color, stroke_color(mark, at), front ? 256 : faint);
    }
    return color;
}

void tile::paint(picture& on, std::vector<std::uint8_t>& found, long x0, long y0, long x1,
                 long y1) {
    grid_ = {2 * x0 - rim, 2 * y0 - rim, 2 * tile_pixels + 2 * rim};
    const auto size = static_cast<std::size_t>(grid_.size);
    for (layer* l : {&base_, &found_, &ghosts_, &marks_}) l->clear(size * size);
    const auto low_x = static_cast<double>(grid_.x), low_y = static_cast<double>(grid_.y);
    const auto side = static_cast<double>(grid_.size);
    const tf::aabb<double, 2> all{{low_x, low_y}, {low_x + side, low_y + side}};
    tf::search(drawn_.tree, all, [&](std::uint32_t id) {
        if (is_face(id))
            put_face(id);
        else
            put_stroke(id);
    });
    for (long y = y0; y < y1; ++y)
        for (long x = x0; x < x1; ++x) {
            const auto first = static_cast<std::size_t>(2 * (y - y0) + rim) * size +
                               static_cast<std::size_t>(2 * (x - x0) + rim);
            std::array<unsigned, 3> sum{2, 2, 2};
            const auto pixel = static_cast<std::size_t>(y) * on.width + static_cast<std::size_t>(x);
            for (const std::size_t at : {first, first + 1, first + size, first + size + 1}) {
                const rgb c = sample(at);
                for (std::size_t i = 0; i < 3; ++i) sum[i] += c[i];
                if (found_.any(at) && found[pixel] == 0)
                    found[pixel] = static_cast<std::uint8_t>(drawn_.kind[found_.id[at]] + 1);
            }
            for (std::size_t i = 0; i < 3; ++i)
                on.pixels[pixel][i] = static_cast<std::uint8_t>(sum[i] / 4);
        }
}

}  // namespace

void paint(picture& on, const drawing& drawn, const area& box) {
    std::vector<face_look> looks(drawn.corners.size());
    tf::for_chunks(looks.size(), tf::light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f)
                           looks[f] = look_of(drawn.triangle(static_cast<std::uint32_t>(f)));
                   });
    const auto x = static_cast<long>(box.x), y = static_cast<long>(box.y);
    const long width = static_cast<long>(box.width), height = static_cast<long>(box.height);
    const long columns = (width + tile_pixels - 1) / tile_pixels;
    const long rows = (height + tile_pixels - 1) / tile_pixels;
    std::vector<std::uint8_t> found(on.pixels.size(), 0);
    tf::for_chunks(static_cast<std::size_t>(columns * rows), 4,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       tile one(drawn, looks, on.width >= 1000 ? 2 : 1);
                       for (std::size_t i = begin; i < end; ++i) {
                           const long left = x + static_cast<long>(i) % columns * tile_pixels;
                           const long top = y + static_cast<long>(i) / columns * tile_pixels;
                           one.paint(on, found, left, top, std::min(left + tile_pixels, x + width),
                                     std::min(top + tile_pixels, y + height));
                       }
                   });
    add_halos(on, found, drawn.colors);
}

}  // namespace tools
