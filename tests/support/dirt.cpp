#include <treeform/mesh/properties.hpp>

#include <support/dirt.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace test {
namespace {

using tf::point3;

constexpr double rounding = 0x1p-48;  // of the diagonal

point3 minus(const point3& a, const point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
point3 plus(const point3& a, const point3& b, double share = 1.0) {
    return {a.x + share * b.x, a.y + share * b.y, a.z + share * b.z};
}
double dot(const point3& a, const point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
point3 cross(const point3& a, const point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const point3& a) { return std::sqrt(dot(a, a)); }
point3 unit(const point3& a) { return plus({0, 0, 0}, a, 1.0 / length(a)); }

point3 random_direction(random& source) {
    while (true) {
        const point3 p{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        if (const double l = length(p); l > 0.1 && l <= 1.0) return unit(p);
    }
}

double diagonal_of(const tf::mesh& mesh) { return tf::bounding_box(mesh.points)->diagonal(); }

/// A clean mesh while it is soiled: which of its faces are to come back as they are.
struct soiler {
    const tf::mesh& clean;
    std::size_t size;
    random& source;
    dirty_mesh made{};
    std::vector<std::uint8_t> touched{};
    double diagonal = 0.0;

    soiler(const tf::mesh& mesh, std::size_t how, random& numbers)
        : clean(mesh), size(how), source(numbers) {
        made.mesh = mesh;
        touched.assign(mesh.faces.size(), 0);
        diagonal = diagonal_of(mesh);
        made.size = rounding * diagonal;
    }

    [[nodiscard]] std::array<point3, 3> triangle(std::uint32_t f) const {
        const auto [a, b, c] = clean.faces[f];
        return {clean.points[a], clean.points[b], clean.points[c]};
    }
    [[nodiscard]] point3 middle(std::uint32_t f) const {
        const auto [a, b, c] = triangle(f);
        return plus({0, 0, 0}, plus(plus(a, b), c), 1.0 / 3.0);
    }
    [[nodiscard]] double longest_edge(std::uint32_t f) const {
        const auto [a, b, c] = triangle(f);
        return std::max({length(minus(b, a)), length(minus(c, b)), length(minus(a, c))});
    }
    [[nodiscard]] double area(std::uint32_t f) const {
        const auto [a, b, c] = triangle(f);
        return length(cross(minus(b, a), minus(c, a))) / 2.0;
    }
    [[nodiscard]] std::uint32_t any_face() {
        return static_cast<std::uint32_t>(source.below(clean.faces.size()));
    }
    /// Of each size, but of a share of the faces at most.
    [[nodiscard]] std::size_t count(std::size_t few, std::size_t more, std::size_t many,
                                    std::size_t share = 8) const {
        return std::min(std::array{few, more, many}[size], clean.faces.size() / share);
    }
    [[nodiscard]] std::set<std::uint32_t> some_faces(std::size_t wanted) {
        std::set<std::uint32_t> some;
        while (some.size() < wanted) some.insert(any_face());
        return some;
    }
    void touch(std::uint32_t f) { touched[f] = 1; }
    void touch_at(const std::set<std::uint32_t>& points) {
        for (std::uint32_t f = 0; f < clean.faces.size(); ++f)
            for (const std::uint32_t corner : clean.faces[f])
                if (points.contains(corner)) touch(f);
    }
    void drop(const std::set<std::uint32_t>& faces) {
        std::vector<tf::face> left;
        for (std::uint32_t f = 0; f < clean.faces.size(); ++f)
            if (!faces.contains(f)) left.push_back(clean.faces[f]);
        made.mesh.faces = std::move(left);
    }
    std::uint32_t add(const point3& p) {
        made.mesh.points.push_back(p);
        return static_cast<std::uint32_t>(made.mesh.points.size() - 1);
    }
    dirty_mesh finished() {
        for (std::uint32_t f = 0; f < clean.faces.size(); ++f)
            if (touched[f] == 0) made.untouched.push_back(triangle(f));
        return std::move(made);
    }
};

/// Shortest edge at each point.
std::vector<double> shortest_edges(const tf::mesh& mesh) {
    std::vector<double> shortest(mesh.points.size(), std::numeric_limits<double>::infinity());
    for (const tf::face& f : mesh.faces)
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::size_t k : {(i + 1) % 3, (i + 2) % 3})
                shortest[f[i]] =
                    std::min(shortest[f[i]], length(minus(mesh.points[f[i]], mesh.points[f[k]])));
    return shortest;
}

/// The face beyond each edge of each face.
std::vector<std::array<std::uint32_t, 3>> neighbors_of(const tf::mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> along;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            along[{mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]}] = f;
    std::vector<std::array<std::uint32_t, 3>> beyond(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            beyond[f][i] = along.at({mesh.faces[f][(i + 1) % 3], mesh.faces[f][i]});
    return beyond;
}

void miss(soiler& s) {
    const auto faces = s.some_faces(s.count(1, 5, s.clean.faces.size() / 100 + 1, 20));
    s.drop(faces);
    for (const std::uint32_t f : faces) {
        s.touch(f);
        s.made.size = std::max(s.made.size, s.longest_edge(f));
    }
}

/// How many faces edges link to one, with it.
std::size_t size_of_part(const std::vector<std::array<std::uint32_t, 3>>& beyond,
                         std::uint32_t first) {
    std::set<std::uint32_t> seen{first};
    for (std::vector<std::uint32_t> open{first}; !open.empty();) {
        const std::uint32_t f = open.back();
        open.pop_back();
        for (const std::uint32_t g : beyond[f])
            if (seen.insert(g).second) open.push_back(g);
    }
    return seen.size();
}

/// A disk of faces around one, with a rim of about so many edges, and at most a sixth of its part.
std::set<std::uint32_t> disk(soiler& s, std::size_t rim_wanted) {
    const auto beyond = neighbors_of(s.clean);
    const std::uint32_t first = s.any_face();
    const std::size_t most = size_of_part(beyond, first) / 6;
    const point3 center = s.middle(first);
    std::set<std::uint32_t> faces{first}, tried{first};
    std::set<std::uint32_t> points(s.clean.faces[first].begin(), s.clean.faces[first].end());
    std::set<std::pair<double, std::uint32_t>> next;
    const auto look_beyond = [&](std::uint32_t f) {
        for (const std::uint32_t g : beyond[f])
            if (!faces.contains(g)) next.emplace(length(minus(s.middle(g), center)), g);
    };
    look_beyond(first);
    std::size_t rim = 3;
    while (!next.empty() && rim < rim_wanted && faces.size() < most) {
        const std::uint32_t g = next.begin()->second;
        next.erase(next.begin());
        std::size_t known_edges = 0, known_points = 0;
        for (const std::uint32_t f : beyond[g]) known_edges += faces.contains(f);
        for (const std::uint32_t p : s.clean.faces[g]) known_points += points.contains(p);
        // By an edge and a new point, or by two edges: otherwise there would be a second rim.
        if (known_points != known_edges + 1 && known_edges != 2) continue;
        faces.insert(g);
        points.insert(s.clean.faces[g].begin(), s.clean.faces[g].end());
        rim = known_edges == 1 ? rim + 1 : rim - 1;
        look_beyond(g);
    }
    return faces;
}

void make_hole(soiler& s) {
    const auto faces = disk(s, std::array<std::size_t, 3>{12, 37, 120}[s.size]);
    s.drop(faces);
    point3 normal{0, 0, 0};
    double area = 0.0;
    for (const std::uint32_t f : faces) {
        s.touch(f);
        area += s.area(f);
        const auto [a, b, c] = s.triangle(f);
        normal = plus(normal, cross(minus(b, a), minus(c, a)));
    }
    // As deep as its points are apart along its mean normal.
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t f : faces)
        for (const point3& p : s.triangle(f)) {
            const double height = dot(unit(normal), p);
            low = std::min(low, height);
            high = std::max(high, height);
        }
    s.made.volume_change = area * (high - low) + rounding * std::pow(s.diagonal, 3);
    s.made.size = s.diagonal;
}

void flip(soiler& s) {
    for (const std::uint32_t f : s.some_faces(s.count(1, 20, 200, 4))) {
        std::swap(s.made.mesh.faces[f][1], s.made.mesh.faces[f][2]);
        s.touch(f);
    }
}

double crack_width(const soiler& s) { return std::array{1e-5, 1e-4, 1e-3}[s.size] * s.diagonal; }

void tear(soiler& s) {
    const std::vector<double> shortest = shortest_edges(s.clean);
    s.made.mesh.points.clear();
    double widest = 0.0;
    for (std::uint32_t f = 0; f < s.clean.faces.size(); ++f) {
        s.touch(f);
        for (std::uint32_t& corner : s.made.mesh.faces[f]) {
            const double by = std::min(crack_width(s) / 2.0, shortest[corner] / 10.0);
            widest = std::max(widest, 2.0 * by);
            corner = s.add(
                plus(s.clean.points[corner], random_direction(s.source), by * s.source.unit()));
        }
    }
    s.made.size = widest;
}

/// Moves the points where the seam runs, on one side of it.
void open_seam(soiler& s) {
    const point3 normal = random_direction(s.source);
    const point3 through = s.middle(s.any_face());
    std::set<std::uint32_t> above, below, seam;
    std::vector<std::uint8_t> is_above(s.clean.faces.size());
    for (std::uint32_t f = 0; f < s.clean.faces.size(); ++f) {
        is_above[f] = dot(normal, minus(s.middle(f), through)) > 0.0;
        (is_above[f] ? above : below).insert(s.clean.faces[f].begin(), s.clean.faces[f].end());
    }
    std::ranges::set_intersection(above, below, std::inserter(seam, seam.end()));
    const std::vector<double> shortest = shortest_edges(s.clean);
    double width = crack_width(s);
    for (const std::uint32_t p : seam) width = std::min(width, shortest[p] / 5.0);
    std::map<std::uint32_t, std::uint32_t> moved;
    for (const std::uint32_t p : seam) moved[p] = s.add(plus(s.clean.points[p], normal, width));
    for (std::uint32_t f = 0; f < s.clean.faces.size(); ++f)
        if (is_above[f])
            for (std::uint32_t& corner : s.made.mesh.faces[f])
                if (seam.contains(corner)) corner = moved[corner];
    s.touch_at(seam);
    s.made.size = std::max(s.made.size, width);
}

void scatter(soiler& s) {
    const tf::box3 box = *tf::bounding_box(s.clean.points);
    const double most = std::array{0.002, 0.005, 0.01}[s.size] * s.diagonal;
    for (std::size_t i = 0; i < s.count(1, 5, 20); ++i) {
        const point3 at{s.source.in(box.min.x, box.max.x), s.source.in(box.min.y, box.max.y),
                        s.source.in(box.min.z, box.max.z)};
        tf::face f{};
        for (std::uint32_t& corner : f)
            corner = s.add(plus(at, random_direction(s.source), most * s.source.in(0.3, 1.0)));
        s.made.mesh.faces.push_back(f);
    }
}

/// From an edge to a point of a face two steps away.
void hang_inside(soiler& s) {
    const auto beyond = neighbors_of(s.clean);
    for (std::size_t i = 0; i < s.count(1, 5, 20, 40); ++i) {
        const std::uint32_t f = s.any_face();
        const std::uint32_t g = beyond[beyond[f][s.source.below(3)]][s.source.below(3)];
        const std::uint32_t a = s.clean.faces[f][0], b = s.clean.faces[f][1];
        const std::uint32_t c = s.clean.faces[beyond[g][0]][s.source.below(3)];
        if (c == a || c == b || std::ranges::count(s.clean.faces[f], c) > 0) continue;
        s.made.mesh.faces.push_back({a, b, c});
    }
}

void stand_box(soiler& s) {
    const std::uint32_t f = s.any_face();
    const auto [a, b, c] = s.triangle(f);
    const point3 up = unit(cross(minus(b, a), minus(c, a)));
    const point3 right = unit(minus(b, a)), back = cross(up, right);
    const double side = std::array{0.02, 0.06, 0.15}[s.size] * s.diagonal;
    const double depth = side * s.source.in(0.2, 0.4);
    tf::mesh box;
    for (int i = 0; i < 8; ++i) {
        point3 p = plus(s.middle(f), right, (i & 1) != 0 ? side : -side);
        p = plus(p, back, (i & 2) != 0 ? side : -side);
        box.points.push_back(plus(p, up, (i & 4) != 0 ? side : -depth));
    }
    box.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    s.made.added = box;
    box.faces.erase(box.faces.begin(), box.faces.begin() + 2);
    s.made.mesh = together(s.clean, box);
}

/// With new points in the middle of edges, which one of both faces gets.
void cut_edges(soiler& s) {
    const auto beyond = neighbors_of(s.clean);
    for (const std::uint32_t f : s.some_faces(s.count(1, 20, 200))) {
        const std::size_t i = s.source.below(3);
        const std::uint32_t g = beyond[f][i];
        if (s.touched[f] != 0 || s.touched[g] != 0) continue;
        s.touch(f);
        s.touch(g);
        const tf::face given = s.clean.faces[f];
        const std::uint32_t from = given[i], to = given[(i + 1) % 3], apex = given[(i + 2) % 3];
        const point3 along = minus(s.clean.points[to], s.clean.points[from]);
        const std::uint32_t m = s.add(plus(s.clean.points[from], along, s.source.in(0.3, 0.7)));
        s.made.mesh.faces[f] = {from, m, apex};
        s.made.mesh.faces.push_back({m, to, apex});
    }
}

void double_all(soiler& s) {
    const double by = std::array{0.02, 0.1, 0.3}[s.size] * s.diagonal;
    s.made.added = moved(s.clean, plus({0, 0, 0}, random_direction(s.source), by));
    s.made.mesh = together(s.clean, s.made.added);
}

void copy(soiler& s) {
    if (s.size == 2) {
        s.made.mesh = s.source.below(2) == 0 ? together(s.clean, s.clean) : s.clean;
        if (s.made.mesh.faces.size() == s.clean.faces.size())
            s.made.mesh.faces.insert(s.made.mesh.faces.end(), s.clean.faces.begin(),
                                     s.clean.faces.end());
        return;
    }
    for (const std::uint32_t f : s.some_faces(s.count(1, 50, 0))) {
        tf::face again = s.clean.faces[f];
        std::rotate(again.begin(), again.begin() + s.source.below(3), again.end());
        if (s.source.below(2) == 0) std::swap(again[0], again[1]);
        s.made.mesh.faces.push_back(again);
    }
}

/// Faces with a corner twice, by number or by coordinates, and faces between an edge and a point in
/// its middle, whose other side has that point.
void add_empty_faces(soiler& s) {
    const auto beyond = neighbors_of(s.clean);
    for (const std::uint32_t f : s.some_faces(s.count(1, 10, 100))) {
        const auto [a, b, c] = s.clean.faces[f];
        const std::size_t way = s.source.below(3);
        if (way == 0) s.made.mesh.faces.push_back({a, b, a});
        if (way == 1) s.made.mesh.faces.push_back({a, b, s.add(s.clean.points[a])});
        if (way != 2) continue;
        s.touch(f);
        const point3 along = minus(s.clean.points[b], s.clean.points[a]);
        const std::uint32_t m = s.add(plus(s.clean.points[a], along, 0.5));
        s.made.mesh.faces[f] = {a, m, c};
        s.made.mesh.faces.push_back({m, b, c});
        s.made.mesh.faces.push_back({a, b, m});
        for (const std::uint32_t g : beyond[f]) s.touch(g);
    }
}

void unjoin(soiler& s) {
    const tf::mesh soup = unjoined(s.clean);
    if (s.size == 0) s.made.mesh = soup;
    if (s.size == 1) s.made.mesh = shuffled(s.source, soup).mesh;
    if (s.size < 2) return;
    for (const std::uint32_t f : s.some_faces(s.clean.faces.size() / 10))
        for (std::uint32_t& corner : s.made.mesh.faces[f]) corner = s.add(s.clean.points[corner]);
}

void invert(soiler& s) {
    s.made.mesh = inside_out(s.clean);
    if (s.size > 0) s.made.mesh = shuffled(s.source, s.made.mesh).mesh;
    if (s.size > 1) s.made.mesh = unjoined(s.made.mesh);
}

}  // namespace

std::string_view name_of(dirt_kind kind) {
    constexpr std::array<std::string_view, dirt_kinds> names{
        "missing",    "hole",     "flipped",   "cracks",  "seam",   "strays",    "inner",
        "bottomless", "inverted", "junctions", "overlap", "copies", "zero_area", "unjoined"};
    return names[static_cast<std::size_t>(kind)];
}

dirty_mesh soil(const tf::mesh& clean, dirt_kind kind, std::size_t size, random& source) {
    constexpr std::array<void (*)(soiler&), dirt_kinds> ways{
        miss,      make_hole, flip,      tear,       open_seam, scatter,         hang_inside,
        stand_box, invert,    cut_edges, double_all, copy,      add_empty_faces, unjoin};
    soiler s(clean, size, source);
    ways[static_cast<std::size_t>(kind)](s);
    return s.finished();
}

}  // namespace test
