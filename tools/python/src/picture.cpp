#include "bindings.hpp"
#include "tools/picture/page.hpp"
#include "tools/picture/scene.hpp"
#include "tools/picture/sheet.hpp"

namespace binding {
namespace {

constexpr std::size_t most_colors = 200;  // further meshes share the last one

/// How to draw meshes, with marked faces and vertex values of the first one.
struct look {
    std::vector<std::string> names;
    std::vector<std::string> colors;  ///< "#rrggbb", one for each mesh
    std::string title;
    std::string verdict;
    bool y_is_up;
    ids_array marked;
    std::optional<array_of<double>> values;
    std::array<double, 2> limits;
    std::string label;
};

/// A scene of meshes, which refers to their points and to `faces`.
struct shown_meshes {
    tools::scene scene{};
    std::vector<std::vector<tf::face>> faces{};  ///< with finite coordinates
};

std::vector<std::uint8_t> marks_of(const look& how, std::size_t count, std::uint8_t marked_kind) {
    std::vector<std::uint8_t> kind(count, 0);
    for (const std::uint32_t f : rows_of<std::uint32_t>(how.marked)) {
        if (f >= count)
            throw std::invalid_argument("marked: there is no face " + std::to_string(f) + " of " +
                                        std::to_string(count));
        kind[f] = marked_kind;
    }
    return kind;
}

void add_faces(shown_meshes& all, tf::mesh_view mesh, std::uint8_t kind, const std::string& name) {
    tools::scene_mesh made{.kind = {kind}, .name = name};
    std::vector<tf::face>& faces = all.faces.emplace_back();
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (const std::uint32_t corner : mesh.faces[f])
            if (corner >= mesh.points.size())
                throw std::invalid_argument("faces: face " + std::to_string(f) +
                                            " has the vertex " + std::to_string(corner) + " of " +
                                            std::to_string(mesh.points.size()));
        if (!std::ranges::all_of(mesh.faces[f], [&](std::uint32_t corner) {
                return tools::is_finite(mesh.points[corner]);
            }))
            continue;
        faces.push_back(mesh.faces[f]);
        made.number.push_back(f);
    }
    made.mesh = {mesh.points, faces};
    all.scene.meshes.push_back(std::move(made));
}

void add_values(tools::scene& scene, const look& how, std::vector<double>& into) {
    const auto values = rows_of<double>(*how.values);
    into.assign(values.begin(), values.end());
    const auto [low, high] = how.limits;
    scene.map = {.name = how.label, .low = low, .high = high, .colors = {}};
    if (low < 0.0 && high > 0.0)
        scene.map->colors = {"#2166ac", "#f7f7f7", "#b2182b"};
    else
        scene.map->colors = {"#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"};
}

shown_meshes show(const held_meshes& meshes, const look& how) {
    shown_meshes all;
    tools::scene& scene = all.scene;
    scene.title = how.title;
    scene.verdict = how.verdict;
    scene.good = true;
    scene.y_is_up = how.y_is_up;
    scene.facts = {{"program", std::string("treeform ") + tf::version_string()}};
    const std::size_t colors = std::min(meshes.size(), most_colors);
    for (std::size_t i = 0; i < colors; ++i)
        scene.classes.push_back({how.names[i], how.colors[i], {}, true});
    const auto marked = static_cast<std::uint8_t>(colors);
    scene.classes.push_back({"marked", "#e02020"});
    all.faces.reserve(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto kind = static_cast<std::uint8_t>(std::min(i, colors - 1));
        const tf::mesh_view mesh = meshes[i]->view();
        const bool first_values = i == 0 && how.values.has_value();
        if (!mesh.faces.empty()) {
            add_faces(all, mesh, kind, how.names[i]);
            if (first_values) add_values(scene, how, scene.meshes.back().value);
        } else {
            scene.dots.push_back(
                {.points = {mesh.points.begin(), mesh.points.end()}, .kind = {kind}});
            if (first_values) add_values(scene, how, scene.dots.back().value);
        }
        if (i > 0 || how.marked.size() == 0) continue;
        const auto kinds = marks_of(how, mesh.faces.size(), marked);
        tools::scene_mesh& first = scene.meshes.front();
        first.kind.clear();
        for (const std::uint32_t f : first.number) first.kind.push_back(kinds[f]);
    }
    return all;
}

look look_of(const py::dict& asked) {
    return {.names = asked["names"].cast<std::vector<std::string>>(),
            .colors = asked["colors"].cast<std::vector<std::string>>(),
            .title = asked["title"].cast<std::string>(),
            .verdict = asked["verdict"].cast<std::string>(),
            .y_is_up = asked["y_is_up"].cast<bool>(),
            .marked = asked["marked"].cast<ids_array>(),
            .values = asked["values"].cast<std::optional<array_of<double>>>(),
            .limits = asked["limits"].cast<std::array<double, 2>>(),
            .label = asked["label"].cast<std::string>()};
}

std::vector<std::string> colors_of(std::size_t count) {
    std::vector<std::string> colors;
    for (std::size_t i = 0; i < count; ++i) colors.push_back(tools::scene_color(i));
    return colors;
}

tools::view view_of(const std::string& name) {
    const auto at = std::ranges::find(tools::view_names, name);
    return static_cast<tools::view>(at - tools::view_names.begin());
}

py::bytes picture(const held_meshes& meshes, const py::dict& asked,
                  const std::vector<std::string>& views, std::size_t width, std::size_t height) {
    const look how = look_of(asked);
    tools::picture_options options{.width = width, .height = height, .views = {}};
    options.views = list_of(views, view_of);
    return run([&](const tf::progress_callback&) {
        const shown_meshes all = show(meshes, how);
        return tools::png(tools::draw(all.scene, options));
    });
}

py::str page(const held_meshes& meshes, const py::dict& asked) {
    const look how = look_of(asked);
    return run([&](const tf::progress_callback&) { return tools::html(show(meshes, how).scene); });
}

}  // namespace

void add_pictures(py::module_& module) {
    module.attr("VIEWS") = py::cast(std::vector<std::string>(
        tools::view_names.begin(), tools::view_names.end()));  // -> list[str]
    module.attr("PICTURE_SIDES") =
        py::make_tuple(tools::least_side, tools::most_side);  // -> tuple[int, int]
    module.def("colors", &colors_of);
    add_job(module, "picture", &picture, job_kind::long_work);
    add_job(module, "page", &page, job_kind::long_work);
}

}  // namespace binding
