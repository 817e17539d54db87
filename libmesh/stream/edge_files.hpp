#pragma once
/// \file
/// Counts edges of more than two faces, of more faces than memory holds.

#include <libmesh/stream/pacer.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace treeform::detail::stream {

inline constexpr std::size_t piece_of_edges = std::size_t{1}
                                              << 20;  ///< bytes read or written at a time

/// All uses of an edge go to the same of several files, each of which memory holds.
class TREEFORM_API edge_files {
  public:
    /// For at most `uses` of edges. Files are called `name` and a number. About `memory` bytes are
    /// held.
    edge_files(const work_folder& folder, const std::string& name, std::uint64_t uses,
               std::uint64_t memory);
    ~edge_files();
    edge_files(const edge_files&) = delete;
    edge_files& operator=(const edge_files&) = delete;

    /// A face has this edge.
    void put(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t edge = a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
        writers_[static_cast<std::size_t>((edge * 0x9e3779b97f4a7c15 >> 32) * writers_.size() >>
                                          32)]
            .put(edge);
    }
    /// How many edges more than two faces have. Call it once, after all were put.
    /// \throws stream_error, cancelled
    [[nodiscard]] std::uint64_t count_nonmanifold(pacer& pace);

  private:
    std::vector<std::filesystem::path> paths_{};
    std::vector<row_writer> writers_{};
    std::size_t most_;  ///< uses held at a time
};

}  // namespace treeform::detail::stream
