#include <libmesh/base/add_to_box.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/face_rows.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_rows.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {
namespace {

/// Bytes of points held while they are written, and rows read at a time.
constexpr std::size_t held_at_most = std::size_t{1} << 26;
constexpr std::size_t rows_a_run = std::size_t{1} << 15;

using scratch_maker = std::function<std::unique_ptr<scratch>(std::size_t)>;

/// The points of a file, in a file of their own.
class placed_points {
  public:
    placed_points(std::unique_ptr<scratch> file, std::uint64_t memory)
        : file_(std::move(file)),
          at_once_(std::max<std::size_t>(1024, static_cast<std::size_t>(memory / page))) {}

    void put(points_view points) {
        std::memcpy(file_->data() + size_, points.data(), points.size_bytes());
        size_ += points.size_bytes();
        if ((looked_at_ += points.size_bytes()) < held_at_most) return;
        file_->give_back();
        looked_at_ = 0;
    }
    [[nodiscard]] point3 at(std::uint32_t point) {
        if (++looked_at_ > at_once_) {
            file_->give_back();
            looked_at_ = 0;
        }
        point3 p;
        std::memcpy(&p, file_->data() + point * sizeof p, sizeof p);
        return p;
    }

  private:
    static constexpr std::uint64_t page = 4096;  ///< what one look may bring into memory, at least

    std::unique_ptr<scratch> file_;
    std::size_t at_once_;
    std::size_t size_ = 0;
    std::size_t looked_at_ = 0;  ///< since memory was given back: bytes, later points
};

bool have_runs(const source& in, std::vector<element>& elements) {
    const element& vertices = vertices_of(in, elements);
    return std::none_of(elements.begin(), elements.end(), [&](const element& e) {
        return e.rows > 0 && (e.name == "tristrips" || (e.name == "face" && &e < &vertices));
    });
}

template <class Values>
class ply_faces {
  public:
    ply_faces(const source& in, Values values, std::vector<element> elements)
        : in_(in), values_(std::move(values)), elements_(std::move(elements)) {}

    /// Reads up to the first face.
    void read_vertices(face_rows& rows, const scratch_maker& make_scratch, std::uint64_t memory) {
        check_header(rows);
        for (; next_ < elements_.size(); ++next_) {
            const element& e = elements_[next_];
            check_room(values_, e);
            if (&e == faces_) return;
            if (e.name == "vertex") points_.emplace(make_scratch(e.rows * sizeof(point3)), memory);
            each_run(e, [&](const std::vector<point3>& points) {
                if (e.name != "vertex") return;
                if (!fits_single(points)) rows.head.stored_as = precision::float64;
                base::add_to_box(rows.bounds, bounding_box(points));
                points_->put(points);
                for (; next_of_sample_ < read_ + points.size(); next_of_sample_ += step_)
                    if (const point3& p = points[next_of_sample_ - read_]; base::is_finite(p))
                        rows.sample.push_back(p);
                read_ += points.size();
            });
        }
    }

    bool append(std::vector<placed_triangle>& triangles, std::size_t most,
                std::vector<io_warning>& warnings) {
        const std::size_t before = triangles.size();
        if (faces_ != nullptr) append_faces(triangles, most);
        if (triangles.size() > before) return true;
        while (++next_ < elements_.size()) {
            check_room(values_, elements_[next_]);
            each_run(elements_[next_], [](const auto&) {});
        }
        look_behind(values_, warnings);
        return false;
    }

  private:
    void append_faces(std::vector<placed_triangle>& triangles, std::size_t most) {
        const std::size_t before = triangles.size();
        start_columns(*faces_, 0);
        while (stored_ < faces_->rows && triangles.size() - before < most) {
            values_.begin_row();
            for (column& c : faces_->columns) {
                if (c.role == column_role::corners) {
                    append_face(c, triangles);
                } else {
                    read_data(values_, c);
                }
            }
            values_.end_row();
            ++stored_;
        }
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

    /// All rows of `e`; calls `take` with the points of each run.
    template <class Take>
    void each_run(const element& e, const Take& take) {
        element run;
        std::vector<point3> points;
        for (std::size_t left = e.columns.empty() ? 0 : e.rows; left > 0;) {
            const std::size_t rows = std::min(left, rows_a_run);
            restart(run, e);
            points.clear();
            append_vertices(values_, run, points, rows);
            take(points);
            left -= rows;
        }
    }

    void append_face(const column& c, std::vector<placed_triangle>& triangles) {
        const std::size_t count = values_.length(c);
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
            if (i >= 2) triangles.push_back(t);
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
    element* faces_ = nullptr;
    std::optional<placed_points> points_{};
    std::int64_t points_of_file_ = 0;
    std::size_t next_ = 0;  ///< element
    std::size_t step_ = 1;
    std::size_t next_of_sample_ = 0;
    std::size_t read_ = 0;    ///< vertices
    std::size_t stored_ = 0;  ///< faces that were read
};

}  // namespace

bool has_face_runs(const source& ply) {
    ply_header header = read_ply_header(ply);
    return have_runs(ply, header.elements);
}

face_rows open_ply_faces(const source& in, const scratch_maker& make_scratch,
                         std::uint64_t memory) {
    ply_header header = read_ply_header(in);
    face_rows rows;
    rows.head.stored_as = precision::float32;
    with_reader(in, header, [&](const char* format, auto values) {
        rows.head.format = format;
        using reader = ply_faces<decltype(values)>;
        const auto faces =
            std::make_shared<reader>(in, std::move(values), std::move(header.elements));
        faces->read_vertices(rows, make_scratch, memory);
        rows.append = [faces](auto& triangles, std::size_t most, auto& warnings) {
            return faces->append(triangles, most, warnings);
        };
    });
    return rows;
}

}  // namespace treeform::detail::io
