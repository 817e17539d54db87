#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/text_columns.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace treeform::detail::io {

namespace {

/// A point a line: x y z and any further columns, separated by blanks, commas or semicolons; in
/// another order where a heading names the columns.
class xyz_reader {
  public:
    xyz_reader(const source& in, std::string_view format,
               std::span<const std::pair<std::string, std::string>> chosen)
        : text_(in), pts_(format == "pts"), chosen_(chosen) {
        skip_heading();
        if (done()) text_.file.fail("no points found");
        learn_columns();
        facts_.clear();
    }

    /// The element "vertex" without rows; none when there is nothing to say about it.
    [[nodiscard]] std::vector<element> elements() const {
        if (declared_.columns.empty()) return {};
        return {declared_};
    }
    /// Of what was read so far.
    [[nodiscard]] std::vector<io_warning> warnings() const {
        std::vector<io_warning> all = warnings_;
        if (keep_more_) remark_on_cells(declared_, facts_, all);
        text_.remark(all);
        return all;
    }
    /// Types for the columns, by all that was read; what is not to be a double.
    [[nodiscard]] const std::vector<text_column>& facts() const { return facts_; }
    void learn_types(const std::vector<text_column>& facts) {
        facts_ = facts;
        choose_types(declared_, facts_);
    }
    [[nodiscard]] bool has_large_numbers() const {
        return std::ranges::any_of(declared_.columns, [](const column& c) {
            return c.type == scalar_type::int64 || c.type == scalar_type::uint64;
        });
    }
    /// False when the further columns differ between the lines read so far.
    [[nodiscard]] bool even() const { return keep_more_; }

    /// Goes through the lines that begin in a part.
    [[nodiscard]] record_index scan(const file_part& part, std::size_t most_marks, bool even) {
        keep_more_ = keep_more_ && even;
        text_scan lines(text_, part, most_marks);
        for (point3 p; !done() && lines.is_in_part();) {
            lines.add();
            line(p);
            more_.clear();
            text_.file.release_before(text_.at);
        }
        record_index found = std::move(lines).found();
        found.even = keep_more_;
        found.hexadecimal = text_.hexadecimal;
        found.columns = facts_;
        return found;
    }

    /// What was found in all lines. The next one is that of the mark.
    void start(const record_index& all, const record_index::mark& at) {
        text_.at = text_.end;
        check_count(all.records);
        text_.hexadecimal = all.hexadecimal;
        learn_types(all.columns);
        if (!all.even) drop_columns();
        text_.file.rewind();
        text_.at = text_.file.begin() + std::min<std::uint64_t>(at.byte, text_.file.size());
    }

    /// \pre all lines were read, `count` of them
    void check_count(std::uint64_t count) {
        if (!promised_ || count == *promised_) return;
        const std::string both =
            std::to_string(*promised_) + " points announced, " + std::to_string(count) + " found";
        if (count < *promised_) text_.fail("the file ends within the points: " + both);
        warnings_.push_back({"count", both});
    }

    /// As `point_rows::append`. The columns are of no use once lines are not `even`.
    std::size_t append(std::vector<point3>& points, element& vertices, std::size_t most) {
        constexpr std::size_t at_once = 512;
        std::size_t rows = 0;
        for (; rows < most && !done(); ++rows) {
            if (rows % at_once == 0) store_columns(vertices);
            point3 p;
            line(p);
            points.push_back(p);
            text_.file.release_before(text_.at);
        }
        store_columns(vertices);
        return rows;
    }

    static constexpr const char* uneven =
        "lines have different numbers of columns; only x y z were kept";

  private:
    static constexpr std::size_t no_axis = 3;

    /// Skips blank lines and comments, which start with # or //; the last one may be a heading.
    [[nodiscard]] bool done() {
        for (;;) {
            text_.skip_spaces();
            if (text_.done()) return true;
            if (*text_.at != '#' && !text_.starts_with("//")) return false;
            comment_ = text_.rest_of_line();
        }
    }

    /// The last comment where it names the coordinates, as in "//X Y Z R G B".
    [[nodiscard]] std::string_view named_comment() const {
        const std::size_t start = std::min(comment_.find_first_not_of("#/"), comment_.size());
        const std::string_view names = comment_.substr(start);
        return find_axes(split_heading(names)) ? names : std::string_view();
    }

    /// One line of names, or one line with the number of points, may come first.
    void skip_heading() {
        if (done()) return;
        if (text_.starts_with("sep=")) (void)text_.rest_of_line();  // for spreadsheets
        if (done()) return;
        const char* start = text_.at;
        const bool starts_with_number = parse_number(text_.at, text_.end).end != nullptr;
        std::string_view first = text_.rest_of_line();
        const bool one_word = std::none_of(first.begin(), first.end(), is_blank) &&
                              first.find_first_of(",;") == std::string_view::npos;
        heading_ = starts_with_number ? named_comment() : first;
        if (!starts_with_number || one_word) {
            if (pts_ && starts_with_number) promised_ = whole_number(first);
            if (!promised_ && (starts_with_number || !find_axes(split_heading(heading_))))
                warnings_.push_back({"heading", "the first line is not a point and was skipped"});
            if (done()) return;
            start = text_.at;
            first = text_.rest_of_line();
        }
        text_.at = start;
        learn_separator(first);
    }

    [[nodiscard]] static std::optional<std::uint64_t> whole_number(std::string_view word) {
        std::uint64_t value = 0;
        const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool whole = end.ec == std::errc() && end.ptr == word.data() + word.size();
        return whole ? std::optional(value) : std::nullopt;
    }

    /// A comma separates columns only where no blank does the same without one: in "1,5 2,5 3,5" it
    /// is a decimal mark.
    void learn_separator(std::string_view first) {
        if (first.find(';') != std::string_view::npos) {
            separator_ = ';';
            return;
        }
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
            if (is_blank(first[i]) && !is_blank(first[i + 1]) &&
                first.find_last_not_of(" \t", i) != std::string_view::npos &&
                first[first.find_last_not_of(" \t", i)] != ',' && first[i + 1] != ',')
                return;
        if (first.find(',') != std::string_view::npos) separator_ = ',';
    }

    /// From the heading, from what was chosen, and from the number of values in the first line.
    void learn_columns() {
        std::vector<std::string> names = split_heading(heading_);
        if (heading_.empty()) names.clear();
        while (!names.empty() && names.back().empty()) names.pop_back();
        const char* const start = text_.at;
        if (names.empty() && !chosen_.empty()) {
            const std::size_t count = split_heading(text_.rest_of_line()).size();
            for (std::size_t i = 1; i <= count; ++i) names.push_back("column_" + std::to_string(i));
            text_.at = start;
        }
        auto axes = choose_columns(text_.file, chosen_, names);
        const bool is_chosen = axes.has_value();
        if (!axes) axes = find_axes(names);
        if (!axes && has_angles(names))
            text_.file.fail_line(
                heading_.data(),
                "latitude and longitude are angles, not coordinates: first project them to "
                "meters, for instance with cs2cs or pdal");
        if (axes) {
            if (!is_chosen) tell_axes(names, *axes);
            axis_of_.assign(1 + *std::max_element(axes->begin(), axes->end()), no_axis);
            for (std::size_t axis = 0; axis < 3; ++axis) axis_of_[(*axes)[axis]] = axis;
        }
        expected_ = names.size() > 3 && axes ? names.size() - 3 : 0;
        point3 p;
        line(p);
        text_.at = start;
        width_ = more_.size();
        more_.clear();
        declare_columns(promised_ && !axes ? names_in_pts(*width_ + 3) : names);
    }

    /// Says what is taken for x, y and z where it is called otherwise.
    void tell_axes(const std::vector<std::string>& names, const std::array<std::size_t, 3>& axes) {
        const std::string &x = names[axes[0]], &y = names[axes[1]], &z = names[axes[2]];
        if (x.size() + y.size() + z.size() == 3 && to_lower(x[0]) == 'x' && to_lower(y[0]) == 'y')
            return;
        warnings_.push_back(
            {"columns", "x, y and z are the columns '" + x + "', '" + y + "' and '" + z + "'"});
    }

    /// Of so many columns in a PTS file; empty where these have no usual meaning.
    [[nodiscard]] static std::vector<std::string> names_in_pts(std::size_t count) {
        if (count == 4) return {"x", "y", "z", "intensity"};
        if (count == 6) return {"x", "y", "z", "red", "green", "blue"};
        if (count == 7) return {"x", "y", "z", "intensity", "red", "green", "blue"};
        return {};
    }

    void declare_columns(const std::vector<std::string>& names) {
        const std::size_t count = *width_ + 3;
        const bool in_order = axis_of_ == axes_in_order;
        if (!keep_more_ || (in_order && width_ == 0)) return;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t axis = i < axis_of_.size() ? axis_of_[i] : no_axis;
            if (axis < 3 && in_order) continue;  // the order in which they are taken anyway
            const bool named = names.size() == count && !names[i].empty();
            column c{.name = named ? names[i] : "column_" + std::to_string(i + 1)};
            if (axis < 3) {
                c.name = "xyz"[axis];
                c.role = role_of_axis(axis);
            }
            declared_.columns.push_back(std::move(c));
        }
    }

    void drop_columns() {
        keep_more_ = false;
        warnings_.push_back({"columns", uneven});
        declared_.columns.clear();
    }

    /// Whether there was one, other than a blank.
    bool skip_separator() {
        text_.skip_blanks();
        if (separator_ == ' ' || text_.done() || *text_.at != separator_) return false;
        ++text_.at;
        text_.skip_blanks();
        return true;
    }

    [[nodiscard]] double number(std::string_view what) {
        const bool quoted = text_.at < text_.end && *text_.at == '"';
        const parsed<double> n = parse_number(text_.at + (quoted ? 1 : 0), text_.end);
        if (!ends_cell(n, quoted)) return text_.number(what);
        const double value = text_.take(n);
        if (quoted) ++text_.at;
        return value;
    }

    /// Whether a cell ends behind the number, or behind a quote there.
    [[nodiscard]] bool ends_cell(const parsed<double>& n, bool quoted) const {
        if (n.end == nullptr || (quoted && (n.end == text_.end || *n.end != '"'))) return false;
        const char* const at = n.end + (quoted ? 1 : 0);
        return at == text_.end || is_space(*at) || *at == separator_;
    }

    /// What is no number is NaN. `place` is among the values behind the coordinates.
    void take_cell(std::size_t place) {
        if (facts_.size() <= place) facts_.resize(place + 1);
        const bool quoted = text_.at < text_.end && *text_.at == '"';
        const char* const start = text_.at + (quoted ? 1 : 0);
        const parsed<double> n = parse_number(start, text_.end);
        if (!ends_cell(n, quoted)) {
            const bool decimal_comma = !quoted && n.end != nullptr && *n.end == ',' &&
                                       n.end + 1 < text_.end && is_digit(n.end[1]);
            if (decimal_comma) static_cast<void>(text_.number("a number"));  // says what is wrong
            pass_word();
            return add_gap(place);
        }
        text_cell c{.value = text_.take(n)};
        if (quoted) ++text_.at;
        text_column& fact = facts_[place];
        fact.min = std::min(fact.min, c.value);
        fact.max = std::max(fact.max, c.value);
        fact.whole = fact.whole && take_whole(start, n.end, c, fact);
        more_.push_back(c);
    }

    void pass_word() {
        if (!text_.done() && *text_.at == '"') {
            const char* at = text_.at + 1;
            while (at < text_.end && *at != '"' && !is_newline(*at)) ++at;
            if (at < text_.end && *at == '"') text_.at = at + 1;
        }
        while (!text_.done() && !is_newline(*text_.at) && *text_.at != separator_ &&
               (separator_ != ' ' || !is_blank(*text_.at)))
            ++text_.at;
    }

    void add_gap(std::size_t place) {
        if (facts_.size() <= place) facts_.resize(place + 1);
        ++facts_[place].gaps;
        more_.push_back({std::numeric_limits<double>::quiet_NaN()});
    }

    void line(point3& p) {
        const std::size_t before = more_.size();
        for (std::size_t i = 0; i < axis_of_.size(); ++i) {
            if (i > 0) skip_separator();
            const std::size_t axis = axis_of_[i];
            if (axis < no_axis)
                p[axis] = number("a coordinate");
            else
                take_cell(more_.size() - before);
        }
        while (keep_more_) {
            const bool separated = skip_separator();
            const std::size_t place = more_.size() - before;
            if (text_.line_done()) {
                if (separated && place < width_.value_or(expected_)) add_gap(place);
                break;
            }
            take_cell(place);
        }
        keep_more_ = keep_more_ && (!width_ || more_.size() - before == *width_);
        text_.skip_line();
    }

    /// Moves the values of the last lines to their columns.
    void store_columns(element& vertices) {
        const std::size_t width = width_.value_or(0);
        if (keep_more_ && width > 0) {
            const std::size_t rows = more_.size() / width;
            std::size_t place = 0;
            for (column& c : vertices.columns)
                if (c.role == column_role::data)
                    append_cells(c, more_, {.first = place++, .width = width, .rows = rows});
        }
        more_.clear();
    }
    static inline const std::vector<std::size_t> axes_in_order{0, 1, 2};

    text text_;
    bool pts_;
    std::span<const std::pair<std::string, std::string>> chosen_;
    std::optional<std::uint64_t> promised_{};  ///< number of points that the first line says
    std::string_view comment_{};
    std::string_view heading_{};
    char separator_ = ' ';
    std::vector<std::size_t> axis_of_ = axes_in_order;  ///< of the values that each line must have
    bool keep_more_ = true;  ///< so far every line has the same number of further values
    std::optional<std::size_t> width_{};  ///< how many that is; none ahead of the first line
    std::size_t expected_ = 0;            ///< by the heading
    std::vector<text_cell> more_{};
    std::vector<text_column> facts_{};  ///< of the columns behind the coordinates
    element declared_{.name = "vertex"};
    std::vector<io_warning> warnings_{};
};

}  // namespace

mesh_file read_xyz(const source& in, std::string_view format,
                   std::span<const std::pair<std::string, std::string>> columns) {
    xyz_reader reader(in, format, columns);
    mesh_file file;
    file.format = format == "pts" ? "xyz" : format;
    file.attributes.elements = reader.elements();
    element none{.name = "vertex"};
    element& vertices = file.attributes.elements.empty() ? none : file.attributes.elements[0];
    reader.append(file.mesh.points, vertices, std::numeric_limits<std::size_t>::max());
    vertices.rows = file.mesh.points.size();
    if (vertices.rows > std::numeric_limits<std::uint32_t>::max())
        in.fail("more points than 32-bit numbers can name");
    reader.check_count(vertices.rows);
    if (reader.even()) {
        reader.learn_types(reader.facts());
        if (reader.has_large_numbers()) {  // once more, as numbers that doubles do not hold
            xyz_reader again(in, format, columns);
            again.learn_types(reader.facts());
            const std::size_t rows = vertices.rows;
            vertices = again.elements()[0];
            std::vector<point3> points;
            again.append(points, vertices, std::numeric_limits<std::size_t>::max());
            vertices.rows = rows;
        }
        const std::vector<element> typed = reader.elements();
        for (std::size_t i = 0; !typed.empty() && i < typed[0].columns.size(); ++i)
            if (typed[0].columns[i].role == column_role::data)
                retype(vertices.columns[i], typed[0].columns[i].type);
    }
    file.warnings = reader.warnings();
    if (!reader.even()) {
        file.warnings.push_back({"columns", xyz_reader::uneven});
        file.attributes.elements.clear();
    }
    file.stored_as = fits_float32(file.mesh.points) ? precision::float32 : precision::float64;
    return file;
}

record_index scan_xyz(const source& in, std::string_view format, const file_part& part,
                      std::size_t most, bool even,
                      std::span<const std::pair<std::string, std::string>> columns) {
    return xyz_reader(in, format, columns).scan(part, most, even);
}

point_rows open_xyz_points(const source& in, std::string_view format, std::uint64_t first,
                           const record_index* known,
                           std::span<const std::pair<std::string, std::string>> columns) {
    auto reader = std::make_shared<xyz_reader>(in, format, columns);
    const record_index found =
        known == nullptr ? reader->scan({}, most_marks, true) : record_index();
    const record_index& all = known == nullptr ? found : *known;
    point_rows rows;
    const record_index::mark at = all.before(first);
    reader->start(all, at);
    rows.count = all.records;
    rows.left_out = at.record;
    rows.head.format = format == "pts" ? "xyz" : format;
    rows.head.warnings = reader->warnings();
    rows.head.attributes.elements = reader->elements();
    rows.append = [reader](std::vector<point3>& points, element& vertices, std::size_t most,
                           std::vector<io_warning>&) {
        return reader->append(points, vertices, most);
    };
    return rows;
}

}  // namespace treeform::detail::io
