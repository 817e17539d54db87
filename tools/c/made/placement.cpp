// Made by tools/bindings of placement.h and the headers of C++: see its README.
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/placement.hpp>

namespace tf = treeform;

static_assert(TREEFORM_END_CONTACT == static_cast<int>(tf::placement_end::contact));
static_assert(TREEFORM_END_BED == static_cast<int>(tf::placement_end::bed));
static_assert(TREEFORM_END_UNCHANGED == static_cast<int>(tf::placement_end::unchanged));
static_assert(TREEFORM_END_MOVED_APART == static_cast<int>(tf::placement_end::moved_apart));
static_assert(TREEFORM_END_NOTHING_MET == static_cast<int>(tf::placement_end::nothing_met));
static_assert(TREEFORM_END_TOO_FAR == static_cast<int>(tf::placement_end::too_far));
static_assert(TREEFORM_END_STARTS_PENETRATING ==
              static_cast<int>(tf::placement_end::starts_penetrating));
static_assert(TREEFORM_END_STARTS_TOO_NEAR == static_cast<int>(tf::placement_end::starts_too_near));
static_assert(TREEFORM_END_STARTS_TOUCHING == static_cast<int>(tf::placement_end::starts_touching));
static_assert(TREEFORM_END_STARTS_BELOW_BED ==
              static_cast<int>(tf::placement_end::starts_below_bed));
static_assert(TREEFORM_END_NOT_REPRESENTABLE ==
              static_cast<int>(tf::placement_end::not_representable));
static_assert(TREEFORM_END_TOO_MANY_STEPS == static_cast<int>(tf::placement_end::too_many_steps));
static_assert(TREEFORM_END_OUT_OF_RANGE == static_cast<int>(tf::placement_end::out_of_range));
static_assert(TREEFORM_END_CANCELLED == static_cast<int>(tf::placement_end::cancelled));

tf::placement_options glue::read(const treeform_place_options* options) {
    return read(chosen(options, treeform_place_options_init));
}
tf::placement_options glue::read(const treeform_place_options& o) {
    tf::placement_options how;
    how.clearance = o.clearance;
    how.max_travel = given(o.max_travel);
    how.flip = o.flip != 0;
    how.max_angle = o.max_angle;
    how.tolerance = given(o.tolerance);
    how.max_steps = limit(o.max_steps);
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.bed = given(o.bed);
    how.close_in = o.close_in != 0;
    how.normals = limit(o.normals);
    how.face_pairs = limit(o.face_pairs);
    how.effort = o.effort;
    how.limit = limit(o.limit);
    how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.progress = progress(o);

    return how;
}

void treeform_place_options_init(treeform_place_options* options, size_t size) {
    treeform_place_options to{};
    const tf::placement_options from;
    using namespace glue;
    to.clearance = from.clearance;
    to.max_travel = not_known;
    to.flip = from.flip;
    to.max_angle = from.max_angle;
    to.tolerance = not_known;
    to.max_steps = from.max_steps;
    to.precision = static_cast<treeform_precision>(from.precision);
    to.bed = not_known;
    to.close_in = from.close_in;
    to.normals = from.normals;
    to.face_pairs = from.face_pairs;
    to.effort = from.effort;
    to.limit = from.limit;
    to.vertices = static_cast<treeform_vertices>(from.vertices);
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::placement_contact& from, treeform_contact& to) {
    copy(from.point, to.point);
    copy(from.normal, to.normal);
    to.moving = from.moving;
    to.fixed_face = from.fixed_face.value_or(TREEFORM_NONE);
    to.fixed = static_cast<std::uint32_t>(from.fixed);
}

void glue::fill(keeper& kept, const tf::placement& from, treeform_placement& to) {
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.end = static_cast<treeform_placement_end>(from.end);
    to.points = flat(from.points);
    to.point_count = from.points.size();
    copy(from.matrix, to.matrix);
    copy(from.direction, to.direction);
    to.travel = from.travel;
    to.clearance = from.clearance;
    to.bed = from.bed.value_or(not_known);
    to.below_bed = from.below_bed;
    to.at_start = static_cast<treeform_mesh_relation>(from.at_start);
    to.at_place = static_cast<treeform_mesh_relation>(from.at_place);
    if (from.nearest) to.nearest = &filled<treeform_relation>(kept, *from.nearest);
    to.nearest_fixed = from.nearest_fixed;
    to.contacts = list<treeform_contact>(kept, from.contacts);
    to.contact_listed = from.contacts.size();
    to.contact_count = from.contact_count;
    to.effort = same<treeform_search_effort>(from.effort);
    to.angle = from.angle;
    to.tolerance = from.tolerance;
    to.offset = from.offset;
    to.backed_off = from.statistics.backed_off;
    to.fixed_culled = from.statistics.fixed_culled;
    to.pairs_tested = from.statistics.pairs_tested;
    to.steps = from.statistics.steps;
    to.message = kept.keep(from.message()).c_str();
}

void glue::fill(keeper&, const tf::impact& from, treeform_impact& to) {
    to.end = static_cast<treeform_placement_end>(from.end);
    to.time = from.time;
    to.contacts = same<treeform_impact_contact>(from.contacts);
    to.contact_listed = from.contacts.size();
    to.contact_count = from.contact_count;
    to.pairs_tested = from.pairs_tested;
}

static_assert(sizeof(treeform_impact_contact) == sizeof(tf::face_contact));
static_assert(offsetof(treeform_impact_contact, face_a) == offsetof(tf::face_contact, face_a));
static_assert(offsetof(treeform_impact_contact, face_b) == offsetof(tf::face_contact, face_b));
static_assert(offsetof(treeform_impact_contact, point) == offsetof(tf::face_contact, point));

tf::impact_options glue::read(const treeform_impact_options* options) {
    return read(chosen(options, treeform_impact_options_init));
}
tf::impact_options glue::read(const treeform_impact_options& o) {
    tf::impact_options how;
    how.move_a = matrix(o.move_a);
    how.move_b = matrix(o.move_b);
    how.latest = o.latest;
    how.limit = limit(o.limit);
    how.progress = progress(o);

    return how;
}

void treeform_impact_options_init(treeform_impact_options* options, size_t size) {
    treeform_impact_options to{};
    const tf::impact_options from;
    to.latest = from.latest;
    to.limit = from.limit;
    glue::init(options, size, to);
}

treeform_code treeform_slide(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                             size_t count, const double direction[3],
                             const treeform_place_options* options,
                             treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(tf::slide(glue::ref(moving, "moving"), glue::refs(fixed, count, "fixed"),
                                    glue::finite(direction, "direction"), glue::read(options)),
                          placement);
    });
}

treeform_code treeform_drop(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t count, const double* direction,
                            const treeform_place_options* options, treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(glue::drop(glue::ref(moving, "moving"), glue::refs(fixed, count, "fixed"),
                                     direction, glue::read(options)),
                          placement);
    });
}

treeform_code treeform_mate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t count, const treeform_place_options* options,
                            treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(tf::mate(glue::ref(moving, "moving"), glue::refs(fixed, count, "fixed"),
                                   glue::read(options)),
                          placement);
    });
}

treeform_code treeform_separate(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                size_t count, const treeform_place_options* options,
                                treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(tf::separate(glue::ref(moving, "moving"),
                                       glue::refs(fixed, count, "fixed"), glue::read(options)),
                          placement);
    });
}

treeform_code treeform_turn(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                            size_t count, const double origin[3], const double direction[3],
                            const treeform_place_options* options, treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(tf::turn(glue::ref(moving, "moving"), glue::refs(fixed, count, "fixed"),
                                   glue::finite(origin, "origin"),
                                   glue::finite(direction, "direction"), glue::read(options)),
                          placement);
    });
}

treeform_code treeform_mate_features(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                     size_t count, const treeform_feature* of_moving,
                                     const treeform_feature* of_fixed,
                                     const treeform_place_options* options,
                                     treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(
            glue::mate_features(glue::ref(moving, "moving"), glue::refs(fixed, count, "fixed"),
                                of_moving, of_fixed, glue::read(options)),
            placement);
    });
}

treeform_code treeform_measure_among(const treeform_mesh* moving, const treeform_mesh* const* fixed,
                                     size_t count, const treeform_place_options* options,
                                     treeform_placement** placement) {
    return glue::guard([&] {
        glue::start(placement);
        return glue::give(tf::measure_among(glue::ref(moving, "moving"),
                                            glue::refs(fixed, count, "fixed"), glue::read(options)),
                          placement);
    });
}

treeform_code treeform_find_face_relations(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t count,
                                           const treeform_placement* placement,
                                           treeform_face_relations** relations) {
    return glue::guard([&] {
        glue::start(relations);
        return glue::give(
            glue::find_face_relations(moving, glue::refs(fixed, count, "fixed"), placement),
            relations);
    });
}

treeform_code treeform_time_of_impact(const treeform_mesh* a, const treeform_mesh* b,
                                      const double motion[3],
                                      const treeform_impact_options* options,
                                      treeform_impact** impact) {
    return glue::guard([&] {
        glue::start(impact);
        return glue::give(tf::time_of_impact(glue::ref(a, "a"), glue::ref(b, "b"),
                                             glue::finite(motion, "motion"), glue::read(options)),
                          impact);
    });
}

treeform_code treeform_time_to_distance(const treeform_mesh* a, const treeform_mesh* b,
                                        const double motion[3], double distance,
                                        const treeform_impact_options* options,
                                        treeform_impact** impact) {
    return glue::guard([&] {
        glue::start(impact);
        return glue::give(
            tf::time_to_distance(glue::ref(a, "a"), glue::ref(b, "b"),
                                 glue::finite(motion, "motion"), distance, glue::read(options)),
            impact);
    });
}
