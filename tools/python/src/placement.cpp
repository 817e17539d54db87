#include "bindings.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

constexpr words<14> end_words{"contact",
                              "bed",
                              "stays",
                              "moved_apart",
                              "nothing_met",
                              "too_far",
                              "starts_penetrating",
                              "starts_too_near",
                              "starts_touching",
                              "starts_below_bed",
                              "no_coordinates",
                              "too_many_steps",
                              "out_of_range",
                              "cancelled"};
constexpr words<3> relation_words{"separate", "touching", "penetrating"};
constexpr std::uint32_t no_face = 0xFFFFFFFF;

py::tuple contacts_of(const tf::placement& at) {
    using contact = tf::placement_contact;
    return py::make_tuple(
        column(at.contacts, [](const contact& c) { return numbers(c.point); }),
        column(at.contacts, [](const contact& c) { return numbers(c.normal); }),
        column(at.contacts, [](const contact& c) { return c.moving; }),
        column(at.contacts, [](const contact& c) { return c.fixed_face.value_or(no_face); }),
        column(at.contacts, [](const contact& c) { return static_cast<std::uint32_t>(c.fixed); }));
}

py::dict as_dict(const tf::mesh_measure& m) {
    py::dict made;
    made["relation"] = word_of(relation_words, m.relation.relation);
    made["distance"] = m.distance;
    made["surface_distance"] = m.surface_distance;
    made["on_a"] = as_array(m.on_a.point);
    made["on_b"] = as_array(m.on_b.point);
    made["face_a"] = m.on_a.face;
    made["face_b"] = m.on_b.face;
    made["a_inside_b"] = m.relation.a_inside_b;
    made["b_inside_a"] = m.relation.b_inside_a;
    return made;
}

py::tuple as_tuple(const tf::search_effort& e) { return py::make_tuple(e.pairs, e.bound, e.cut); }

py::dict as_dict(tf::placement&& at) {
    py::dict made;
    made["end"] = word_of(end_words, at.end);
    made["message"] = at.message();
    made["matrix"] = as_array(at.matrix);
    made["direction"] = as_array(at.direction);
    made["travel"] = at.travel;
    made["at_start"] = word_of(standing_words, at.at_start);
    made["at_place"] = word_of(standing_words, at.at_place);
    made["contacts"] = contacts_of(at);
    made["contact_count"] = at.contact_count;
    made["nearest"] = py::none();
    if (at.nearest) made["nearest"] = py::make_tuple(at.nearest->fixed, as_dict(at.nearest->how));
    made["certificate"] = std::move(at.certificate);
    made["effort"] = as_tuple(at.effort);
    made["points"] = as_array(std::move(at.points));
    return made;
}

/// `f` of the fixed mesh, with what it has indexed, or of several.
template <class F>
auto with_fixed(const held_meshes& fixed, const F& f) {
    if (fixed.size() == 1) return f(fixed[0]->prepared());
    const std::vector<tf::prepared_mesh> all = borrowed(fixed);
    return f(std::span<const tf::prepared_mesh>(all));
}

/// `verb(moving, fixed, options)` as a job.
template <class Options, class Verb>
auto place(const held_mesh& moving, const held_meshes& fixed, Options options, const Verb& verb) {
    return run([&](const tf::progress_callback& report) {
        options.progress = report;
        return with_fixed(fixed,
                          [&](const auto& all) { return verb(moving.prepared(), all, options); });
    });
}

py::dict slide(const held_mesh& moving, const held_meshes& fixed, const array_of<double>& direction,
               double clearance, std::optional<double> max_travel, std::optional<double> bed,
               const std::string& precision) {
    const tf::slide_options options{.clearance = clearance,
                                    .max_travel = max_travel,
                                    .precision = precision_of(precision),
                                    .bed = bed};
    const tf::point3 along = point_of(direction);
    return as_dict(place(moving, fixed, options,
                         [&](const auto& m, const auto& all, const tf::slide_options& o) {
                             return tf::slide(m, all, along, o);
                         }));
}

py::dict drop(const held_mesh& moving, const held_meshes& fixed, double clearance,
              std::optional<double> max_travel, std::optional<double> bed,
              const array_of<double>& direction, const std::string& precision) {
    tf::drop_options options{.clearance = clearance,
                             .max_travel = max_travel,
                             .precision = precision_of(precision),
                             .bed = bed,
                             .direction = point_of(direction)};
    if (fixed.empty())
        return as_dict(run([&](const tf::progress_callback& report) {
            options.progress = report;
            return tf::drop(moving.prepared(), options);
        }));
    return as_dict(place(moving, fixed, options,
                         [](const auto& m, const auto& all, const tf::drop_options& o) {
                             return tf::drop(m, all, o);
                         }));
}

py::dict mate(const held_mesh& moving, const held_meshes& fixed, double clearance,
              std::optional<double> max_travel, const std::string& precision) {
    const tf::mate_options options{
        .clearance = clearance, .max_travel = max_travel, .precision = precision_of(precision)};
    return as_dict(place(moving, fixed, options,
                         [](const auto& m, const auto& all, const tf::mate_options& o) {
                             return tf::mate(m, all, o);
                         }));
}

py::dict separate(const held_mesh& moving, const held_meshes& fixed, double clearance,
                  std::optional<double> max_travel, std::uint64_t effort,
                  const std::string& precision) {
    const tf::separate_options options{.clearance = clearance,
                                       .max_travel = max_travel,
                                       .precision = precision_of(precision),
                                       .effort = effort};
    return as_dict(place(moving, fixed, options,
                         [](const auto& m, const auto& all, const tf::separate_options& o) {
                             return tf::separate(m, all, o);
                         }));
}

py::dict turn(const held_mesh& moving, const held_meshes& fixed, const array_of<double>& axis,
              const array_of<double>& origin, double clearance, double max_angle,
              std::optional<double> tolerance, const std::string& precision) {
    const tf::turn_options options{.clearance = clearance,
                                   .max_angle = max_angle,
                                   .tolerance = tolerance,
                                   .precision = precision_of(precision)};
    const tf::turn_axis about{point_of(origin), point_of(axis)};
    tf::turn_result turned = place(moving, fixed, options,
                                   [&](const auto& m, const auto& all, const tf::turn_options& o) {
                                       return tf::turn(m, all, about, o);
                                   });
    py::dict made = as_dict(std::move(turned.at));
    made["angle"] = turned.angle;
    made["tolerance"] = turned.tolerance;
    return made;
}

// ---- features ----

tf::mesh_feature feature_of(const std::string& kind, const array_of<double>& origin,
                            const array_of<double>& direction) {
    tf::mesh_feature made;
    made.kind = choice<tf::feature_kind>("kind", feature_words, kind);
    made.origin = point_of(origin);
    made.direction = point_of(direction);
    return made;
}

py::dict mate_features(const held_mesh& moving, const held_meshes& fixed, const std::string& kind,
                       const array_of<double>& origin, const array_of<double>& direction,
                       const array_of<double>& fixed_origin,
                       const array_of<double>& fixed_direction, double clearance, bool flip,
                       const std::string& precision) {
    tf::feature_mate_options options{
        .clearance = clearance, .flip = flip, .precision = precision_of(precision)};
    const tf::mesh_feature a = feature_of(kind, origin, direction);
    const tf::mesh_feature b = feature_of(kind, fixed_origin, fixed_direction);
    const std::vector<tf::prepared_mesh> all = borrowed(fixed);
    tf::feature_mating mated = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::mate_features(moving.prepared(), all, a, b, options);
    });
    py::dict made = as_dict(std::move(mated.at));
    made["angle"] = mated.turn_angle;
    made["offset"] = mated.offset;
    return made;
}

// ---- measures ----

py::object measure(const held_mesh& a, const held_mesh& b, double radius,
                   const std::string& vertices) {
    tf::measure_options options{.radius = radius, .vertices = identity_of(vertices)};
    const auto found = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::measure(a.prepared(), b.prepared(), options);
    });
    return found ? py::object(as_dict(*found)) : py::none();
}

py::object penetration_depth(const held_mesh& a, const held_mesh& b, std::size_t directions,
                             std::uint64_t effort) {
    tf::depth_options options{.directions = directions, .effort = effort};
    const auto found = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::penetration_depth(a.prepared(), b.prepared(), options);
    });
    if (!found) return py::none();
    return py::make_tuple(found->depth, as_array(found->move), as_tuple(found->effort));
}

py::tuple time_of_impact(const held_mesh& a, const held_mesh& b, const array_of<double>& motion,
                         const array_of<double>& move_a, const array_of<double>& move_b,
                         double latest) {
    constexpr words<3> ends{"free", "contact", "at_start"};
    tf::impact_options options{
        .move_a = transform_of(move_a), .move_b = transform_of(move_b), .latest = latest};
    const tf::point3 along = point_of(motion);
    const tf::impact met = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::time_of_impact(a.prepared(), b.prepared(), along, options);
    });
    return py::make_tuple(
        word_of(ends, met.end), met.time,
        column(met.contacts,
               [](const tf::face_contact& c) {
                   return std::array<std::uint32_t, 2>{c.face_a, c.face_b};
               }),
        column(met.contacts, [](const tf::face_contact& c) { return numbers(c.point); }));
}

}  // namespace

void add_placement(py::module_& module) {
    module.def("slide", &slide);
    module.def("drop", &drop);
    module.def("mate", &mate);
    module.def("separate", &separate);
    module.def("turn", &turn);
    module.def("mate_features", &mate_features);
    module.def("measure", &measure);
    module.def("penetration_depth", &penetration_depth);
    module.def("time_of_impact", &time_of_impact);
}

}  // namespace binding
