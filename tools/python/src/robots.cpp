#include "arrays.hpp"
#include "bindings.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

constexpr words<4> joint_words{"fixed", "revolute", "continuous", "prismatic"};

/// A robot, and for each link that has meshes these as one, in the link's frame.
struct robot {
    tf::urdf_robot content{};
    std::vector<std::uint32_t> link_of_part{};
    std::vector<tf::mesh> parts{};
};

void add_part(robot& to, std::uint32_t link) {
    tf::mesh joined;
    for (const tf::urdf_mesh& one : to.content.meshes) {
        if (one.link != link) continue;
        const tf::mesh mesh = one.file.empty() ? one.shape : tf::as_mesh(tf::read(one.file)).mesh;
        const auto first = static_cast<std::uint32_t>(joined.points.size());
        for (const tf::point3& p : mesh.points) joined.points.push_back(one.place(p));
        for (const auto& [a, b, c] : mesh.faces)
            joined.faces.push_back({first + a, first + b, first + c});
    }
    if (joined.faces.empty()) return;
    to.link_of_part.push_back(link);
    to.parts.push_back(std::move(joined));
}

/// Pairs of parts whose links are next to each other.
std::vector<std::array<std::uint32_t, 2>> adjacent_parts(const robot& of) {
    const auto part_of = [&](std::uint32_t link) {
        return std::ranges::find(of.link_of_part, link) - of.link_of_part.begin();
    };
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto& [a, b] : of.content.adjacent()) {
        const auto count = static_cast<std::ptrdiff_t>(of.parts.size());
        if (const auto m = part_of(a), n = part_of(b); m < count && n < count)
            pairs.push_back({static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(n)});
    }
    return pairs;
}

py::list joints_of(const tf::urdf_robot& of) {
    py::list all;
    for (const tf::urdf_joint& one : of.joints) {
        const auto limits = one.limits
                                ? py::object(py::make_tuple((*one.limits)[0], (*one.limits)[1]))
                                : py::object(py::none());
        all.append(py::make_tuple(one.name, word_of(joint_words, one.kind), of.links[one.parent],
                                  of.links[one.child], limits));
    }
    return all;
}

/// The robot, its name, links, joints, parts, links of parts, adjacent parts, and what is approximated or
/// no mesh.
py::tuple read_urdf(const std::filesystem::path& path,
                    const std::vector<std::filesystem::path>& package_folders, bool visual) {
    robot made = run([&](const tf::progress_callback& report) {
        robot all{.content =
                      tf::read_urdf(path, {.visual = visual, .package_folders = package_folders})};
        const std::size_t links = all.content.links.size();
        for (std::uint32_t link = 0; link < links; ++link) {
            if (report && !report(static_cast<double>(link) / static_cast<double>(links))) break;
            add_part(all, link);
        }
        return all;
    });
    py::list parts;
    for (tf::mesh& part : made.parts)
        parts.append(
            py::make_tuple(as_array(std::move(part.points)), as_array(std::move(part.faces))));
    const py::list joints = joints_of(made.content);
    py::array adjacent = column(adjacent_parts(made), [](const auto& pair) { return pair; });
    return py::make_tuple(made, made.content.name, made.content.links, joints, parts,
                          made.link_of_part, adjacent, made.content.approximated,
                          made.content.skipped);
}

/// [P][N][4][4] where the parts are, for values [P][J] of the joints of these names.
py::array_t<double> poses(const robot& of, const std::vector<std::string>& joints,
                          const array_of<double>& values) {
    if (values.ndim() != 2 || static_cast<std::size_t>(values.shape(1)) != joints.size())
        throw std::invalid_argument("treeform: not a value for each joint");
    const auto count = static_cast<std::size_t>(values.shape(0));
    py::array_t<double> made({count, of.link_of_part.size(), std::size_t{4}, std::size_t{4}});
    double* to = made.mutable_data();
    std::vector<tf::joint_value> given;
    for (const std::string& name : joints) given.push_back({name, 0.0});
    for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t j = 0; j < joints.size(); ++j)
            given[j].value = values.data()[p * joints.size() + j];
        const auto places = tf::link_transforms(of.content, given);
        for (const std::uint32_t link : of.link_of_part) {
            for (const auto& row : places[link].rows) to = std::copy(row.begin(), row.end(), to);
            for (const double entry : {0.0, 0.0, 0.0, 1.0}) *to++ = entry;
        }
    }
    return made;
}

}  // namespace

void add_robots(py::module_& module) {
    py::class_<robot>(module, "RobotData").def("poses", &poses);
    module.def("read_urdf", &read_urdf);
}

}  // namespace binding
