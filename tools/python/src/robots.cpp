#include "bindings.hpp"

namespace binding {
namespace {

py::object read_urdf(const std::filesystem::path& path,
                     const std::vector<std::filesystem::path>& package_folders, bool visual) {
    std::vector<tf::urdf_mesh> parts;
    tf::urdf_robot made = run([&](const tf::progress_callback& report) {
        tf::urdf_robot content = tf::read_urdf(path, package_folders, visual);
        double files = 0.0;
        parts = content.parts([&](const std::filesystem::path& file) {
            const double share = files++ / static_cast<double>(content.meshes.size());
            if (report && !report(share)) throw cancelled();
            return tf::as_mesh(tf::read(file)).mesh;
        });
        return content;
    });
    return object(of_result{}, std::move(made), parts);
}

/// [P][N][4][4] the transforms of the parts, for values [P][J] of the joints with these names.
py::array_t<double> poses(const robot_data& of, const std::vector<std::string>& joints,
                          const array_of<double>& values) {
    if (values.ndim() != 2 || static_cast<std::size_t>(values.shape(1)) != joints.size())
        throw std::invalid_argument("treeform: expected a value for each joint");
    const auto count = static_cast<std::size_t>(values.shape(0));
    py::array_t<double> made({count, of.links.size(), std::size_t{4}, std::size_t{4}});
    double* to = made.mutable_data();
    std::map<std::string, double> given;
    for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t j = 0; j < joints.size(); ++j)
            given[joints[j]] = values.data()[p * joints.size() + j];
        const auto places = of.content.link_transforms(given);
        for (const std::uint32_t link : of.links) to = put(places[link], to);
    }
    return made;
}

}  // namespace

void add_robots(py::module_& module) {
    py::class_<robot_data>(module, "RobotData").def("poses", &poses);
    add_job(module, "read_urdf", &read_urdf, job_kind::long_work);  // -> Robot
}

}  // namespace binding
