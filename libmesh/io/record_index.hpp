#pragma once
/// \file
/// An index of the records of a file whose positions are only known after reading: their number,
/// and the positions of some. Several processes may build it.

#include <libmesh/io/source.hpp>
#include <libmesh/io/text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::io {

inline constexpr std::size_t most_marks = 1024;

/// Properties of the cells of a text column.
struct text_column {
    bool whole = true;           ///< all are integers, without point and exponent
    bool beyond = false;         ///< one is beyond 2^53
    bool unsigned_only = false;  ///< one is beyond 2^63
    std::uint64_t gaps = 0;      ///< number of empty cells, and cells with text
    double min = 0.0;
    double max = 0.0;

    void add(const text_column& more) {
        whole = whole && more.whole;
        beyond = beyond || more.beyond;
        unsigned_only = unsigned_only || more.unsigned_only;
        gaps += more.gaps;
        min = std::min(min, more.min);
        max = std::max(max, more.max);
    }
};

/// A record is a line with the values of a point, or for PLY of any row; in binary files, a point
/// with lists, and the last mark is the end of all points.
struct record_index {
    struct mark {
        std::uint64_t record = 0;
        std::uint64_t byte = 0;  ///< byte of the file at which it begins
    };
    std::uint64_t records = 0;
    std::vector<mark> marks{};  ///< ascending; includes the first record
    bool even = true;           ///< for XYZ: all lines have as many values as the first one
    bool hexadecimal = false;   ///< whether a number is hexadecimal
    std::vector<text_column> columns{};  ///< for XYZ: the columns after x, y and z

    /// The last mark at or before the record.
    [[nodiscard]] mark before(std::uint64_t record) const {
        const auto behind = std::ranges::upper_bound(marks, record, {}, &mark::record);
        return behind == marks.begin() ? mark{} : behind[-1];
    }
    /// Appends the index of the next part.
    void add(const record_index& next) {
        for (const mark& m : next.marks) marks.push_back({records + m.record, m.byte});
        records += next.records;
        even = even && next.even;
        hexadecimal = hexadecimal || next.hexadecimal;
        columns.resize(std::max(columns.size(), next.columns.size()));
        for (std::size_t i = 0; i < next.columns.size(); ++i) columns[i].add(next.columns[i]);
    }
};

/// Collects evenly spread marks of a sequence of records.
class spread_marks {
  public:
    /// `most`: largest number of marks, at least 2.
    explicit spread_marks(std::size_t most) : most_(most) {}

    /// Call it for each record, in order. \pre the record is after those before
    void add(std::uint64_t record, std::uint64_t byte) {
        if (record % spacing_ != 0) return;
        while (record % spacing_ == 0 && marks_.size() == most_) thin_out();
        if (record % spacing_ == 0) marks_.push_back({record, byte});
    }
    [[nodiscard]] std::vector<record_index::mark> all() && { return std::move(marks_); }

  private:
    /// Keeps every other mark.
    void thin_out() {
        spacing_ *= 2;
        std::erase_if(marks_, [&](const auto& m) { return m.record % spacing_ != 0; });
    }

    std::size_t most_;
    std::uint64_t spacing_ = 1;
    std::vector<record_index::mark> marks_{};
};

/// Counts the records whose lines begin in a part of a text, and sets evenly spread marks.
class text_scan {
  public:
    /// For the rest of the text; with at most `most` marks, at least 2.
    text_scan(text& of, const file_part& part, std::size_t most)
        : text_(of), body_(of.at), marks_(most) {
        const auto size = static_cast<std::uint64_t>(text_.end - body_);
        last_ = body_ + part.last(size);
        text_.at = body_ + part.first(size);
        if (text_.at != body_ && !is_newline(text_.at[-1])) text_.skip_line();
    }

    /// Whether the text is at a record of the part.
    [[nodiscard]] bool is_in_part() const {
        const char* line = text_.at;
        while (line != body_ && is_blank(line[-1])) --line;
        return line < last_;
    }
    /// Adds the record at the present position of the text.
    void add() {
        marks_.add(found_.records, static_cast<std::uint64_t>(text_.at - text_.file.begin()));
        ++found_.records;
    }
    [[nodiscard]] record_index found() && {
        found_.marks = std::move(marks_).all();
        return std::move(found_);
    }

  private:
    text& text_;
    const char* body_;
    const char* last_;
    spread_marks marks_;
    record_index found_{};
};

/// The index of rows that are non-blank lines, from `body` on.
[[nodiscard]] record_index scan_rows(const source& in, const char* body, const file_part& part,
                                     std::size_t most);

}  // namespace treeform::detail::io
