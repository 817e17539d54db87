#include <libmesh/io/detail/writers.hpp>

namespace tf::detail {

namespace {

void put_vertices(const write_job& job) {
    auto colours = colour_columns(job.file, "vertex");
    if (colours.size() == 4) colours.pop_back();
    const auto& points = job.file.mesh.points;
    for (std::size_t v = 0; v < points.size(); ++v) {
        job.out.put("v ");
        job.point(points[v]);
        for (const column* c : colours) {
            job.out.put(' ');
            job.out.number(colour_value(*c, v));
        }
        job.out.put('\n');
    }
}

/// The names that differ from those in force.
void put_names(sink& out, const part& now, const part& before) {
    if (now.object != before.object) out.put("o " + now.object + '\n');
    // A new object has no group until one is named.
    if (now.group != (now.object != before.object ? std::string() : before.group))
        out.put("g " + now.group + '\n');
    if (now.material != before.material) out.put("usemtl " + now.material + '\n');
}

}  // namespace

void write_obj(const write_job& job) {
    // A file of no bytes would be taken for one that was cut off.
    if (job.file.mesh.points.empty()) job.out.put("# no vertices\n");
    put_vertices(job);
    const auto& parts = job.file.attributes.parts;
    std::size_t part_index = 0;
    part current;
    for_each_stored_face(job.file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
        for (;
             part_index < parts.size() && parts[part_index].first_face <= face_row(job.file, first);
             ++part_index) {
            put_names(job.out, parts[part_index], current);
            current = parts[part_index];
        }
        job.out.put('f');
        for (const std::uint32_t corner : corners) {
            job.out.put(' ');
            job.out.number(std::uint64_t{corner} + 1);
        }
        job.out.put('\n');
    });
}

}  // namespace tf::detail
