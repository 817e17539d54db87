#include <libmesh/io/detail/writers.hpp>

namespace tf::detail {

void write_xyz(const write_job& job) {
    const element* vertices = find_element(job.file.attributes, "vertex");
    const auto& points = job.file.mesh.points;
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
    if (!job.file.mesh.faces.empty())
        job.result.warnings.push_back({"faces-dropped", "XYZ holds points only"});
}

}  // namespace tf::detail
