#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

/// What a placement keeps besides what is handed out.
struct kept_placement {
    tf::placement at;
};

std::unique_ptr<glue::answer<treeform_placement>> answer_of(tf::placement from) {
    if (from.certificate.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_placement>();
    const tf::placement& at = made->keep(kept_placement{std::move(from)}).at;
    glue::fill(*made, at, made->value);
    return made;
}

treeform_code give_placed(std::unique_ptr<glue::answer<treeform_placement>> made,
                          treeform_placement** out) {
    const bool placed = made->value.certificate->status == TREEFORM_STATUS_OK;
    if (!placed) glue::say(made->value.message);
    glue::give(std::move(made), out);
    return placed ? TREEFORM_OK : TREEFORM_NO_PLACE;
}

/// `place(moving, fixed)`, which returns a placement.
template <class Place>
treeform_code place_among(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                          std::size_t fixed_count, treeform_placement** out, const Place& place) {
    return glue::guard([&] {
        glue::start(out);
        const tf::prepared_mesh& m = *glue::need(moving, "moving").prepared;
        const tf::mesh_refs row = glue::refs(fixed, fixed_count, "fixed");
        return give_placed(answer_of(place(m, row)), out);
    });
}

tf::mesh_feature feature_of(const treeform_feature* from, const char* name) {
    const treeform_feature& f = glue::need(from, name);
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

}  // namespace

treeform_code treeform_slide(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                             size_t fixed_count, const double direction[3],
                             const treeform_place_options* options,
                             treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::slide(m, f, glue::point(direction, "direction"),
                                            glue::read_as<tf::slide_options>(options));
                       });
}

treeform_code treeform_drop(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t fixed_count, const double* direction,
                            const treeform_place_options* options, treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           auto how = glue::read_as<tf::drop_options>(options);
                           if (direction) how.direction = glue::point(direction, "direction");
                           return f.empty() ? tf::drop(m, how) : tf::drop(m, f, how);
                       });
}

treeform_code treeform_mate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t fixed_count, const treeform_place_options* options,
                            treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::mate(m, f, glue::read_as<tf::mate_options>(options));
                       });
}

treeform_code treeform_separate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                size_t fixed_count, const treeform_place_options* options,
                                treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::separate(m, f, glue::read_as<tf::separate_options>(options));
                       });
}

treeform_code treeform_measure_among(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                     size_t fixed_count, const treeform_place_options* options,
                                     treeform_placement** placement) {
    return place_among(
        moving, fixed, fixed_count, placement, [&](const auto& m, const tf::mesh_refs& f) {
            return tf::measure_among(m, f, glue::read_as<tf::measure_among_options>(options));
        });
}

treeform_code treeform_turn(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t fixed_count, const double origin[3], const double direction[3],
                            const treeform_place_options* options, treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        const tf::prepared_mesh& m = *glue::need(moving, "moving").prepared;
        const tf::mesh_refs row = glue::refs(fixed, fixed_count, "fixed");
        tf::turn_result turned =
            tf::turn(m, row, {glue::point(origin, "origin"), glue::point(direction, "direction")},
                     glue::read_as<tf::turn_options>(options));
        auto made = answer_of(std::move(turned.at));
        made->value.angle = turned.angle;
        made->value.tolerance = turned.tolerance;
        made->value.steps = turned.steps;
        return give_placed(std::move(made), placement);
    });
}

treeform_code treeform_mate_features(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                     size_t fixed_count, const treeform_feature* of_moving,
                                     const treeform_feature* of_fixed,
                                     const treeform_place_options* options,
                                     treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        const tf::prepared_mesh& m = *glue::need(moving, "moving").prepared;
        const tf::mesh_refs row = glue::refs(fixed, fixed_count, "fixed");
        tf::feature_mating mated = tf::mate_features(
            m, row, feature_of(of_moving, "of_moving"), feature_of(of_fixed, "of_fixed"),
            glue::read_as<tf::feature_mate_options>(options));
        auto made = answer_of(std::move(mated.at));
        made->value.angle = mated.turn_angle;
        made->value.offset = mated.offset;
        return give_placed(std::move(made), placement);
    });
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
        const tf::placement& at = static_cast<const kept_placement*>(from->kept[0].get())->at;
        if (at.points.size() != m.view().points.size())
            throw std::invalid_argument("placement is of another mesh");
        for (const tf::placement_contact& one : at.contacts)
            if (one.moving >= m.view().faces.size() || (one.fixed_face && one.fixed >= fixed_count))
                throw std::invalid_argument("placement is of other meshes");
        auto made = glue::make<treeform_contact_classes>();
        const auto& found = made->keep(tf::classify_contacts(m, row, at));
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
