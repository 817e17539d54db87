#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>

#include <tools/c/glue.hpp>

#include <limits>

namespace tf = treeform;

struct treeform_robot {
    void* owner;
    treeform::urdf_robot content;
};

namespace {

treeform_robot_joint joint_of(const tf::urdf_joint& from) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {from.name.c_str(),
            static_cast<std::int32_t>(from.kind),
            from.parent,
            from.child,
            from.limits ? (*from.limits)[0] : none,
            from.limits ? (*from.limits)[1] : none};
}

}  // namespace

void treeform_robot_options_init(treeform_robot_options* options, size_t size) {
    glue::init(options, size, treeform_robot_options{});
}

treeform_code treeform_read_urdf(const char* path, const treeform_robot_options* options,
                                 treeform_robot** robot) {
    return glue::guard([&] {
        glue::start(robot);
        const auto o = glue::chosen(options, treeform_robot_options_init);
        tf::urdf_options how;
        how.visual = o.visual != 0;
        for (const std::string& one :
             glue::texts(o.package_folders, o.package_folder_count, "package_folders"))
            how.package_folders.emplace_back(one);
        auto made = glue::make<treeform_robot>();
        made->value.content = tf::read_urdf(&glue::need(path, "path"), how);
        glue::give(std::move(made), robot);
    });
}

treeform_code treeform_robot_look(const treeform_robot* robot, treeform_robot_view** view) {
    return glue::guard([&] {
        glue::start(view);
        const tf::urdf_robot& from = glue::need(robot, "robot").content;
        auto made = glue::make<treeform_robot_view>();
        treeform_robot_view& v = made->value;
        v.name = from.name.c_str();
        v.links = glue::words(*made, from.links);
        v.link_count = from.links.size();
        std::vector<treeform_robot_joint> joints;
        for (const tf::urdf_joint& one : from.joints) joints.push_back(joint_of(one));
        v.joints = made->keep(std::move(joints)).data();
        v.joint_count = from.joints.size();
        std::vector<treeform_robot_mesh> meshes;
        for (const tf::urdf_mesh& one : from.meshes) {
            treeform_robot_mesh& mesh = meshes.emplace_back();
            mesh.link = one.link;
            mesh.file = made->keep(one.file.string()).c_str();
            glue::copy(one.place, mesh.place);
            mesh.points = one.shape.points.empty() ? nullptr : &one.shape.points[0].x;
            mesh.point_count = one.shape.points.size();
            mesh.faces = one.shape.faces.empty() ? nullptr : one.shape.faces[0].data();
            mesh.face_count = one.shape.faces.size();
        }
        v.meshes = made->keep(std::move(meshes)).data();
        v.mesh_count = from.meshes.size();
        const auto& adjacent = made->keep(from.adjacent());
        v.adjacent = adjacent.empty() ? nullptr : adjacent.data()->data();
        v.adjacent_count = adjacent.size();
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
