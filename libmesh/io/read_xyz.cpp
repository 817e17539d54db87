#include <libmesh/io/detail/readers.hpp>
#include <libmesh/io/detail/text.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace tf::detail {

namespace {

/// A point a line: x y z and any further columns, separated by blanks, commas or semicolons.
class xyz_reader {
  public:
    explicit xyz_reader(const source& in) : text_(in) { file_.format = "xyz"; }

    mesh_file read() {
        skip_heading();
        while (!done()) {
            line();
            text_.file.release_before(text_.at);
        }
        if (file_.mesh.points.empty()) text_.file.fail("no point found");
        if (file_.mesh.points.size() > std::numeric_limits<std::uint32_t>::max())
            text_.file.fail("more points than 32-bit numbers can name");
        store_columns();
        file_.stored_as = fits_single(file_.mesh.points) ? precision::single_ : precision::double_;
        return std::move(file_);
    }

  private:
    /// Comments start with # or //.
    [[nodiscard]] bool done() {
        while (!text_.text_done() && text_.starts_with("//")) text_.skip_line();
        return text_.done();
    }

    /// One line of names, or one line with the number of points, may come first.
    void skip_heading() {
        if (done()) return;
        const char* start = text_.at;
        const bool starts_with_number = parse_number(text_.at, text_.end).end != nullptr;
        std::string_view first = text_.rest_of_line();
        const bool one_word = std::none_of(first.begin(), first.end(), is_blank) &&
                              first.find_first_of(",;") == std::string_view::npos;
        if (!starts_with_number || one_word) {
            file_.warnings.push_back({"heading", "the first line is no point and was left out"});
            if (done()) return;
            start = text_.at;
            first = text_.rest_of_line();
        }
        text_.at = start;
        learn_separator(first);
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

    void skip_separator() {
        text_.skip_blanks();
        if (separator_ == ' ' || text_.done() || *text_.at != separator_) return;
        ++text_.at;
        text_.skip_blanks();
    }

    [[nodiscard]] double number(std::string_view what) {
        const parsed<double> n = parse_number(text_.at, text_.end);
        if (n.end != nullptr && n.end != text_.end && *n.end == separator_) {
            text_.at = n.end;
            return n.value;
        }
        return text_.number(what);
    }

    void line() {
        point3 p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (axis > 0) skip_separator();
            p[axis] = number("a coordinate");
        }
        const std::size_t before = more_.size();
        for (skip_separator(); !text_.line_done() && keep_more_; skip_separator()) {
            const parsed<double> n = parse_number(text_.at, text_.end);
            if (n.end == nullptr)
                keep_more_ = false;
            else
                more_.push_back(number("a number"));
        }
        const std::size_t width = more_.size() - before;
        if (file_.mesh.points.empty()) width_ = width;
        keep_more_ = keep_more_ && width == width_;
        text_.skip_line();
        file_.mesh.points.push_back(p);
    }

    void store_columns() {
        if (!keep_more_) {
            file_.warnings.push_back(
                {"columns", "the columns after x y z differ between lines; none was kept"});
            return;
        }
        const std::size_t count = file_.mesh.points.size();
        std::vector<double> values(count);
        for (std::size_t c = 0; c < width_; ++c) {
            for (std::size_t i = 0; i < count; ++i) values[i] = more_[i * width_ + c];
            obtain_element(file_.attributes, "vertex", count)
                .columns.push_back(make_column<double>("column_" + std::to_string(c + 4), values));
        }
    }

    text text_;
    mesh_file file_{};
    char separator_ = ' ';
    bool keep_more_ = true;  ///< so far every line has the same number of further columns
    std::size_t width_ = 0;
    std::vector<double> more_{};
};

}  // namespace

mesh_file read_xyz(const source& in) { return xyz_reader(in).read(); }

}  // namespace tf::detail
