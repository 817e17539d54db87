#pragma once
/// \file
/// Files of rows of 64-bit numbers, as many a row as their user says, rows sorted on the disk, and
/// those that each rank has for each, on their way through files of the folder.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

using numbers = std::span<const std::uint64_t>;
using row_writer = record_writer<std::uint64_t>;  ///< row after row

/// Reads the rows of a file one by one.
class row_reader {
  public:
    /// `expected` counts numbers, not rows. Reads about `bytes` at a time. If `some` is not all
    /// rows, the checksum is not verified.
    row_reader(std::filesystem::path path, record_count expected, std::size_t width,
               std::size_t bytes, const share& some = {})
        : reader_(std::move(path), expected, bytes, width), width_(width) {
        if (some.size() < expected.records / width)
            reader_.narrow(some.first * width, some.size() * width);
        left_ = reader_.next();
    }

    [[nodiscard]] bool empty() const { return left_.empty(); }
    /// \pre not empty
    [[nodiscard]] numbers front() const { return left_.first(width_); }
    void pop() {
        left_ = left_.subspan(width_);
        if (left_.empty()) left_ = reader_.next();
    }

  private:
    record_reader<std::uint64_t> reader_;
    std::size_t width_;
    std::span<const std::uint64_t> left_{};
};

/// The rows of several files, one file after the other.
class row_chain {
  public:
    struct file {
        std::filesystem::path path{};
        record_count count{};  ///< in numbers
        share some{};          ///< the rows to read
    };
    row_chain(std::vector<file> files, std::size_t width, std::size_t bytes)
        : files_(std::move(files)), width_(width), bytes_(bytes) {
        open_next();
    }

    [[nodiscard]] bool empty() const { return !reader_ || reader_->empty(); }
    /// \pre not empty
    [[nodiscard]] numbers front() const { return reader_->front(); }
    void pop() {
        reader_->pop();
        open_next();
    }

  private:
    void open_next() {
        for (; empty() && next_ < files_.size(); ++next_) {
            const file& f = files_[next_];
            reader_.emplace(f.path, f.count, width_, bytes_, f.some);
        }
    }

    std::vector<file> files_;
    std::size_t width_;
    std::size_t bytes_;
    std::size_t next_ = 0;
    std::optional<row_reader> reader_{};
};

/// Merges the rows of several files that are each sorted by their first `keys` numbers; of equal
/// keys, those of earlier files come first.
class row_merge {
  public:
    row_merge(std::vector<row_reader> readers, std::size_t keys);

    [[nodiscard]] bool empty() const { return heap_.empty(); }
    /// \pre not empty
    [[nodiscard]] numbers front() const { return readers_[heap_.front()].front(); }
    void pop();

  private:
    [[nodiscard]] bool after(std::size_t a, std::size_t b) const;

    std::vector<row_reader> readers_;
    std::size_t keys_;
    std::vector<std::size_t> heap_{};
};

/// External merge sort of rows by their first `keys` numbers.
class row_sorter {
  public:
    struct shape {
        std::size_t width;
        std::size_t keys;
    };
    /// File names are `name` and a number. Uses about `memory` bytes.
    row_sorter(const work_folder& folder, std::string name, shape size, std::uint64_t memory);
    ~row_sorter();
    row_sorter(const row_sorter&) = delete;
    row_sorter& operator=(const row_sorter&) = delete;

    void put(numbers r) {
        held_.insert(held_.end(), r.begin(), r.end());
        if (held_.size() >= most_) write_held();
    }
    /// All rows in order; a stable sort. May be called again, but no row may be put afterwards.
    [[nodiscard]] row_merge sorted();

  private:
    [[nodiscard]] std::filesystem::path path(std::size_t i) const;
    void write_held();

    const work_folder& folder_;
    std::string name_;
    shape shape_;
    std::uint64_t memory_;
    std::size_t most_;
    std::vector<std::uint64_t> held_{};
    std::vector<record_count> pieces_{};
};

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
