#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>

namespace tf = treeform;

/// A placement, and what only its operation has: `more(to)` fills it.
template <class More>
static treeform_code give_placed(tf::placement&& at, treeform_placement** out, const More& more) {
    glue::check(at.certificate.status);
    auto made = glue::make<treeform_placement>();
    glue::fill(*made, made->keep(std::move(at)), made->value);
    more(made->value);
    const bool placed = made->value.certificate->status == TREEFORM_STATUS_OK;
    if (!placed) glue::say(made->value.message);
    glue::give(std::move(made), out);
    return placed ? TREEFORM_OK : TREEFORM_NO_PLACE;
}

treeform_code glue::give(tf::placement&& at, treeform_placement** out) {
    return give_placed(std::move(at), out, [](treeform_placement&) {});
}

treeform_code glue::give(tf::turn_result&& turned, treeform_placement** out) {
    return give_placed(std::move(turned.at), out, [&](treeform_placement& to) {
        to.angle = turned.angle;
        to.tolerance = turned.tolerance;
        to.steps = turned.steps;
    });
}

treeform_code glue::give(tf::feature_mating&& mated, treeform_placement** out) {
    return give_placed(std::move(mated.at), out, [&](treeform_placement& to) {
        to.angle = mated.turn_angle;
        to.offset = mated.offset;
    });
}

tf::drop_options glue::drop_options_of(const treeform_place_options* options,
                                       const double* direction) {
    auto how = read_as<tf::drop_options>(options);
    if (direction) how.direction = point(direction, "direction");
    return how;
}

tf::mesh_feature glue::feature_of(const treeform_feature* from, const char* name) {
    const treeform_feature& f = need(from, name);
    tf::mesh_feature feature;
    feature.kind = glue::choice<tf::feature_kind>(f.kind, 2, "kind");
    feature.origin = glue::point(f.origin, "origin");
    feature.direction = glue::point(f.direction, "direction");
    feature.radius = f.radius;
    feature.hollow = f.hollow != 0;
    feature.area = f.area;
    feature.deviation = f.deviation;
    const std::span faces = glue::array(f.faces, f.face_count, "the faces of a feature");
    feature.faces.assign(faces.begin(), faces.end());
    return feature;
}

treeform_code treeform_classify_contacts(const treeform_mesh* moving,
                                         const treeform_mesh* const* fixed, size_t fixed_count,
                                         const treeform_placement* placement,
                                         treeform_contact_classes** classes) {
    return glue::guard([&] {
        glue::start(classes);
        const tf::prepared_mesh& m = *glue::need(moving, "moving").prepared;
        const tf::mesh_refs row = glue::refs(fixed, fixed_count, "fixed");
        void* const owner = glue::need(placement, "placement").owner;
        auto* const from =
            dynamic_cast<glue::answer<treeform_placement>*>(static_cast<glue::owned*>(owner));
        if (!from) throw std::invalid_argument("placement is none of this library");
        const tf::placement& at = *static_cast<const tf::placement*>(from->kept[0].get());
        if (at.points.size() != m.view().points.size())
            throw std::invalid_argument("placement is of another mesh");
        for (const tf::placement_contact& one : at.contacts)
            if (one.moving >= m.view().faces.size() || (one.fixed_face && one.fixed >= fixed_count))
                throw std::invalid_argument("placement is of other meshes");
        auto made = glue::make<treeform_contact_classes>();
        const auto& found = made->keep(tf::contact_classes::of(m, row, at));
        const auto bytes = [](const std::vector<tf::contact_class>& of) {
            return of.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(of.data());
        };
        std::vector<const std::uint8_t*> of_fixed;
        for (const auto& one : found.fixed) of_fixed.push_back(bytes(one));
        made->value.moving = bytes(found.moving);
        made->value.moving_count = found.moving.size();
        made->value.fixed_count = of_fixed.size();
        made->value.fixed = made->keep(std::move(of_fixed)).data();
        glue::give(std::move(made), classes);
    });
}

treeform_code treeform_time_to_distance(const treeform_mesh* a, const treeform_mesh* b,
                                        const double motion[3], double distance,
                                        const treeform_impact_options* options,
                                        treeform_impact** impact) {
    return glue::guard([&] {
        glue::start(impact);
        const tf::impact_options how = glue::read(options);
        if (options && (options->move_a || options->move_b))
            throw std::invalid_argument("a distance is looked for where the meshes are");
        return glue::give(tf::time_to_distance(glue::ref(a, "a"), glue::ref(b, "b"),
                                               glue::point(motion, "motion"), distance,
                                               {how.latest, how.limit, how.progress}),
                          impact);
    });
}
