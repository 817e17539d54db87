#pragma once
/// \file
/// Reads values of rows one by one, from text or bytes. Both readers have the same functions:
/// begin_row, length, scalar, end_row, remark.

#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/text.hpp>
#include <treeform/mesh/attributes.hpp>

#include <string>

namespace treeform::detail::io {

template <class T>
void append(std::vector<std::byte>& values, T value) {
    const std::size_t size = values.size();
    values.resize(size + sizeof value);
    std::memcpy(values.data() + size, &value, sizeof value);
}

/// One row in each line.
class text_values {
  public:
    text_values(const source& in, const char* body) : text_(in) { text_.at = body; }

    [[nodiscard]] std::size_t bytes_left() const {
        return static_cast<std::size_t>(text_.end - text_.at);
    }
    /// Whether `rows` rows fit into the bytes: each value needs at least a digit and a separator,
    /// except for the last separator of the file.
    [[nodiscard]] static bool can_hold(std::size_t bytes, std::size_t rows, const element& e) {
        return e.columns.empty() || rows <= (bytes + 1) / (2 * e.columns.size());
    }

    /// Takes over known properties of the whole text, for rows that other processes read.
    void expect(const record_index& all) { text_.hexadecimal = all.hexadecimal; }
    /// Continues at a row.
    void go_to(const char* row) { text_.at = row; }
    /// Skips a row without parsing its values.
    void pass_row() {
        text_.skip_spaces();
        text_.skip_line();
        text_.file.release_before(text_.at);
    }

    void begin_row() { text_.skip_spaces(); }
    [[nodiscard]] const char* at() const { return text_.at; }

    /// The length of a list; an error if it exceeds the rest of the file.
    [[nodiscard]] std::size_t length(const column&) {
        text_.skip_blanks();
        const char* const start = text_.at;
        const std::int64_t count = text_.integer("the length of a list");
        if (count >= 0 && static_cast<std::size_t>(count) <= bytes_left())
            return static_cast<std::size_t>(count);
        text_.at = start;
        text_.fail("a list cannot have " + quoted(start, text_.end) + " values");
    }

    [[nodiscard]] double coordinate(const column&) {
        text_.skip_blanks();
        return text_.number("a coordinate");
    }

    [[nodiscard]] std::int64_t index(const column&) {
        text_.skip_blanks();
        return text_.integer("a vertex index");
    }

    void scalar(column& c) {
        text_.skip_blanks();
        with_type(c.type, [&]<class T>(T) {
            const parsed<T> n = parse<T>();
            if (n.end == nullptr || (n.end != text_.end && !is_space(*n.end))) {
                if (text_.done() || is_newline(*text_.at)) text_.fail("the row ends too early");
                text_.fail(quoted(text_.at, text_.end) + " is not a valid value of " + c.name);
            }
            append(c.values, text_.take(n));
        });
    }

    void end_row() {
        text_.skip_blanks();
        if (!text_.done() && !is_newline(*text_.at))
            text_.fail("more values than the header announces");
        text_.file.release_before(text_.at);
    }

    [[nodiscard]] bool only_blanks_left() {
        text_.skip_spaces();
        return text_.done();
    }
    void remark(std::vector<io_warning>& warnings) const { text_.remark(warnings); }
    [[noreturn]] void fail(const std::string& reason) const { text_.fail(reason); }

  private:
    template <class T>
    [[nodiscard]] parsed<T> parse() const {
        if constexpr (std::is_floating_point_v<T>) {
            return parse_number<T>(text_.at, text_.end);
        } else {
            if constexpr (sizeof(T) == 8) {
                T value{};  // a double would round it
                const auto [stop, error] = std::from_chars(text_.at, text_.end, value);
                if (error == std::errc{} && (stop == text_.end || is_space(*stop)))
                    return {value, stop};
            }
            // Some files write integers with a point: 255.0.
            const parsed<double> n = parse_number(text_.at, text_.end);
            if (n.end == nullptr || !is_value_of<T>(n.value)) return {};
            return {static_cast<T>(n.value), n.end, n.hexadecimal};
        }
    }

    text text_;
};

/// Values in the byte order `order`.
template <std::endian order>
class byte_values {
  public:
    byte_values(const source& in, const char* body) : file_(in), at_(body) {}

    [[nodiscard]] std::size_t bytes_left() const {
        return static_cast<std::size_t>(file_.end() - at_);
    }
    [[nodiscard]] static bool can_hold(std::size_t bytes, std::size_t rows, const element& e) {
        std::size_t row = 0;
        for (const column& c : e.columns) row += size_of(c.list_length.value_or(c.type));
        return row == 0 || rows <= bytes / row;
    }

    void expect(const record_index&) {}
    void begin_row() {}
    [[nodiscard]] const char* at() const { return at_; }
    void go_to(const char* at) { at_ = at; }

    [[nodiscard]] std::size_t length(const column& c) {
        const char* const start = at_;
        const auto count = with_type(
            *c.list_length, [&]<class T>(T) { return static_cast<std::int64_t>(take<T>()); });
        if (count >= 0 && static_cast<std::size_t>(count) <= bytes_left() / size_of(c.type))
            return static_cast<std::size_t>(count);
        file_.fail_byte(start,
                        "a list of " + std::to_string(count) + " values, more than the file holds");
    }

    [[nodiscard]] double coordinate(const column& c) {
        return with_type(c.type, [&]<class T>(T) { return static_cast<double>(take<T>()); });
    }

    [[nodiscard]] std::int64_t index(const column& c) {
        if (c.type == scalar_type::int32) return take<std::int32_t>();
        return with_type(c.type, [&]<class T>(T) { return static_cast<std::int64_t>(take<T>()); });
    }

    void scalar(column& c) {
        with_type(c.type, [&]<class T>(T) { append(c.values, take<T>()); });
    }

    void end_row() { file_.release_before(at_); }

    /// Skips the next `bytes` bytes, which must exist, and returns their address.
    [[nodiscard]] const char* take_bytes(std::size_t bytes) {
        const char* const first = at_;
        at_ += bytes;
        return first;
    }

    [[nodiscard]] bool only_blanks_left() const { return at_ == file_.end(); }
    void remark(std::vector<io_warning>&) const {}
    [[noreturn]] void fail(const std::string& reason) const { file_.fail_byte(at_, reason); }

  private:
    template <class T>
    [[nodiscard]] T take() {
        if (bytes_left() < sizeof(T)) file_.fail_byte(at_, "the file ends within a row");
        const T value = base::load<T, order>(at_);
        at_ += sizeof(T);
        return value;
    }

    const source& file_;
    const char* at_;
};

}  // namespace treeform::detail::io
