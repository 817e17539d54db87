#pragma once
/// \file
/// Compressed PCD files, unpacked once for all ranks.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/passing_files.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <cstdint>
#include <filesystem>

namespace treeform::detail::stream {

/// Unpacks the compressed data of `pcd` to an empty file that rank 0 created, and returns the
/// number of unpacked bytes. Decompression is sequential, so ranks unpack their shares (of bytes
/// read and written) in turn, and send their position to the next rank. Collective: every rank must
/// call this.
///
/// \throws io_error, the same on all ranks if the data is damaged; cancelled
std::uint64_t unpack_in_turn(const std::filesystem::path& pcd, const std::filesystem::path& to,
                             const communicator& all, cancellable_progress& pace);

/// Unpacked inputs in the folder, from which points are read until the end.
class unpacked_inputs {
  public:
    /// Collective: every rank must call this. \throws as `unpack_in_turn`
    unpacked_inputs(const work_folder& folder, const communicator& all, const cloud_inputs& inputs,
                    joined_points& source, cancellable_progress& pace);

    /// Their size in the folder, in bytes.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    passing_files files_;
    std::uint64_t bytes_ = 0;
};

}  // namespace treeform::detail::stream
