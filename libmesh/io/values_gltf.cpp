#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/values_gltf.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

namespace treeform::detail::io {

namespace {

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
void overwrite(buffers_gltf& buffers, const model_gltf& model, std::size_t number,
               std::size_t element, std::string& dense) {
    const accessor_gltf& accessor = model.accessors[number];
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

values_gltf::values_gltf(buffers_gltf& buffers, const model_gltf& model, std::size_t number) {
    const accessor_gltf& accessor = model.accessors[number];
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
        const auto found =
            find_row(buffers.bytes_of_view(*accessor.view), model.views[*accessor.view].stride,
                     accessor.offset, accessor.count, element);
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
    overwrite(buffers, model, number, element, dense_);
    first_ = dense_.data();
    stride_ = element;
}

double values_gltf::raw(std::size_t i, std::size_t component) const {
    return load_as_double(first_ + i * stride_ + component * size_of(type_), type_);
}

double values_gltf::as_share(double stored) const {
    switch (type_) {
        case scalar_type::int8:
            return std::max(stored / 127.0, -1.0);
        case scalar_type::uint8:
            return stored / 255.0;
        case scalar_type::int16:
            return std::max(stored / 32767.0, -1.0);
        case scalar_type::uint16:
            return stored / 65535.0;
        default:
            return stored;
    }
}

}  // namespace treeform::detail::io
