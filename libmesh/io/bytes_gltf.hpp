#pragma once
/// \file
/// The bytes of a glTF: the parts of a GLB, what buffers hold, the values of accessors, and the
/// meshes that these make, each with coordinates of its own.

#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

struct parts_gltf {
    std::string_view json{};
    std::optional<std::string_view> binary{};  ///< binary part, if a GLB has one
    std::uint64_t trailing = 0;                ///< bytes after the length in the GLB header
    /// whether it is a GLB of glTF 1.0, of which this has only the JSON
    bool is_version_1 = false;
};

/// \throws io_error for a GLB that is truncated, or of a version other than 1 and 2
[[nodiscard]] parts_gltf parts_of_gltf(const source& in);

/// The contents of the buffers, each loaded when it is first needed. The arguments of the
/// constructor must outlive this.
///
/// A buffer is the binary part of the GLB, a base64 "data:" URI, or a file whose name is relative
/// to the folder of `path` and does not leave it.
class buffers_gltf {
  public:
    /// `path` is empty for bytes in memory, which cannot refer to files.
    buffers_gltf(const source& in, const std::filesystem::path& path, const model_gltf& model,
                 const parts_gltf& parts);

    /// \throws io_error for a buffer that is missing or too short
    [[nodiscard]] std::string_view bytes_of_view(std::size_t view);
    /// Sets the values of an accessor that are not in a buffer, element after element.
    void give_values(std::size_t accessor, std::string bytes) {
        given_[accessor] = std::move(bytes);
    }
    [[nodiscard]] const std::string* given_values(std::size_t accessor) const {
        const auto at = given_.find(accessor);
        return at == given_.end() ? nullptr : &at->second;
    }
    [[nodiscard]] const model_gltf& model() const { return model_; }
    /// Size in bytes of the glTF itself.
    [[nodiscard]] std::size_t file_size() const { return in_.size(); }

    /// Throws io_error "file: things[number] reason".
    [[noreturn]] void fail(const char* things, std::size_t number, const std::string& reason) const;

  private:
    [[nodiscard]] std::string_view load(std::size_t buffer);
    [[nodiscard]] std::string_view load_file(std::size_t buffer, const std::string& uri);

    const source& in_;
    std::filesystem::path folder_{};
    bool has_folder_;
    const model_gltf& model_;
    std::optional<std::string_view> binary_;
    std::vector<std::optional<std::string_view>> loaded_;
    std::deque<source> files_{};
    std::deque<std::string> decoded_{};
    std::map<std::size_t, std::string> given_{};
};

/// The values, as doubles. Values of a sparse accessor are assembled first. The buffers must
/// outlive this.
class values_gltf {
  public:
    /// \throws io_error if there are too few bytes for the values
    values_gltf(buffers_gltf& buffers, std::size_t accessor);
    values_gltf(const values_gltf&) = delete;
    values_gltf& operator=(const values_gltf&) = delete;
    ~values_gltf() = default;

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t components() const { return components_; }
    /// As it is stored.
    [[nodiscard]] double raw(std::size_t i, std::size_t component) const;
    /// The value; integers of a normalized accessor are converted to -1 to 1.
    [[nodiscard]] double at(std::size_t i, std::size_t component) const {
        return normalized_ ? as_share(raw(i, component)) : raw(i, component);
    }
    /// The value as if the accessor were normalized.
    [[nodiscard]] double share(std::size_t i, std::size_t component) const {
        return as_share(raw(i, component));
    }
    /// Of whole numbers.
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

/// Whether treeform was built with draco.
[[nodiscard]] bool reads_draco();

/// Unpacks the indices and the supported attributes, and sets them as the values of their
/// accessors.
///
/// \pre    `primitive.draco`
/// \throws io_error for damaged data, for data that claims more values than it can hold, if the
///         number of values differs from that of the accessors, and without draco
void unpack_draco(buffers_gltf& buffers, std::size_t mesh, const primitive_gltf& primitive);

/// A primitive of a mesh, with triangles or only points. Primitives with the same attribute
/// accessors share their points.
struct shape_gltf {
    const primitive_gltf* primitive = nullptr;
    std::size_t first_point = 0;
    bool adds_points = false;
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// The sizes of a mesh.
struct outline_gltf {
    std::vector<shape_gltf> shapes{};
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// The attributes of points over all used meshes, and counts of content that is not read.
struct survey_gltf {
    std::uint64_t points = 0;  ///< counted once for each mesh
    std::uint64_t with_normals = 0;
    std::uint64_t with_texture = 0;
    std::uint64_t with_colors = 0;
    std::optional<scalar_type> color_type{};  ///< float32 if types differ
    bool has_alpha = false;
    std::uint64_t lines = 0;
    std::uint64_t corners_left_over = 0;  ///< corners left over after whole triangles
    std::uint64_t without_positions = 0;  ///< number of primitives without positions
    bool morphs = false;
    std::set<std::string> unread{};  ///< names of attributes that are not read
    std::set<std::string> unread_of_faces{};
    std::set<std::size_t> checked{};  ///< accessors whose bytes were checked

    [[nodiscard]] std::size_t channels() const { return has_alpha ? 4 : 3; }
};

/// A mesh in its own coordinates, with the attributes in the survey.
struct local_mesh_gltf {
    std::vector<point3> points{};
    std::vector<face> faces{};
    std::vector<point3> normals{};  ///< [V] or empty
    /// [V] or empty; with the origin at the lower left corner
    std::vector<std::array<float, 2>> texture{};
    std::vector<std::byte> colors{};       ///< [V][channels] or empty
    std::vector<std::size_t> materials{};  ///< [F] number of the material, from 1; 0: none
};

/// Counts the content of a mesh, checks that its bytes exist, and adds to the survey.
///
/// \throws io_error if bytes are missing, and for attributes of invalid types
[[nodiscard]] outline_gltf outline_of(buffers_gltf& buffers, std::size_t mesh, survey_gltf& survey);

/// \throws io_error naming the first index that is out of range
[[nodiscard]] local_mesh_gltf decode(buffers_gltf& buffers, std::size_t mesh,
                                     const outline_gltf& outline, const survey_gltf& survey);

}  // namespace treeform::detail::io
