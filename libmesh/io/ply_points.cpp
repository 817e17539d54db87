#include <libmesh/io/face_texture.hpp>
#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/vertex_rows.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {
namespace {

/// The element "vertex" from the front to the back, and the elements behind it.
template <class Values>
class ply_points {
  public:
    /// Of `vertices`, as many rows are left to read.
    ply_points(const source& in, Values values, const element& vertices,
               std::vector<element> behind, std::uint64_t points, const text_index* known)
        : in_(in),
          values_(std::move(values)),
          left_(vertices.rows),
          columns_(vertices),
          behind_(std::move(behind)),
          all_points_(points),
          known_(known) {}

    std::size_t append(std::vector<point3>& points, element& vertices, std::size_t most,
                       std::vector<io_warning>& warnings) {
        const std::size_t rows = std::min(most, left_);
        append_vertices(values_, vertices, points, rows);
        left_ -= rows;
        if (rows == 0 && behind_.empty()) look_behind(values_, warnings);
        return rows;
    }

    /// \pre the numbers of points are those of the file
    bool read(row_block& block, std::size_t most, std::uint64_t points,
              std::vector<io_warning>& warnings) {
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
        if (e.name == "face") block.first_corner.push_back(0);
        points_ = static_cast<std::int64_t>(points);
        constexpr std::size_t corners_a_face = 4;
        while (block.rows.rows < most && block.corners.size() < corners_a_face * most &&
               row_ < e.rows)
            read_row(block);
        return true;
    }

    [[nodiscard]] row_place next_row() {
        pass_points();
        row_place place{.row = row_,
                        .byte = static_cast<std::uint64_t>(values_.at() - in_.begin())};
        for (std::size_t e = 0; e < at_; ++e) place.row += behind_[e].rows;
        return place;
    }

    void go_to(const row_place& place) {
        left_ = 0;
        at_ = 0;
        std::uint64_t row = place.row;
        for (; at_ < behind_.size() && row >= behind_[at_].rows; ++at_) row -= behind_[at_].rows;
        row_ = static_cast<std::size_t>(row);
        values_.go_to(in_.begin() + std::min<std::uint64_t>(place.byte, in_.size()));
    }

    [[nodiscard]] std::vector<row_place> parts(std::size_t count) {
        std::vector<alike_rows> rows;
        if constexpr (has_bytes<Values>) {
            if (left_ > 0 && fixed_row_size(columns_) == 0) return {};
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
            return parts_of_rows(static_cast<std::uint64_t>(values_.at() - in_.begin()), rows,
                                 count);
        } else {
            return parts_of_text(count);
        }
    }

  private:
    [[nodiscard]] std::vector<row_place> parts_of_text(std::size_t count) {
        std::uint64_t rows = 0;
        for (const element& e : behind_) rows += e.rows;
        const bool plain = known_ != nullptr && known_->records == all_points_ + rows &&
                           !known_->hexadecimal;  // else there is something to say at the end
        if (!plain) return {};
        std::vector<row_place> places;
        for (std::size_t part = 0; part <= count; ++part) {
            const std::uint64_t row = rows / count * part + rows % count * part / count;
            go_to_line(all_points_ + row);
            places.push_back({row, static_cast<std::uint64_t>(values_.at() - in_.begin())});
        }
        left_ = 0;
        return places;
    }
    /// By way of the last mark ahead of it.
    void go_to_line(std::uint64_t line) {
        const text_index::mark at = known_->before(line);
        values_.go_to(in_.begin() + std::min<std::uint64_t>(at.byte, in_.size()));
        for (std::uint64_t left = line - at.record; left > 0; --left) values_.pass_row();
    }

    void pass_points() {
        if constexpr (has_bytes<Values>) {
            if (const std::size_t size = fixed_row_size(columns_); size > 0) {
                static_cast<void>(values_.take_bytes(left_ * size));
                left_ = 0;
            }
        } else if (known_ != nullptr && left_ > 0) {
            go_to_line(all_points_);
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
        values_.begin_row();
        for (column& c : block.rows.columns) {
            if (c.role == column_role::corners)
                read_corners(c, block);
            else
                read_data(values_, c);
        }
        values_.end_row();
        ++block.rows.rows;
        ++row_;
    }

    void read_corners(const column& c, row_block& block) {
        const std::size_t count = values_.length(c);
        if (length_.value_or(count) != count) values_.fail("a face of another length");
        if (count < 3) values_.fail("face with " + std::to_string(count) + " corners");
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t index = values_.index(c);
            if (index < 0 || index >= points_)
                values_.fail("vertex index " + std::to_string(index) + " is out of range");
            block.corners.push_back(static_cast<std::uint32_t>(index));
        }
        block.first_corner.push_back(block.corners.size());
    }

    const source& in_;
    Values values_;
    std::size_t left_;
    element columns_;
    std::vector<element> behind_;  ///< with rows
    std::size_t at_ = 0;           ///< the one that is read
    std::size_t row_ = 0;          ///< the next of it
    std::int64_t points_ = 0;
    std::uint64_t all_points_;  ///< of the file
    const text_index* known_;
    std::optional<std::size_t> length_{};  ///< of all faces, where they must be alike
};

/// The elements behind the points that have rows; what cannot be read so is refused.
std::vector<element> elements_behind(const source& in, const std::vector<element>& elements,
                                     const element& vertices) {
    std::vector<element> behind;
    for (const element& e : elements) {
        if (&e == &vertices || e.rows == 0 || e.columns.empty()) continue;
        const auto same_name = std::ranges::count(elements, e.name, &element::name);
        if (&e < &vertices || e.name == "tristrips" || same_name > 1)
            fail_in_blocks(in, "element '" + e.name + "' is not read in blocks");
        if (e.name == "face") {
            if (with_role(e, column_role::corners) == nullptr)
                in.fail("element 'face' has no list of vertex_indices");
            if (find_column(e, face_texture_name) != nullptr)
                fail_in_blocks(in, "texture coordinates of corners are not read in blocks");
        }
        behind.push_back(e);
    }
    if (!behind.empty() && vertices.rows > most_numbers)
        in.fail("more vertices than 32-bit numbers can name");
    return behind;
}

}  // namespace

point_rows open_ply_points(const source& in, std::uint64_t first, bool with_rows,
                           const text_index* known) {
    ply_header header = read_ply_header(in);
    point_rows rows;
    element& vertices = vertices_of(in, header.elements);
    for (const element& e : header.elements)
        if (!with_rows && &e != &vertices && e.rows > 0)
            fail_in_blocks(
                in, "element '" + e.name + "' has rows; only files of points are read in blocks");
    std::vector<element> behind = elements_behind(in, header.elements, vertices);
    const std::uint64_t count = vertices.rows;
    rows.count = count;
    with_reader(in, header, [&](const char*, auto values) { check_room(values, vertices); });
    const bool binary = header.encoding != ply_encoding::ascii;
    if (const std::size_t row = fixed_row_size(vertices); binary && row > 0) {
        rows.left_out = first;
        header.body += first * row;
        vertices.rows -= first;
    }
    if (!binary && known != nullptr) {
        const text_index::mark at = known->before(first);
        rows.left_out = at.record;
        header.body =
            std::max(header.body, in.begin() + std::min<std::uint64_t>(at.byte, in.size()));
        vertices.rows -= at.record;
    }
    with_reader(in, header, [&](const char* format, auto values) {
        rows.head.format = format;
        if (known != nullptr) values.expect(*known);
        using reader = ply_points<decltype(values)>;
        const auto body = std::make_shared<reader>(in, std::move(values), vertices,
                                                   std::move(behind), count, known);
        rows.append = [body](auto& points, element& to, std::size_t most, auto& warnings) {
            return body->append(points, to, most, warnings);
        };
        rows.behind = [body, count](row_block& block, std::size_t most, auto& warnings) {
            return body->read(block, most, count, warnings);
        };
        rows.next_row = [body] { return body->next_row(); };
        rows.go_to = [body](const row_place& place) { body->go_to(place); };
        rows.row_parts = [body](std::size_t parts) { return body->parts(parts); };
    });
    rows.head.stored_as =
        binary && has_single_axes(vertices) ? precision::float32 : precision::float64;
    vertices.rows = 0;
    take_remarks(header, rows.head);
    rows.head.attributes.elements = std::move(header.elements);
    return rows;
}

std::optional<text_index> scan_ply(const source& in, const file_part& part, std::size_t most) {
    const ply_header header = read_ply_header(in);
    if (header.encoding != ply_encoding::ascii) return std::nullopt;
    return scan_rows(in, header.body, part, most);
}

}  // namespace treeform::detail::io
