#include "parts.hpp"

#include <treeform/tree/transform.hpp>

#include <string>

namespace binding {

py::object volumes_of(const tf::boolean_result& from) {
    const auto& v = from.volumes;
    return v ? py::object(py::make_tuple(v->first, v->second, v->either, v->both)) : py::none();
}

py::object contacts_of(const tf::placement& at) {
    using contact = tf::placement_contact;
    constexpr std::uint32_t no_face = tf::operand_element::none;
    py::dict made;
    made["points"] = column(at.contacts, [](const contact& c) { return numbers(c.point); });
    made["normals"] = column(at.contacts, [](const contact& c) { return numbers(c.normal); });
    made["moving"] = column(at.contacts, [](const contact& c) { return c.moving; });
    made["fixed_face"] =
        column(at.contacts, [=](const contact& c) { return c.fixed_face.value_or(no_face); });
    made["fixed"] =
        column(at.contacts, [](const contact& c) { return static_cast<std::uint32_t>(c.fixed); });
    return object_of("treeform._placement", "Contacts", made);
}

py::list regions_of(tf::part_clash& from) {
    py::list regions;
    for (tf::contact_region& region : from.regions)
        regions.append(py::make_tuple(value_of(region.box), region.face_pairs,
                                      as_array(std::move(region.faces_a)),
                                      as_array(std::move(region.faces_b))));
    return regions;
}

py::list warnings_of(const tf::weld_stream_result& from) {
    py::list warnings;
    for (const tf::io_warning& one : from.survey.warnings) warnings.append(one.text);
    for (const auto* const written : {&from.written.welded, &from.written.removed})
        if (*written)
            for (const tf::io_warning& one : (*written)->warnings) warnings.append(one.text);
    return warnings;
}

py::object mesh_object(tf::mesh&& mesh, const py::object& certificate, const py::object& data) {
    return py::module_::import("treeform._mesh")
        .attr("Mesh")
        .attr("_of")(as_array(std::move(mesh.points)), as_array(std::move(mesh.faces)), certificate,
                     data);
}

py::object moved_mesh(std::vector<tf::point3>&& points, const held_mesh& body,
                      const tf::transform<3>& matrix, const py::object& certificate) {
    const py::tuple turned = turned_over(body, matrix);
    const py::object there =
        points.empty() ? py::object(body.points()) : as_array(std::move(points));
    return py::module_::import("treeform._mesh")
        .attr("Mesh")
        .attr("_of")(there, turned[0], certificate, turned[1]);
}

}  // namespace binding
