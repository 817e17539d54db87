#include "tools/tf-place/placing/motion_options.hpp"

#include "tools/shell/exit_status.hpp"
#include "tools/shell/parse_value.hpp"
#include <treeform/mesh/distance.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace tools {
namespace {

/// By `feature_kind`.
constexpr std::array<const char*, 2> kinds{"plane", "axis"};

/// "12" or "0,5,-3.2".
feature_pick parse_pick(std::string_view option, std::string_view text) {
    if (text.find(',') != std::string_view::npos) return {.point = parse_point(option, text)};
    const std::uint64_t face = parse_count(option, text);
    if (face > std::numeric_limits<std::uint32_t>::max())
        refuse(std::string(option) + " " + std::string(text) + ": no face has this number");
    return {.face = static_cast<std::uint32_t>(face)};
}

struct found_feature {
    std::size_t body = 0;
    tf::mesh_feature feature{};
};

/// In the body with that face.
std::optional<found_feature> at_face(const tf::body_set& set, tf::feature_kind kind,
                                     std::uint32_t number) {
    for (std::size_t body = 0; body < set.shapes.size(); ++body) {
        const tf::mesh_view mesh = set.shapes[body].indexed_view();
        if (set.shapes[body].is_cloud()) continue;
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
            if (set.face_in_file(body, f) != number) continue;
            auto one = tf::feature_at(mesh, kind, f);
            if (!one) return std::nullopt;
            return found_feature{body, std::move(*one)};
        }
    }
    return std::nullopt;
}

/// In the body that is nearest to the point.
std::optional<found_feature> near_point(const tf::body_set& set, tf::feature_kind kind,
                                        const tf::point3& p) {
    std::optional<std::size_t> nearest;
    std::uint32_t face = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t body = 0; body < set.shapes.size(); ++body) {
        const auto at = tf::closest_point(set.shapes[body], p);
        if (set.shapes[body].is_cloud() || !at || !(at->distance < least)) continue;
        least = at->distance;
        nearest = body;
        face = at->face;
    }
    if (!nearest) return std::nullopt;
    auto one = tf::feature_at(set.shapes[*nearest].indexed_view(), kind, face);
    if (!one) return std::nullopt;
    return found_feature{*nearest, std::move(*one)};
}

std::optional<found_feature> find(const tf::body_set& set, tf::feature_kind kind,
                                  const feature_pick& pick) {
    if (pick.face) return at_face(set, kind, *pick.face);
    if (pick.point) return near_point(set, kind, *pick.point);
    std::optional<found_feature> best;
    for (std::size_t body = 0; body < set.shapes.size(); ++body) {
        if (set.shapes[body].is_cloud()) continue;
        auto all = tf::find_features(set.shapes[body].indexed_view(), kind);
        if (!all.empty() && (!best || all[0].area > best->feature.area))
            best = found_feature{body, std::move(all[0])};
    }
    return best;
}

json feature_entry(const tf::mesh_feature& f) {
    const bool axis = f.kind == tf::feature_kind::axis;
    return {{"origin", f.origin},
            {"direction", f.direction},
            {"radius", or_null(axis, f.radius)},
            {"hollow", or_null(axis, f.hollow)},
            {"area", f.area},
            {"deviation", f.deviation},
            {"triangles", f.faces.size()}};
}

}  // namespace

void add_turn_options(command_line& line, turn_settings& s) {
    line.option({"--axis", "X,Y,Z", "turn: direction of the axis (right-hand rule)", "0,0,1"},
                [&s](std::string_view text) { s.axis = parse_direction("--axis", text); });
    line.option({"--origin", "X,Y,Z", "turn: a point of the axis", "0,0,0"},
                [&s](std::string_view text) { s.origin = parse_point("--origin", text); });
    line.option(
        {"--max-angle", "DEG", "turn: largest angle; exit 1 without contact within it", "360"},
        [&s](std::string_view text) {
            s.max_angle = parse_number("--max-angle", text);
            if (!(s.max_angle > 0.0 && s.max_angle <= 360.0))
                refuse("--max-angle " + std::string(text) + ": expected an angle up to 360");
        });
}

std::span<const char* const> turn_option_names() {
    static constexpr std::array<const char*, 3> names{"--axis", "--origin", "--max-angle"};
    return names;
}

void add_feature_options(command_line& line, feature_settings& s) {
    line.option({"--feature", "KIND",
                 "mate: plane | axis: bring the largest planes or axes\n"
                 "together, then slide along them until contact"},
                [&s](std::string_view text) {
                    s.kind = static_cast<tf::feature_kind>(parse_choice("--feature", text, kinds));
                });
    line.offer("--feature", {kinds.begin(), kinds.end()});
    line.option({"--pick", "FACE|X,Y,Z", "mate: the feature of MOVING at this face or point"},
                [&s](std::string_view text) { s.moving = parse_pick("--pick", text); });
    line.option(
        {"--pick-fixed", "FACE|X,Y,Z", "mate: the feature of --fixed at this face or\npoint"},
        [&s](std::string_view text) { s.fixed = parse_pick("--pick-fixed", text); });
    line.flag(s.flip,
              {"--flip", "", "mate: normals of planes point the same way; axes are\nreversed"});
}

std::span<const char* const> feature_option_names() {
    static constexpr std::array<const char*, 4> names{"--feature", "--pick", "--pick-fixed",
                                                      "--flip"};
    return names;
}

std::optional<mating> mate_by_features(const feature_settings& s, const tf::body_set& moving,
                                       const tf::body_set& fixed,
                                       const tf::placement_options& options, std::string& reason) {
    const char* const kind = kinds[static_cast<std::size_t>(*s.kind)];
    auto of_moving = find(moving, *s.kind, s.moving);
    auto of_fixed = find(fixed, *s.kind, s.fixed);
    if (!of_moving || !of_fixed) {
        const bool picked =
            of_moving ? s.fixed.face || s.fixed.point : s.moving.face || s.moving.point;
        reason = std::string(of_moving ? "the fixed mesh has no " : "MOVING has no ") + kind +
                 (picked ? " at the picked face or point" : "");
        return std::nullopt;
    }
    mating result{std::move(of_moving->feature), std::move(of_fixed->feature), of_fixed->body, {}};
    result.found =
        tf::mate_features(moving.shapes[0], fixed.shapes, result.moving, result.fixed, options);
    return result;
}

json turn_entry(const turn_settings& s, const tf::placement& found) {
    return {
        {"axis", s.axis},       {"origin", s.origin},           {"max_angle", s.max_angle},
        {"angle", found.angle}, {"tolerance", found.tolerance}, {"steps", found.statistics.steps}};
}

json mating_entry(const mating& m, const tf::placement& at) {
    return {{"kind", kinds[static_cast<std::size_t>(m.moving.kind)]},
            {"moving", feature_entry(m.moving)},
            {"fixed", feature_entry(m.fixed)},
            {"turn_angle", at.angle},
            {"offset", at.offset}};
}

}  // namespace tools
