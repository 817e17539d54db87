#pragma once
/// \file
/// What is known of the records of a file whose places can only be read, once all have been looked
/// at, be it by many: how many there are, and where some of them begin.

#include <libmesh/io/file_part.hpp>
#include <libmesh/io/text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::io {

inline constexpr std::size_t most_marks = 1024;

/// What the cells of a column of text are.
struct text_column {
    bool whole = true;           ///< whole numbers, without point and exponent
    bool beyond = false;         ///< one of them is beyond 2^53
    bool unsigned_only = false;  ///< and one beyond 2^63
    std::uint64_t gaps = 0;      ///< empty cells, and words
    double least = 0.0;
    double greatest = 0.0;

    void add(const text_column& more) {
        whole = whole && more.whole;
        beyond = beyond || more.beyond;
        unsigned_only = unsigned_only || more.unsigned_only;
        gaps += more.gaps;
        least = std::min(least, more.least);
        greatest = std::max(greatest, more.greatest);
    }
};

/// A record is a line with the values of a point, or in a PLY of a row; in binary a point with
/// lists, where the last mark is the end of all points.
struct record_index {
    struct mark {
        std::uint64_t record = 0;
        std::uint64_t byte = 0;  ///< of the file, where it begins
    };
    std::uint64_t records = 0;
    std::vector<mark> marks{};           ///< ascending; the first record has one
    bool even = true;                    ///< of XYZ: all lines have as many values as the first one
    bool hexadecimal = false;            ///< a number is
    std::vector<text_column> columns{};  ///< of XYZ: those behind x, y and z

    /// The last mark that is not behind the record.
    [[nodiscard]] mark before(std::uint64_t record) const {
        const auto behind = std::ranges::upper_bound(marks, record, {}, &mark::record);
        return behind == marks.begin() ? mark{} : behind[-1];
    }
    /// Adds what was found in the next part.
    void add(const record_index& next) {
        for (const mark& m : next.marks) marks.push_back({records + m.record, m.byte});
        records += next.records;
        even = even && next.even;
        hexadecimal = hexadecimal || next.hexadecimal;
        columns.resize(std::max(columns.size(), next.columns.size()));
        for (std::size_t i = 0; i < next.columns.size(); ++i) columns[i].add(next.columns[i]);
    }
};

/// Marks of records, evenly spread, as these come.
class spread_marks {
  public:
    /// At most so many, at least two.
    explicit spread_marks(std::size_t most) : most_(most) {}

    /// Of each record, or each some-th one. \pre it is behind those before
    void add(std::uint64_t record, std::uint64_t byte) {
        if (record % spacing_ != 0) return;
        while (record % spacing_ == 0 && marks_.size() == most_) thin_out();
        if (record % spacing_ == 0) marks_.push_back({record, byte});
    }
    [[nodiscard]] std::vector<record_index::mark> all() && { return std::move(marks_); }

  private:
    /// Leaves every other one.
    void thin_out() {
        spacing_ *= 2;
        std::erase_if(marks_, [&](const auto& m) { return m.record % spacing_ != 0; });
    }

    std::size_t most_;
    std::uint64_t spacing_ = 1;
    std::vector<record_index::mark> marks_{};
};

/// Counts the records whose lines begin in one part of a text, and marks some, evenly spread.
class text_scan {
  public:
    /// Of what is left of the text; at most `most` marks, at least two.
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
    /// The text is at the next record.
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

/// Of rows that are lines which are not blank, from `body` on.
[[nodiscard]] record_index scan_rows(const source& in, const char* body, const file_part& part,
                                     std::size_t most);

}  // namespace treeform::detail::io
