#include <libmesh/base/add_to_box.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/ply_body.hpp>
#include <libmesh/io/point_rows.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace treeform::detail::io {
namespace {

constexpr std::size_t rows_a_run = std::size_t{1} << 15;  ///< read at a time

/// The triangles of faces whose points have been put.
class ply_faces {
  public:
    ply_faces(point_rows rows, std::unique_ptr<point_store> points, std::uint64_t rows_ahead)
        : rows_(std::move(rows)), points_(std::move(points)), rows_ahead_(rows_ahead) {}

    void go_to(const row_place& first, std::optional<std::uint64_t> end) {
        is_part_ = true;
        rows_.go_to(first);
        next_ = first.row;
        end_ = end;
    }

    [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

    bool append(std::vector<placed_triangle>& triangles, std::size_t most,
                std::vector<io_warning>& warnings) {
        const std::size_t before = triangles.size();
        while (triangles.size() - before < most && next_ != end_) {
            const std::uint64_t left = end_ ? *end_ - next_ : rows_a_run;
            const std::size_t some =
                static_cast<std::size_t>(std::min<std::uint64_t>(left, rows_a_run));
            if (!rows_.behind(block_, some, warnings)) {
                end_ = next_;
                remark_on_short_faces(left_out_, warnings);
                break;
            }
            if (is_part_ && block_.left_out > 0)
                throw io_error(
                    "a face with fewer than three corners, which only a single process can read");
            if (block_.rows.name == "face") add(triangles);
            next_ += block_.rows.rows + block_.left_out;
            left_out_ += block_.left_out;
        }
        return triangles.size() > before;
    }

    /// The points of the part, and what is to be reported of them.
    void put_points(face_rows& faces, const file_part& part) {
        const std::uint64_t count = rows_.count;
        const std::uint64_t first = part.first(count);
        const std::uint64_t last = part.last(count);
        const std::uint64_t step = count / sample_size + 1;
        std::uint64_t sampled = (first + step - 1) / step * step;
        const element declared = *rows_.head.attributes.find("vertex");
        element run;
        std::vector<point3> points;
        for (std::uint64_t next = rows_.left_out; next < last; next += points.size()) {
            restart(run, declared);
            points.clear();
            const std::uint64_t left = (next < first ? first : last) - next;
            rows_.append(points, run,
                         static_cast<std::size_t>(std::min<std::uint64_t>(left, rows_a_run)),
                         faces.head.warnings);
            if (next < first) continue;
            if (!fits_float32(points)) faces.head.stored_as = precision::float64;
            base::add_to_box(faces.bounds, bounding_box(points));
            points_->put(points);
            for (; sampled < next + points.size(); sampled += step)
                if (const point3& p = points[sampled - next]; base::is_finite(p))
                    faces.sample.push_back(p);
        }
    }

  private:
    void add(std::vector<placed_triangle>& triangles) {
        auto stored = static_cast<std::uint32_t>(next_ - rows_ahead_ - left_out_);
        for (std::size_t f = 0; f < block_.rows.rows; ++f, ++stored) {
            placed_triangle t{.stored = stored};
            const std::uint64_t first = block_.first_corner[f];
            for (std::uint64_t c = first; c < block_.first_corner[f + 1]; ++c) {
                const std::size_t k = std::min<std::uint64_t>(c - first, 2);
                if (c - first > 2) {
                    t.corners[1] = t.corners[2];
                    t.at[1] = t.at[2];
                }
                t.corners[k] = block_.corners[c];
                t.at[k] = points_->at(t.corners[k]);
                if (k == 2) triangles.push_back(t);
            }
        }
    }

    point_rows rows_;
    std::unique_ptr<point_store> points_;
    std::uint64_t rows_ahead_;  ///< of the faces, behind the points
    std::uint64_t next_ = 0;    ///< row behind the points
    std::optional<std::uint64_t> end_{};
    std::uint64_t left_out_ = 0;  ///< faces
    bool is_part_ = false;
    row_block block_{};
};

}  // namespace

face_rows open_ply_faces(const source& in,
                         const std::function<std::unique_ptr<point_store>(std::size_t)>& make_store,
                         const file_part& part, const record_index* known) {
    ply_header header = read_ply_header(in);
    const element& vertices = vertices_of(in, header.elements);
    if (vertices.rows > most_numbers) in.fail("more vertices than 32-bit numbers can name");
    face_rows rows;
    rows.points = vertices.rows;
    std::uint64_t rows_ahead = 0;
    for (const element& e : header.elements) {
        if (&e <= &vertices || e.columns.empty()) continue;
        if (e.name == "face") {
            rows.stored_faces = e.rows;
            break;
        }
        rows_ahead += e.rows;
    }
    if (rows.stored_faces > most_numbers) in.fail("more faces than 32-bit numbers can name");
    point_rows all = open_ply_points(in, part.first(rows.points), row_use::read, known);
    rows.head.format = all.head.format;
    rows.head.stored_as = precision::float32;
    rows.row_parts = all.row_parts;
    const auto faces =
        std::make_shared<ply_faces>(std::move(all), make_store(vertices.rows), rows_ahead);
    faces->put_points(rows, part);
    rows.append = [faces](auto& triangles, std::size_t most, auto& warnings) {
        return faces->append(triangles, most, warnings);
    };
    rows.left_out = [faces] { return faces->left_out(); };
    rows.go_to = [faces](const row_place& first, std::optional<std::uint64_t> end) {
        faces->go_to(first, end);
    };
    return rows;
}

}  // namespace treeform::detail::io
