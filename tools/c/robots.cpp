#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>

#include <tools/c/made/structs.hpp>

#include <limits>

namespace tf = treeform;

struct treeform_robot {
    void* owner;
    treeform::urdf_robot content;
};

treeform_code treeform_read_urdf(const char* path, const treeform_robot_options* options,
                                 treeform_robot** robot) {
    return glue::guard([&] {
        glue::start(robot);
        auto made = glue::make<treeform_robot>();
        made->value.content = tf::read_urdf(&glue::need(path, "path"), glue::read(options));
        glue::give(std::move(made), robot);
    });
}

treeform_code treeform_robot_look(const treeform_robot* robot, treeform_robot_view** view) {
    return glue::guard([&] {
        glue::start(view);
        const tf::urdf_robot& from = glue::need(robot, "robot").content;
        auto made = glue::make<treeform_robot_view>();
        glue::fill(*made, from, made->value);
        glue::give(std::move(made), view);
    });
}

treeform_code treeform_robot_parts_of(const treeform_robot* robot, treeform_robot_parts** parts) {
    return glue::guard([&] {
        glue::start(parts);
        auto made = glue::make<treeform_robot_parts>();
        auto& from = made->keep(
            glue::need(robot, "robot").content.parts([](const std::filesystem::path& file) {
                return tf::as_mesh(tf::read(file)).mesh;
            }));
        auto& shapes = made->keep(std::vector<tf::prepared_mesh>());
        for (tf::mesh& part : from.parts) shapes.emplace_back(std::move(part));
        auto& handles = made->keep(std::vector<treeform_mesh>(shapes.size()));
        std::vector<const treeform_mesh*> meshes;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            handles[i].prepared = &shapes[i];
            handles[i].set = shapes.data();
            meshes.push_back(&handles[i]);
        }
        made->value.meshes = made->keep(std::move(meshes)).data();
        made->value.links = from.links.data();
        made->value.count = from.links.size();
        made->value.adjacent = from.adjacent.empty() ? nullptr : from.adjacent[0].data();
        made->value.adjacent_count = from.adjacent.size();
        glue::give(std::move(made), parts);
    });
}

treeform_code treeform_link_transforms(const treeform_robot* robot, const char* const* joints,
                                       const double* values, size_t count, double* places) {
    return glue::guard([&] {
        const tf::urdf_robot& from = glue::need(robot, "robot").content;
        const std::vector<std::string> names = glue::texts(joints, count, "joints");
        const std::span all = glue::array(values, count, "values");
        std::vector<tf::joint_value> given;
        for (std::size_t i = 0; i < count; ++i) given.push_back({names[i], all[i]});
        const auto found = from.link_transforms(given);
        (void)glue::array(places, 12 * found.size(), "places");
        for (std::size_t i = 0; i < found.size(); ++i) glue::copy(found[i], places + 12 * i);
    });
}
