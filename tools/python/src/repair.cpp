#include "bindings.hpp"

namespace binding {
namespace {

py::tuple join_equal_points(const held_mesh& mesh) {
    const carrying attributes({&mesh});
    std::vector<std::uint32_t> first, faces(mesh.view().faces.size());
    tf::mesh joined = run([&](const tf::progress_callback&) {
        if (!mesh.data().is_none())
            first = tf::find_equal_points(mesh.view().points).first_of_group;
        return tf::join_equal_points(mesh.view());
    });
    std::iota(faces.begin(), faces.end(), 0U);
    const py::object data = attributes.to(joined, faces, first);
    return py::make_tuple(as_array(std::move(joined.points)), as_array(std::move(joined.faces)),
                          data);
}

}  // namespace

void add_repair(py::module_& module) { add_job(module, "join_equal_points", &join_equal_points); }

}  // namespace binding
