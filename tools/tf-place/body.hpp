#pragma once
/// \file
/// The meshes that the tool reads: MOVING, and those that are fixed.

#include "tools/common/run.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// A file's mesh, or a part of it, or a cloud.
struct body {
    std::string path{};
    std::shared_ptr<tf::mesh_file> file{};  ///< as read, or as moved by --start; parts share it
    std::size_t file_number = 0;            ///< among the fixed files
    tf::file_body is{};
    bool cloud = false;
    std::size_t faces = 0;
    std::optional<tf::box3> box{};
    std::uint64_t non_finite = 0;  ///< triangles of the file left out, or points

    [[nodiscard]] std::uint32_t stored_face(std::uint32_t f) const {
        return is.stored_face(*file, f);
    }
    [[nodiscard]] std::string label() const;  ///< for people: the path, and the part
};

/// Bodies side by side with what the library takes.
struct body_set {
    std::vector<body> bodies{};
    std::vector<tf::prepared_mesh> shapes{};
    json entries = json::array();  ///< of the report, by file
    bool read = false;
    bool as_single = false;

    [[nodiscard]] std::size_t indexed() const;
    [[nodiscard]] std::vector<std::string> labels() const;
};

/// Reads `path`, moves it by `start`, and adds it as one body. \returns what the report says of it;
/// of the only input it says so
json read_body(job& work, const std::string& path, const tf::transform<3>& start, body_set& to);

/// Of --start.
[[nodiscard]] tf::transform<3> start_of(const place_settings& settings);

/// The fixed meshes, read once for all MOVING.
void read_fixed(job& work, const place_settings& settings, bool as_single, body_set& fixed);

}  // namespace tools
