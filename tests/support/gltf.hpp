#pragma once
/// \file
/// glTF and GLB, entry by entry, so that any of them may be wrong.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace test {

constexpr int gltf_int8 = 5120, gltf_uint8 = 5121, gltf_int16 = 5122, gltf_uint16 = 5123,
              gltf_uint32 = 5125, gltf_float = 5126;

template <class T>
std::string bytes_of_values(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

inline std::string base64_of(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

inline std::string glb_of(std::string json, std::string_view binary) {
    const auto word = [](std::size_t value) {
        std::string text;
        for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
        return text;
    };
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string second =
        binary.empty() ? std::string()
                       : word(binary.size()) + std::string("BIN\0", 4) + std::string(binary);
    return "glTF" + word(2) + word(20 + json.size() + second.size()) + word(json.size()) + "JSON" +
           json + second;
}

/// Entries are JSON; `more` is that of further members of the root, with a comma behind each.
struct gltf_file {
    std::string binary{};
    std::vector<std::string> views{};
    std::vector<std::string> accessors{};
    std::vector<std::string> meshes{};
    std::vector<std::string> nodes{};
    std::string scenes = R"([{"nodes":[0]}])";
    std::string more{};

    /// A view of these bytes, which start at a multiple of four; its number.
    std::size_t add_view(const std::string& bytes, const std::string& members = {}) {
        binary.resize((binary.size() + 3) / 4 * 4);
        views.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(binary.size()) +
                        R"(,"byteLength":)" + std::to_string(bytes.size()) + members + "}");
        binary += bytes;
        return views.size() - 1;
    }
    std::size_t add_accessor(std::size_t view, int type, std::size_t count, const char* shape,
                             const std::string& members = {}) {
        accessors.push_back(R"({"bufferView":)" + std::to_string(view) + R"(,"componentType":)" +
                            std::to_string(type) + R"(,"count":)" + std::to_string(count) +
                            R"(,"type":")" + shape + "\"" + members + "}");
        return accessors.size() - 1;
    }
    /// An accessor of a view of its own.
    template <class T>
    std::size_t add(const std::vector<T>& values, int type, const char* shape,
                    const std::string& members = {}) {
        const std::string_view of(shape);
        const std::size_t components = of == "SCALAR" ? 1 : static_cast<std::size_t>(of[3] - '0');
        return add_accessor(add_view(bytes_of_values(values)), type, values.size() / components,
                            shape, members);
    }
    /// A mesh of one primitive.
    void add_mesh(const std::string& attributes, const std::string& members) {
        meshes.push_back(R"({"primitives":[{"attributes":{)" + attributes + "}" + members + "}]}");
    }

    [[nodiscard]] std::string json(const std::string& uri = {}) const {
        const auto list = [](const char* name, const std::vector<std::string>& entries) {
            std::string text;
            for (const std::string& e : entries) text += (text.empty() ? "" : ",") + e;
            return entries.empty() ? text : std::string("\"") + name + "\":[" + text + "],";
        };
        const std::string buffer = R"("buffers":[{"byteLength":)" + std::to_string(binary.size()) +
                                   (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}],";
        return "{" + more + (binary.empty() ? "" : buffer) + list("bufferViews", views) +
               list("accessors", accessors) + list("meshes", meshes) + list("nodes", nodes) +
               (scenes.empty() ? "" : "\"scenes\":" + scenes + ",") +
               R"("asset":{"version":"2.0"}})";
    }
    [[nodiscard]] std::string glb() const { return glb_of(json(), binary); }
    [[nodiscard]] std::string embedded() const {
        return json("data:application/octet-stream;base64," + base64_of(binary));
    }
};

inline const std::vector<float> cube_corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                             0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
inline const std::vector<std::uint16_t> cube_indices{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7,
                                                     0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5,
                                                     2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/// Accessor 0 is of the corners, 1 of the indices; one node, which has `members`.
inline gltf_file gltf_cube(const std::string& members = {}) {
    gltf_file file;
    file.add(cube_corners, gltf_float, "VEC3");
    file.add(cube_indices, gltf_uint16, "SCALAR");
    file.add_mesh(R"("POSITION":0)", R"(,"indices":1)");
    file.nodes = {R"({"mesh":0)" + members + "}"};
    return file;
}

}  // namespace test
