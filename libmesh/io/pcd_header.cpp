#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/lzf.hpp>
#include <libmesh/io/pcd_header.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t most_values = 65'536;  ///< in a row; a field of many is a histogram

struct declared_field {
    std::string name{};
    char kind = 'F';
    std::size_t size = 4;
    std::size_t count = 1;
};

[[nodiscard]] std::optional<scalar_type> type_of(const declared_field& f) {
    const std::string wanted = f.kind + std::to_string(f.size);
    for (int t = 0; t <= static_cast<int>(scalar_type::float64); ++t)
        if (type_and_size(static_cast<scalar_type>(t)) == wanted)
            return static_cast<scalar_type>(t);
    return std::nullopt;
}

class pcd_header_reader {
  public:
    explicit pcd_header_reader(const source& in) : text_(in) {}

    pcd_header read() {
        while (!has_data_) {
            if (text_.done()) text_.fail("the file ends without 'DATA'");
            statement();
            end_line();
        }
        header_.body = text_.at;
        place_fields();
        place_axes();
        count_points();
        return std::move(header_);
    }

  private:
    void statement() {
        text_.skip_blanks();
        if (!text_.done() && *text_.at == '#') return comment();
        start_ = text_.at;
        const std::string_view keyword = text_.word();
        if (keyword.empty()) return;
        if (keyword == "VERSION")
            (void)text_.rest_of_line();
        else if (keyword == "FIELDS" || keyword == "COLUMNS")
            names();
        else if (keyword == "SIZE")
            each([&](declared_field& f) { f.size = number(8); });
        else if (keyword == "TYPE")
            each([&](declared_field& f) { f.kind = kind(); });
        else if (keyword == "COUNT")
            each([&](declared_field& f) { f.count = number(most_values, 0); });
        else if (keyword == "WIDTH")
            width_ = number_at_word();
        else if (keyword == "HEIGHT")
            height_ = number_at_word();
        else if (keyword == "POINTS")
            points_ = number_at_word();
        else if (keyword == "VIEWPOINT")
            viewpoint_ = text_.rest_of_line();
        else if (keyword == "DATA")
            encoding();
        else
            fail("unknown word in the header: " + quoted(start_, text_.end));
    }

    [[noreturn]] void fail(const std::string& reason) {
        text_.at = start_;
        text_.fail(reason);
    }

    /// Data may start with any byte, so exactly one line end is taken.
    void end_line() {
        text_.skip_blanks();
        if (text_.starts_with("\r\n"))
            text_.at += 2;
        else if (!text_.done() && *text_.at == '\n')
            ++text_.at;
        else if (!text_.done())
            fail("more words than expected");
    }

    void comment() {
        const std::string_view line = text_.rest_of_line().substr(1);
        if (line.starts_with(" .PCD")) return;
        header_.remarks.comments.emplace_back(line.starts_with(' ') ? line.substr(1) : line);
    }

    void names() {
        if (!fields_.empty()) fail("fields declared twice");
        while (!line_ends()) fields_.push_back({.name = std::string(text_.word())});
    }

    [[nodiscard]] bool line_ends() {
        text_.skip_blanks();
        return text_.done() || is_newline(*text_.at);
    }

    template <class F>
    void each(F&& f) {
        for (declared_field& one : fields_) {
            if (line_ends()) fail("fewer words than fields");
            f(one);
        }
    }

    [[nodiscard]] std::size_t number(std::size_t most, std::int64_t least = 1) {
        const std::int64_t value = text_.integer("a number");
        if (value < least || static_cast<std::size_t>(value) > most)
            fail("expected a number from " + std::to_string(least) + " to " + std::to_string(most));
        return static_cast<std::size_t>(value);
    }

    [[nodiscard]] std::uint64_t number_at_word() {
        text_.skip_blanks();
        const std::int64_t value = text_.integer("a number");
        if (value < 0) fail("the number is negative");
        return static_cast<std::uint64_t>(value);
    }

    [[nodiscard]] char kind() {
        const std::string_view word = text_.word();
        if (word != "I" && word != "U" && word != "F") fail("expected type I, U or F");
        return word[0];
    }

    void encoding() {
        text_.skip_blanks();
        const std::string_view name = text_.word();
        if (name == "ascii")
            header_.encoding = pcd_encoding::ascii;
        else if (name == "binary")
            header_.encoding = pcd_encoding::binary;
        else if (name == "binary_compressed")
            header_.encoding = pcd_encoding::compressed;
        else
            fail("unknown encoding");
        has_data_ = true;
    }

    void place_fields() {
        std::size_t values = 0;
        for (const declared_field& f : fields_) {
            if (f.count == 0) continue;  // padding that is not needed
            const auto type = type_of(f);
            if (!type)
                text_.file.fail("field " + f.name + ": type " + f.kind + " cannot have " +
                                std::to_string(f.size) + " bytes");
            if ((values += f.count) > most_values) text_.file.fail("too many values in a row");
            if (f.name != "_" || header_.encoding == pcd_encoding::ascii) add_columns(f, *type);
            header_.row_size += f.size * f.count;
        }
    }

    void add_columns(const declared_field& f, scalar_type type) {
        for (std::size_t i = 0; i < f.count; ++i) {
            const std::string number = f.count > 1 ? '[' + std::to_string(i) + ']' : "";
            header_.vertices.columns.push_back({.name = f.name + number, .type = type});
            header_.places.push_back({.in_row = header_.row_size + i * f.size,
                                      .fields_ahead = header_.row_size,
                                      .in_field = i * f.size,
                                      .field_size = f.size * f.count});
        }
    }

    void place_axes() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string name(1, "xyz"[axis]);
            auto& columns = header_.vertices.columns;
            const auto at = std::ranges::find(columns, name, &column::name);
            if (at == columns.end()) text_.file.fail("no field " + name);
            at->role = role_of_axis(axis);
        }
    }

    void count_points() {
        if (!points_ && !width_) text_.file.fail("the header does not have the number of points");
        const std::uint64_t height = height_.value_or(1);
        // Numbers are below 2^44, so the product of two can be too large for 64 bits.
        const bool product_fits =
            height == 0 || width_.value_or(0) <= (std::uint64_t{1} << 62) / height;
        const std::uint64_t product =
            product_fits ? width_.value_or(0) * height : ~std::uint64_t{0};
        if (points_ && width_ && product != *points_)
            text_.file.fail("POINTS is " + std::to_string(*points_) +
                            ", but WIDTH times HEIGHT is " +
                            (product_fits ? std::to_string(product) : "more"));
        header_.vertices.rows = points_.value_or(product);
        auto& info = header_.remarks.obj_info;
        if (width_ && height > 1) {
            info.push_back("num_cols " + std::to_string(*width_));
            info.push_back("num_rows " + std::to_string(height));
        }
        if (!viewpoint_.empty() && viewpoint_ != "0 0 0 1 0 0 0")
            info.push_back("viewpoint " + std::string(viewpoint_));
    }

    text text_;
    pcd_header header_{};
    std::vector<declared_field> fields_{};
    const char* start_ = nullptr;  ///< of the statement
    std::optional<std::uint64_t> width_{};
    std::optional<std::uint64_t> height_{};
    std::optional<std::uint64_t> points_{};
    std::string_view viewpoint_{};
    bool has_data_ = false;
};

}  // namespace

pcd_header read_pcd_header(const source& in) { return pcd_header_reader(in).read(); }

packed_pcd find_packed_pcd(const source& in, const pcd_header& header) {
    const auto there = static_cast<std::size_t>(in.end() - header.body);
    if (there < 8) in.fail_byte(header.body, "the file ends within the lengths of the data");
    const std::size_t packed = base::load<std::uint32_t, std::endian::little>(header.body);
    const std::size_t size = base::load<std::uint32_t, std::endian::little>(header.body + 4);
    if (packed > there - 8)
        in.fail_byte(header.body, "the file ends within the data: " + std::to_string(packed) +
                                      " bytes announced");
    if (size / header.row_size != header.vertices.rows || size % header.row_size != 0)
        in.fail_byte(header.body + 4, std::to_string(size) + " bytes of data do not match " +
                                          std::to_string(header.vertices.rows) + " points");
    if (size / lzf_most_ratio > packed)
        in.fail_byte(header.body, "the data cannot be unpacked to the announced size");
    return {{header.body + 8, packed}, size, there - 8 > packed};
}

}  // namespace treeform::detail::io
