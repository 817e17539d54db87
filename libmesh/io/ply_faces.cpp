#include <libmesh/base/add_to_box.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/face_rows.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/vertex_rows.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {
namespace {

constexpr std::size_t rows_a_run = std::size_t{1} << 15;  ///< read at a time

using store_maker = std::function<std::unique_ptr<point_store>(std::size_t)>;

bool have_runs(const source& in, std::vector<element>& elements) {
    const element& vertices = vertices_of(in, elements);
    return std::none_of(elements.begin(), elements.end(), [&](const element& e) {
        return e.rows > 0 && (e.name == "tristrips" || (e.name == "face" && &e < &vertices));
    });
}

template <class Values>
class ply_faces {
  public:
    ply_faces(const source& in, Values values, std::vector<element> elements, const file_part& part,
              const text_index* known)
        : in_(in),
          values_(std::move(values)),
          elements_(std::move(elements)),
          part_(part),
          known_(known) {
        if (known != nullptr) values_.expect(*known);
    }

    /// Reads up to the first face.
    void read_vertices(face_rows& rows, const store_maker& make_store) {
        check_header(rows);
        for (; next_ < elements_.size(); ++next_) {
            const element& e = elements_[next_];
            check_room(values_, e);
            if (&e == faces_) return find_first_face(rows);
            if (e.name != "vertex") {  // somebody looks at them
                part_.rank == 0 ? read_rows(e) : skip_rows(e, e.rows);
                continue;
            }
            points_ = make_store(e.rows);
            read_ = part_.first(e.rows);
            next_of_sample_ = (read_ + step_ - 1) / step_ * step_;
            skip_rows(e, read_);
            const std::size_t last = part_.last(e.rows);
            each_run(e, last - read_, [&](const std::vector<point3>& points) {
                if (!fits_single(points)) rows.head.stored_as = precision::float64;
                base::add_to_box(rows.bounds, bounding_box(points));
                points_->put(points);
                for (; next_of_sample_ < read_ + points.size(); next_of_sample_ += step_)
                    if (const point3& p = points[next_of_sample_ - read_]; base::is_finite(p))
                        rows.sample.push_back(p);
                read_ += points.size();
            });
            skip_rows(e, e.rows - last);
        }
    }

    bool append(std::vector<placed_triangle>& triangles, std::size_t most,
                std::vector<io_warning>& warnings) {
        const std::size_t before = triangles.size();
        if (faces_ != nullptr) append_faces(triangles, most);
        if (triangles.size() > before || !part_.is_last()) return triangles.size() > before;
        while (++next_ < elements_.size()) {
            check_room(values_, elements_[next_]);
            read_rows(elements_[next_]);
        }
        look_behind(values_, warnings);
        return false;
    }

  private:
    void append_faces(std::vector<placed_triangle>& triangles, std::size_t most) {
        const std::size_t before = triangles.size();
        forget_data();
        const std::uint64_t first = part_.first(faces_->rows);
        const std::uint64_t last = part_.last(faces_->rows);
        while (stored_ < last && triangles.size() - before < most) {
            values_.begin_row();
            for (column& c : faces_->columns) {
                if (c.role == column_role::corners) {
                    read_face(c, stored_ >= first ? &triangles : nullptr);
                } else {
                    read_data(values_, c);
                }
            }
            values_.end_row();
            ++row_;
            if (++stored_ % rows_a_run == 0) forget_data();
        }
        forget_data();
    }

    void forget_data() {
        start_columns(*faces_, 0);
        for (column& c : faces_->columns) c.values.clear();
    }

    void check_header(face_rows& rows) {
        const element& vertices = vertices_of(in_, elements_);
        if (!have_runs(in_, elements_))
            in_.fail("faces ahead of their vertices, and triangle strips, are not read by runs");
        if (vertices.rows > most_numbers) in_.fail("more vertices than 32-bit numbers can name");
        points_of_file_ = static_cast<std::int64_t>(vertices.rows);
        step_ = vertices.rows / sample_size + 1;
        rows.points = vertices.rows;
        for (element& e : elements_) {
            if (e.name != "face" || e.rows == 0) continue;
            if (with_role(e, column_role::corners) == nullptr)
                in_.fail("element 'face' has no list of vertex_indices");
            if (e.rows > most_numbers) in_.fail("more faces than 32-bit numbers can name");
            faces_ = &e;
            rows.stored_faces = e.rows;
        }
    }

    void skip_rows(const element& e, std::size_t count) {
        if constexpr (has_bytes<Values>) {
            if (const std::size_t size = fixed_row_size(e); size > 0) {
                static_cast<void>(values_.take_bytes(count * size));
                return values_.end_row();
            }
        } else if (known_ != nullptr) {
            return pass_lines(e.columns.empty() ? 0 : count);
        }
        each_run(e, count, [](const auto&) {});
    }
    void read_rows(const element& e) {
        if constexpr (has_bytes<Values>) return skip_rows(e, e.rows);
        each_run(e, e.rows, [](const auto&) {});
    }

    /// By way of the last mark ahead of where they end.
    void pass_lines(std::size_t count) {
        const std::uint64_t next = row_ + count;
        if (const text_index::mark at = known_->before(next); at.record > row_) {
            values_.go_to(in_.begin() + std::min<std::uint64_t>(at.byte, in_.size()));
            row_ = at.record;
        }
        for (; row_ < next; ++row_) values_.pass_row();
    }

    /// Goes to the first face of the part, if all faces ahead of it may be alike, by the bytes that
    /// they take.
    void find_first_face(face_rows& rows) {
        if constexpr (has_bytes<Values>) {
            const std::uint64_t first = part_.first(faces_->rows);
            if (part_.size == 1 || part_.from_front) return;
            std::size_t behind = 0;
            for (const element& e : elements_) {
                if (&e <= faces_ || e.rows == 0) continue;
                if (fixed_row_size(e) == 0) return;
                behind += e.rows * fixed_row_size(e);
            }
            const std::size_t size = alike_row_size(values_, *faces_, length_);
            rows.jumped = size > 0 && values_.bytes_left() == faces_->rows * size + behind;
            if (!rows.jumped) {
                length_.reset();
                return;
            }
            static_cast<void>(values_.take_bytes(first * size));
            values_.end_row();
            stored_ = first;
        } else if (known_ != nullptr) {
            rows.jumped = true;
            stored_ = part_.first(faces_->rows);
            pass_lines(stored_);
        }
    }

    /// The next `count` rows of `e`; calls `take` with the points of each run.
    template <class Take>
    void each_run(const element& e, std::size_t count, const Take& take) {
        element run;
        std::vector<point3> points;
        for (std::size_t left = e.columns.empty() ? 0 : count; left > 0;) {
            const std::size_t rows = std::min(left, rows_a_run);
            restart(run, e);
            points.clear();
            append_vertices(values_, run, points, rows);
            take(points);
            left -= rows;
            row_ += rows;
        }
    }

    /// Those of other parts, which have no `triangles`, are passed over.
    void read_face(const column& c, std::vector<placed_triangle>* triangles) {
        const std::size_t count = values_.length(c);
        if (length_.value_or(count) != count) values_.fail("a face of another length");
        if (triangles == nullptr) {
            for (std::size_t i = 0; i < count; ++i) static_cast<void>(values_.index(c));
            return;
        }
        if (count < 3) values_.fail("face with " + std::to_string(count) + " corners");
        placed_triangle t{.stored = static_cast<std::uint32_t>(stored_)};
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t corner = std::min<std::size_t>(i, 2);
            if (i > 2) {
                t.corners[1] = t.corners[2];
                t.at[1] = t.at[2];
            }
            t.corners[corner] = vertex(values_.index(c));
            t.at[corner] = points_->at(t.corners[corner]);
            if (i >= 2) triangles->push_back(t);
        }
    }

    [[nodiscard]] std::uint32_t vertex(std::int64_t index) const {
        if (index < 0 || index >= points_of_file_)
            values_.fail("vertex index " + std::to_string(index) + " is out of range");
        return static_cast<std::uint32_t>(index);
    }

    const source& in_;
    Values values_;
    std::vector<element> elements_;
    file_part part_;
    const text_index* known_;
    element* faces_ = nullptr;
    std::optional<std::size_t> length_{};  ///< of all faces, where they must be alike
    std::unique_ptr<point_store> points_{};
    std::int64_t points_of_file_ = 0;
    std::size_t next_ = 0;  ///< element
    std::size_t step_ = 1;
    std::size_t next_of_sample_ = 0;
    std::size_t read_ = 0;    ///< vertices
    std::size_t stored_ = 0;  ///< faces that were read
    std::uint64_t row_ = 0;   ///< of all elements, the next one; of text
};

}  // namespace

bool has_face_runs(const source& ply) {
    ply_header header = read_ply_header(ply);
    return have_runs(ply, header.elements);
}

face_rows open_ply_faces(const source& in, const store_maker& make_store, const file_part& part,
                         const text_index* known) {
    ply_header header = read_ply_header(in);
    face_rows rows;
    rows.head.stored_as = precision::float32;
    with_reader(in, header, [&](const char* format, auto values) {
        rows.head.format = format;
        using reader = ply_faces<decltype(values)>;
        const auto faces = std::make_shared<reader>(in, std::move(values),
                                                    std::move(header.elements), part, known);
        faces->read_vertices(rows, make_store);
        rows.append = [faces](auto& triangles, std::size_t most, auto& warnings) {
            return faces->append(triangles, most, warnings);
        };
    });
    return rows;
}

}  // namespace treeform::detail::io
