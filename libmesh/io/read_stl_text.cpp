#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/text.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 18;
constexpr std::size_t pieces_at_once = 32;

/// The first line behind `at` that starts with "facet", where a piece can be cut; else `end`.
[[nodiscard]] const char* next_facet(const char* at, const char* end) {
    while (at < end) {
        at = std::find(at, end, '\n');
        while (at < end && is_space(*at)) ++at;
        if (starts_with_word(at, end, "facet")) return at;
    }
    return end;
}

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

    /// Reads the points of facets alone, for another reader, from `begin` to `end` at most.
    /// Memory that has been in use is taken over: new pages cost as much as parsing.
    stl_text_reader(const source& in, const char* begin, const char* end,
                    std::vector<point3>&& memory)
        : text_(in), is_piece_(true) {
        text_.at = begin;
        text_.end = end;
        file_.mesh.points = std::move(memory);
        file_.mesh.points.clear();
    }

    mesh_file read() {
        while (!next_is_end()) solid();
        if (file_.attributes.parts.size() == 1 && file_.attributes.parts[0].object.empty())
            file_.attributes.parts.clear();
        file_.stored_faces = file_.mesh.faces.size();
        remark();
        file_.stored_as = fits_float32(file_.mesh.points) ? precision::float32 : precision::float64;
        return std::move(file_);
    }

  private:
    /// Between words, zero bytes are blanks: some programs write those behind their strings. Within
    /// a line of coordinates they may be digits that were lost, and are refused.
    [[nodiscard]] static bool separates(char c) { return is_space(c) || c == '\0'; }
    void skip_to_word() {
        for (text_.skip_spaces(); !text_.done() && *text_.at == '\0'; text_.skip_spaces()) {
            ++zero_bytes_;
            ++text_.at;
        }
    }

    [[nodiscard]] bool next_is_end() {
        skip_to_word();
        return text_.done();
    }

    /// Whether `keyword` stands here as a word, in any case.
    [[nodiscard]] bool at_word(std::string_view keyword) const {
        if (!starts_with_word(text_.at, text_.end, keyword)) return false;
        const char* const behind = text_.at + keyword.size();
        return behind == text_.end || separates(*behind);
    }

    /// Moves behind `keyword` when it is the next word.
    [[nodiscard]] bool accept(std::string_view keyword) {
        skip_to_word();
        if (!at_word(keyword)) return false;
        text_.at += keyword.size();
        return true;
    }

    /// Leaves out the words that follow in this line, up to one of `expected`.
    void leave_out_up_to(std::initializer_list<std::string_view> expected) {
        const auto here = [&](std::string_view keyword) { return at_word(keyword); };
        for (text_.skip_blanks(); !text_.done() && !separates(*text_.at); text_.skip_blanks()) {
            if (std::any_of(expected.begin(), expected.end(), here)) return;
            if (stray_words_++ == 0) first_stray_ = text_.at;
            while (!text_.done() && !separates(*text_.at)) ++text_.at;
        }
    }

    /// "endsolid", which some programs write as two words.
    [[nodiscard]] bool accept_end() {
        if (accept("endsolid")) return true;
        if (!accept("end")) return false;
        expect("solid");
        return true;
    }

    void expect(std::string_view keyword) {
        if (accept(keyword)) return;
        if (text_.done())
            text_.fail("expected '" + std::string(keyword) + "', but the file ends: truncated?");
        text_.fail("expected '" + std::string(keyword) + "', found " + quoted(text_.at, text_.end));
    }

    void solid() {
        expect("solid");
        file_.attributes.parts.push_back(
            {.object = name(), .first_face = static_cast<std::uint32_t>(file_.mesh.faces.size())});
        facets_by_pieces();
        while (!accept_end()) {
            facet();
            text_.file.release_before(text_.at);
        }
        (void)name();
    }

    /// The facets ahead that many threads can read: the text is cut ahead of facets, and what was
    /// read counts up to the first piece that ends in something else, or cannot be read. There the
    /// reading in one goes on, which knows what may follow, and says what is wrong and where.
    void facets_by_pieces() {
        std::vector<std::vector<point3>> memory(pieces_at_once);
        while (text_.at >= pieces_tried_) {
            std::vector<const char*> cuts{text_.at};
            while (cuts.size() <= pieces_at_once && cuts.back() != text_.end) {
                const auto left = static_cast<std::size_t>(text_.end - cuts.back());
                cuts.push_back(next_facet(cuts.back() + std::min(left, piece_bytes), text_.end));
            }
            if (cuts.size() < 3) return;
            pieces_tried_ = cuts.back();
            std::vector<stl_text_reader> pieces;
            for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
                pieces.emplace_back(text_.file, cuts[i], cuts[i + 1], std::move(memory[i]));
            for_chunks(pieces.size(), 1, [&](std::size_t i, auto, auto) { pieces[i].facets(); });
            for (std::size_t i = 0; i < pieces.size(); ++i) {
                if (!pieces[i].legible_) return;
                add(pieces[i]);
                if (!pieces[i].text_.done()) return;
                memory[i] = std::move(pieces[i].file_.mesh.points);
            }
        }
    }

    /// Up to the first word that is not "facet".
    void facets() {
        try {
            while (!next_is_end() && at_word("facet")) facet();
        } catch (const io_error&) {
            legible_ = false;
        }
    }

    void add(const stl_text_reader& piece) {
        const std::vector<point3>& points = piece.file_.mesh.points;
        check_count(file_.mesh.points.size() + points.size());
        auto corner = static_cast<std::uint32_t>(file_.mesh.points.size());
        file_.mesh.points.insert(file_.mesh.points.end(), points.begin(), points.end());
        for (std::size_t i = 0; i < points.size(); i += 3, corner += 3)
            file_.mesh.faces.push_back({corner, corner + 1, corner + 2});
        if (stray_words_ == 0) first_stray_ = piece.first_stray_;
        stray_words_ += piece.stray_words_;
        zero_bytes_ += piece.zero_bytes_;
        text_.hexadecimal = text_.hexadecimal || piece.text_.hexadecimal;
        text_.at = piece.text_.at;
        text_.file.release_before(text_.at);
    }

    /// What follows in the line; up to a zero byte, where some programs end their strings.
    [[nodiscard]] std::string name() {
        const std::string_view rest = text_.rest_of_line();
        const std::size_t length = std::min(rest.find('\0'), rest.size());
        zero_bytes_ += static_cast<std::size_t>(
            std::count(rest.begin() + static_cast<std::ptrdiff_t>(length), rest.end(), '\0'));
        return std::string(rest.substr(0, length));
    }

    void facet() {
        skip_to_word();
        if (text_.done()) text_.fail("the file ends without 'endsolid': truncated?");
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
        leave_out_up_to({"endfacet"});
        expect("endfacet");
        leave_out_up_to({"facet", "endsolid"});
        if (is_piece_) return;
        const std::size_t count = file_.mesh.points.size();
        check_count(count);
        const auto first = static_cast<std::uint32_t>(count - 3);
        file_.mesh.faces.push_back({first, first + 1, first + 2});
    }

    void check_count(std::size_t points) const {
        if (points > std::numeric_limits<std::uint32_t>::max())
            text_.fail("more corners than 32-bit numbers can name");
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

    void remark() {
        text_.remark(file_.warnings);
        if (stray_words_ > 0)
            file_.warnings.push_back(
                {"stray-words", std::to_string(stray_words_) +
                                    (stray_words_ == 1 ? " word" : " words") +
                                    " after 'endloop' or 'endfacet' ignored, the first in line " +
                                    std::to_string(text_.file.line_of(first_stray_))});
        if (zero_bytes_ > 0)
            file_.warnings.push_back(
                {"zero-bytes", std::to_string(zero_bytes_) +
                                   (zero_bytes_ == 1 ? " zero byte" : " zero bytes") +
                                   " between words read as blanks"});
    }

    text text_;
    mesh_file file_{};
    std::size_t zero_bytes_ = 0;
    std::size_t stray_words_ = 0;
    const char* first_stray_ = nullptr;
    const char* pieces_tried_ = text_.at;  ///< up to here, pieces were tried
    bool is_piece_ = false;
    bool legible_ = true;  ///< of a piece
};

}  // namespace

mesh_file read_stl_text(const source& in) { return stl_text_reader(in).read(); }

}  // namespace treeform::detail::io
