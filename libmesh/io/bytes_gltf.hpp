#pragma once
/// \file
/// The bytes of a glTF: the parts of a GLB, and what buffers hold.

#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/source.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

struct parts_gltf {
    std::string_view json{};
    std::optional<std::string_view> binary{};  ///< of a GLB that has one
    std::uint64_t trailing = 0;                ///< bytes behind the length that a GLB says
    bool is_version_1 = false;                 ///< a GLB of glTF 1.0, of which this has the JSON
};

/// \throws io_error for a GLB that is cut short, or of another version than 1 and 2
[[nodiscard]] parts_gltf parts_of_gltf(const source& in);

/// What the buffers hold; each is looked for when it is first needed. What the constructor gets
/// must outlive it.
///
/// A buffer is the binary part of the GLB, a "data:" of base64, or a file whose name is relative to
/// the folder of `path` and does not leave that.
class buffers_gltf {
  public:
    /// `path` is empty for bytes that have none, beside which there are no files.
    buffers_gltf(const source& in, const std::filesystem::path& path, const model_gltf& model,
                 const parts_gltf& parts);

    /// \throws io_error for what is not there, or not as long as it should be
    [[nodiscard]] std::string_view bytes_of_view(std::size_t view);
    /// Values of an accessor that stand elsewhere, element after element; none of others.
    void give_values(std::size_t accessor, std::string bytes) {
        given_[accessor] = std::move(bytes);
    }
    [[nodiscard]] const std::string* given_values(std::size_t accessor) const {
        const auto at = given_.find(accessor);
        return at == given_.end() ? nullptr : &at->second;
    }
    /// Bytes of the glTF itself.
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

}  // namespace treeform::detail::io
