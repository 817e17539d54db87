#include <libmesh/io/detail/face_sink.hpp>
#include <libmesh/io/detail/readers.hpp>
#include <libmesh/io/detail/reserve.hpp>
#include <libmesh/io/detail/text.hpp>

#include <cstring>
#include <limits>
#include <string>

namespace tf::detail {

namespace {

struct line_counts {
    std::size_t vertices = 0;
    std::size_t faces = 0;
};

/// Lines that start with "v " and "f ", so that arrays get their size at once. Only a hint: files
/// with carriage returns alone, or indented ones, make the arrays grow.
line_counts count_lines(const source& in) {
    line_counts counts;
    const char* at = in.begin();
    while (in.end() - at > 1) {
        if (at[1] == ' ') {
            counts.vertices += *at == 'v' ? 1U : 0U;
            counts.faces += *at == 'f' ? 1U : 0U;
        }
        const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(in.end() - at));
        if (newline == nullptr) break;
        at = static_cast<const char*>(newline) + 1;
        in.release_before(at);
    }
    in.rewind();
    return counts;
}

/// One pass over the text. Faces may name vertices that follow; what they may name at most is known
/// only at the end, so the first pass takes any number, and when one proves too large a second pass
/// with the right limit finds its line.
class obj_reader {
  public:
    obj_reader(const source& in, std::uint64_t index_limit)
        : text_(in), index_limit_(index_limit), faces_(file_) {
        file_.format = "obj";
    }

    void reserve(const line_counts& counts) {
        reserve_large(file_.mesh.points, counts.vertices);
        reserve_large(file_.mesh.faces, counts.faces);
    }

    void read() {
        while (!text_.text_done()) {
            statement();
            text_.skip_line();
            text_.file.release_before(text_.at);
        }
        if (file_.mesh.points.size() > std::numeric_limits<std::uint32_t>::max() ||
            file_.mesh.faces.size() > std::numeric_limits<std::uint32_t>::max())
            text_.file.fail("more vertices or triangles than 32-bit numbers can name");
        if (file_.mesh.points.empty() && file_.mesh.faces.empty() && has_other_lines_)
            text_.file.fail("no vertex and no face found: not an OBJ file?");
    }

    /// True when each corner is a vertex.
    [[nodiscard]] bool in_range() const {
        return file_.mesh.faces.empty() || largest_index_ < file_.mesh.points.size();
    }
    [[nodiscard]] std::size_t vertex_count() const { return file_.mesh.points.size(); }

    [[nodiscard]] mesh_file take() {
        store_colours();
        if (skipped_elements_ > 0)
            file_.warnings.push_back(
                {"skipped-elements",
                 std::to_string(skipped_elements_) + " point and line elements were not read"});
        if (has_more_indices_)
            file_.warnings.push_back({"texture-normal-indices",
                                      "texture coordinates and normals of corners were not read"});
        file_.stored_as = fits_single(file_.mesh.points) ? precision::single_ : precision::double_;
        return std::move(file_);
    }

  private:
    void statement() {
        const char first = *text_.at;
        const char second = text_.end - text_.at > 1 ? text_.at[1] : '\n';
        const bool one_letter = is_space(second);
        if (first == 'v' && one_letter) return vertex();
        if (first == 'f' && one_letter) return face_line();
        if ((first == 'l' || first == 'p') && one_letter) ++skipped_elements_;
        if ((first == 'o' || first == 'g') && one_letter) return name(first);
        if (first == 'u' && text_.starts_with("usemtl")) return name(first);
        if (first == '\0') text_.fail("a zero byte: binary data, not text");
        has_other_lines_ = true;
        // Anything else is left out. Where such a statement is continued, the next line starts with
        // a number and is left out in its turn.
    }

    /// Skips blanks and continued line ends; true at the end of the statement.
    [[nodiscard]] bool statement_done() {
        for (;;) {
            if (text_.line_done()) return true;
            if (*text_.at != '\\' || text_.end - text_.at < 2 || !is_newline(text_.at[1]))
                return false;
            const bool two_bytes =
                text_.end - text_.at > 2 && text_.at[1] == '\r' && text_.at[2] == '\n';
            text_.at += two_bytes ? 3 : 2;
        }
    }

    void vertex() {
        ++text_.at;
        const double x = coordinate();
        const double y = coordinate();
        const double z = coordinate();
        if (!statement_done()) rest_of_vertex();
        file_.mesh.points.push_back({x, y, z});
    }
    [[nodiscard]] double coordinate() {
        (void)statement_done();
        return text_.number("a coordinate");
    }

    /// One more number is the weight of a rational curve's point, which is no coordinate; three or
    /// more are a colour.
    void rest_of_vertex() {
        double more[3] = {};
        std::size_t count = 0;
        for (; !statement_done(); ++count) {
            const double value = text_.number("a number");
            if (count < 3) more[count] = value;
        }
        if (count < 3) return;
        has_colours_ = true;
        if (colours_.size() == 3 * file_.mesh.points.size())
            colours_.insert(colours_.end(), more, more + 3);
    }

    void face_line() {
        ++text_.at;
        faces_.begin();
        while (!statement_done()) faces_.add(corner());
        const std::size_t corners = faces_.finish();
        if (corners < 3) text_.fail("face with " + std::to_string(corners) + " corners");
        if (new_part_) start_part();
    }

    /// v, v/vt, v//vn or v/vt/vn; what follows the vertex number is only looked over.
    [[nodiscard]] std::uint32_t corner() {
        const parsed<std::int64_t> index = parse_integer(text_.at, text_.end);
        if (index.end == nullptr)
            text_.fail(quoted(text_.at, text_.end) + " where a vertex index should stand");
        const auto count = static_cast<std::int64_t>(file_.mesh.points.size());
        const std::int64_t vertex = index.value > 0 ? index.value - 1 : count + index.value;
        if (index.value == 0) text_.fail("vertex index 0 (OBJ counts from 1)");
        if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= index_limit_)
            text_.fail("vertex index " + quoted(text_.at, index.end) + " is out of range");
        largest_index_ = std::max(largest_index_, static_cast<std::uint64_t>(vertex));
        const char* p = index.end;
        has_more_indices_ = has_more_indices_ || (p < text_.end && *p == '/');
        while (p < text_.end && (is_digit(*p) || *p == '/' || *p == '-')) ++p;
        if ((p != index.end && *index.end != '/') ||
            (p < text_.end && !is_space(*p) && *p != '#' && *p != '\\'))
            text_.fail(quoted(text_.at, text_.end) + " where a corner should stand");
        text_.at = p;
        return static_cast<std::uint32_t>(vertex);
    }

    void name(char kind) {
        (void)text_.word();
        const std::string_view name = text_.rest_of_line();
        (kind == 'o' ? part_.object : kind == 'g' ? part_.group : part_.material) = name;
        if (kind == 'o') part_.group.clear();
        new_part_ = true;
    }
    void start_part() {
        part_.first_face = static_cast<std::uint32_t>(file_.stored_faces - 1);
        file_.attributes.parts.push_back(part_);
        new_part_ = false;
    }

    void store_colours() {
        if (!has_colours_) return;
        const std::size_t count = file_.mesh.points.size();
        if (colours_.size() != 3 * count) {
            file_.warnings.push_back(
                {"vertex-colours", "only some vertices have a colour; none was kept"});
            return;
        }
        element& vertices = obtain_element(file_.attributes, "vertex", count);
        std::vector<double> channel(count);
        const char* const names[] = {"red", "green", "blue"};
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t v = 0; v < count; ++v) channel[v] = colours_[3 * v + c];
            vertices.columns.push_back(make_column<double>(names[c], channel));
        }
    }

    text text_;
    std::uint64_t index_limit_;
    mesh_file file_{};
    face_sink faces_;
    part part_{};
    bool new_part_ = false;
    std::uint64_t largest_index_ = 0;
    std::size_t skipped_elements_ = 0;
    bool has_more_indices_ = false;
    bool has_other_lines_ = false;  ///< than comments, vertices, faces, elements and names
    bool has_colours_ = false;
    std::vector<double> colours_{};  ///< [3 * vertices] as long as every vertex has one
};

}  // namespace

mesh_file read_obj(const source& in) {
    obj_reader reader(in, std::numeric_limits<std::uint32_t>::max());
    reader.reserve(count_lines(in));
    reader.read();
    if (!reader.in_range()) obj_reader(in, reader.vertex_count()).read();
    return reader.take();
}

}  // namespace tf::detail
