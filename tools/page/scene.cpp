#include "tools/page/scene.hpp"

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

namespace tools {
namespace {

constexpr std::uint32_t grid_steps = 1U << 22;

/// Points in steps from the low corner of the box. Quarters of coordinates keep differences
/// finite.
class lattice {
  public:
    explicit lattice(const tf::box3& box) : low_(box.min) {
        double extent = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            extent = std::max(extent, 0.25 * box.max[axis] - 0.25 * box.min[axis]);
        quarter_step_ = std::max(extent / grid_steps, 1e-300);
    }
    [[nodiscard]] std::array<std::uint32_t, 3> at(const tf::point3& p) const {
        std::array<std::uint32_t, 3> steps{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double offset = (0.25 * p[axis] - 0.25 * low_[axis]) / quarter_step_;
            steps[axis] =
                static_cast<std::uint32_t>(std::clamp(std::round(offset), 0.0, double{grid_steps}));
        }
        return steps;
    }
    [[nodiscard]] double step() const { return std::min(4.0 * quarter_step_, 1e300); }

  private:
    tf::point3 low_;
    double quarter_step_ = 1.0;
};

/// Whole numbers as base64 of zigzag varints: small ones take one byte.
class number_stream {
  public:
    void put(std::int64_t value) {
        std::uint64_t bits =
            (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; bits > 127; bits >>= 7) bytes_ += static_cast<char>((bits & 127) | 128);
        bytes_ += static_cast<char>(bits);
    }
    [[nodiscard]] std::string base64() const;

  private:
    std::string bytes_;
};

std::string number_stream::base64() const {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes_.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = i; j < i + 3; ++j)
            group = group << 8 | (j < bytes_.size() ? static_cast<unsigned char>(bytes_[j]) : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j <= bytes_.size() ? letters[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

/// Marked faces, lowest regions first while there is room.
std::vector<std::uint32_t> choose_marked(const scene_input& input, std::size_t limit) {
    std::vector<std::uint32_t> marked;
    for (std::uint32_t f = 0; f < input.kind.size(); ++f)
        if (input.kind[f] != 0) marked.push_back(f);
    if (marked.size() <= limit) return marked;
    std::stable_sort(marked.begin(), marked.end(), [&](std::uint32_t a, std::uint32_t b) {
        return input.region[a] < input.region[b];
    });
    marked.resize(limit);
    std::sort(marked.begin(), marked.end());
    return marked;
}

using steps3 = std::array<std::uint32_t, 3>;

/// [V] for each point the first point in its cube of a grid; corners of marked faces stay.
std::vector<std::uint32_t> cluster(std::span<const steps3> points, const std::vector<bool>& fixed,
                                   std::uint32_t cubes) {
    std::unordered_map<std::uint64_t, std::uint32_t> first_in_cube;
    std::vector<std::uint32_t> leader(points.size());
    const std::uint32_t edge = grid_steps / cubes + 1;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::uint64_t key = 0;
        for (const std::uint32_t step : points[i]) key = key << 21 | step / edge;
        leader[i] = fixed[i] ? i : first_in_cube.try_emplace(key, i).first->second;
    }
    return leader;
}

struct thinned {
    std::vector<std::uint32_t> leader;  ///< [V]
    std::vector<std::uint32_t> faces;   ///< plain ones that keep three corners
};

/// Joins points in ever larger cubes until few enough plain faces are left.
thinned thin_out(const scene_input& input, std::span<const steps3> points, std::size_t limit) {
    std::vector<bool> fixed(points.size(), false);
    for (std::size_t f = 0; f < input.kind.size(); ++f)
        if (input.kind[f] != 0)
            for (const std::uint32_t corner : input.mesh.faces[f]) fixed[corner] = true;
    thinned result;
    for (std::uint32_t cubes = grid_steps; true; cubes = cubes > 400 ? 400 : cubes * 3 / 4) {
        result.leader = cluster(points, fixed, cubes);
        result.faces.clear();
        for (std::uint32_t f = 0; f < input.kind.size(); ++f) {
            const auto& [a, b, c] = input.mesh.faces[f];
            const std::uint32_t x = result.leader[a];
            const std::uint32_t y = result.leader[b];
            const std::uint32_t z = result.leader[c];
            if (input.kind[f] == 0 && x != y && y != z && z != x) result.faces.push_back(f);
        }
        if (result.faces.size() <= limit) return result;
        if (cubes > 2) continue;
        result.faces.resize(limit);
        return result;
    }
}

void put_point(number_stream& stream, const steps3& point, steps3& last) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        stream.put(std::int64_t{point[axis]} - std::int64_t{last[axis]});
    last = point;
}

void put_faces(number_stream& stream, const scene_input& input,
               std::span<const std::uint32_t> faces, std::span<const std::uint32_t> leader,
               std::span<const std::uint32_t> place) {
    std::int64_t last_corner = 0;
    std::int64_t last_number = 0;
    for (const std::uint32_t f : faces) {
        for (const std::uint32_t corner : input.mesh.faces[f]) {
            const std::int64_t at = place[leader[corner]];
            stream.put(at - last_corner);
            last_corner = at;
        }
        stream.put(std::int64_t{input.number[f]} - last_number);
        last_number = input.number[f];
        stream.put(input.kind[f]);
        if (input.kind[f] != 0) stream.put(static_cast<std::uint32_t>(input.region[f]));
    }
}

/// Points in the order in which faces use them; \returns [V] the place of each.
std::vector<std::uint32_t> put_points(number_stream& stream, const scene_input& input,
                                      std::span<const std::uint32_t> faces,
                                      std::span<const std::uint32_t> leader,
                                      std::span<const steps3> points, std::size_t& count) {
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> place(points.size(), unused);
    steps3 last{};
    for (const std::uint32_t f : faces) {
        for (const std::uint32_t corner : input.mesh.faces[f]) {
            std::uint32_t& at = place[leader[corner]];
            if (at != unused) continue;
            at = static_cast<std::uint32_t>(count++);
            put_point(stream, points[leader[corner]], last);
        }
    }
    return place;
}

}  // namespace

packed_scene pack(const scene_input& input, const scene_limits& limits) {
    packed_scene scene;
    const tf::box3 box = tf::bounding_box(input.mesh.points).value_or(tf::box3{});
    const lattice grid(box);
    std::vector<steps3> points;
    points.reserve(input.mesh.points.size());
    for (const tf::point3& p : input.mesh.points) points.push_back(grid.at(p));
    scene.low = box.min;
    scene.size = grid.at(box.max);
    scene.steps = std::max({scene.size[0], scene.size[1], scene.size[2], 1U});
    scene.step = grid.step();

    const std::vector<std::uint32_t> marked = choose_marked(input, limits.marked);
    const auto all_marked = static_cast<std::size_t>(
        std::count_if(input.kind.begin(), input.kind.end(), [](auto k) { return k != 0; }));
    const thinned plain = thin_out(input, points, limits.plain);
    scene.marked_left_out = all_marked - marked.size();
    scene.plain_left_out = input.mesh.faces.size() - all_marked - plain.faces.size();
    std::vector<std::uint32_t> faces;
    std::merge(plain.faces.begin(), plain.faces.end(), marked.begin(), marked.end(),
               std::back_inserter(faces));
    scene.faces = faces.size();

    number_stream stream;
    const auto place = put_points(stream, input, faces, plain.leader, points, scene.points);
    put_faces(stream, input, faces, plain.leader, place);
    scene.segments = std::min(input.curves.size(), limits.curves);
    scene.segments_left_out = input.curves.size() - scene.segments;
    steps3 last{};
    for (const auto& segment : input.curves.first(scene.segments))
        for (const tf::point3& end : segment.ends) put_point(stream, grid.at(end), last);
    scene.geometry = stream.base64();
    return scene;
}

}  // namespace tools
