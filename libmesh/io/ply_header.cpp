#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace treeform::detail::io {

namespace {

/// The first ones in the order of `scalar_type`: those that are written.
constexpr std::array<std::pair<std::string_view, scalar_type>, 18> type_names{{
    {"char", scalar_type::int8},
    {"uchar", scalar_type::uint8},
    {"short", scalar_type::int16},
    {"ushort", scalar_type::uint16},
    {"int", scalar_type::int32},
    {"uint", scalar_type::uint32},
    {"int64", scalar_type::int64},  // not of the format as first described
    {"uint64", scalar_type::uint64},
    {"float", scalar_type::float32},
    {"double", scalar_type::float64},
    {"int8", scalar_type::int8},
    {"uint8", scalar_type::uint8},
    {"int16", scalar_type::int16},
    {"uint16", scalar_type::uint16},
    {"int32", scalar_type::int32},
    {"uint32", scalar_type::uint32},
    {"float32", scalar_type::float32},
    {"float64", scalar_type::float64},
}};

bool is_integer(scalar_type type) { return type < scalar_type::float32; }

class ply_header_reader {
  public:
    explicit ply_header_reader(const source& in) : text_(in) {}

    ply_header read() {
        if (text_.word() != "ply") text_.fail("no 'ply' at the start");
        learn_newline();
        while (statement()) end_line();
        text_.skip_blanks();
        end_line();
        header_.body = text_.at;
        give_roles();
        return std::move(header_);
    }

  private:
    /// The first line shows how lines end. Binary data may start with any byte, also with one that
    /// ends lines, so exactly one line end is taken after the header.
    void learn_newline() {
        text_.skip_blanks();
        if (text_.done() || !is_newline(*text_.at))
            text_.fail("expected only 'ply' on the first line");
        only_returns_ = text_.starts_with("\r") && !text_.starts_with("\r\n");
        end_line();
    }

    void end_line() {
        if (text_.done()) text_.fail("the file ends within the header");
        if (!is_newline(*text_.at)) text_.fail("more words than expected");
        if (!only_returns_ && text_.starts_with("\r\n"))
            text_.at += 2;
        else if (*text_.at == '\n' || (only_returns_ && *text_.at == '\r'))
            ++text_.at;
        else
            text_.fail("a carriage return within a line");
    }

    /// False at "end_header".
    [[nodiscard]] bool statement() {
        text_.skip_blanks();
        const char* const start = text_.at;
        const std::string_view keyword = text_.word();
        if (keyword == "end_header") return false;
        if (keyword == "comment")
            comment();
        else if (keyword == "obj_info")
            header_.obj_info.push_back(remark());
        else if (keyword == "format")
            format();
        else if (keyword == "element")
            declare_element();
        else if (keyword == "property")
            declare_property();
        else if (!keyword.empty())
            fail_at(start, "unknown word in the header");
        else if (text_.done())
            text_.fail("the file ends without 'end_header'");
        text_.skip_blanks();
        return true;
    }

    [[noreturn]] void fail_at(const char* where, const std::string& reason) {
        text_.at = where;
        text_.fail(reason + ": " + quoted(where, text_.end));
    }

    /// What follows the keyword and one blank, as it stands.
    [[nodiscard]] std::string remark() {
        if (!text_.done() && is_blank(*text_.at)) ++text_.at;
        const char* const first = text_.at;
        text_.skip_line();
        return {first, text_.at};
    }

    void comment() {
        const char* const start = text_.at;
        if (next_word() == texture_file_keyword)
            if (const std::string_view name = text_.rest_of_line(); !name.empty()) {
                header_.texture_files.emplace_back(name);
                return;
            }
        text_.at = start;
        header_.comments.push_back(remark());
    }

    [[nodiscard]] std::string_view next_word() {
        text_.skip_blanks();
        return text_.word();
    }

    void format() {
        text_.skip_blanks();
        const char* const start = text_.at;
        const auto at = std::ranges::find(ply_encodings, text_.word());
        if (at == ply_encodings.end()) fail_at(start, "unknown encoding");
        header_.encoding = static_cast<ply_encoding>(at - ply_encodings.begin());
        if (next_word() != "1.0") text_.fail("not version 1.0 of the format");
        has_format_ = true;
    }

    void declare_element() {
        const std::string_view name = next_word();
        text_.skip_blanks();
        const char* const start = text_.at;
        const parsed<std::int64_t> rows = parse_integer(text_.at, text_.end);
        const bool ended = rows.end != nullptr && (rows.end == text_.end || is_space(*rows.end));
        if (name.empty() || !ended || *start == '-')
            fail_at(start, "an element needs a name and a count");
        text_.at = rows.end;
        for (const element& e : header_.elements)
            if (e.name == name) fail_at(name.data(), "element declared twice");
        header_.elements.push_back(
            {.name = std::string(name), .rows = static_cast<std::size_t>(rows.value)});
    }

    [[nodiscard]] scalar_type type() {
        text_.skip_blanks();
        const char* const start = text_.at;
        const std::string_view name = text_.word();
        for (const auto& [known, value] : type_names)
            if (known == name) return value;
        fail_at(start, "unknown type");
    }

    void declare_property() {
        if (header_.elements.empty()) text_.fail("a property before the first element");
        column c;
        text_.skip_blanks();
        const char* const start = text_.at;
        if (text_.word() == "list") {
            c.list_length = type();
            if (!is_integer(*c.list_length))
                fail_at(start, "the length of a list must be an integer");
        } else {
            text_.at = start;
        }
        c.type = type();
        c.name = next_word();
        if (c.name.empty()) text_.fail("a property without a name");
        header_.elements.back().columns.push_back(std::move(c));
    }

    void give_roles() {
        if (!has_format_) text_.file.fail("no 'format' in the header");
        for (element& e : header_.elements) {
            for (column& c : e.columns) {
                if (e.name == "vertex" && !c.list_length && c.name.size() == 1 && c.name >= "x" &&
                    c.name <= "z")
                    take_role(e, c, role_of_axis(static_cast<std::size_t>(c.name[0] - 'x')));
                if ((e.name == "face" || (e.name == "tristrips" && e.rows > 0)) && c.list_length &&
                    is_integer(c.type) && (c.name == "vertex_indices" || c.name == "vertex_index"))
                    take_role(e, c, column_role::corners);
            }
        }
    }
    /// The first column of a name has the role; a second one is data.
    static void take_role(element& e, column& c, column_role role) {
        for (const column& other : e.columns)
            if (other.role == role) return;
        c.role = role;
    }

    text text_;
    ply_header header_{};
    bool only_returns_ = false;
    bool has_format_ = false;
};

}  // namespace

std::string_view name_of(scalar_type type) {
    return type_names[static_cast<std::size_t>(type)].first;
}

ply_header read_ply_header(const source& in) { return ply_header_reader(in).read(); }

}  // namespace treeform::detail::io
