#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/text.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace treeform::detail::io {

namespace {

/// What the first word, [ST][C][N][4][n]OFF, says about a vertex.
struct off_kind {
    bool texture = false;
    bool color = false;
    bool normal = false;
    bool weight = false;     ///< a fourth, homogeneous coordinate
    bool dimension = false;  ///< the dimension stands in the file
};

[[nodiscard]] bool take(std::string_view& word, std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
}

/// Numbers after the ones that a row must have, as many in each row.
struct extra_numbers {
    std::size_t width = 0;
    std::size_t widest = 0;
    std::size_t rows = 0;
    bool even = true;  ///< every row so far has `width` of them
    /// By place in a row: whether no row has a number with a point or an exponent there. Shorter
    /// where that is not known.
    std::vector<bool> whole{};
    std::vector<double> values{};
    std::vector<std::uint64_t> begin{};  ///< [rows + 1] once there are values

    void end_row() {
        const std::uint64_t size = values.size();
        // Most files have none of them, and then need no table of where they begin.
        if (size > 0) begin.resize(rows + 1, 0);
        const std::size_t count = size > 0 ? size - begin.back() : 0;
        if (rows == 0) width = count;
        widest = std::max(widest, count);
        even = even && count == width;
        if (size > 0) begin.push_back(size);
        ++rows;
    }
};

class off_reader {
  public:
    explicit off_reader(const source& in) : text_(in), faces_(file_) { file_.format = "off"; }

    mesh_file read() {
        read_kind();
        read_counts();
        for (std::size_t v = 0; v < vertices_; ++v) read_vertex();
        for (std::size_t f = 0; f < face_count_; ++f) read_face();
        store_vertex_extras();
        if (faces_extra_.even)
            store_columns("face", faces_extra_, color_names(faces_extra_.width));
        else
            store_list();
        if (!text_.text_done())
            file_.warnings.push_back({"trailing-bytes", "data after the last face were not read"});
        faces_.remark(file_.warnings);
        text_.remark(file_.warnings);
        if (file_.mesh.faces.size() > std::numeric_limits<std::uint32_t>::max())
            text_.file.fail("more triangles than 32-bit numbers can name");
        file_.stored_as = fits_float32(file_.mesh.points) ? precision::float32 : precision::float64;
        return std::move(file_);
    }

  private:
    void read_kind() {
        if (text_.text_done()) text_.fail("no counts: truncated?");
        const char* const start = text_.at;
        std::string_view word = text_.word();
        if (!word.ends_with("OFF") && (is_digit(*start) || *start == '-')) {
            text_.at = start;  // the first word may be left out
            return;
        }
        kind_.texture = take(word, "ST");
        kind_.color = take(word, "C");
        kind_.normal = take(word, "N");
        kind_.weight = take(word, "4");
        kind_.dimension = take(word, "n");
        if (word.size() > 3 && word.starts_with("OFF") && is_digit(word[3])) {
            text_.at = word.data() + 3;  // no blank ahead of the counts
            return;
        }
        if (word != "OFF") text_.fail("expected 'OFF', found " + quoted(start, text_.end));
        if (text_.text_done()) text_.fail("no counts: truncated?");
        if (text_.starts_with("BINARY")) text_.fail("binary OFF is not read");
        if (kind_.dimension && text_.integer("the dimension") != 3)
            text_.fail("only points of three dimensions are read");
    }

    [[nodiscard]] std::size_t read_count(std::string_view what) {
        if (text_.text_done()) text_.fail("the file ends within the counts");
        const std::int64_t count = text_.integer(what);
        if (count < 0) text_.fail("negative count");
        return static_cast<std::size_t>(count);
    }

    /// The counts must be such as the bytes behind them can hold: a digit and a separator for each
    /// number; one number for the smallest face, of no corners.
    void read_counts() {
        vertices_ = read_count("the number of vertices");
        face_count_ = read_count("the number of faces");
        if (!text_.line_done()) (void)text_.integer("the number of edges");
        const auto left = static_cast<std::size_t>(text_.end - text_.at);
        const std::size_t numbers = 3U + (kind_.weight ? 1U : 0U) + (kind_.normal ? 3U : 0U);
        if (vertices_ > (left + 1) / (2 * numbers) || face_count_ > (left + 1) / 2)
            text_.fail("counts larger than the file can hold");
        if (vertices_ > std::numeric_limits<std::uint32_t>::max())
            text_.fail("more vertices than 32-bit numbers can name");
        reserve_large(file_.mesh.points, vertices_);
        reserve_large(file_.mesh.faces, face_count_);
    }

    [[nodiscard]] double next_number(std::string_view what) {
        if (text_.text_done()) text_.fail("the file ends within the vertices");
        return text_.number(what);
    }

    void read_vertex() {
        point3 p;
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = next_number("a coordinate");
        if (kind_.weight && next_number("a weight") != 1.0)
            text_.fail("a weight other than 1 is not supported, since points would be rounded");
        if (kind_.normal)
            for (int i = 0; i < 3; ++i) normals_.values.push_back(next_number("a normal"));
        if (kind_.normal) normals_.end_row();
        read_extras(vertices_extra_);
        const std::size_t least = (kind_.color ? 3U : 0U) + (kind_.texture ? 2U : 0U);
        if (vertices_extra_.width < least || (least == 0 && vertices_extra_.width > 0) ||
            !vertices_extra_.even)
            text_.fail("the numbers of this vertex do not match the first word of the file");
        file_.mesh.points.push_back(p);
        text_.file.release_before(text_.at);
    }

    void read_extras(extra_numbers& extras) {
        while (!text_.line_done()) {
            const char* const start = text_.at;
            const std::size_t place =
                extras.values.size() - (extras.begin.empty() ? 0 : extras.begin.back());
            extras.values.push_back(text_.number("a number"));
            if (place >= extras.whole.size()) extras.whole.resize(place + 1, true);
            for (const char* c = start; c < text_.at; ++c)
                extras.whole[place] =
                    extras.whole[place] && (is_digit(*c) || *c == '-' || *c == '+');
        }
        extras.end_row();
    }

    void read_face() {
        if (text_.text_done()) text_.fail("the file ends within the faces");
        const std::int64_t corners = text_.integer("the number of corners");
        if (corners < 0) text_.fail("face with " + std::to_string(corners) + " corners");
        faces_.begin();
        for (std::int64_t i = 0; i < corners; ++i) {
            if (text_.text_done()) text_.fail("the file ends within a face");
            const std::int64_t vertex = text_.integer("a vertex index");
            if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices_)
                text_.fail("vertex index " + std::to_string(vertex) + " is out of range");
            faces_.add(static_cast<std::uint32_t>(vertex));
        }
        if (faces_.finish())
            read_extras(faces_extra_);
        else
            text_.skip_line();
        text_.file.release_before(text_.at);
    }

    [[nodiscard]] static std::vector<std::string> color_names(std::size_t width) {
        if (width == 1) return {"color_index"};
        std::vector<std::string> names{"red", "green", "blue", "alpha"};
        for (std::size_t i = names.size(); i < width; ++i)
            names.push_back("number_" + std::to_string(i + 1));
        names.resize(width);
        return names;
    }

    void store_vertex_extras() {
        if (kind_.normal) store_columns("vertex", normals_, {"nx", "ny", "nz"});
        const std::size_t texture = kind_.texture ? 2 : 0;
        if (vertices_extra_.width < texture) return;  // a file without vertices
        std::vector<std::string> names = color_names(vertices_extra_.width - texture);
        if (kind_.texture) names.insert(names.end(), {"s", "t"});
        store_columns("vertex", vertices_extra_, names);
    }

    /// One column for each number of a row; what is ahead of texture coordinates as bytes where all
    /// of it are small whole numbers, as colors are.
    void store_columns(std::string_view name, const extra_numbers& extras,
                       const std::vector<std::string>& names) {
        if (extras.rows == 0 || names.empty()) return;
        const std::size_t width = names.size();
        const auto colors = static_cast<std::size_t>(std::ranges::find(names, "s") - names.begin());
        bool bytes = width > 1 && colors <= extras.whole.size();
        for (std::size_t i = 0; bytes && i < extras.values.size(); ++i)
            bytes = i % width >= colors ||
                    (extras.whole[i % width] && extras.values[i] >= 0 && extras.values[i] <= 255);
        element& e = file_.attributes.find_or_add(name, extras.rows);
        std::vector<double> values(extras.rows);
        for (std::size_t c = 0; c < width; ++c) {
            for (std::size_t row = 0; row < extras.rows; ++row)
                values[row] = extras.values[row * width + c];
            if (bytes && c < colors) {
                const std::vector<std::uint8_t> small(values.begin(), values.end());
                e.columns.push_back(column::of<std::uint8_t>(names[c], small));
            } else {
                e.columns.push_back(column::of<double>(names[c], values));
            }
        }
    }

    void store_list() {
        column c = column::of<double>("off_color", faces_extra_.values);
        c.list_length = faces_extra_.widest < 256 ? scalar_type::uint8 : scalar_type::uint32;
        c.list_begin = std::move(faces_extra_.begin);
        file_.attributes.find_or_add("face", faces_extra_.rows).columns.push_back(std::move(c));
    }

    text text_;
    off_kind kind_{};
    mesh_file file_{};
    face_sink faces_;
    std::size_t vertices_ = 0;
    std::size_t face_count_ = 0;
    extra_numbers normals_{};
    extra_numbers vertices_extra_{};
    extra_numbers faces_extra_{};
};

}  // namespace

mesh_file read_off(const source& in) { return off_reader(in).read(); }

}  // namespace treeform::detail::io
