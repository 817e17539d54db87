#include "bindings.hpp"

namespace binding {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

py::tuple closest_point(const held_mesh& mesh, const points_array& queries, double radius) {
    const auto all = points_of(queries);
    std::vector<tf::point3> points(all.size(), {nan, nan, nan});
    std::vector<double> distances(all.size(), infinity);
    std::vector<std::uint32_t> faces(all.size(), none);
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const auto found =
            tf::closest_point(mesh.prepared(), all.subspan(begin, end - begin), radius);
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (!found[i]) continue;
            points[begin + i] = found[i]->point;
            distances[begin + i] = found[i]->distance;
            faces[begin + i] = found[i]->face;
        }
    });
    return py::make_tuple(as_array(std::move(points)), as_array<double>(std::move(distances)),
                          as_array(std::move(faces)));
}

py::tuple locate(const held_mesh& mesh, const points_array& queries) {
    const auto all = points_of(queries);
    std::vector<std::uint8_t> where(all.size());
    std::vector<std::int32_t> winding(all.size());
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const auto found = tf::locate(mesh.prepared(), all.subspan(begin, end - begin));
        for (std::size_t i = 0; i < found.size(); ++i) {
            where[begin + i] = static_cast<std::uint8_t>(found[i].where);
            winding[begin + i] = found[i].winding;
        }
    });
    return py::make_tuple(as_array<std::uint8_t>(std::move(where)),
                          as_array<std::int32_t>(std::move(winding)));
}

// ---- rays ----

/// The rays of two arrays.
class rays {
  public:
    rays(const points_array& origins, const points_array& directions, double t_min, double t_max)
        : from_(points_of(origins)), along_(points_of(directions)), t_min_(t_min), t_max_(t_max) {
        if (from_.size() != along_.size())
            throw std::invalid_argument("directions: " + std::to_string(along_.size()) + " for " +
                                        std::to_string(from_.size()) + " origins");
    }
    [[nodiscard]] std::size_t size() const { return from_.size(); }

    [[nodiscard]] std::vector<tf::ray3> piece(std::size_t begin, std::size_t end) const {
        std::vector<tf::ray3> some;
        for (std::size_t i = begin; i < end; ++i)
            some.push_back({numbers(from_[i]), numbers(along_[i]), t_min_, t_max_});
        return some;
    }

  private:
    tf::points_view from_, along_;
    double t_min_, t_max_;
};

/// `t` of a hit of ray `i` of a piece. It may be infinite by the length of the direction alone.
double finite(double t, std::size_t i) {
    if (t < infinity && t > -infinity) return t;
    throw std::invalid_argument("directions: that of ray " + std::to_string(i) +
                                " is too short: where it hits a face, t is no number of float64");
}

py::tuple raycast(const held_mesh& mesh, const points_array& origins,
                  const points_array& directions, double t_min, double t_max) {
    const rays all(origins, directions, t_min, t_max);
    std::vector<double> t(all.size(), infinity);
    std::vector<std::uint32_t> faces(all.size(), none);
    std::vector<std::uint8_t> at(all.size(), static_cast<std::uint8_t>(tf::feature::interior));
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const auto hits = tf::raycast(mesh.prepared(), all.piece(begin, end));
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (!hits[i]) continue;
            t[begin + i] = finite(hits[i]->t, i);
            faces[begin + i] = hits[i]->face;
            at[begin + i] = static_cast<std::uint8_t>(hits[i]->at);
        }
    });
    return py::make_tuple(as_array<double>(std::move(t)), as_array(std::move(faces)),
                          as_array<std::uint8_t>(std::move(at)));
}

py::tuple raycast_all(const held_mesh& mesh, const points_array& origins,
                      const points_array& directions, double t_min, double t_max) {
    const rays all(origins, directions, t_min, t_max);
    std::vector<std::uint32_t> ray_of_hit, faces;
    std::vector<double> t;
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const tf::answer_lists<tf::mesh_hit> found =
            tf::raycast_all(mesh.prepared(), all.piece(begin, end));
        for (std::size_t i = 0; i + 1 < found.begin.size(); ++i)
            for (std::size_t h = found.begin[i]; h < found.begin[i + 1]; ++h) {
                ray_of_hit.push_back(static_cast<std::uint32_t>(begin + i));
                faces.push_back(found.answers[h].face);
                t.push_back(finite(found.answers[h].t, i));
            }
    });
    return py::make_tuple(as_array<double>(std::move(t)), as_array(std::move(ray_of_hit)),
                          as_array(std::move(faces)));
}

py::array raycast_any(const held_mesh& mesh, const points_array& origins,
                      const points_array& directions, double t_min, double t_max) {
    const rays all(origins, directions, t_min, t_max);
    std::vector<std::uint8_t> any(all.size());
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const auto hit = tf::raycast_any(mesh.prepared(), all.piece(begin, end));
        std::copy(hit.begin(), hit.end(), any.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    return as_array<std::uint8_t>(std::move(any));
}

}  // namespace

void add_nearness(py::module_& module) {
    add_job(module, "closest_point", &closest_point);
    add_job(module, "locate", &locate);
    add_job(module, "raycast", &raycast);
    add_job(module, "raycast_all", &raycast_all);
    add_job(module, "raycast_any", &raycast_any);
}

}  // namespace binding
