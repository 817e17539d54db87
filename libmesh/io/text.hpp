#pragma once
/// \file
/// A position in the text of an input, with parsing steps common to all text formats.

#include <libmesh/io/number.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// The beginning of the text at `at` for an error message: one word, printable, short.
[[nodiscard]] inline std::string quoted(const char* at, const char* end) {
    constexpr std::size_t longest = 24;
    std::string word = "'";
    for (; at < end && !is_space(*at) && word.size() <= longest; ++at)
        word += *at >= ' ' && *at <= '~' ? *at : '?';
    return word + (at < end && !is_space(*at) ? "...'" : "'");
}

struct text {
    const source& file;
    const char* at;
    const char* end;
    bool hexadecimal = false;  ///< whether a number was hexadecimal

    explicit text(const source& s) : file(s), at(s.begin()), end(s.end()) {
        if (starts_with("\xef\xbb\xbf")) at += 3;  // byte order mark of UTF-8
    }

    [[nodiscard]] bool done() const { return at == end; }
    [[nodiscard]] bool starts_with(std::string_view word) const {
        return std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(word);
    }

    void skip_blanks() {
        while (at < end && is_blank(*at)) ++at;
    }
    void skip_spaces() {
        while (at < end && is_space(*at)) ++at;
    }
    void skip_line() {
        while (at < end && !is_newline(*at)) ++at;
    }
    /// Skips blanks; true at a newline, at a comment, at the end of the text.
    [[nodiscard]] bool line_done() {
        skip_blanks();
        return at == end || is_newline(*at) || *at == '#';
    }
    /// Skips blanks, newlines and comments; true at the end of the text.
    [[nodiscard]] bool text_done() {
        for (;;) {
            skip_spaces();
            if (at == end) return true;
            if (*at != '#') return false;
            skip_line();
        }
    }

    /// Reads the bytes up to the next blank or newline.
    [[nodiscard]] std::string_view word() {
        const char* const first = at;
        while (at < end && !is_space(*at)) ++at;
        return {first, static_cast<std::size_t>(at - first)};
    }
    /// Reads the rest of the line, without blanks around it.
    [[nodiscard]] std::string_view rest_of_line() {
        skip_blanks();
        const char* const first = at;
        skip_line();
        const char* last = at;
        while (last > first && is_blank(last[-1])) --last;
        return {first, static_cast<std::size_t>(last - first)};
    }

    /// Reads a number, which must be followed by a blank, newline or comment: "1.#IND" is not a
    /// number.
    [[nodiscard]] double number(std::string_view what) {
        const parsed<double> n = parse_number(at, end);
        if (n.end == nullptr || !delimited(n.end)) fail_number(what, n.end);
        return take(n);
    }
    /// Advances past a parsed number, and returns its value.
    template <class T>
    T take(const parsed<T>& n) {
        at = n.end;
        hexadecimal = hexadecimal || n.hexadecimal;
        return n.value;
    }
    [[nodiscard]] std::int64_t integer(std::string_view what) {
        const parsed<std::int64_t> n = parse_integer(at, end);
        if (n.end == nullptr || !delimited(n.end)) fail_number(what, n.end);
        at = n.end;
        return n.value;
    }

    /// Adds warnings about the numbers read so far.
    void remark(std::vector<io_warning>& warnings) const {
        if (hexadecimal)
            warnings.push_back(
                {"hexadecimal", "the file has hexadecimal numbers, such as 0x1.8p1"});
    }

    [[noreturn]] void fail(std::string_view reason) const { file.fail_line(at, reason); }

  private:
    [[nodiscard]] bool delimited(const char* p) const {
        return p == end || is_space(*p) || (*p == '#' && p[-1] != '.');
    }
    [[noreturn]] void fail_number(std::string_view what, const char* stop) const {
        const std::string subject(what);
        if (at == end) fail("expected " + subject + ", but the file ends");
        if (is_newline(*at)) fail("expected " + subject + ", but the line ends");
        // "1,5" has a decimal mark, "1.5, 2" and "1, 2" a separator.
        if (stop != nullptr && *stop == ',')
            fail("expected " + subject + ", found " + quoted(at, end) +
                 (stop + 1 < end && is_digit(stop[1])
                      ? ": the decimal separator must be a point"
                      : ": numbers are separated by blanks, not by commas"));
        fail("expected " + subject + ", found " + quoted(at, end));
    }
};

}  // namespace treeform::detail::io
