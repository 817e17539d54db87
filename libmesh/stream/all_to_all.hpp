#pragma once
/// \file
/// All-to-all: rows that each rank has for each, on their way through files of the folder.

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
    /// Rows of `width` numbers. About `memory` bytes are held.
    all_to_all(const work_folder& folder, const communicator& all, std::string name,
               std::size_t width, std::uint64_t memory);

    void put(std::size_t to, numbers row) { to_[to].put(row); }
    /// Hands over what was put. Collective: every rank must call this, once.
    void send();
    /// What the process has been given by each, in the order of the ranks.
    [[nodiscard]] std::vector<row_reader> received() const;
    /// What each has been given by each, in the order of those who were given it.
    [[nodiscard]] std::vector<row_reader> received_by_all() const;
    /// Rows given to those of lower ranks.
    [[nodiscard]] std::uint64_t rows_before() const;
    /// The process has read what it was given.
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
    std::vector<std::vector<record_count>> counts_{};  ///< of what [a] has put for [b]
};

/// A `row_sorter` for each rank, of rows that any of it has for it.
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
    /// As that of a `row_sorter`; of equal keys, first those that came from lower ranks. All come
    /// here the first time.
    [[nodiscard]] row_merge sorted();

  private:
    row_sorter sorter_;
    std::optional<all_to_all> exchanged_{};  ///< until they are sorted; none where one is alone
};

}  // namespace treeform::detail::stream
