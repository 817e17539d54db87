#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/repair/detach.hpp>
#include <libmesh/round/surface_faults.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/certificate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace treeform::detail::repair {
namespace {

// Of float32, tried first: some programs make floats of doubles, and some join what is nearer than
// a micrometer (OpenSCAD: 2^-20).
constexpr double wide_steps = 32.0;
constexpr int least_doublings = 6;    // 2, 4, 8 ... steps of the coordinates
constexpr double farthest = 0x1p-11;  // of the diagonal, where that is more
constexpr int likely_ways = 3;
constexpr int all_ways = likely_ways + 8;
constexpr std::size_t most_alone = 32;

point3 unit(const point3& v) {
    const double length = std::hypot(v.x, v.y, v.z);
    return length > 0.0 ? base::scaled(v, 1.0 / length) : point3{0.0, 0.0, 0.0};
}

/// Those with equal coordinates, of which there are several.
std::vector<std::vector<std::uint32_t>> groups_of_equal(points_view points) {
    const auto equal = weld::few_equal_points(points);
    if (!equal) return {};
    std::vector<std::vector<std::uint32_t>> all(equal->first_of_group.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) all[equal->group_of_point[v]].push_back(v);
    std::erase_if(all, [](const auto& group) { return group.size() < 2; });
    return all;
}

class detacher {
  public:
    detacher(mesh& solid, precision of, double limit)
        : solid_(solid),
          of_(of),
          limit_(limit),
          step_(coordinate_step(solid.points, of)),
          wide_(wide_steps * coordinate_step(solid.points, precision::float32)),
          stars_(solid.points.size(), solid.faces),
          groups_(groups_of_equal(solid.points)),
          joined_(solid.faces) {
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            for (const std::uint32_t v : groups_[g])
                twins_[v] = {.group = g, .given = solid.points[v]};
            join(groups_[g]);
        }
    }

    detached run() {
        for (int way = 0; way < likely_ways && wide_ <= limit_ && !vertices_left().empty(); ++way)
            move(vertices_left(), way, wide_);
        const int most = most_doublings(), few = std::min(most, least_doublings);
        move_by(0, few);
        move_by(few, most);
        detached result;
        result.touching = vertices_left().size();
        for (const auto& [v, twin] : twins_) {
            if (!twin.moved) continue;
            ++result.moved;
            result.max_displacement =
                std::max(result.max_displacement,
                         base::largest_of(base::minus(solid_.points[v], twin.given)));
        }
        return result;
    }

  private:
    /// A vertex of a group.
    struct twin_vertex {
        std::size_t group = 0;
        point3 given{};
        bool moved = false;
        bool on_trial = false;  ///< moved, and to be checked
        bool broke = false;
    };

    /// Gives those of a group that have not moved one number.
    void join(const std::vector<std::uint32_t>& group) {
        const std::uint32_t* first = nullptr;
        for (const std::uint32_t& v : group) {
            const bool is_moved = twins_.at(v).moved;
            if (!is_moved && first == nullptr) first = &v;
            for (const std::uint32_t f : stars_[v])
                for (std::size_t i = 0; i < 3; ++i)
                    if (solid_.faces[f][i] == v) joined_[f][i] = is_moved ? v : *first;
        }
    }

    /// A cone as thin as a needle has a place in it only where it is as wide as a step. No
    /// further than the limit.
    [[nodiscard]] int most_doublings() const {
        int most = least_doublings;
        const auto box = bounding_box(solid_.points);
        while (box && std::ldexp(step_, most) < farthest * box->diagonal()) ++most;
        while (most > 0 && steps(most - 1) > limit_) --most;
        return most;
    }

    /// As far as so many doublings.
    void move_by(int from, int to) {
        for (int tried = from * likely_ways; tried < to * likely_ways && !vertices_left().empty();
             ++tried)
            move(vertices_left(), tried % likely_ways, steps(tried / likely_ways));
        // Neighbors may be in each other's way: each alone, while they are few.
        if (const auto left = vertices_left(); left.size() <= most_alone)
            for (const std::uint32_t v : left) move_alone(v, from, to);
    }

    void move_alone(std::uint32_t v, int from, int to) {
        for (int doublings = from; doublings < to; ++doublings)
            for (int way = 0; way < (doublings < least_doublings ? all_ways : likely_ways); ++way)
                if (is_kept(v)) move({v}, way, steps(doublings));
    }

    /// Whether it is where it was given, and another one, too.
    [[nodiscard]] bool is_kept(std::uint32_t v) const {
        const twin_vertex& twin = twins_.at(v);
        return !twin.moved && std::ranges::count_if(groups_[twin.group], [&](std::uint32_t w) {
                                  return !twins_.at(w).moved;
                              }) > 1;
    }

    [[nodiscard]] std::vector<std::uint32_t> vertices_left() const {
        std::vector<std::uint32_t> left;
        for (const auto& [v, twin] : twins_)
            if (is_kept(v)) left.push_back(v);
        return left;
    }

    /// Where the fan lies: what touches in a point are as a rule two cones, of solid or of space,
    /// and each draws back into itself.
    [[nodiscard]] point3 to_neighbors(std::uint32_t v) const {
        point3 sum{0.0, 0.0, 0.0};
        for (const std::uint32_t f : stars_[v])
            for (const std::uint32_t corner : solid_.faces[f])
                if (corner != v)
                    sum =
                        base::plus(sum, unit(base::minus(solid_.points[corner], solid_.points[v])));
        return unit(sum);
    }

    /// Against the mean of the normals: where the fan is flat.
    [[nodiscard]] point3 inward(std::uint32_t v) const {
        point3 sum{0.0, 0.0, 0.0};
        for (const std::uint32_t f : stars_[v]) {
            const auto [a, b, c] = base::triangle_of(solid_, f);
            sum = base::minus(sum, unit(base::cross(base::minus(b, a), base::minus(c, a))));
        }
        return unit(sum);
    }

    /// Behind all faces of the fan, as nearly as a few steps of the perceptron come to that.
    [[nodiscard]] point3 behind_all(std::uint32_t v) const {
        constexpr int rounds = 200;
        point3 way = to_neighbors(v);
        std::vector<point3> normals;
        for (const std::uint32_t f : stars_[v]) {
            const auto [a, b, c] = base::triangle_of(solid_, f);
            normals.push_back(unit(base::cross(base::minus(b, a), base::minus(c, a))));
        }
        for (int round = 0; round < rounds; ++round) {
            const auto worst = std::ranges::max_element(
                normals, {}, [&](const point3& n) { return base::dot(n, way); });
            if (base::dot(*worst, way) < 0.0) break;
            way = base::minus(way, base::scaled(*worst, 1.5 * base::dot(*worst, way) + 1e-9));
        }
        return unit(way);
    }

    [[nodiscard]] point3 direction(std::uint32_t v, int way) const {
        if (way == 0) return to_neighbors(v);
        if (way == 1) return inward(v);
        if (way == 2) return behind_all(v);
        const int octant = way - likely_ways;
        return {octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0};
    }

    [[nodiscard]] double steps(int doublings) const { return step_ * std::ldexp(2.0, doublings); }

    /// Moves vertices; those that then meet something go back.
    void move(const std::vector<std::uint32_t>& vertices, int way, double by) {
        std::vector<point3> places;
        for (const std::uint32_t v : vertices) {
            point3 place = base::plus(twins_.at(v).given, base::scaled(direction(v, way), by));
            if (of_ == precision::float32)
                place = {base::nearest_float(place.x), base::nearest_float(place.y),
                         base::nearest_float(place.z)};
            places.push_back(place);
        }
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            solid_.points[vertices[i]] = places[i];
            twins_.at(vertices[i]).moved = twins_.at(vertices[i]).on_trial = true;
        }
        bool any_broke = true;
        while (any_broke) {  // what moved beside one that went back may now meet it
            for (const std::uint32_t v : vertices) join(groups_[twins_.at(v).group]);
            mark_equal(vertices);
            mark_meeting(vertices);
            any_broke = false;
            for (const std::uint32_t v : vertices) {
                twin_vertex& twin = twins_.at(v);
                if (!std::exchange(twin.broke, false)) continue;
                any_broke = true;
                twin.moved = twin.on_trial = false;
                solid_.points[v] = twin.given;
            }
        }
        for (const std::uint32_t v : vertices) twins_.at(v).on_trial = false;
    }

    /// Those that are still at the place of another of their group.
    void mark_equal(const std::vector<std::uint32_t>& vertices) {
        for (const std::uint32_t v : vertices) {
            twin_vertex& twin = twins_.at(v);
            if (!twin.on_trial) continue;
            const auto is_here = [&](std::uint32_t w) {
                return w != v && solid_.points[w] == solid_.points[v];
            };
            twin.broke = std::ranges::any_of(groups_[twin.group], is_here);
        }
    }

    void mark_meeting(const std::vector<std::uint32_t>& vertices) {
        std::vector<std::uint8_t> certified(solid_.faces.size(), 1);
        bool any = false;
        for (const std::uint32_t v : vertices) {
            if (!twins_.at(v).on_trial || twins_.at(v).broke) continue;
            any = true;
            for (const std::uint32_t f : stars_[v]) certified[f] = 0;
        }
        if (!any) return;
        // Vertices that still are at one place are one: what touches there is nothing new.
        const round::surface_faults faults =
            round::find_faults({solid_.points, joined_}, {.certified = certified, .solid = true});
        const auto blame = [&](std::uint32_t f) {
            for (const std::uint32_t corner : solid_.faces[f])
                if (const auto at = twins_.find(corner); at != twins_.end() && at->second.on_trial)
                    at->second.broke = true;
        };
        for (const std::uint32_t f : faults.degenerate) blame(f);
        for (const std::uint32_t f : faults.turned) blame(f);
        for (const face_pair& pair : faults.pairs) {
            blame(pair.a);
            blame(pair.b);
        }
    }

    mesh& solid_;
    precision of_;
    double limit_;
    double step_;
    double wide_;
    base::stars stars_;
    std::vector<std::vector<std::uint32_t>> groups_;
    std::vector<face> joined_;                      ///< see `join`
    std::map<std::uint32_t, twin_vertex> twins_{};  ///< those of groups
};

}  // namespace

detached detach(mesh& solid, precision of, double limit) {
    return detacher(solid, of, limit).run();
}

}  // namespace treeform::detail::repair
