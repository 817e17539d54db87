// Made by tools/bindings of base.h and the headers of C++: see its README.
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static_assert(TREEFORM_FLOAT32 == static_cast<int>(tf::precision::float32));
static_assert(TREEFORM_FLOAT64 == static_cast<int>(tf::precision::float64));
static_assert(TREEFORM_BY_COORDINATES == static_cast<int>(tf::vertex_identity::by_coordinates));
static_assert(TREEFORM_BY_INDEX == static_cast<int>(tf::vertex_identity::by_index));
static_assert(TREEFORM_STATUS_OK == static_cast<int>(tf::status::ok));
static_assert(TREEFORM_STATUS_OPEN_INPUT == static_cast<int>(tf::status::open_input));
static_assert(TREEFORM_STATUS_SHEET == static_cast<int>(tf::status::sheet));
static_assert(TREEFORM_STATUS_EXCESSIVE_LOSS == static_cast<int>(tf::status::excessive_loss));
static_assert(TREEFORM_STATUS_NOT_MANIFOLD == static_cast<int>(tf::status::not_manifold));
static_assert(TREEFORM_STATUS_NOT_CERTIFIED == static_cast<int>(tf::status::not_certified));
static_assert(TREEFORM_STATUS_VANISHED == static_cast<int>(tf::status::vanished));
static_assert(TREEFORM_STATUS_OUT_OF_RANGE == static_cast<int>(tf::status::out_of_range));
static_assert(TREEFORM_STATUS_NO_PLACEMENT == static_cast<int>(tf::status::no_placement));
static_assert(TREEFORM_STATUS_CANCELLED == static_cast<int>(tf::status::cancelled));

static_assert(sizeof(treeform_element) == sizeof(tf::operand_element));
static_assert(offsetof(treeform_element, operand) == offsetof(tf::operand_element, operand));
static_assert(offsetof(treeform_element, index) == offsetof(tf::operand_element, index));

static_assert(sizeof(treeform_search_effort) == sizeof(tf::search_effort));
static_assert(offsetof(treeform_search_effort, pairs) == offsetof(tf::search_effort, pairs));
static_assert(offsetof(treeform_search_effort, bound) == offsetof(tf::search_effort, bound));
static_assert(offsetof(treeform_search_effort, cut) == offsetof(tf::search_effort, cut));

void glue::fill(keeper& kept, const tf::certificate& from, treeform_certificate& to) {
    to.status = static_cast<treeform_status>(from.status);
    to.meeting_count = from.meeting_count;
    to.meeting = flat(from.meeting);
    to.meeting_listed = from.meeting.size();
    to.meeting_at = flat(from.meeting_at);
    to.open_count = from.open_count;
    to.open_edges = flat(from.open_edges);
    to.open_listed = from.open_edges.size();
    to.open_faces = same<treeform_element>(from.open_faces);
    to.boundary_edges = from.boundary_edges;
    to.misoriented_edges = from.misoriented_edges;
    to.max_displacement = from.max_displacement;
    to.precision = static_cast<treeform_precision>(from.precision);
    to.vanished_faces = from.vanished_faces;
    to.size_before = from.size_before;
    to.size_after = from.size_after;
    to.size_is_volume = from.size_is_volume;
    to.message = kept.keep(from.message()).c_str();
}

void glue::fill(keeper&, const std::vector<std::uint32_t>& from, treeform_indices& to) {
    to.values = from.data();
    to.count = from.size();
}

void glue::fill(keeper& kept, const std::vector<std::string>& from, treeform_strings& to) {
    to.values = words(kept, from);
    to.count = from.size();
}
