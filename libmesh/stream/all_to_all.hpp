#pragma once
/// \file
/// All-to-all communication: sends rows from every rank to every rank, through files of the folder.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/work_folder.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

class all_to_all {
  public:
    /// Rows have `width` numbers. Uses about `memory` bytes.
    all_to_all(const work_folder& folder, const communicator& all, std::string name,
               std::size_t width, std::uint64_t memory);

    void put(std::size_t to, numbers row) { to_[to].put(row); }
    /// Sends the rows that were put. Collective: every rank must call this, once.
    void send();
    /// The rows that each rank sent to this one, by sender.
    [[nodiscard]] std::vector<row_reader> received() const;
    /// The rows that all ranks sent to all, by receiver, then by sender.
    [[nodiscard]] std::vector<row_reader> received_by_all() const;
    /// Number of rows sent to lower ranks.
    [[nodiscard]] std::uint64_t rows_before() const;
    /// Removes the files of received rows; call it after reading them.
    void remove_received() const;

  private:
    [[nodiscard]] std::filesystem::path path(std::size_t from, std::size_t to) const;
    void add_received(std::size_t by, std::vector<row_reader>& readers) const;

    const work_folder& folder_;
    const communicator& all_;
    std::string name_;
    std::size_t width_;
    std::uint64_t memory_;
    std::vector<row_writer> to_{};
    std::vector<std::vector<record_count>> counts_{};  ///< [a][b] rows that rank a sent to rank b
};

/// A `row_sorter` for each rank, of rows that any rank puts for it.
class shared_sorter {
  public:
    shared_sorter(const work_folder& folder, const communicator& all, const std::string& name,
                  row_sorter::shape size, std::uint64_t memory);

    void put(std::size_t to, numbers row) {
        if (exchanged_)
            exchanged_->put(to, row);
        else
            sorter_.put(row);
    }
    /// As `row_sorter::sorted`; rows with equal keys are ordered by the rank that put them. The
    /// first call is collective.
    [[nodiscard]] row_merge sorted();

  private:
    row_sorter sorter_;
    std::optional<all_to_all> exchanged_{};  ///< until rows are sorted; none for a single process
};

}  // namespace treeform::detail::stream
