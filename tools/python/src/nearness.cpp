#include "bindings.hpp"

namespace binding {
namespace {

struct numbered_hit {
    double t;
    std::uint32_t ray, face;
};

py::tuple raycast_all(const held_mesh& mesh, const points_array& origins,
                      const points_array& directions, double t_min, double t_max) {
    const rays all(origins, directions, t_min, t_max);
    std::vector<numbered_hit> hits;
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const tf::mesh_hits found = tf::raycast_all(mesh.prepared(), all.piece(begin, end));
        for (std::size_t i = 0; i + 1 < found.begin.size(); ++i)
            for (std::size_t h = found.begin[i]; h < found.begin[i + 1]; ++h)
                hits.push_back({finite(found.hits[h].t, i), static_cast<std::uint32_t>(begin + i),
                                found.hits[h].face});
    });
    return py::make_tuple(column(hits, &numbered_hit::t), column(hits, &numbered_hit::ray),
                          column(hits, &numbered_hit::face));
}

}  // namespace

void add_nearness(py::module_& module) { add_job(module, "raycast_all", &raycast_all); }

}  // namespace binding
