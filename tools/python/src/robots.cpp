#include "bindings.hpp"

namespace binding {
namespace {

struct robot {
    tf::urdf_robot content{};
    tf::robot_parts parts{};
};

py::list joints_of(const tf::urdf_robot& of) {
    py::list all;
    for (const tf::urdf_joint& one : of.joints) {
        const auto limits = one.limits
                                ? py::object(py::make_tuple((*one.limits)[0], (*one.limits)[1]))
                                : py::object(py::none());
        all.append(py::make_tuple(one.name, word_of(one.kind), of.links[one.parent],
                                  of.links[one.child], limits));
    }
    return all;
}

/// The robot, its name, links, joints, parts, links of parts, adjacent parts, and what is
/// approximated or no mesh.
py::tuple read_urdf(const std::filesystem::path& path,
                    const std::vector<std::filesystem::path>& package_folders, bool visual) {
    robot made = run([&](const tf::progress_callback& report) {
        tf::urdf_robot content =
            tf::read_urdf(path, {.visual = visual, .package_folders = package_folders});
        double files = 0.0;
        tf::robot_parts all = content.parts([&](const std::filesystem::path& file) {
            const double share = files++ / static_cast<double>(content.meshes.size());
            if (report && !report(share)) throw cancelled();
            return tf::as_mesh(tf::read(file)).mesh;
        });
        return robot{std::move(content), std::move(all)};
    });
    py::list parts;
    for (tf::mesh& part : made.parts.parts)
        parts.append(
            py::make_tuple(as_array(std::move(part.points)), as_array(std::move(part.faces))));
    const py::list joints = joints_of(made.content);
    py::array adjacent = column(made.parts.adjacent, [](const auto& pair) { return pair; });
    return py::make_tuple(made, made.content.name, made.content.links, joints, parts,
                          made.parts.links, adjacent, made.content.approximated,
                          made.content.skipped);
}

/// [P][N][4][4] where the parts are, for values [P][J] of the joints of these names.
py::array_t<double> poses(const robot& of, const std::vector<std::string>& joints,
                          const array_of<double>& values) {
    if (values.ndim() != 2 || static_cast<std::size_t>(values.shape(1)) != joints.size())
        throw std::invalid_argument("treeform: not a value for each joint");
    const auto count = static_cast<std::size_t>(values.shape(0));
    py::array_t<double> made({count, of.parts.links.size(), std::size_t{4}, std::size_t{4}});
    double* to = made.mutable_data();
    std::map<std::string, double> given;
    for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t j = 0; j < joints.size(); ++j)
            given[joints[j]] = values.data()[p * joints.size() + j];
        const auto places = of.content.link_transforms(given);
        for (const std::uint32_t link : of.parts.links) {
            for (const auto& row : places[link].rows) to = std::copy(row.begin(), row.end(), to);
            for (const double entry : {0.0, 0.0, 0.0, 1.0}) *to++ = entry;
        }
    }
    return made;
}

}  // namespace

void add_robots(py::module_& module) {
    py::class_<robot>(module, "RobotData").def("poses", &poses);
    add_job(module, "read_urdf", &read_urdf, job_kind::long_work);
}

}  // namespace binding
