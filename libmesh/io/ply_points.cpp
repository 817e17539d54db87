#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/point_rows.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {
namespace {

/// Elements that have rows.
struct elements_to_read {
    std::vector<element> ahead{};  ///< of the points
    element points{};
    std::vector<element> behind{};
};

/// What cannot be read so is refused.
elements_to_read sort_elements(const source& in, std::vector<element>& elements, row_use use) {
    const element& vertices = vertices_of(in, elements);
    elements_to_read sorted{.points = vertices};
    for (const element& e : elements) {
        if (&e == &vertices || e.rows == 0) continue;
        if (use == row_use::none)
            fail_in_blocks(
                in, "element '" + e.name + "' has rows; only files of points are read in blocks");
        if (e.columns.empty()) continue;
        const bool is_ahead = &e < &vertices;
        const bool is_face = e.name == "face";
        if ((is_ahead && (is_face || use == row_use::copied)) || e.name == "tristrips" ||
            std::ranges::count(elements, e.name, &element::name) > 1)
            fail_in_blocks(in, "element '" + e.name + "' is not read in blocks");
        if (is_face && with_role(e, column_role::corners) == nullptr)
            in.fail("element 'face' has no list of vertex_indices");
        if (is_face && use == row_use::copied && e.find(face_texture_name) != nullptr)
            fail_in_blocks(in, "texture coordinates of corners are not read in blocks");
        (is_ahead ? sorted.ahead : sorted.behind).push_back(e);
    }
    if (!sorted.behind.empty() && vertices.rows > most_numbers)
        in.fail("more vertices than 32-bit numbers can name");
    return sorted;
}

/// The element "vertex" from the front to the back, and the elements behind it.
template <class Values>
class ply_points {
  public:
    ply_points(const source& in, Values values, const elements_to_read& elements,
               const record_index* known)
        : in_(in),
          values_(std::move(values)),
          left_(elements.points.rows),
          columns_(elements.points),
          behind_(elements.behind),
          known_(known) {
        if (known != nullptr) values_.expect(*known);
        pass_rows(elements.ahead);
        check_room(values_, columns_);
    }

    /// Passes over the first points, as many of them as takes no reading; returns how many.
    std::uint64_t pass(std::uint64_t first) {
        if constexpr (has_bytes<Values>) {
            if (const std::size_t size = fixed_row_size(columns_); size > 0) {
                static_cast<void>(values_.take_bytes(first * size));
                left_ -= first;
                return first;
            }
        }
        const auto at =
            known_ == nullptr ? record_index::mark{} : known_->before(lines_ahead_ + first);
        if (at.record <= lines_ahead_) return 0;
        go_to_byte(at.byte);
        left_ = columns_.rows - (at.record - lines_ahead_);
        return at.record - lines_ahead_;
    }

    /// As `scan_listed_points`.
    [[nodiscard]] listed_points scan(const row_place& first, std::uint64_t end, std::size_t most) {
        constexpr std::size_t points_a_mark = 16;
        if (first.byte > 0) go_to_byte(first.byte);
        left_ = columns_.rows - std::min<std::uint64_t>(first.row, columns_.rows);
        listed_points seen;
        spread_marks marks(most);
        element rows;
        std::vector<point3> points;
        while (left_ > 0 && byte() < end) {
            marks.add(seen.found.records, byte());
            restart(rows, columns_);
            points.clear();
            append_vertices(values_, rows, points, std::min(left_, points_a_mark));
            left_ -= points.size();
            seen.found.records += points.size();
        }
        seen.next = {first.row + seen.found.records, byte()};
        seen.found.marks = std::move(marks).all();
        if (left_ == 0) seen.found.marks.push_back({seen.found.records, byte()});
        return seen;
    }

    std::size_t append(std::vector<point3>& points, element& vertices, std::size_t most,
                       std::vector<io_warning>& warnings) {
        const std::size_t rows = std::min(most, left_);
        append_vertices(values_, vertices, points, rows);
        left_ -= rows;
        if (rows == 0 && behind_.empty()) look_behind(values_, warnings);
        return rows;
    }

    bool read(row_block& block, std::size_t most, std::vector<io_warning>& warnings) {
        pass_points();
        while (at_ < behind_.size() && row_ == behind_[at_].rows) {
            ++at_;
            row_ = 0;
        }
        if (at_ == behind_.size()) {
            look_behind(values_, warnings);
            return false;
        }
        const element& e = behind_[at_];
        if (row_ == 0) check_room(values_, e);
        restart(block.rows, e);
        block.corners.clear();
        block.first_corner.clear();
        block.left_out = 0;
        if (e.name == "face") block.first_corner.push_back(0);
        constexpr std::size_t corners_a_face = 4;
        while (block.rows.rows + block.left_out < most &&
               block.corners.size() < corners_a_face * most && row_ < e.rows)
            read_row(block);
        return true;
    }

    [[nodiscard]] row_place next_row() {
        pass_points();
        row_place place{.row = row_, .byte = byte()};
        for (std::size_t e = 0; e < at_; ++e) place.row += behind_[e].rows;
        return place;
    }

    void go_to(const row_place& place) {
        left_ = 0;
        at_ = 0;
        std::uint64_t row = place.row;
        for (; at_ < behind_.size() && row >= behind_[at_].rows; ++at_) row -= behind_[at_].rows;
        row_ = static_cast<std::size_t>(row);
        go_to_byte(place.byte);
    }

    [[nodiscard]] std::vector<row_place> parts(std::size_t count) {
        std::vector<alike_rows> rows;
        if constexpr (has_bytes<Values>) {
            if (fixed_row_size(columns_) == 0 && known_ == nullptr) return {};
            pass_points();
            Values values = values_;
            std::optional<std::size_t> corners;
            for (const element& e : behind_) {
                std::size_t size = fixed_row_size(e);
                if (e.name == "face") size = alike_row_size(values, e, corners);
                if (size == 0 || e.rows > values.bytes_left() / size) return {};
                static_cast<void>(values.take_bytes(e.rows * size));
                rows.push_back({e.rows, size});
            }
            if (values.bytes_left() > 0) return {};
            length_ = corners;
            return parts_of_rows(byte(), rows, count);
        } else {
            return parts_of_text(count);
        }
    }

  private:
    [[nodiscard]] std::uint64_t byte() const {
        return static_cast<std::uint64_t>(values_.at() - in_.begin());
    }
    void go_to_byte(std::uint64_t byte) {
        values_.go_to(in_.begin() + std::min<std::uint64_t>(byte, in_.size()));
    }

    [[nodiscard]] std::vector<row_place> parts_of_text(std::size_t count) {
        std::uint64_t rows = 0;
        for (const element& e : behind_) rows += e.rows;
        const bool plain = known_ != nullptr &&
                           known_->records == lines_ahead_ + columns_.rows + rows &&
                           !known_->hexadecimal;  // else there is something to say at the end
        if (!plain) return {};
        std::vector<row_place> places;
        for (std::size_t part = 0; part <= count; ++part) {
            const std::uint64_t row = rows / count * part + rows % count * part / count;
            go_to_line(columns_.rows + row);
            places.push_back({row, byte()});
        }
        left_ = 0;
        return places;
    }
    /// Of a line, counted from the first point; by way of the last mark ahead of it.
    void go_to_line(std::uint64_t line) {
        line += lines_ahead_;
        const record_index::mark at = known_->before(line);
        go_to_byte(at.byte);
        for (std::uint64_t left = line - at.record; left > 0; --left) values_.pass_row();
    }

    void pass_rows(const std::vector<element>& ahead) {
        for (const element& e : ahead) {
            check_room(values_, e);
            if constexpr (has_bytes<Values>) {
                if (const std::size_t size = fixed_row_size(e); size > 0) {
                    static_cast<void>(values_.take_bytes(e.rows * size));
                    continue;
                }
            }
            element row;
            restart(row, e);
            for (std::size_t left = e.rows; left > 0; --left) {
                for (column& c : row.columns) {
                    c.values.clear();
                    c.list_begin.clear();
                }
                (void)io::read_row(values_, row, [](const column&) { return true; });
            }
            if constexpr (!has_bytes<Values>) lines_ahead_ += e.rows;
        }
    }

    void pass_points() {
        if constexpr (has_bytes<Values>) {
            if (fixed_row_size(columns_) > 0)
                static_cast<void>(pass(left_));
            else if (left_ > 0)
                static_cast<void>(pass(columns_.rows));
        } else if (known_ != nullptr && left_ > 0) {
            go_to_line(columns_.rows);
            left_ = 0;
        }
        constexpr std::size_t run = std::size_t{1} << 15;
        std::vector<point3> points;
        for (element rows; left_ > 0; left_ -= std::min(left_, run)) {
            restart(rows, columns_);
            points.clear();
            append_vertices(values_, rows, points, std::min(left_, run));
        }
    }

    void read_row(row_block& block) {
        const std::size_t corners = block.corners.size();
        ++row_;
        if (io::read_row(values_, block.rows,
                         [&](const column& c) { return read_corners(c, block); })) {
            ++block.rows.rows;
            return;
        }
        drop_last_row(block.rows);
        block.corners.resize(corners);
        block.first_corner.pop_back();
        ++block.left_out;
    }

    /// False for fewer than three.
    [[nodiscard]] bool read_corners(const column& c, row_block& block) {
        const std::size_t count = values_.length(c);
        if (length_.value_or(count) != count) values_.fail("a face of another length");
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t index = values_.index(c);
            if (index < 0 || index >= static_cast<std::int64_t>(columns_.rows))
                values_.fail("vertex index " + std::to_string(index) + " is out of range");
            block.corners.push_back(static_cast<std::uint32_t>(index));
        }
        block.first_corner.push_back(block.corners.size());
        return count >= 3;
    }

    const source& in_;
    Values values_;
    std::size_t left_;               ///< points to read
    element columns_;                ///< of the points
    std::vector<element> behind_;    ///< with rows
    std::size_t at_ = 0;             ///< the one that is read
    std::size_t row_ = 0;            ///< the next of it
    std::uint64_t lines_ahead_ = 0;  ///< of the points, in text
    const record_index* known_;
    std::optional<std::size_t> length_{};  ///< of all faces, where they must be alike
};

}  // namespace

bool has_readable_rows(const source& ply) {
    ply_header header = read_ply_header(ply);
    try {
        static_cast<void>(sort_elements(ply, header.elements, row_use::read));
        return true;
    } catch (const io_error& error) {
        if (error.why() != io_error::kind::blocks) throw;
        return false;
    }
}

point_rows open_ply_points(const source& in, std::uint64_t first, row_use use,
                           const record_index* known) {
    ply_header header = read_ply_header(in);
    const elements_to_read elements = sort_elements(in, header.elements, use);
    point_rows rows;
    rows.count = elements.points.rows;
    with_reader(in, header, [&](const char* format, auto values) {
        rows.head.format = format;
        using reader = ply_points<decltype(values)>;
        const auto body = std::make_shared<reader>(in, std::move(values), elements, known);
        rows.left_out = body->pass(first);
        rows.append = [body](auto& points, element& to, std::size_t most, auto& warnings) {
            return body->append(points, to, most, warnings);
        };
        rows.behind = [body](row_block& block, std::size_t most, auto& warnings) {
            return body->read(block, most, warnings);
        };
        rows.next_row = [body] { return body->next_row(); };
        rows.go_to = [body](const row_place& place) { body->go_to(place); };
        rows.row_parts = [body](std::size_t parts) { return body->parts(parts); };
    });
    rows.head.stored_as = header.encoding != ply_encoding::ascii && has_single_axes(elements.points)
                              ? precision::float32
                              : precision::float64;
    vertices_of(in, header.elements).rows = 0;
    take_remarks(header, rows.head);
    rows.head.attributes.elements = std::move(header.elements);
    return rows;
}

bool has_listed_points(const source& ply) {
    ply_header header = read_ply_header(ply);
    return header.encoding != ply_encoding::ascii &&
           fixed_row_size(vertices_of(ply, header.elements)) == 0;
}

listed_points scan_listed_points(const source& ply, const row_place& first, std::uint64_t end,
                                 std::size_t most) {
    ply_header header = read_ply_header(ply);
    const elements_to_read elements = sort_elements(ply, header.elements, row_use::read);
    listed_points seen;
    with_reader(ply, header, [&](const char*, auto values) {
        ply_points<decltype(values)> points(ply, std::move(values), elements, nullptr);
        seen = points.scan(first, end, most);
    });
    return seen;
}

std::optional<record_index> scan_ply(const source& in, const file_part& part, std::size_t most) {
    const ply_header header = read_ply_header(in);
    if (header.encoding != ply_encoding::ascii) return std::nullopt;
    return scan_rows(in, header.body, part, most);
}

}  // namespace treeform::detail::io
