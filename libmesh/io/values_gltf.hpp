#pragma once
/// \file
/// The values of an accessor of a glTF.

#include <libmesh/io/bytes_gltf.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace treeform::detail::io {

/// The values, as doubles. Values of a sparse accessor are assembled first. The buffers must
/// outlive this.
class values_gltf {
  public:
    /// \throws io_error if there are too few bytes for the values
    values_gltf(buffers_gltf& buffers, const model_gltf& model, std::size_t accessor);
    values_gltf(const values_gltf&) = delete;
    values_gltf& operator=(const values_gltf&) = delete;
    ~values_gltf() = default;

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t components() const { return components_; }
    [[nodiscard]] scalar_type type() const { return type_; }
    /// The value as stored.
    [[nodiscard]] double raw(std::size_t i, std::size_t component) const;
    /// The value; integers of a normalized accessor are converted to -1 to 1.
    [[nodiscard]] double at(std::size_t i, std::size_t component) const {
        return normalized_ ? as_share(raw(i, component)) : raw(i, component);
    }
    /// The value as if the accessor were normalized.
    [[nodiscard]] double share(std::size_t i, std::size_t component) const {
        return as_share(raw(i, component));
    }
    /// The value of an integer accessor.
    [[nodiscard]] std::uint32_t index(std::size_t i) const {
        return static_cast<std::uint32_t>(raw(i, 0));
    }

  private:
    [[nodiscard]] double as_share(double stored) const;

    const char* first_ = nullptr;
    std::size_t stride_ = 0;
    std::size_t size_ = 0;
    std::size_t components_ = 0;
    scalar_type type_ = scalar_type::float32;
    bool normalized_ = false;
    std::string dense_{};  ///< the values of a sparse accessor
};

}  // namespace treeform::detail::io
