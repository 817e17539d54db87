#include <libmesh/io/readers.hpp>
#include <libmesh/io/reserve.hpp>
#include <libmesh/io/text.hpp>

#include <limits>
#include <string>

namespace treeform::detail::io {

namespace {

class stl_text_reader {
  public:
    explicit stl_text_reader(const source& in) : text_(in) {
        file_.indexed = false;
        file_.format = "stl-ascii";
        // A facet takes seven lines; files that write it on fewer make the arrays grow.
        const std::size_t lines = in.count_newlines();
        reserve_large(file_.mesh.points, lines / 7 * 3);
        reserve_large(file_.mesh.faces, lines / 7);
    }

    mesh_file read() {
        while (!next_is_end()) solid();
        if (file_.attributes.parts.size() == 1 && file_.attributes.parts[0].object.empty())
            file_.attributes.parts.clear();
        file_.stored_faces = file_.mesh.faces.size();
        file_.stored_as = fits_single(file_.mesh.points) ? precision::float32 : precision::float64;
        return std::move(file_);
    }

  private:
    [[nodiscard]] bool next_is_end() {
        text_.skip_spaces();
        return text_.done();
    }

    /// Moves behind `keyword` when it stands here as a word, in any case.
    [[nodiscard]] bool accept(std::string_view keyword) {
        text_.skip_spaces();
        if (!starts_with_word(text_.at, text_.end, keyword)) return false;
        const char* const behind = text_.at + keyword.size();
        if (behind != text_.end && !is_space(*behind)) return false;
        text_.at = behind;
        return true;
    }

    void expect(std::string_view keyword) {
        if (accept(keyword)) return;
        if (text_.done())
            text_.fail("the file ends where '" + std::string(keyword) + "' should stand: cut off?");
        text_.fail(quoted(text_.at, text_.end) + " where '" + std::string(keyword) +
                   "' should stand");
    }

    void solid() {
        expect("solid");
        file_.attributes.parts.push_back(
            {.object = std::string(text_.rest_of_line()),
             .first_face = static_cast<std::uint32_t>(file_.mesh.faces.size())});
        while (!accept("endsolid")) facet();
        text_.skip_line();
    }

    void facet() {
        text_.skip_spaces();
        if (text_.done()) text_.fail("the file ends without 'endsolid': cut off?");
        expect("facet");
        // The normal follows from the corners; files hold anything there, even -nan(ind).
        for (int word = 0; !accept("outer"); ++word) {
            if (word == 4 || text_.done()) expect("outer");
            (void)text_.word();
        }
        expect("loop");
        std::size_t corners = 0;
        for (; !accept("endloop"); ++corners) {
            if (corners == 3) text_.fail("facet with more than 3 vertices");
            vertex();
        }
        if (corners != 3) text_.fail("facet with " + std::to_string(corners) + " vertices");
        expect("endfacet");
        const std::size_t count = file_.mesh.points.size();
        if (count > std::numeric_limits<std::uint32_t>::max())
            text_.fail("more corners than 32-bit numbers can name");
        const auto first = static_cast<std::uint32_t>(count - 3);
        file_.mesh.faces.push_back({first, first + 1, first + 2});
        text_.file.release_before(text_.at);
    }

    void vertex() {
        expect("vertex");
        const double x = coordinate();
        const double y = coordinate();
        const double z = coordinate();
        file_.mesh.points.push_back({x, y, z});
    }

    [[nodiscard]] double coordinate() {
        text_.skip_spaces();
        return text_.number("a coordinate");
    }

    text text_;
    mesh_file file_{};
};

}  // namespace

mesh_file read_stl_text(const source& in) { return stl_text_reader(in).read(); }

}  // namespace treeform::detail::io
