#pragma once
/// \file
/// Placements in C.

#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/mesh/write.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/mesh.hpp>

namespace glue {

inline treeform_code give(tf::placement&& at, treeform_placement** out) {
    check(at.certificate.status);
    const treeform_placement& to = hand_out(std::move(at), out);
    if (to.certificate->status == TREEFORM_STATUS_OK) return TREEFORM_OK;
    say(to.message);
    return TREEFORM_NO_PLACE;
}

/// Moves `moving` down, along `direction` (null: 0, 0, -1), onto the bed or one of `fixed`; `fixed`
/// may be empty.
inline tf::placement drop(const tf::mesh_ref& moving, const tf::mesh_refs& fixed,
                          const double* direction, const tf::placement_options& options) {
    return tf::drop(moving, fixed, options,
                    direction ? point(direction, "direction") : tf::point3{0.0, 0.0, -1.0});
}

inline tf::mesh_feature feature_of(const treeform_mesh_feature* from, const char* name) {
    const treeform_mesh_feature& f = need(from, name);
    tf::mesh_feature feature;
    feature.kind = choice<tf::feature_kind>(f.kind, 2, "kind");
    feature.origin = point(f.origin, "origin");
    feature.direction = point(f.direction, "direction");
    feature.radius = f.radius;
    feature.hollow = f.hollow != 0;
    feature.area = f.area;
    feature.deviation = f.deviation;
    feature.faces = copied_as<std::uint32_t>(f.faces, f.face_count, "the faces of a feature");
    return feature;
}

/// Aligns two planes, or two axes, and slides `moving` until it meets one of `fixed`.
inline tf::placement mate_features(const tf::mesh_ref& moving, const tf::mesh_refs& fixed,
                                   const treeform_mesh_feature* of_moving,
                                   const treeform_mesh_feature* of_fixed,
                                   const tf::placement_options& options) {
    return tf::mate_features(moving, fixed, feature_of(of_moving, "of_moving"),
                             feature_of(of_fixed, "of_fixed"), options);
}

/// The mesh that was placed, with the points of the placement. A copy of points and faces.
inline answer_of<treeform_mesh> moved(const treeform_placement* placement,
                                      const tf::mesh_ref& moving) {
    const auto& at = kept_in<tf::placement>(need(placement, "placement"), "placement");
    tf::mesh own = at.moved(moving).value();
    const std::vector<tf::face> faces = own.faces;
    return mesh_of(std::move(own), {}, faces, TREEFORM_COPY);
}

/// Writes `moving` at its place, in the coordinates that were checked. Fails if the format would
/// round them, or if there is no place. `written` may be null.
inline tf::write_result write_placement(const std::filesystem::path& path,
                                        const tf::mesh_ref& moving,
                                        const treeform_placement* placement,
                                        const tf::write_options& options) {
    const auto& at = kept_in<tf::placement>(need(placement, "placement"), "placement");
    return tf::write(path, at.moved(moving), options);
}

/// The relation of each face to the other meshes; `placement` is a placement of `moving` among
/// `fixed`.
inline answer_of<treeform_face_relations> find_face_relations(const treeform_mesh* moving,
                                                              const tf::mesh_refs& fixed,
                                                              const treeform_placement* placement) {
    const tf::prepared_mesh& m = *need(moving, "moving").prepared;
    const auto& at = kept_in<tf::placement>(need(placement, "placement"), "placement");
    if (at.points.size() != m.indexed_view().points.size())
        throw std::invalid_argument("placement is not of this moving mesh");
    for (const tf::placement_contact& one : at.contacts)
        if (one.moving >= m.indexed_view().faces.size() ||
            (one.fixed_face && one.fixed >= fixed.size()))
            throw std::invalid_argument("placement is not of these meshes");
    auto made = make<treeform_face_relations>();
    const auto& found = made->keep(at.face_relations(m, fixed));
    const auto bytes = [](const std::vector<tf::mesh_relation>& of) {
        return reinterpret_cast<const std::uint8_t*>(or_null(of));
    };
    auto& of_fixed = made->keep(std::vector<const std::uint8_t*>());
    for (std::size_t i = 1; i < found.size(); ++i) of_fixed.push_back(bytes(found[i]));
    made->value.moving = bytes(found[0]);
    made->value.moving_count = found[0].size();
    made->value.fixed_count = of_fixed.size();
    made->value.fixed = of_fixed.data();
    return made;
}

}  // namespace glue
