#include "bindings.hpp"
#include "state.hpp"

namespace binding {
namespace {

using tf::certificate;

std::string text_of(const certificate& c) {
    const std::string status = word_of(c.status);
    return c ? "Certificate(ok)" : "Certificate(" + status + ": " + c.message() + ")";
}

py::array_t<std::uint32_t> open_faces(const certificate& c) {
    return column(c.open, [](const tf::open_edge& edge) {
        return std::array<std::uint32_t, 2>{edge.face.operand, edge.face.index};
    });
}

py::array_t<double> open_edges(const certificate& c) {
    py::array_t<double> made(
        {static_cast<py::ssize_t>(c.open.size()), py::ssize_t{2}, py::ssize_t{3}});
    double* to = made.mutable_data();
    for (const tf::open_edge& edge : c.open)
        for (const tf::point3& end : edge.ends)
            for (std::size_t k = 0; k < 3; ++k) *to++ = end[k];
    return made;
}

}  // namespace
}  // namespace binding

namespace treeform {
/// Found by the type of `c`.
template <class State>
static void all_fields(State& state, certificate& c) {
    state(c.status, c.meeting_count, c.meeting, c.meeting_at, c.open_count, c.open,
          c.boundary_edges, c.misoriented_edges, c.max_displacement, c.precision, c.vanished_faces,
          c.size_before, c.size_after, c.size_is_volume);
}
}  // namespace treeform

namespace binding {

void add_certificates(py::module_& module) {
    py::class_<certificate>(module, "Certificate",
                            R"(What was checked about the coordinates of a result.

True where everything that the operation promises was checked, exactly, and holds.)")
        .def("__bool__", [](const certificate& c) { return static_cast<bool>(c); })
        .def("__repr__", &text_of)
        .def("__str__", &certificate::message)
        .def_property_readonly(
            "status", [](const certificate& c) { return word_of(c.status); },
            "'ok', or how the operation ended.")
        .def_property_readonly("message", &certificate::message, "Half a sentence for people.")
        .def_readonly("meeting_count", &certificate::meeting_count,
                      "Pairs of faces that meet where they should not.")
        .def_property_readonly(
            "meeting",
            [](const certificate& c) {
                return column(c.meeting, [](const auto& pair) { return pair; });
            },
            "(n, 2) uint32: the first 100 of these pairs.")
        .def_readonly("open_count", &certificate::open_count,
                      "Edges whose signed face count is not zero.")
        .def_property_readonly("open_edges", &open_edges,
                               "(n, 2, 3) float64: the ends of the first 100 of these edges.")
        .def_property_readonly("open_faces", &open_faces,
                               "(n, 2) uint32: the operand and the face at each of these edges.")
        .def_readonly("boundary_edges", &certificate::boundary_edges,
                      "Of the open edges, those of an odd number of faces.")
        .def_readonly("misoriented_edges", &certificate::misoriented_edges,
                      "Of the open edges, those of faces that run the same way.")
        .def_readonly("max_displacement", &certificate::max_displacement,
                      "Rounding moved no coordinate further than this.")
        .def_property_readonly(
            "precision", [](const certificate& c) { return word_of(c.precision); },
            "Of the coordinates: 'float32' or 'float64'.")
        .def_readonly("vanished_faces", &certificate::vanished_faces,
                      "Of 'vanished': faces of the exact result.")
        .def_readonly("size_before", &certificate::size_before,
                      "Of 'excessive_loss': volume or area before.")
        .def_readonly("size_after", &certificate::size_after, "The same after.")
        .def_readonly("size_is_volume", &certificate::size_is_volume, "Whether these are volumes.")
        .def(pickled<certificate>());
}

}  // namespace binding
