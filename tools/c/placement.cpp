#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <tools/c/relations.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

/// What a placement keeps besides what is handed out.
struct kept_placement {
    tf::placement at;
};

/// Sets those of the options that the verb has.
template <class Options>
Options options_of(const treeform_place_options* options) {
    const auto o = glue::chosen(options, treeform_place_options_init);
    Options how;
    if constexpr (requires { how.clearance; }) how.clearance = o.clearance;
    if constexpr (requires { how.max_travel; }) how.max_travel = glue::given(o.max_travel);
    if constexpr (requires { how.precision; }) how.precision = glue::precision(o.precision);
    if constexpr (requires { how.bed; }) how.bed = glue::given(o.bed);
    if constexpr (requires { how.close_in; }) how.close_in = o.close_in != 0;
    if constexpr (requires { how.normals; }) {
        how.normals = glue::limit(o.normals);
        how.face_pairs = glue::limit(o.face_pairs);
        how.effort = o.effort;
    }
    if constexpr (requires { how.max_angle; }) {
        how.max_angle = o.max_angle;
        how.tolerance = glue::given(o.tolerance);
        how.max_steps = glue::limit(o.max_steps);
    }
    if constexpr (requires { how.flip; }) how.flip = o.flip != 0;
    how.limit = glue::limit(o.limit);
    how.vertices = glue::vertices(o.vertices);
    how.progress = glue::progress(o);
    return how;
}

treeform_contact contact_of(const tf::placement_contact& from) {
    treeform_contact c{};
    glue::copy(from.point, c.point);
    glue::copy(from.normal, c.normal);
    c.moving = from.moving;
    c.fixed_face = from.fixed_face.value_or(TREEFORM_NONE);
    c.fixed = static_cast<std::uint32_t>(from.fixed);
    return c;
}

std::unique_ptr<glue::answer<treeform_placement>> answer_of(tf::placement from) {
    if (from.certificate.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_placement>();
    const tf::placement& at = made->keep(kept_placement{std::move(from)}).at;
    treeform_placement& p = made->value;
    p.certificate = glue::keep(*made, at.certificate);
    p.end = static_cast<treeform_placement_end>(at.end);
    p.message = made->keep(at.message()).c_str();
    p.points = glue::flat(at.points);
    p.point_count = at.points.size();
    glue::copy(at.matrix, p.matrix);
    glue::copy(at.direction, p.direction);
    p.travel = at.travel;
    p.clearance = at.clearance;
    p.bed = at.bed.value_or(glue::not_known);
    p.below_bed = at.below_bed;
    p.on_bed = at.on_bed;
    p.at_start = static_cast<treeform_standing>(at.at_start);
    p.at_place = static_cast<treeform_standing>(at.at_place);
    p.nearest_fixed = TREEFORM_NONE;
    if (at.nearest) {
        p.nearest_fixed = static_cast<std::uint32_t>(at.nearest->fixed);
        p.nearest = &made->keep(glue::relation_of(at.nearest->how));
    }
    std::vector<treeform_contact> contacts;
    for (const tf::placement_contact& one : at.contacts) contacts.push_back(contact_of(one));
    p.contact_listed = contacts.size();
    p.contacts = made->keep(std::move(contacts)).data();
    p.contact_count = at.contact_count;
    p.backed_off = at.statistics.backed_off;
    p.fixed_culled = at.statistics.fixed_culled;
    p.pairs_tested = at.statistics.pairs_tested;
    p.effort = glue::copied(at.effort);
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

template <class Impact>
void give_impact(Impact from, treeform_impact** out) {
    if (from.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_impact>();
    const Impact& kept = made->keep(std::move(from));
    made->value.end = static_cast<std::int32_t>(kept.end);
    made->value.time = kept.time;
    made->value.contacts = glue::same<treeform_impact_contact>(kept.contacts);
    made->value.contact_listed = kept.contacts.size();
    made->value.contact_count = kept.contact_count;
    made->value.pairs_tested = kept.pairs_tested;
    glue::give(std::move(made), out);
}

}  // namespace

void treeform_place_options_init(treeform_place_options* options, size_t size) {
    const tf::separate_options apart;
    const tf::turn_options turned;
    treeform_place_options defaults{};
    defaults.max_travel = defaults.bed = defaults.tolerance = glue::not_known;
    defaults.precision = TREEFORM_FLOAT64;
    defaults.close_in = 1;
    defaults.limit = apart.limit;
    defaults.normals = apart.normals;
    defaults.face_pairs = apart.face_pairs;
    defaults.max_angle = turned.max_angle;
    defaults.max_steps = turned.max_steps;
    glue::init(options, size, defaults);
}

treeform_code treeform_slide(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                             size_t fixed_count, const double direction[3],
                             const treeform_place_options* options,
                             treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::slide(m, f, glue::point(direction, "direction"),
                                            options_of<tf::slide_options>(options));
                       });
}

treeform_code treeform_drop(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t fixed_count, const double* direction,
                            const treeform_place_options* options, treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           auto how = options_of<tf::drop_options>(options);
                           if (direction) how.direction = glue::point(direction, "direction");
                           return f.empty() ? tf::drop(m, how) : tf::drop(m, f, how);
                       });
}

treeform_code treeform_mate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t fixed_count, const treeform_place_options* options,
                            treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::mate(m, f, options_of<tf::mate_options>(options));
                       });
}

treeform_code treeform_separate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                size_t fixed_count, const treeform_place_options* options,
                                treeform_placement** placement) {
    return place_among(moving, fixed, fixed_count, placement,
                       [&](const auto& m, const tf::mesh_refs& f) {
                           return tf::separate(m, f, options_of<tf::separate_options>(options));
                       });
}

treeform_code treeform_measure_among(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                     size_t fixed_count, const treeform_place_options* options,
                                     treeform_placement** placement) {
    return place_among(
        moving, fixed, fixed_count, placement, [&](const auto& m, const tf::mesh_refs& f) {
            return tf::measure_among(m, f, options_of<tf::measure_among_options>(options));
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
                     options_of<tf::turn_options>(options));
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
        tf::feature_mating mated = tf::mate_features(m, row, feature_of(of_moving, "of_moving"),
                                                     feature_of(of_fixed, "of_fixed"),
                                                     options_of<tf::feature_mate_options>(options));
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

void treeform_impact_options_init(treeform_impact_options* options, size_t size) {
    treeform_impact_options defaults{};
    defaults.latest = glue::infinity;
    defaults.limit = tf::impact_options{}.limit;
    glue::init(options, size, defaults);
}

treeform_code treeform_time_of_impact(const treeform_mesh* a, const treeform_mesh* b,
                                      const double motion[3],
                                      const treeform_impact_options* options,
                                      treeform_impact** impact) {
    return glue::guard([&] {
        glue::start(impact);
        const auto o = glue::chosen(options, treeform_impact_options_init);
        const tf::impact_options how{glue::matrix(o.move_a), glue::matrix(o.move_b), o.latest,
                                     glue::limit(o.limit), glue::progress(o)};
        const tf::point3 along = glue::point(motion, "motion");
        give_impact(glue::asked(a, b,
                                [&](const auto& x, const auto& y) {
                                    return tf::time_of_impact(x, y, along, how);
                                }),
                    impact);
    });
}

treeform_code treeform_time_to_distance(const treeform_mesh* a, const treeform_mesh* b,
                                        const double motion[3], double distance,
                                        const treeform_impact_options* options,
                                        treeform_impact** impact) {
    return glue::guard([&] {
        glue::start(impact);
        const auto o = glue::chosen(options, treeform_impact_options_init);
        if (o.move_a || o.move_b)
            throw std::invalid_argument("a distance is looked for where the meshes are");
        const tf::approach_options how{o.latest, glue::limit(o.limit), glue::progress(o)};
        const tf::point3 along = glue::point(motion, "motion");
        give_impact(glue::asked(a, b,
                                [&](const auto& x, const auto& y) {
                                    return tf::time_to_distance(x, y, along, distance, how);
                                }),
                    impact);
    });
}
