#pragma once
/// \file
/// What is known of the lines of a text once all have been looked at, be it by many: how many are
/// records, and where some of these begin.

#include <libmesh/io/file_part.hpp>
#include <libmesh/io/text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::io {

inline constexpr std::size_t most_marks = 1024;

/// A record is a line with the values of a point, or in a PLY of a row.
struct text_index {
    struct mark {
        std::uint64_t record = 0;
        std::uint64_t byte = 0;  ///< of the file, where it begins
    };
    std::uint64_t records = 0;
    std::vector<mark> marks{};  ///< ascending; the first record has one
    bool even = true;           ///< of XYZ: all lines have as many values as the first one
    bool hexadecimal = false;   ///< a number is

    /// The last mark that is not behind the record.
    [[nodiscard]] mark before(std::uint64_t record) const {
        const auto behind = std::ranges::upper_bound(marks, record, {}, &mark::record);
        return behind == marks.begin() ? mark{} : behind[-1];
    }
    /// Adds what was found in the next part.
    void add(const text_index& next) {
        for (const mark& m : next.marks) marks.push_back({records + m.record, m.byte});
        records += next.records;
        even = even && next.even;
        hexadecimal = hexadecimal || next.hexadecimal;
    }
};

/// Counts the records whose lines begin in one part of a text, and marks some, evenly spread.
class text_scan {
  public:
    /// Of what is left of the text; at most `most` marks, at least two.
    text_scan(text& of, const file_part& part, std::size_t most)
        : text_(of), body_(of.at), most_(most) {
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
        if (found_.records % spacing_ == 0 && found_.marks.size() == most_) thin_out();
        if (found_.records % spacing_ == 0)
            found_.marks.push_back(
                {found_.records, static_cast<std::uint64_t>(text_.at - text_.file.begin())});
        ++found_.records;
    }
    [[nodiscard]] text_index found() && { return std::move(found_); }

  private:
    /// Leaves every other one.
    void thin_out() {
        std::size_t left = 0;
        for (std::size_t i = 0; i < found_.marks.size(); i += 2)
            found_.marks[left++] = found_.marks[i];
        found_.marks.resize(left);
        spacing_ *= 2;
    }

    text& text_;
    const char* body_;
    const char* last_;
    std::size_t most_;
    std::uint64_t spacing_ = 1;
    text_index found_{};
};

/// Of rows that are lines which are not blank, from `body` on.
[[nodiscard]] text_index scan_rows(const source& in, const char* body, const file_part& part,
                                   std::size_t most);

}  // namespace treeform::detail::io
