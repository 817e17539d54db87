#include <libmesh/io/writers.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace treeform::detail::io {

namespace {

using json = nlohmann::ordered_json;
using color = std::array<double, 4>;

constexpr std::size_t most_colors = 256;

/// Triangles of one color.
struct primitive {
    color rgba{0.8, 0.8, 0.8, 1.0};
    std::vector<std::uint32_t> triangles{};
};

/// glTF's factors are linear; colors in files are not. Rounded to what an eye can tell, so that
/// the text does not depend on the last bit of std::pow.
[[nodiscard]] double linear(double srgb) {
    const double x = std::clamp(srgb, 0.0, 1.0);
    const double y = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return std::round(y * 1e4) / 1e4;
}

/// By first appearance.
[[nodiscard]] std::vector<primitive> by_color(const write_job& job) {
    const mesh_file& file = job.file;
    const auto columns = color_columns(file, "face");
    std::vector<primitive> primitives;
    std::map<color, std::size_t> number;
    for (std::uint32_t f = 0; f < file.mesh.faces.size(); ++f) {
        primitive one;
        for (std::size_t c = 0; c < columns.size(); ++c)
            one.rgba[c] = color_value(*columns[c], face_row(file, f));
        const auto [at, added] = number.emplace(one.rgba, primitives.size());
        if (added) primitives.push_back(one);
        if (primitives.size() > most_colors) {
            job.result.warnings.push_back(
                {"colors-dropped", "more than 256 different colors of faces; none was written"});
            primitives.assign(1, {});
            for (std::uint32_t all = 0; all < file.mesh.faces.size(); ++all)
                primitives[0].triangles.push_back(all);
            return primitives;
        }
        primitives[at->second].triangles.push_back(f);
    }
    return primitives;
}

[[nodiscard]] double largest_move(std::span<const point3> points, const point3& offset) {
    double largest = 0.0;
    for (const point3& p : points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double local = base::nearest_float(p[axis] - offset[axis]);
            largest = std::max(largest, std::abs(local + offset[axis] - p[axis]));
        }
    return largest;
}

/// Columns of faces that glTF has a type for: whole numbers from 0 on. Colors have become
/// materials.
[[nodiscard]] std::vector<const column*> numbers_of_faces(const mesh_file& file) {
    std::vector<const column*> numbers;
    const element* const faces = find_element(file.attributes, "face");
    if (faces == nullptr) return numbers;
    const auto colors = color_columns(file, "face");
    for (const column& c : faces->columns) {
        if (c.role != column_role::data || c.list_length ||
            std::find(colors.begin(), colors.end(), &c) != colors.end())
            continue;
        bool fits = c.type != scalar_type::float32 && c.type != scalar_type::float64;
        for (std::size_t i = 0; fits && i < value_count(c); ++i) {
            const double value = number_at(c, i);
            fits = value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max();
        }
        if (fits) numbers.push_back(&c);
    }
    return numbers;
}

struct box {
    point3 min;
    point3 max;
};

[[nodiscard]] box box_of(std::span<const point3> points) {
    box b{points[0], points[0]};
    for (const point3& p : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(p[axis])) throw io_error("GLB holds finite coordinates only");
            b.min[axis] = std::min(b.min[axis], p[axis]);
            b.max[axis] = std::max(b.max[axis], p[axis]);
        }
    }
    return b;
}

/// Where the positions' origin is put: zero, or the middle of the box where that loses less. It is
/// a float32 value, since readers take it for one.
[[nodiscard]] point3 choose_offset(const write_job& job, const box& b) {
    const auto& points = job.file.mesh.points;
    point3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
        middle[axis] = base::nearest_float(b.min[axis] / 2 + b.max[axis] / 2);
    const double moved = largest_move(points, middle);
    if (moved >= job.result.max_displacement) return {};
    job.result.max_displacement = moved;
    return middle;
}

/// The parts of the one buffer: positions, indices, then the values of each number column.
[[nodiscard]] json describe_views(std::size_t position_bytes, std::size_t index_bytes,
                                  std::size_t number_bytes, std::size_t numbers) {
    json views = json::array(
        {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", position_bytes}, {"target", 34962}},
         {{"buffer", 0},
          {"byteOffset", position_bytes},
          {"byteLength", index_bytes},
          {"target", 34963}}});
    for (std::size_t n = 0; n < numbers; ++n)
        views.push_back({{"buffer", 0},
                         {"byteOffset", position_bytes + index_bytes + n * number_bytes},
                         {"byteLength", number_bytes}});
    return views;
}

[[nodiscard]] json describe_positions(const write_job& job, const box& b, const point3& offset) {
    const auto local = [&](const point3& p) {
        json xyz = json::array();
        for (std::size_t axis = 0; axis < 3; ++axis)
            xyz.push_back(base::nearest_float(p[axis] - offset[axis]));
        return xyz;
    };
    return {{"bufferView", 0}, {"componentType", 5126}, {"count", job.file.mesh.points.size()},
            {"type", "VEC3"},  {"min", local(b.min)},   {"max", local(b.max)}};
}

/// `count` unsigned integers of a view, from a byte of it on.
[[nodiscard]] json describe_integers(std::size_t view, std::size_t byte, std::size_t count) {
    return {{"bufferView", view},
            {"byteOffset", byte},
            {"componentType", 5125},
            {"count", count},
            {"type", "SCALAR"}};
}

[[nodiscard]] json describe_material(const primitive& p) {
    json material = {{"doubleSided", true}};
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", {linear(p.rgba[0]), linear(p.rgba[1]), linear(p.rgba[2]), p.rgba[3]}},
        {"metallicFactor", 0.0}};
    if (p.rgba[3] < 1.0) material["alphaMode"] = "BLEND";
    return material;
}

[[nodiscard]] json describe(const std::vector<primitive>& primitives, const write_job& job,
                            const std::vector<const column*>& numbers, const box& b,
                            const point3& offset) {
    const std::size_t position_bytes = 12 * job.file.mesh.points.size();
    const std::size_t index_bytes = 12 * job.file.mesh.faces.size();
    const std::size_t number_bytes = 4 * job.file.mesh.faces.size();
    json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "treeform"}};
    root["scene"] = 0;
    root["scenes"] = json::array({{{"nodes", {0}}}});
    json node = {{"mesh", 0}};
    if (offset != point3{}) node["translation"] = {offset.x, offset.y, offset.z};
    root["nodes"] = json::array({node});
    root["buffers"] = json::array(
        {{{"byteLength", position_bytes + index_bytes + numbers.size() * number_bytes}}});
    root["bufferViews"] = describe_views(position_bytes, index_bytes, number_bytes, numbers.size());
    json accessors = json::array({describe_positions(job, b, offset)});
    json shapes = json::array();
    json materials = json::array();
    std::size_t first = 0;
    for (const primitive& p : primitives) {
        shapes.push_back({{"attributes", {{"POSITION", 0}}},
                          {"indices", accessors.size()},
                          {"material", materials.size()}});
        accessors.push_back(describe_integers(1, first, 3 * p.triangles.size()));
        json properties;
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            properties[numbers[n]->name] = accessors.size();
            accessors.push_back(describe_integers(2 + n, first / 3, p.triangles.size()));
        }
        if (!numbers.empty()) shapes.back()["extras"]["face_properties"] = std::move(properties);
        first += 12 * p.triangles.size();
        materials.push_back(describe_material(p));
    }
    root["accessors"] = std::move(accessors);
    root["materials"] = std::move(materials);
    root["meshes"] = json::array({{{"primitives", std::move(shapes)}}});
    return root;
}

}  // namespace

void write_glb(const write_job& job) {
    const auto& mesh = job.file.mesh;
    json root = {{"asset", {{"version", "2.0"}, {"generator", "treeform"}}},
                 {"scene", 0},
                 {"scenes", json::array({json::object()})}};
    std::vector<primitive> primitives;
    std::vector<const column*> numbers;
    point3 offset;
    if (!mesh.faces.empty()) {
        const box b = box_of(mesh.points);
        offset = choose_offset(job, b);
        primitives = by_color(job);
        numbers = numbers_of_faces(job.file);
        root = describe(primitives, job, numbers, b, offset);
    }
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary =
        12 * mesh.points.size() + (12 + 4 * numbers.size()) * mesh.faces.size();
    const std::size_t total = 12 + 8 + text.size() + (binary > 0 ? 8 + binary : 0);
    if (total > std::numeric_limits<std::uint32_t>::max())
        throw io_error("GLB cannot be larger than 4 GiB");
    const auto word = [&](std::size_t value) {
        job.out.raw<std::endian::little>(static_cast<std::uint32_t>(value));
    };
    job.out.put("glTF");
    word(2);
    word(total);
    word(text.size());
    job.out.put("JSON");
    job.out.put(text);
    if (binary == 0) return;
    word(binary);
    job.out.put(std::string_view("BIN\0", 4));
    for (const point3& p : mesh.points)
        for (std::size_t axis = 0; axis < 3; ++axis)
            job.out.raw<std::endian::little>(static_cast<float>(p[axis] - offset[axis]));
    for (const primitive& p : primitives)
        for (const std::uint32_t f : p.triangles)
            for (const std::uint32_t corner : mesh.faces[f])
                job.out.raw<std::endian::little>(corner);
    for (const column* const c : numbers)
        for (const primitive& p : primitives)
            for (const std::uint32_t f : p.triangles)
                job.out.raw<std::endian::little>(
                    static_cast<std::uint32_t>(number_at(*c, face_row(job.file, f))));
}

}  // namespace treeform::detail::io
