#include <libmesh/io/writers.hpp>

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

}  // namespace

void write_xyz(const write_job& job) { put_rows(job, job.file.mesh.points, job.vertices); }

point_sink start_xyz_points(const write_job& job, std::uint64_t) {
    return {.rows = [job](std::span<const point3> points, const element* vertices) {
        put_rows(job, points, vertices);
    }};
}

}  // namespace treeform::detail::io
