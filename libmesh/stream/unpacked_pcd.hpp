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

/// Unpacks what is packed in `pcd` to an empty file that rank 0 has made. What a byte
/// stands for is known when those ahead are, so each in turn unpacks its share, counted in bytes
/// read and made, and sends the next one how far it has come. Collective: every rank must call
/// this. Returns how many bytes it became.
///
/// \throws io_error, all of them the same where the packed bytes are damaged; cancelled
std::uint64_t unpack_in_turn(const std::filesystem::path& pcd, const std::filesystem::path& to,
                             const communicator& all, cancellable_progress& pace);

/// The unpacked inputs in a folder, from where they are read until the end.
class unpacked_inputs {
  public:
    /// Collective: every rank must call this. \throws as `unpack_in_turn`
    unpacked_inputs(const work_folder& folder, const communicator& all, const cloud_inputs& inputs,
                    joined_points& source, cancellable_progress& pace);

    /// That they take in the folder.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    passing_files files_;
    std::uint64_t bytes_ = 0;
};

}  // namespace treeform::detail::stream
