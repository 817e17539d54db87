#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/json_entry.hpp>
#include <libmesh/io/model_gltf.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* texture_transform = "KHR_texture_transform";
constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// Extensions that are read, and those that change only how a surface looks or what is known of it.
[[nodiscard]] bool is_harmless(std::string_view name) {
    constexpr std::array<std::string_view, 7> read{
        "KHR_mesh_quantization",   instancing,          texture_transform,      "EXT_mesh_features",
        "EXT_structural_metadata", "KHR_audio_emitter", "KHR_animation_pointer"};
    constexpr std::array<std::string_view, 9> looks{
        "KHR_materials_", "KHR_technique", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
        "EXT_materials_", "KHR_lights_",   "EXT_lights_",  "KHR_xmp"};
    const auto begins = [&](std::string_view start) { return name.starts_with(start); };
    return std::ranges::count(read, name) > 0 || std::ranges::any_of(looks, begins);
}

/// Whether it is 1.0, which has no numbers for things but names.
[[nodiscard]] bool says_version_1(const json_entry& root) {
    const auto version = root.find("asset", "version");
    if (!version) root.fail("has no 'asset' with a 'version'");
    if (version->is_number()) return version->number() < 2.0;  // as 1.0 had it at first
    return version->text().starts_with("1.") || version->text() == "1";
}

void refuse_versions(const source& in, const json_entry& root) {
    const auto version = root.find("asset", "version");
    const auto least = root.find("asset", "minVersion");
    const std::string& needed = least ? least->text() : version->text();
    if (!needed.starts_with("2.") || (least && needed != "2.0"))
        in.fail("glTF " + needed + " is not supported, only 2.0");
}

void refuse_extensions(const source& in, const json_entry& root) {
    root.for_each("extensionsRequired", [&](const json_entry& name) {
        if (is_harmless(name.text()) || (name.text() == draco_extension && reads_draco())) return;
        const bool packs = name.text() == draco_extension || name.text() == meshopt;
        in.fail("the file requires the extension " + name.text() + ", which is not supported" +
                (packs ? "; gltf-transform copy IN OUT unpacks it" : ""));
    });
}

[[nodiscard]] scalar_type type_of(const json_entry& component) {
    using enum scalar_type;
    constexpr std::array<std::optional<scalar_type>, 7> from_5120{int8, uint8,  int16,  uint16,
                                                                  {},   uint32, float32};
    const std::uint64_t code = component.whole() - 5120;
    if (code >= from_5120.size() || !from_5120[code]) component.fail("is not a type of glTF 2.0");
    return *from_5120[code];
}

[[nodiscard]] std::size_t components_of(const json_entry& type) {
    constexpr std::array<std::string_view, 4> vectors{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto* const at = std::find(vectors.begin(), vectors.end(), type.text());
    return at == vectors.end() ? 0 : static_cast<std::size_t>(at - vectors.begin()) + 1;
}

class parser {
  public:
    explicit parser(const json_entry& root) : root_(root) {}

    [[nodiscard]] model_gltf parse() {
        root_.for_each("buffers", [&](const json_entry& e) { add_buffer(e); });
        root_.for_each("bufferViews", [&](const json_entry& e) { add_view(e); });
        root_.for_each("accessors", [&](const json_entry& e) { add_accessor(e); });
        root_.for_each("materials", [&](const json_entry& e) { add_material(e); });
        root_.for_each("meshes", [&](const json_entry& e) { add_mesh(e); });
        root_.for_each("nodes", [&](const json_entry& e) { add_node(e); });
        find_roots();
        return std::move(model_);
    }

  private:
    [[nodiscard]] std::uint64_t whole_or(const json_entry& of, const char* key,
                                         std::uint64_t other) const {
        const auto found = of.find(key);
        return found ? found->whole() : other;
    }
    [[nodiscard]] std::string name_of(const json_entry& e) const {
        const auto name = e.find("name");
        return name ? name->text() : std::string();
    }
    [[nodiscard]] std::size_t view_of(const json_entry& e) const {
        return e.get("bufferView").number_of(model_.views.size(), "buffer views");
    }
    [[nodiscard]] std::size_t accessor_of(const json_entry& e) const {
        return e.number_of(model_.accessors.size(), "accessors");
    }

    void add_buffer(const json_entry& e) {
        buffer_gltf buffer{.size = e.get("byteLength").whole()};
        if (const auto uri = e.find("uri")) buffer.uri = uri->text();
        model_.buffers.push_back(std::move(buffer));
    }

    void add_view(const json_entry& e) {
        view_gltf view{.buffer = e.get("buffer").number_of(model_.buffers.size(), "buffers"),
                       .offset = whole_or(e, "byteOffset", 0),
                       .size = e.get("byteLength").whole(),
                       .stride = whole_or(e, "byteStride", 0)};
        if (e.find("extensions", meshopt)) view.compression = meshopt;
        model_.views.push_back(std::move(view));
    }

    void add_accessor(const json_entry& e) {
        accessor_gltf accessor{.offset = whole_or(e, "byteOffset", 0),
                               .count = e.get("count").whole(),
                               .type = type_of(e.get("componentType")),
                               .components = components_of(e.get("type"))};
        if (accessor.count == 0) e.get("count").fail("is 0");
        if (const auto flag = e.find("normalized")) accessor.normalized = flag->flag();
        if (e.find("bufferView")) accessor.view = view_of(e);
        if (const auto sparse = e.find("sparse")) {
            const json_entry indices = sparse->get("indices");
            const json_entry values = sparse->get("values");
            accessor.sparse = sparse_gltf{.count = sparse->get("count").whole(),
                                          .index_view = view_of(indices),
                                          .index_offset = whole_or(indices, "byteOffset", 0),
                                          .index_type = type_of(indices.get("componentType")),
                                          .value_view = view_of(values),
                                          .value_offset = whole_or(values, "byteOffset", 0)};
        }
        model_.accessors.push_back(accessor);
    }

    void add_material(const json_entry& e) {
        material_gltf material;
        if (const auto looks = e.find("pbrMetallicRoughness")) {
            const auto texture = looks->find("baseColorTexture");
            model_.has_textures = model_.has_textures || texture;
            if (texture) material = material_of(*texture);
            if (const auto color = looks->find("baseColorFactor"))
                material.color = color->numbers<4>();
            // What is opaque ignores it.
            const auto alpha = e.find("alphaMode");
            if (material.color && (!alpha || alpha->text() == "OPAQUE")) (*material.color)[3] = 1.0;
        }
        model_.materials.push_back(material);
    }
    [[nodiscard]] material_gltf material_of(const json_entry& texture) const {
        material_gltf material{.texture_set = whole_or(texture, "texCoord", 0)};
        const auto e = texture.find("extensions", texture_transform);
        if (!e) return material;
        texture_transform_gltf t;
        if (const auto offset = e->find("offset")) t.offset = offset->numbers<2>();
        if (const auto rotation = e->find("rotation")) t.rotation = rotation->number();
        if (const auto scale = e->find("scale")) t.scale = scale->numbers<2>();
        material.texture_set = whole_or(*e, "texCoord", material.texture_set);
        material.transform = t;
        return material;
    }

    void add_mesh(const json_entry& e) {
        mesh_gltf mesh{.name = name_of(e)};
        e.get("primitives").for_each([&](const json_entry& p) {
            mesh.primitives.push_back(primitive_of(p));
        });
        model_.meshes.push_back(std::move(mesh));
    }
    [[nodiscard]] primitive_gltf primitive_of(const json_entry& e) const {
        primitive_gltf primitive;
        e.get("attributes").for_each_member([&](const std::string& name, const json_entry& a) {
            primitive.attributes.emplace(name, accessor_of(a));
        });
        if (const auto indices = e.find("indices")) primitive.indices = accessor_of(*indices);
        if (const auto material = e.find("material"))
            primitive.material = material->number_of(model_.materials.size(), "materials");
        primitive.mode = static_cast<unsigned>(whole_or(e, "mode", 4));
        if (const auto mode = e.find("mode")) (void)mode->number_of(7, "modes");
        primitive.morphs = e.count("targets") > 0;
        if (const auto extras = e.find("extras"); extras && extras->is_object())
            if (const auto own = extras->find("face_properties"); own && own->is_object())
                own->for_each_member([&](const std::string& name, const json_entry&) {
                    primitive.face_properties.insert(name);
                });
        if (const auto packed = e.find("extensions", draco_extension)) {
            primitive.draco = draco_gltf{.view = view_of(*packed)};
            packed->get("attributes").for_each_member([&](const auto& name, const auto& id) {
                primitive.draco->attributes[name] =
                    static_cast<std::uint32_t>(id.number_of(1U << 31, "attributes"));
            });
        }
        return primitive;
    }

    void add_node(const json_entry& e) {
        node_gltf node{.name = name_of(e), .transform = transform_of_node(e)};
        if (const auto mesh = e.find("mesh"))
            node.mesh = mesh->number_of(model_.meshes.size(), "meshes");
        const std::size_t nodes = root_.count("nodes");
        e.for_each("children", [&](const json_entry& child) {
            node.children.push_back(child.number_of(nodes, "nodes"));
        });
        node.has_skin = e.find("skin").has_value();
        if (const auto instances = e.find("extensions", instancing)) {
            instances_gltf all;
            instances->get("attributes").for_each_member([&](const auto& name, const auto& a) {
                if (name == "TRANSLATION") all.translation = accessor_of(a);
                if (name == "ROTATION") all.rotation = accessor_of(a);
                if (name == "SCALE") all.scale = accessor_of(a);
            });
            node.instances = all;
        }
        model_.nodes.push_back(std::move(node));
    }

    [[nodiscard]] static transform<3> transform_of_node(const json_entry& e) {
        if (const auto matrix = e.find("matrix")) return transform_of_matrix(*matrix);
        const auto point = [&](const char* key, const point3& usual) {
            const auto found = e.find(key);
            if (!found) return usual;
            const auto [x, y, z] = found->numbers<3>();
            return point3{x, y, z};
        };
        const point3 translation = point("translation", {});
        const point3 scale = point("scale", {1, 1, 1});
        std::array<double, 4> rotation{0, 0, 0, 1};
        if (const auto r = e.find("rotation")) {
            rotation = r->numbers<4>();
            if (!is_rotation(rotation)) r->fail("is not a rotation");
        }
        return transform_of(translation, rotation, scale);
    }

    /// Column by column. The last row may be a multiple of 0 0 0 1.
    [[nodiscard]] static transform<3> transform_of_matrix(const json_entry& e) {
        const auto m = e.numbers<16>();
        if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] == 0.0)
            e.fail("is a projection: its last row is not 0 0 0 1");
        transform<3> t;
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t col = 0; col < 4; ++col) t.rows[row][col] = m[4 * col + row] / m[15];
        return t;
    }

    /// The nodes of the default scene, else of the first; without scenes, those without a parent.
    void find_roots() {
        model_.scenes = root_.count("scenes");
        const auto chosen = root_.find("scene");
        const std::size_t scene = chosen ? chosen->number_of(model_.scenes, "scenes") : 0;
        std::size_t number = 0;
        root_.for_each("scenes", [&](const json_entry& e) {
            if (number++ != scene) return;
            e.for_each("nodes", [&](const json_entry& node) {
                model_.roots.push_back(node.number_of(model_.nodes.size(), "nodes"));
            });
        });
        if (model_.scenes > 0) return;
        std::vector<bool> has_parent(model_.nodes.size(), false);
        for (const node_gltf& node : model_.nodes)
            for (const std::size_t child : node.children) has_parent[child] = true;
        for (std::size_t n = 0; n < has_parent.size(); ++n)
            if (!has_parent[n]) model_.roots.push_back(n);
    }

    const json_entry& root_;
    model_gltf model_{};
};

}  // namespace

bool is_rotation(const std::array<double, 4>& quaternion) {
    const auto [x, y, z, w] = quaternion;
    const double square = x * x + y * y + z * z + w * w;
    return square > 1e-100 && square < 1e100;
}

transform<3> transform_of(const point3& translation, const std::array<double, 4>& rotation,
                          const point3& scale) {
    const auto [x, y, z, w] = rotation;
    const double s = 2.0 / (x * x + y * y + z * z + w * w);  // of any length: rounded, it is not 1
    const std::array<std::array<double, 3>, 3> turn{
        {{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
         {s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
         {s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}}};
    transform<3> t;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t col = 0; col < 3; ++col) t.rows[row][col] = turn[row][col] * scale[col];
        t.rows[row][3] = translation[row];
    }
    return t;
}

model_gltf parse_gltf(const source& in, std::string_view json, bool is_version_1) {
    refuse_deep_json(in, json);
    if (is_version_1) return {.is_version_1 = true};
    // Some programs fill the JSON of a GLB up with zeros.
    json = json.substr(0, json.find_last_not_of('\0') + 1);
    nlohmann::json text;
    try {
        text = nlohmann::json::parse(json.begin(), json.end());
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = std::min(std::max<std::size_t>(error.byte, 1) - 1, json.size());
        in.fail_byte(json.data() + byte, "the JSON is invalid here, or truncated");
    } catch (const nlohmann::json::exception&) {
        in.fail("the JSON has a number that is too large");
    }
    const json_entry root(in, text);
    if (says_version_1(root)) return {.is_version_1 = true};
    refuse_versions(in, root);
    refuse_extensions(in, root);
    return parser(root).parse();
}

}  // namespace treeform::detail::io
