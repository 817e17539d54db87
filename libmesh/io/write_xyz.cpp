#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>

#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

void put_rows(const write_job& job, std::span<const point3> points, const element* vertices) {
    for (std::size_t v = 0; v < points.size(); ++v) {
        job.point(points[v]);
        if (vertices != nullptr) {
            for (const column& c : vertices->columns) {
                if (c.role != column_role::data || c.list_length) continue;
                job.out.put(' ');
                put_number(job.out, c, v);
            }
        }
        job.out.put('\n');
    }
}

[[nodiscard]] std::string quoted_name(const std::string& name) {
    if (name.find_first_of(",;\"") == std::string::npos) return name;
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + '"';
}

/// A heading, then a point a line; columns in their order.
class csv_writer {
  public:
    explicit csv_writer(const write_job& job)
        : job_(job), declared_(declare_vertices(job, true, std::nullopt)) {
        bool first = true;
        for (const column& c : declared_.columns) {
            if (c.list_length) continue;
            if (!std::exchange(first, false)) job.out.put(',');
            job.out.put(quoted_name(c.name));
        }
        job.out.put('\n');
    }

    void put_points(std::span<const point3> points, const element* source) const {
        for (std::size_t row = 0; row < points.size(); ++row) {
            bool first = true;
            for (std::size_t i = 0; i < declared_.columns.size(); ++i) {
                const column& c = declared_.columns[i];
                if (c.list_length) continue;
                if (!std::exchange(first, false)) job_.out.put(',');
                if (c.role == column_role::data)
                    put_number(job_.out, with_values(declared_, source, i), row);
                else
                    job_.coordinate(points[row][axis_number(c.role)]);
            }
            job_.out.put('\n');
        }
    }

  private:
    write_job job_;
    element declared_;
};

}  // namespace

void write_xyz(const write_job& job) { put_rows(job, job.file.mesh.points, job.vertices); }

point_sink start_xyz_points(const write_job& job, std::uint64_t) {
    return {.rows = [job](std::span<const point3> points, const element* vertices) {
        put_rows(job, points, vertices);
    }};
}

void write_csv(const write_job& job) {
    csv_writer(job).put_points(job.file.mesh.points, job.vertices);
}

point_sink start_csv_points(const write_job& job, std::uint64_t) {
    return {.rows = [writer = csv_writer(job)](std::span<const point3> points,
                                               const element* vertices) {
        writer.put_points(points, vertices);
    }};
}

}  // namespace treeform::detail::io
