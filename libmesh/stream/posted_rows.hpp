#pragma once
/// \file
/// Rows that each of a team has for each, on their way through files of the folder.

#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/team.hpp>
#include <libmesh/stream/work_folder.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

class posted_rows {
  public:
    /// Rows of `width` numbers. About `memory` bytes are held.
    posted_rows(const work_folder& folder, const team& all, std::string name, std::size_t width,
                std::uint64_t memory);

    void put(std::size_t to, numbers row) { to_[to].put(row); }
    /// Hands over what was put. All come here, each once.
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
    const team& all_;
    std::string name_;
    std::size_t width_;
    std::uint64_t memory_;
    std::vector<row_writer> to_{};
    std::vector<std::vector<record_count>> counts_{};  ///< of what [a] has put for [b]
};

/// A `row_sorter` for each of a team, of rows that any of it has for it.
class shared_sorter {
  public:
    shared_sorter(const work_folder& folder, const team& all, const std::string& name,
                  row_sorter::shape size, std::uint64_t memory);

    void put(std::size_t to, numbers row) {
        if (posted_)
            posted_->put(to, row);
        else
            sorter_.put(row);
    }
    /// As that of a `row_sorter`; of equal keys, first those that came from lower ranks. All come
    /// here the first time.
    [[nodiscard]] row_merge sorted();

  private:
    row_sorter sorter_;
    std::optional<posted_rows> posted_{};  ///< until they are sorted; none where one is alone
};

}  // namespace treeform::detail::stream
