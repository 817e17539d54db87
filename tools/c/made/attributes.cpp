// Made by tools/bindings of attributes.h and the headers of C++: see its README.
#include <tools/c/attributes.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

treeform_code treeform_carry(treeform_file* file, const treeform_carry_source* inputs, size_t count,
                             const treeform_element* face_source,
                             const treeform_element* vertex_source,
                             const treeform_element* face_of_cut_vertex) {
    return glue::guard([&] {
        glue::carry(glue::content(file, "file"), inputs, count, face_source, vertex_source,
                    face_of_cut_vertex);
    });
}

treeform_code treeform_carry_one(treeform_file* file, const treeform_carry_source* input,
                                 const uint32_t* face_source, const uint32_t* vertex_source,
                                 const uint32_t* face_of_new_vertex,
                                 const uint32_t* corner_source) {
    return glue::guard([&] {
        glue::carry_one(glue::content(file, "file"), input, face_source, vertex_source,
                        face_of_new_vertex, corner_source);
    });
}

treeform_code treeform_face_groups(const treeform_carry_source* inputs, size_t count,
                                   int32_t by_values, int32_t by_input,
                                   treeform_indices** indices) {
    return glue::guard([&] {
        glue::start(indices);
        return glue::give(glue::face_groups(inputs, count, by_values != 0, by_input != 0), indices);
    });
}

treeform_code treeform_corner_groups(const treeform_carry_source* input,
                                     treeform_indices** indices) {
    return glue::guard([&] {
        glue::start(indices);
        return glue::give(glue::corner_groups(input), indices);
    });
}

treeform_code treeform_add_source_columns(treeform_file* file, const char* name,
                                          const treeform_element* face_source,
                                          const char* const* inputs, size_t count) {
    return glue::guard([&] {
        glue::add_source_columns(glue::content(file, "file"),
                                 std::string(&glue::need(name, "name")), face_source,
                                 glue::texts(inputs, count, "inputs"));
    });
}

treeform_code treeform_color_distances(treeform_file* file, const double* distances, size_t count,
                                       double low, double high) {
    return glue::guard([&] {
        glue::color_distances(glue::content(file, "file"),
                              glue::array(distances, count, "distances"), low, high);
    });
}

treeform_code treeform_color_contacts(treeform_file* file, const uint8_t* relations, size_t count,
                                      double halo) {
    return glue::guard([&] {
        glue::color_contacts(glue::content(file, "file"),
                             glue::array(relations, count, "relations"), halo);
    });
}
