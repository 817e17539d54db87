#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/bytes_gltf.hpp>

#include <draco/compression/decode.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace treeform::detail::io {

namespace {

/// Numbers of seven bits a byte; beyond the end of the bytes, 0.
[[nodiscard]] std::uint64_t varint_at(std::string_view bytes, std::size_t& at) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; at < bytes.size() && shift < 64; shift += 7) {
        const auto byte = static_cast<unsigned char>(bytes[at++]);
        value |= std::uint64_t{byte & 0x7fU} << shift;
        if (byte < 0x80) break;
    }
    return value;
}

/// What is wrong with the head, in words: the decoder makes room for all faces that it announces.
[[nodiscard]] std::string fault_of_head(std::string_view bytes) {
    constexpr std::size_t head = 11;
    if (bytes.size() < head || !bytes.starts_with("DRACO")) return "not a Draco header";
    const bool is_mesh = bytes[7] == 1;
    const bool has_metadata = (static_cast<unsigned char>(bytes[10]) & 0x80U) != 0;
    if (!is_mesh || bytes[5] != 2 || bytes[6] < 2 || has_metadata)
        return "of a kind that glTF does not allow";
    const bool is_edgebreaker = bytes[8] == 1;
    std::size_t at = is_edgebreaker ? head + 1 : head;
    const std::uint64_t first = varint_at(bytes, at);
    const std::uint64_t second = varint_at(bytes, at);
    const std::uint64_t faces = is_edgebreaker ? second : first;
    const std::uint64_t points = is_edgebreaker ? first : second;
    const std::uint64_t most = (std::uint64_t{1} << 20) + 1000 * bytes.size();
    if (faces > most || points > 3 * faces) return "more faces than its bytes can hold";
    return {};
}

/// Room for `count` elements of the accessor, filled by `put(i, T* to)`.
template <class T, class F>
[[nodiscard]] std::string filled(std::size_t count, std::size_t components, F&& put) {
    std::string bytes(count * components * sizeof(T), '\0');
    std::array<T, 4> row{};
    for (std::size_t i = 0; i < count; ++i) {
        if (!put(i, row.data())) return {};
        for (std::size_t c = 0; c < components; ++c)
            base::store<std::endian::little>(bytes.data() + (i * components + c) * sizeof(T),
                                             row[c]);
    }
    return bytes;
}

[[nodiscard]] bool is_read(std::string_view attribute) {
    return attribute == "POSITION" || attribute == "NORMAL" || attribute == "COLOR_0" ||
           attribute.starts_with("TEXCOORD_");
}

class unpacker {
  public:
    unpacker(buffers_gltf& buffers, std::size_t mesh) : buffers_(buffers), mesh_(mesh) {}

    void unpack(const primitive_gltf& primitive) {
        const std::string_view bytes = buffers_.bytes_of_view(primitive.draco->view);
        if (const std::string fault = fault_of_head(bytes); !fault.empty()) fail(fault);
        draco::DecoderBuffer in;
        in.Init(bytes.data(), bytes.size());
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&in);
        if (!decoded.ok()) fail("damaged");
        const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
        for (const auto& [name, id] : primitive.draco->attributes) {
            const auto accessor = primitive.attributes.find(name);
            if (!is_read(name) || accessor == primitive.attributes.end()) continue;
            const draco::PointAttribute* const values = mesh->GetAttributeByUniqueId(id);
            if (values == nullptr) fail(name + " is missing");
            give_attribute(*mesh, *values, accessor->second);
        }
        if (primitive.indices) give_indices(*mesh, *primitive.indices);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        buffers_.fail("meshes", mesh_, "has invalid Draco data: " + what);
    }

    void give_attribute(const draco::Mesh& mesh, const draco::PointAttribute& values,
                        std::size_t number) {
        const accessor_gltf& accessor = buffers_.model().accessors[number];
        const std::size_t count = mesh.num_points();
        if (accessor.components == 0 || accessor.count != count)
            fail("its size differs from that of its accessors");
        give(number, count, [&]<class T>(std::size_t i, T* to) {
            const auto at = values.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
            return values.ConvertValue<T>(at, static_cast<std::int8_t>(accessor.components), to);
        });
    }

    void give_indices(const draco::Mesh& mesh, std::size_t number) {
        const accessor_gltf& accessor = buffers_.model().accessors[number];
        const std::size_t count = std::size_t{3} * mesh.num_faces();
        if (accessor.components != 1 || accessor.count != count)
            fail("its size differs from that of its accessors");
        give(number, count, [&]<class T>(std::size_t i, T* to) {
            const auto& face = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)));
            *to = static_cast<T>(face[i % 3].value());
            return true;
        });
    }

    template <class F>
    void give(std::size_t number, std::size_t count, F&& put) {
        const accessor_gltf& accessor = buffers_.model().accessors[number];
        std::string bytes = with_type(
            accessor.type, [&]<class T>(T) { return filled<T>(count, accessor.components, put); });
        if (bytes.empty()) fail("its types differ from those of its accessors");
        buffers_.give_values(number, std::move(bytes));
    }

    buffers_gltf& buffers_;
    std::size_t mesh_;
};

}  // namespace

bool reads_draco() { return true; }

void unpack_draco(buffers_gltf& buffers, std::size_t mesh, const primitive_gltf& primitive) {
    unpacker(buffers, mesh).unpack(primitive);
}

}  // namespace treeform::detail::io
