#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/placement.hpp>

#include <tools/c/glue.hpp>

namespace tf = treeform;

namespace {

void add(tf::body_set& to, const tf::mesh_file& file, std::string label, treeform_body_kind kind) {
    const std::string name = label;
    if (kind == TREEFORM_BODY_FILE)
        to.add(file, std::move(label), name);
    else if (kind == TREEFORM_BODY_PARTS)
        to.add_parts(file, std::move(label), name);
    else
        to.add_named_parts(file, std::move(label), name);
}

std::vector<std::uint32_t> faces_in_file(const tf::body_set& set, std::size_t body) {
    std::vector<std::uint32_t> faces(set.shapes[body].view().faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) faces[f] = set.stored_face(body, f);
    return faces;
}

void fill(glue::answer<treeform_bodies>& made, const tf::body_set& set) {
    const std::size_t count = set.bodies.size();
    auto& handles = made.keep(std::vector<treeform_mesh>(count));
    std::vector<const treeform_mesh*> meshes(count);
    std::vector<treeform_body> bodies(count);
    for (std::size_t i = 0; i < count; ++i) {
        handles[i].prepared = &set.shapes[i];
        handles[i].set = set.shapes.data();
        meshes[i] = &handles[i];
        const auto& faces = made.keep(faces_in_file(set, i));
        bodies[i] = {&handles[i],
                     static_cast<std::uint32_t>(set.bodies[i].file),
                     set.bodies[i].name.c_str(),
                     made.keep(set.label(i)).c_str(),
                     faces.data(),
                     faces.size()};
    }
    made.value.meshes = made.keep(std::move(meshes)).data();
    made.value.bodies = made.keep(std::move(bodies)).data();
    made.value.count = count;
}

}  // namespace

treeform_code treeform_bodies_of(const treeform_file* const* files, const char* const* labels,
                                 size_t count, treeform_body_kind kind, treeform_bodies** bodies) {
    return glue::guard([&] {
        glue::start(bodies);
        (void)glue::choice<int>(kind, 3, "kind");
        const std::vector<std::string> names = glue::texts(labels, count, "labels");
        auto made = glue::make<treeform_bodies>();
        auto& set = made->keep(tf::body_set{});
        for (std::size_t i = 0; i < count; ++i)
            add(set, glue::need(glue::array(files, count, "files")[i], "files").content, names[i],
                kind);
        fill(*made, set);
        glue::give(std::move(made), bodies);
    });
}

treeform_code treeform_put_back(treeform_bodies* bodies, size_t body, const double* points,
                                size_t count, const double* matrix, treeform_precision written_as,
                                treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        auto* const owner = dynamic_cast<glue::answer<treeform_bodies>*>(
            static_cast<glue::owned*>(glue::need(bodies, "bodies").owner));
        if (!owner) throw std::invalid_argument("bodies are none of this library");
        auto& set = *static_cast<tf::body_set*>(owner->kept[0].get());
        if (body >= set.bodies.size())
            throw std::invalid_argument("body " + std::to_string(body) + " is not there");
        const std::size_t wanted = set.shapes[body].view().points.size();
        if (count != wanted)
            throw std::invalid_argument(std::to_string(count) + " points for a body of " +
                                        std::to_string(wanted));
        const tf::transform<3> by = glue::matrix(&glue::need(matrix, "matrix"));
        if (!by.finite()) throw std::invalid_argument("the matrix is not finite");
        set.put_back(body, glue::points(points, count, "points"), by, glue::precision(written_as));
        glue::give(tf::mesh_file(set.file_of(body).content), file);
    });
}
