#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/placement.hpp>

#include <tools/c/glue.hpp>
#include <tools/c/inputs.hpp>

namespace tf = treeform;

namespace {

std::size_t faces_of(const tf::carry_source& input) { return input.file->mesh.faces.size(); }

/// Elements of the operands, each of which is there; `count_of(input)` is how many there are.
template <class CountOf>
std::span<const tf::operand_element> elements(const treeform_element* data, std::size_t count,
                                              const char* name,
                                              std::span<const tf::carry_source> inputs,
                                              const CountOf& count_of) {
    static_assert(sizeof(treeform_element) == sizeof(tf::operand_element));
    for (const treeform_element& one : glue::array(data, count, name))
        if (one.operand != TREEFORM_NONE &&
            (one.operand >= inputs.size() || one.index >= count_of(inputs[one.operand])))
            throw std::invalid_argument(std::string(name) + " names element " +
                                        std::to_string(one.index) + " of operand " +
                                        std::to_string(one.operand) + ", which is not there");
    return {reinterpret_cast<const tf::operand_element*>(data), count};
}

std::span<const std::uint32_t> numbers(const std::uint32_t* data, std::size_t count,
                                       const char* name, std::size_t limit) {
    const std::span all = glue::array(data, count, name);
    for (const std::uint32_t one : all)
        if (one != TREEFORM_NONE && one >= limit)
            throw std::invalid_argument(std::string(name) + " names " + std::to_string(one) +
                                        ", which is not there");
    return all;
}

}  // namespace

glue::carry_inputs::carry_inputs(const treeform_carry_source* inputs, std::size_t count) {
    for (const treeform_carry_source& one : array(inputs, count, "inputs")) {
        const tf::mesh_file* file = &need(one.file, "the file of an input").content;
        if (!one.triangle_of_face) {
            sources_.push_back({file, {}});
            continue;
        }
        const std::span<const std::uint32_t> seen{one.triangle_of_face, one.face_count};
        tf::mesh_file& copy = files_.emplace_back(*file);
        copy.mesh.faces.clear();
        for (const std::uint32_t triangle : seen) {
            if (triangle >= file->mesh.faces.size())
                throw std::invalid_argument("triangle " + std::to_string(triangle) +
                                            " is none of the file of an input");
            copy.mesh.faces.push_back(file->mesh.faces[triangle]);
        }
        sources_.push_back({&copy, seen});
    }
}

template <class Find>
static treeform_code give_groups(const treeform_carry_source* inputs, size_t count,
                                 treeform_indices** groups, const Find& find) {
    return glue::guard([&] {
        glue::start(groups);
        auto made = glue::make<treeform_indices>();
        const glue::carry_inputs files(inputs, count);
        const auto& found =
            made->keep(find(tf::carry_sources({files.sources().begin(), files.sources().end()})));
        made->value.values = found.data();
        made->value.count = found.size();
        glue::give(std::move(made), groups);
    });
}

treeform_code treeform_carry(treeform_file* file, const treeform_carry_source* inputs, size_t count,
                             const treeform_element* face_source,
                             const treeform_element* vertex_source,
                             const treeform_element* face_of_cut_vertex) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const glue::carry_inputs files(inputs, count);
        const std::span from = files.sources();
        const auto points = [](const tf::carry_source& s) { return s.file->mesh.points.size(); };
        tf::carried_elements made;
        made.face_source =
            elements(face_source, to.mesh.faces.size(), "face_source", from, faces_of);
        made.vertex_source =
            elements(vertex_source, to.mesh.points.size(), "vertex_source", from, points);
        if (face_of_cut_vertex)
            made.face_of_cut_vertex = elements(face_of_cut_vertex, to.mesh.points.size(),
                                               "face_of_cut_vertex", from, faces_of);
        tf::carry_sources({from.begin(), from.end()}).carry(to, made);
    });
}

treeform_code treeform_carry_one(treeform_file* file, const treeform_carry_source* input,
                                 const uint32_t* face_source, const uint32_t* vertex_source,
                                 const uint32_t* face_of_new_vertex,
                                 const uint32_t* corner_source) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const glue::carry_inputs files(input, 1);
        const tf::carry_source from = files.sources()[0];
        const std::size_t points = to.mesh.points.size(), faces = to.mesh.faces.size();
        std::span<const std::uint32_t> of_new, corners;
        if (face_of_new_vertex != nullptr)
            of_new = numbers(face_of_new_vertex, points, "face_of_new_vertex", faces_of(from));
        if (corner_source != nullptr)
            corners = numbers(corner_source, 3 * faces, "corner_source", 3 * faces_of(from));
        tf::carry_sources(from).carry(
            to, numbers(face_source, faces, "face_source", faces_of(from)),
            numbers(vertex_source, points, "vertex_source", from.file->mesh.points.size()), of_new,
            corners);
    });
}

treeform_code treeform_face_groups(const treeform_carry_source* inputs, size_t count,
                                   int32_t by_values, int32_t by_input, treeform_indices** groups) {
    return give_groups(inputs, count, groups, [&](const tf::carry_sources& all) {
        return all.face_groups(by_values != 0, by_input != 0);
    });
}

treeform_code treeform_corner_groups(const treeform_carry_source* input,
                                     treeform_indices** groups) {
    return give_groups(input, 1, groups,
                       [](const tf::carry_sources& all) { return all.corner_groups(); });
}

treeform_code treeform_add_source_columns(treeform_file* file, const char* name,
                                          const treeform_element* face_source,
                                          const char* const* inputs, size_t count) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        (void)glue::need(name, "name");
        const std::size_t faces = to.mesh.faces.size();
        (void)glue::array(face_source, faces, "face_source");
        tf::set_source_columns(to, name,
                               {reinterpret_cast<const tf::operand_element*>(face_source), faces},
                               glue::texts(inputs, count, "inputs"));
    });
}

treeform_code treeform_color_distances(treeform_file* file, const double* distances, size_t count,
                                       double low, double high) {
    return glue::guard([&] {
        tf::deviation_result::color(glue::need(file, "file").content,
                                    glue::array(distances, count, "distances"), low, high);
    });
}

treeform_code treeform_color_contacts(treeform_file* file, const uint8_t* classes, size_t count,
                                      double halo) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        std::vector<tf::contact_class> all;
        for (const std::uint8_t one : glue::array(classes, count, "classes"))
            all.push_back(glue::choice<tf::contact_class>(one, 4, "a class"));
        tf::contact_color_options how;
        how.halo = halo;
        tf::contact_classes::color(to, all, how);
    });
}
