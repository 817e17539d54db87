#include <libmesh/io/bytes_gltf.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace treeform::detail::io {

namespace {

constexpr unsigned triangles = 4;
constexpr unsigned strip = 5;

/// Accessors of the attributes of a primitive that are read.
struct attributes_gltf {
    std::optional<std::size_t> position{};
    std::optional<std::size_t> normal{};
    std::optional<std::size_t> texture{};
    std::optional<std::size_t> color{};
    std::size_t transform = 0;  ///< of the texture: number of the material that has one, from 1

    friend auto operator<=>(const attributes_gltf&, const attributes_gltf&) = default;
};

[[nodiscard]] const material_gltf& material_of(const model_gltf& model, const primitive_gltf& p) {
    static const material_gltf none;
    return p.material ? model.materials[*p.material] : none;
}

[[nodiscard]] attributes_gltf attributes_of(const model_gltf& model, const primitive_gltf& p) {
    const auto find = [&](const std::string& name) -> std::optional<std::size_t> {
        const auto at = p.attributes.find(name);
        return at == p.attributes.end() ? std::nullopt : std::optional(at->second);
    };
    const material_gltf& material = material_of(model, p);
    attributes_gltf a{.position = find("POSITION"),
                      .normal = find("NORMAL"),
                      .texture = find("TEXCOORD_" + std::to_string(material.texture_set)),
                      .color = find("COLOR_0")};
    if (a.texture && material.transform) a.transform = *p.material + 1;
    return a;
}

/// That the bytes are there; once for each accessor, since many primitives may have one.
void check_bytes(buffers_gltf& buffers, std::size_t accessor, survey_gltf& survey) {
    if (survey.checked.insert(accessor).second) (void)values_gltf(buffers, accessor);
}

void check_type(const buffers_gltf& buffers, std::size_t accessor, std::size_t components,
                std::uint64_t count, const std::string& name) {
    const accessor_gltf& a = buffers.model().accessors[accessor];
    if (a.components != components)
        buffers.fail("accessors", accessor, "has a type that " + name + " cannot have");
    if (a.count != count)
        buffers.fail("accessors", accessor,
                     "has " + std::to_string(a.count) + " values of " + name + " for " +
                         std::to_string(count) + " points");
}

void survey_colors(const buffers_gltf& buffers, std::size_t accessor, std::uint64_t count,
                   survey_gltf& survey) {
    const accessor_gltf& a = buffers.model().accessors[accessor];
    const bool has_alpha = a.components == 4;
    check_type(buffers, accessor, has_alpha ? 4 : 3, count, "COLOR_0");
    if (a.type != scalar_type::float32 && a.type != scalar_type::uint8 &&
        a.type != scalar_type::uint16)
        buffers.fail("accessors", accessor, "has a type that COLOR_0 cannot have");
    survey.with_colors += count;
    survey.has_alpha = survey.has_alpha || has_alpha;
    if (!survey.color_type)
        survey.color_type = a.type;
    else if (survey.color_type != a.type)
        survey.color_type = scalar_type::float32;
}

void survey_points(buffers_gltf& buffers, const primitive_gltf& p, const attributes_gltf& a,
                   survey_gltf& survey) {
    const std::uint64_t count = buffers.model().accessors[*a.position].count;
    check_type(buffers, *a.position, 3, count, "POSITION");
    if (a.normal) check_type(buffers, *a.normal, 3, count, "NORMAL");
    if (a.texture) check_type(buffers, *a.texture, 2, count, "TEXCOORD");
    for (const auto& used : {a.position, a.normal, a.texture, a.color})
        if (used) check_bytes(buffers, *used, survey);
    survey.points += count;
    survey.with_normals += a.normal ? count : 0;
    survey.with_texture += a.texture ? count : 0;
    if (a.color) survey_colors(buffers, *a.color, count, survey);
    for (const auto& [name, accessor] : p.attributes)
        if (name != "POSITION" && name != "NORMAL" && name != "COLOR_0" && accessor != a.texture)
            survey.unread.insert(name);
}

/// Lines that `corners` corners of a primitive without triangles are: none of points.
[[nodiscard]] std::uint64_t line_count(unsigned mode, std::uint64_t corners) {
    return mode == 0 ? 0 : mode == 1 ? corners / 2 : mode == 3 ? corners - 1 : corners;
}

[[nodiscard]] std::uint64_t triangle_count(unsigned mode, std::uint64_t corners) {
    return mode < triangles ? 0 : mode == triangles ? corners / 3 : std::max(corners, 2UL) - 2;
}

class decoder {
  public:
    decoder(buffers_gltf& buffers, std::size_t mesh, const survey_gltf& survey)
        : buffers_(buffers), mesh_(mesh), survey_(survey) {}

    [[nodiscard]] local_mesh_gltf decode(const outline_gltf& outline) {
        made_.points.reserve(outline.points);
        made_.faces.reserve(outline.faces);
        for (const shape_gltf& shape : outline.shapes) {
            const attributes_gltf a = attributes_of(buffers_.model(), *shape.primitive);
            if (shape.adds_points) {
                add_points(*a.position);
                if (survey_.with_normals > 0) add_normals(a.normal);
                if (survey_.with_texture > 0) add_texture(a.texture, *shape.primitive);
                if (survey_.with_colors > 0) add_colors(a.color);
            }
            add_faces(shape);
            const auto& material = shape.primitive->material;
            made_.materials.resize(made_.faces.size(), material ? *material + 1 : 0);
        }
        return std::move(made_);
    }

  private:
    void add_points(std::size_t accessor) {
        const values_gltf values(buffers_, accessor);
        for (std::size_t i = 0; i < values.size(); ++i)
            made_.points.push_back({values.at(i, 0), values.at(i, 1), values.at(i, 2)});
    }

    void add_normals(const std::optional<std::size_t>& accessor) {
        made_.normals.resize(made_.points.size());
        if (!accessor) return;
        const values_gltf values(buffers_, *accessor);
        const std::size_t first = made_.points.size() - values.size();
        for (std::size_t i = 0; i < values.size(); ++i)
            made_.normals[first + i] = {values.at(i, 0), values.at(i, 1), values.at(i, 2)};
    }

    /// glTF counts v from the upper edge of an image; where there is none, all get 0 0.
    void add_texture(const std::optional<std::size_t>& accessor, const primitive_gltf& p) {
        made_.texture.resize(made_.points.size());
        if (!accessor) return;
        const values_gltf values(buffers_, *accessor);
        const std::size_t first = made_.points.size() - values.size();
        const auto& transform = material_of(buffers_.model(), p).transform;
        for (std::size_t i = 0; i < values.size(); ++i) {
            double u = values.at(i, 0);
            double v = values.at(i, 1);
            if (transform) {
                const double c = std::cos(transform->rotation);
                const double s = std::sin(transform->rotation);
                const double x = transform->scale[0] * u;
                const double y = transform->scale[1] * v;
                u = transform->offset[0] + (c * x + s * y);
                v = transform->offset[1] + (c * y - s * x);
            }
            made_.texture[first + i] = {static_cast<float>(u), static_cast<float>(1.0 - v)};
        }
    }

    /// Where there are none, all get white.
    void add_colors(const std::optional<std::size_t>& accessor) {
        const std::size_t size = size_of(*survey_.color_type);
        const std::size_t channels = survey_.channels();
        const std::size_t before = made_.colors.size() / (size * channels);
        made_.colors.resize(made_.points.size() * channels * size);
        std::byte* to = made_.colors.data() + before * channels * size;
        const auto put = [&](double stored, double share) {
            with_type(*survey_.color_type, [&]<class T>(T) {
                const T value = static_cast<T>(sizeof(T) == 4 ? share : stored);
                std::memcpy(to, &value, sizeof value);
            });
            to += size;
        };
        const double full = size == 1 ? 255.0 : size == 2 ? 65535.0 : 1.0;
        if (!accessor) {
            for (std::size_t i = before * channels; i < made_.points.size() * channels; ++i)
                put(full, 1.0);
            return;
        }
        const values_gltf values(buffers_, *accessor);
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t c = 0; c < channels; ++c)
                if (c < values.components())
                    put(values.raw(i, c), values.share(i, c));
                else
                    put(full, 1.0);
    }

    void add_faces(const shape_gltf& shape) {
        const primitive_gltf& p = *shape.primitive;
        if (!p.indices) {
            return add_faces(shape, [&](std::size_t i) {
                return static_cast<std::uint32_t>(shape.first_point + i);
            });
        }
        const values_gltf indices(buffers_, *p.indices);
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices.index(i) >= shape.points)
                buffers_.fail("meshes", mesh_,
                              "has index " + std::to_string(indices.index(i)) + ", but there are " +
                                  std::to_string(shape.points) + " points");
        add_faces(shape, [&](std::size_t i) {
            return static_cast<std::uint32_t>(shape.first_point + indices.index(i));
        });
    }

    template <class Corner>
    void add_faces(const shape_gltf& shape, Corner&& corner) {
        for (std::size_t f = 0; f < shape.faces; ++f) {
            std::array<std::size_t, 3> at{3 * f, 3 * f + 1, 3 * f + 2};
            if (shape.primitive->mode == strip)
                at = {f, f + 1 + f % 2, f + 2 - f % 2};
            else if (shape.primitive->mode != triangles)
                at = {f + 1, f + 2, 0};
            made_.faces.push_back({corner(at[0]), corner(at[1]), corner(at[2])});
        }
    }

    buffers_gltf& buffers_;
    std::size_t mesh_;
    const survey_gltf& survey_;
    local_mesh_gltf made_{};
};

void check_indices(buffers_gltf& buffers, std::size_t accessor, survey_gltf& survey) {
    const accessor_gltf& a = buffers.model().accessors[accessor];
    if (a.components != 1 || (a.type != scalar_type::uint8 && a.type != scalar_type::uint16 &&
                              a.type != scalar_type::uint32))
        buffers.fail("accessors", accessor, "has a type that indices cannot have");
    check_bytes(buffers, accessor, survey);
}

}  // namespace

outline_gltf outline_of(buffers_gltf& buffers, std::size_t mesh, survey_gltf& survey) {
    const model_gltf& model = buffers.model();
    outline_gltf outline;
    std::map<attributes_gltf, std::size_t> first_point;
    for (const primitive_gltf& p : model.meshes[mesh].primitives) {
        const attributes_gltf a = attributes_of(model, p);
        if (!a.position) {
            ++survey.without_positions;
            continue;
        }
        if (p.draco && !model.accessors[*a.position].view &&
            buffers.given_values(*a.position) == nullptr)
            unpack_draco(buffers, mesh, p);
        if (p.indices) check_indices(buffers, *p.indices, survey);
        const std::uint64_t points = model.accessors[*a.position].count;
        const std::uint64_t corners = p.indices ? model.accessors[*p.indices].count : points;
        survey.morphs = survey.morphs || p.morphs;
        survey.unread_of_faces.insert(p.face_properties.begin(), p.face_properties.end());
        const auto [at, is_new] = first_point.emplace(a, outline.points);
        if (is_new) {
            survey_points(buffers, p, a, survey);
            outline.points += points;
        }
        const std::uint64_t faces = triangle_count(p.mode, corners);
        if (p.mode < triangles) survey.lines += line_count(p.mode, corners);
        if (p.mode == triangles) survey.corners_left_over += corners % 3;
        outline.faces += faces;
        outline.shapes.push_back({&p, at->second, is_new, points, faces});
    }
    return outline;
}

local_mesh_gltf decode(buffers_gltf& buffers, std::size_t mesh, const outline_gltf& outline,
                       const survey_gltf& survey) {
    return decoder(buffers, mesh, survey).decode(outline);
}

}  // namespace treeform::detail::io
