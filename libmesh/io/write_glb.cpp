#include <libmesh/io/parts_glb.hpp>
#include <libmesh/io/writers.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

using json = nlohmann::ordered_json;

/// glTF's factors are linear; colors in files are not. Rounded to what an eye can tell, so that
/// the text does not depend on the last bit of std::pow.
[[nodiscard]] double linear(double srgb) {
    const double x = std::clamp(srgb, 0.0, 1.0);
    const double y = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return std::round(y * 1e4) / 1e4;
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
    const element* const faces = file.attributes.find("face");
    if (faces == nullptr) return numbers;
    const auto colors = color_columns(file.attributes.find("face"));
    for (const column& c : faces->columns) {
        if (c.role != column_role::data || c.list_length ||
            std::find(colors.begin(), colors.end(), &c) != colors.end())
            continue;
        bool fits = c.type != scalar_type::float32 && c.type != scalar_type::float64;
        for (std::size_t i = 0; fits && i < c.size(); ++i) {
            const double value = c.number(i);
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

/// Values of one kind in the one buffer. Elements have room to start at multiples of four bytes.
struct view_glb {
    std::size_t stride = 0;  ///< 0: of no vertices
    std::size_t size = 0;
    std::size_t offset = 0;
    int target = 0;  ///< 0: none
};

/// What is written, in the order of the file: positions, indices, other attributes of vertices,
/// then the values of each column of whole numbers.
class document_glb {
  public:
    explicit document_glb(const write_job& job)
        : job_(job), layout_(lay_out(job)), attributes_(job), numbers_(numbers_of_faces(job.file)) {
        check_finite(job, "GLB");
        offset_ = choose_offset(job, box_of(job.file.mesh.points));
        for (const part_glb& p : layout_.parts) {
            const std::size_t normal_count = attributes_.count_normals(p);
            const std::size_t texture_count = attributes_.count_texture(p);
            with_normals_.push_back(normal_count == p.vertices.size());
            with_texture_.push_back(texture_count > 0);
            leaves_out_normals_ =
                leaves_out_normals_ || (normal_count > 0 && !with_normals_.back());
            lacks_texture_ =
                lacks_texture_ || (texture_count > 0 && texture_count < p.vertices.size());
        }
        plan_views();
        say_what_is_left_out();
    }

    [[nodiscard]] std::size_t size() const { return size_; }

    [[nodiscard]] json describe() {
        json root;
        root["asset"] = {{"version", "2.0"}, {"generator", "treeform"}};
        root["scene"] = 0;
        json nodes = json::array();
        json meshes = json::array();
        json accessors = json::array();
        for (std::size_t p = 0; p < layout_.parts.size(); ++p) {
            json node = {{"mesh", p}};
            if (offset_ != point3{}) node["translation"] = {offset_.x, offset_.y, offset_.z};
            json mesh = {{"primitives", describe_primitives(p, accessors)}};
            const std::string& name = layout_.parts[p].name;
            if (!name.empty()) node["name"] = mesh["name"] = name;
            nodes.push_back(std::move(node));
            meshes.push_back(std::move(mesh));
        }
        json roots = json::array();
        for (std::size_t p = 0; p < layout_.parts.size(); ++p) roots.push_back(p);
        root["scenes"] = json::array({{{"nodes", std::move(roots)}}});
        root["nodes"] = std::move(nodes);
        root["buffers"] = json::array({{{"byteLength", size_}}});
        root["bufferViews"] = describe_views();
        root["accessors"] = std::move(accessors);
        json materials = json::array();
        for (const color_glb& rgba : layout_.materials)
            materials.push_back(describe_material(rgba));
        root["materials"] = std::move(materials);
        root["meshes"] = std::move(meshes);
        return root;
    }

    void put() const {
        put_positions();
        put_indices();
        put_rows(with_normals_, [&](const vertex_glb& v) { put_floats(attributes_.normal(v)); });
        put_rows(with_texture_, [&](const vertex_glb& v) { put_floats(attributes_.texture(v)); });
        if (attributes_.has_colors())
            for (const part_glb& p : layout_.parts)
                for (const vertex_glb& v : p.vertices) put_color(v.point);
        for (const column* const c : numbers_)
            for (const part_glb& part : layout_.parts)
                for (const primitive_glb& p : part.primitives)
                    for (const std::uint32_t f : p.triangles)
                        job_.out.raw<std::endian::little>(
                            static_cast<std::uint32_t>(c->number(face_row(job_.file, f))));
    }

  private:
    enum : std::size_t { positions, indices, normals, texture, colors, first_number };

    void plan_views() {
        std::size_t vertices = 0;
        std::size_t normal_rows = 0;
        std::size_t texture_rows = 0;
        for (std::size_t p = 0; p < layout_.parts.size(); ++p) {
            const std::size_t count = layout_.parts[p].vertices.size();
            vertices += count;
            normal_rows += with_normals_[p] ? count : 0;
            texture_rows += with_texture_[p] ? count : 0;
        }
        const std::size_t faces = job_.file.mesh.faces.size();
        const std::size_t color_size =
            (attributes_.colors().size() * size_of(attributes_.color_type()) + 3) / 4 * 4;
        constexpr int of_vertices = 34962;
        constexpr int of_indices = 34963;
        views_ = {{.stride = 12, .size = 12 * vertices, .target = of_vertices},
                  {.size = 12 * faces, .target = of_indices},
                  {.stride = 12, .size = 12 * normal_rows, .target = of_vertices},
                  {.stride = 8, .size = 8 * texture_rows, .target = of_vertices},
                  {.stride = color_size, .size = color_size * vertices, .target = of_vertices}};
        views_.insert(views_.end(), numbers_.size(), {.size = 4 * faces});
        for (view_glb& view : views_) {
            view.offset = size_;
            size_ += view.size;
            number_of_view_.push_back(view_count_);
            view_count_ += view.size > 0 ? 1 : 0;
        }
        used_.assign(views_.size(), 0);
    }

    [[nodiscard]] json describe_views() const {
        json all = json::array();
        for (const view_glb& view : views_) {
            if (view.size == 0) continue;
            json one = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.size}};
            if (view.stride > 0) one["byteStride"] = view.stride;
            if (view.target > 0) one["target"] = view.target;
            all.push_back(std::move(one));
        }
        return all;
    }

    /// The next `count` elements of a view.
    [[nodiscard]] json describe_next(std::size_t view, std::size_t count, std::size_t element,
                                     int type, const char* shape) {
        json accessor = {{"bufferView", number_of_view_[view]},
                         {"byteOffset", used_[view]},
                         {"componentType", type},
                         {"count", count},
                         {"type", shape}};
        used_[view] += count * element;
        return accessor;
    }

    [[nodiscard]] json describe_primitives(std::size_t number, json& accessors) {
        const part_glb& part = layout_.parts[number];
        const std::size_t count = part.vertices.size();
        constexpr int floats = 5126;
        constexpr int integers = 5125;
        json attributes;
        const auto add = [&](const char* name, std::size_t view, std::size_t element, int type,
                             const char* shape) {
            attributes[name] = accessors.size();
            accessors.push_back(describe_next(view, count, element, type, shape));
        };
        add("POSITION", positions, 12, floats, "VEC3");
        add_bounds(part, accessors.back());
        if (with_normals_[number]) add("NORMAL", normals, 12, floats, "VEC3");
        if (with_texture_[number]) add("TEXCOORD_0", texture, 8, floats, "VEC2");
        if (attributes_.has_colors()) {
            const std::size_t size = size_of(attributes_.color_type());
            add("COLOR_0", colors, views_[colors].stride,
                size == 1   ? 5121
                : size == 2 ? 5123
                            : floats,
                attributes_.colors().size() == 4 ? "VEC4" : "VEC3");
            if (size < 4) accessors.back()["normalized"] = true;
        }
        json all = json::array();
        for (const primitive_glb& p : part.primitives) {
            all.push_back({{"attributes", attributes},
                           {"indices", accessors.size()},
                           {"material", p.material}});
            const std::size_t faces = p.triangles.size();
            accessors.push_back(describe_next(indices, 3 * faces, 4, integers, "SCALAR"));
            json properties;
            for (std::size_t n = 0; n < numbers_.size(); ++n) {
                properties[numbers_[n]->name] = accessors.size();
                accessors.push_back(describe_next(first_number + n, faces, 4, integers, "SCALAR"));
            }
            if (!numbers_.empty()) all.back()["extras"]["face_properties"] = std::move(properties);
        }
        return all;
    }

    void add_bounds(const part_glb& part, json& accessor) const {
        std::vector<point3> points;
        for (const vertex_glb& v : part.vertices) points.push_back(job_.file.mesh.points[v.point]);
        const box b = box_of(points);
        for (const auto& [key, p] : {std::pair("min", b.min), std::pair("max", b.max)}) {
            json xyz = json::array();
            for (std::size_t axis = 0; axis < 3; ++axis)
                xyz.push_back(base::nearest_float(p[axis] - offset_[axis]));
            accessor[key] = std::move(xyz);
        }
    }

    [[nodiscard]] json describe_material(const color_glb& rgba) const {
        json material = {{"doubleSided", true}};
        json& look = material["pbrMetallicRoughness"];
        if (layout_.has_colors)
            look["baseColorFactor"] = {linear(rgba[0]), linear(rgba[1]), linear(rgba[2]), rgba[3]};
        look["metallicFactor"] = 0.0;
        if (rgba[3] < 1.0) material["alphaMode"] = "BLEND";
        return material;
    }

    template <std::size_t N>
    void put_floats(const std::array<float, N>& values) const {
        for (const float value : values) job_.out.raw<std::endian::little>(value);
    }

    void put_positions() const {
        for (const part_glb& part : layout_.parts)
            for (const vertex_glb& v : part.vertices)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    job_.out.raw<std::endian::little>(
                        static_cast<float>(job_.file.mesh.points[v.point][axis] - offset_[axis]));
    }

    void put_indices() const {
        for (const part_glb& part : layout_.parts)
            for (const face& f : part.faces)
                for (const std::uint32_t corner : f) job_.out.raw<std::endian::little>(corner);
    }

    template <class F>
    void put_rows(const std::vector<bool>& parts, F&& put) const {
        for (std::size_t p = 0; p < layout_.parts.size(); ++p)
            if (parts[p])
                for (const vertex_glb& v : layout_.parts[p].vertices) put(v);
    }

    void put_color(std::size_t row) const {
        std::size_t size = 0;
        for (const column* const c : attributes_.colors()) {
            if (attributes_.color_type() == scalar_type::float32)
                job_.out.raw<std::endian::little>(
                    static_cast<float>(attributes_glb::color_share(*c, row)));
            else
                put_bits<std::endian::little>(job_.out, *c, row);
            size += size_of(attributes_.color_type());
        }
        for (; size < views_[colors].stride; ++size) job_.out.put('\0');
    }

    void warn(const char* code, const std::string& text) const {
        job_.result.warnings.push_back({code, text});
    }

    void say_what_is_left_out() const {
        const std::string in_all =
            "some corners have none or one of length 0, and glb has one for every corner or none";
        if (leaves_out_normals_) warn("corner-values", "normals left out: " + in_all);
        if (lacks_texture_) warn("corner-values", "corners without texture coordinates got 0 0");
        std::string names;
        const auto add = [&](const std::string& name) {
            names += (names.empty() ? "" : ", ") + name;
        };
        for (const std::string& name : attributes_.left_out()) add(name);
        const auto face_colors = color_columns(job_.file.attributes.find("face"));
        if (const element* const faces = job_.file.attributes.find("face"))
            for (const column& c : faces->columns)
                if (c.role == column_role::data &&
                    std::find(numbers_.begin(), numbers_.end(), &c) == numbers_.end() &&
                    std::find(face_colors.begin(), face_colors.end(), &c) == face_colors.end())
                    add(c.name);
        if (!names.empty()) warn("columns-dropped", "properties not written to GLB: " + names);
    }

    const write_job& job_;
    layout_glb layout_;
    attributes_glb attributes_;
    std::vector<const column*> numbers_;
    point3 offset_{};
    std::vector<bool> with_normals_{};
    std::vector<bool> with_texture_{};
    bool leaves_out_normals_ = false;
    bool lacks_texture_ = false;
    std::vector<view_glb> views_{};
    std::vector<std::size_t> number_of_view_{};
    std::vector<std::size_t> used_{};  ///< bytes of views that accessors have
    std::size_t view_count_ = 0;
    std::size_t size_ = 0;
};

}  // namespace

void write_glb(const write_job& job) {
    json root = {{"asset", {{"version", "2.0"}, {"generator", "treeform"}}},
                 {"scene", 0},
                 {"scenes", json::array({json::object()})}};
    std::optional<document_glb> document;
    if (!job.file.mesh.faces.empty()) root = document.emplace(job).describe();
    // Names may be in any character set; JSON has one.
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary = document ? document->size() : 0;
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
    document->put();
}

}  // namespace treeform::detail::io
