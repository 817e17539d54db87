#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/bytes_gltf.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t head_size = 12;  // magic, version, length
constexpr std::size_t chunk_head = 8;  // length, type

[[nodiscard]] std::size_t word_at(std::string_view bytes, std::size_t at) {
    return base::load<std::uint32_t, std::endian::little>(bytes.data() + at);
}

/// "%20" becomes a blank; what is no code stays.
[[nodiscard]] std::string without_percents(std::string_view uri) {
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && uri.size() - i > 2 &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            plain += static_cast<char>(code);
            i += 2;
        } else {
            plain += uri[i];
        }
    }
    return plain;
}

/// "http:", "file:", "C:"
[[nodiscard]] bool has_scheme(std::string_view uri) {
    const std::size_t end =
        uri.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.");
    return end != std::string_view::npos && end > 0 && uri[end] == ':';
}

[[nodiscard]] bool leaves_folder(const std::filesystem::path& name) {
    const std::filesystem::path plain = name.lexically_normal();
    return plain.is_absolute() || (!plain.empty() && *plain.begin() == "..");
}

/// None for what is no base64.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value{};
    value.fill(-1);
    for (std::size_t d = 0; d < digits.size(); ++d)
        value[static_cast<unsigned char>(digits[d])] = static_cast<int>(d);
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = value[static_cast<unsigned char>(c)];
        if (digit < 0) return std::nullopt;
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffU;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

/// Elements of one size at one distance.
struct row_gltf {
    const char* first = nullptr;
    std::size_t stride = 0;
};

/// `count` elements of `size` bytes from byte `offset` of a view; none when it does not hold them.
[[nodiscard]] std::optional<row_gltf> find_row(std::string_view view, std::uint64_t stride,
                                               std::uint64_t offset, std::uint64_t count,
                                               std::size_t size) {
    if (stride == 0) stride = size;
    if (count == 0) return row_gltf{view.data(), size};
    if (stride < size || offset > view.size() || size > view.size() - offset ||
        count - 1 > (view.size() - offset - size) / stride)
        return std::nullopt;
    return row_gltf{view.data() + offset, static_cast<std::size_t>(stride)};
}

[[nodiscard]] double load_as_double(const char* from, scalar_type type) {
    return with_type(type, [&]<class T>(T) {
        return static_cast<double>(base::load<T, std::endian::little>(from));
    });
}

/// Writes the values of a sparse accessor over those in `dense`.
void overwrite(buffers_gltf& buffers, std::size_t number, std::size_t element, std::string& dense) {
    const accessor_gltf& accessor = buffers.model().accessors[number];
    const sparse_gltf& sparse = *accessor.sparse;
    const std::size_t index_size = size_of(sparse.index_type);
    if (sparse.index_type == scalar_type::float32 || sparse.count > accessor.count)
        buffers.fail("accessors", number, "has a sparse part that does not match it");
    const auto indices = find_row(buffers.bytes_of_view(sparse.index_view), 0, sparse.index_offset,
                                  sparse.count, index_size);
    const auto values = find_row(buffers.bytes_of_view(sparse.value_view), 0, sparse.value_offset,
                                 sparse.count, element);
    if (!indices || !values)
        buffers.fail("accessors", number, "has a sparse part beyond the end of its buffer view");
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const double at = load_as_double(indices->first + i * index_size, sparse.index_type);
        if (!(at >= 0.0 && at < static_cast<double>(accessor.count)))
            buffers.fail("accessors", number, "has a sparse index that is out of range");
        std::memcpy(dense.data() + static_cast<std::size_t>(at) * element,
                    values->first + i * element, element);
    }
}

}  // namespace

parts_gltf parts_of_gltf(const source& in) {
    const std::string_view all(in.begin(), in.size());
    parts_gltf parts{.json = all};
    if (!all.starts_with("glTF")) return parts;
    if (all.size() < head_size + chunk_head) in.fail("truncated");
    if (word_at(all, 4) == 1) {
        constexpr std::size_t head_1 = 20;
        const std::size_t size = word_at(all, head_size);
        if (size > all.size() - head_1) in.fail("truncated");
        return {.json = all.substr(head_1, size), .is_version_1 = true};
    }
    if (word_at(all, 4) != 2)
        in.fail("GLB version " + std::to_string(word_at(all, 4)) + " is not supported, only 2");
    const std::size_t length = word_at(all, 8);
    if (length > all.size()) in.fail("truncated");
    parts.trailing = all.size() - length;
    bool first = true;
    for (std::size_t at = head_size; length > at && length - at >= chunk_head;) {
        const std::size_t size = word_at(all, at);
        const std::string_view type = all.substr(at + 4, 4);
        at += chunk_head;
        if (size > length - at) in.fail("truncated");
        const std::string_view chunk = all.substr(at, size);
        if (first && type != "JSON") in.fail_byte(chunk.data() - 4, "the first chunk is not JSON");
        if (first) parts.json = chunk;
        if (type == std::string_view("BIN\0", 4) && !parts.binary) parts.binary = chunk;
        first = false;
        at += size;
    }
    if (first) in.fail("truncated");
    return parts;
}

buffers_gltf::buffers_gltf(const source& in, const std::filesystem::path& path,
                           const model_gltf& model, const parts_gltf& parts)
    : in_(in),
      folder_(path.parent_path()),
      has_folder_(!path.empty()),
      model_(model),
      binary_(parts.binary),
      loaded_(model.buffers.size()) {}

void buffers_gltf::fail(const char* things, std::size_t number, const std::string& reason) const {
    in_.fail(std::string(things) + '[' + std::to_string(number) + "] " + reason);
}

std::string_view buffers_gltf::bytes_of_view(std::size_t number) {
    const view_gltf& view = model_.views[number];
    if (!view.compression.empty())
        fail("bufferViews", number,
             "needs the extension " + view.compression +
                 ", which is not supported; gltf-transform copy IN OUT unpacks it");
    auto& bytes = loaded_[view.buffer];
    if (!bytes) bytes = load(view.buffer);
    if (view.offset > bytes->size() || view.size > bytes->size() - view.offset)
        fail("bufferViews", number, "goes beyond the end of its buffer");
    return bytes->substr(view.offset, view.size);
}

std::string_view buffers_gltf::load(std::size_t number) {
    const buffer_gltf& buffer = model_.buffers[number];
    std::string_view bytes;
    constexpr std::string_view data = "data:";
    if (!buffer.uri) {
        if (number != 0 || !binary_)
            fail("buffers", number, "has no data: neither a uri nor a binary chunk");
        bytes = *binary_;
    } else if (buffer.uri->starts_with(data)) {
        const std::string_view uri = *buffer.uri;
        const std::size_t comma = uri.find(',');
        if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
            fail("buffers", number, "is a 'data:' uri without base64");
        auto decoded = from_base64(uri.substr(comma + 1));
        if (!decoded) fail("buffers", number, "is not valid base64");
        bytes = decoded_.emplace_back(*std::move(decoded));
    } else {
        bytes = load_file(number, *buffer.uri);
    }
    if (bytes.size() < buffer.size)
        fail("buffers", number,
             "has " + std::to_string(bytes.size()) + " of " + std::to_string(buffer.size) +
                 " bytes");
    return bytes.substr(0, buffer.size);
}

std::string_view buffers_gltf::load_file(std::size_t number, const std::string& uri) {
    const std::string name = without_percents(uri);
    if (has_scheme(uri) || name.empty() || name.starts_with('\\') || leaves_folder(name) ||
        name.find('\0') != std::string::npos)
        fail("buffers", number,
             "refers to '" + uri + "'; only files in the folder of the glTF are read");
    if (!has_folder_)
        fail("buffers", number,
             "is in the file '" + name + "', which cannot be found without the path of the glTF");
    std::error_code error;
    std::filesystem::path path = folder_ / name;
    // Not all programs encode names.
    if (!std::filesystem::exists(path, error) && std::filesystem::exists(folder_ / uri, error))
        path = folder_ / uri;
    if (!std::filesystem::is_regular_file(path, error))
        fail("buffers", number, "is in the file '" + path.string() + "', which does not exist");
    try {
        const source& file = files_.emplace_back(source::open(path));
        return {file.begin(), file.size()};
    } catch (const io_error& reason) {
        fail("buffers", number, std::string("cannot be read: ") + reason.what());
    }
}

values_gltf::values_gltf(buffers_gltf& buffers, std::size_t number) {
    const accessor_gltf& accessor = buffers.model().accessors[number];
    components_ = accessor.components;
    type_ = accessor.type;
    normalized_ = accessor.normalized;
    if (components_ == 0)
        buffers.fail("accessors", number, "has matrices, which are not allowed here");
    const std::size_t element = components_ * size_of(type_);
    if (const std::string* const given = buffers.given_values(number)) {
        first_ = given->data();
        stride_ = element;
        size_ = given->size() / element;
        return;
    }
    row_gltf row;
    if (accessor.view) {
        const auto found = find_row(buffers.bytes_of_view(*accessor.view),
                                    buffers.model().views[*accessor.view].stride, accessor.offset,
                                    accessor.count, element);
        if (!found) buffers.fail("accessors", number, "goes beyond the end of its buffer view");
        row = *found;
    } else if (!accessor.sparse) {
        buffers.fail("accessors", number, "has no buffer view");
    } else if (accessor.count > buffers.file_size()) {
        buffers.fail("accessors", number, "announces more values than the file has bytes");
    }
    size_ = static_cast<std::size_t>(accessor.count);
    first_ = row.first;
    stride_ = row.stride;
    if (!accessor.sparse) return;
    dense_.assign(size_ * element, '\0');
    for (std::size_t i = 0; accessor.view && i < size_; ++i)
        std::memcpy(dense_.data() + i * element, row.first + i * row.stride, element);
    overwrite(buffers, number, element, dense_);
    first_ = dense_.data();
    stride_ = element;
}

double values_gltf::raw(std::size_t i, std::size_t component) const {
    return load_as_double(first_ + i * stride_ + component * size_of(type_), type_);
}

double values_gltf::as_share(double stored) const {
    return with_type(type_, [&]<class T>(T) {
        if constexpr (std::is_floating_point_v<T> || sizeof(T) > 2)
            return stored;
        else
            return std::max(stored / std::numeric_limits<T>::max(), -1.0);
    });
}

}  // namespace treeform::detail::io
