#include "tools/picture/pack.hpp"

#include "tools/picture/json.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tools {
namespace {

constexpr std::uint32_t grid_steps = 1U << 22;

/// Points in steps from the low corner of the box. Quarters of coordinates keep differences
/// finite.
class lattice {
  public:
    explicit lattice(const tf::box3& box) : low_(box.min) {
        double extent = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            extent = std::max(extent, 0.25 * box.max[axis] - 0.25 * box.min[axis]);
        quarter_step_ = std::max(extent / grid_steps, 1e-300);
    }
    [[nodiscard]] std::array<std::uint32_t, 3> at(const tf::point3& p) const {
        std::array<std::uint32_t, 3> steps{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double offset = (0.25 * p[axis] - 0.25 * low_[axis]) / quarter_step_;
            if (std::isfinite(offset))  // points that no face uses may be anything
                steps[axis] = static_cast<std::uint32_t>(
                    std::clamp(std::round(offset), 0.0, double{grid_steps}));
        }
        return steps;
    }
    [[nodiscard]] double step() const { return std::min(4.0 * quarter_step_, 1e300); }

  private:
    tf::point3 low_;
    double quarter_step_ = 1.0;
};

/// Whole numbers as base64 of zigzag varints: small ones take one byte.
class number_stream {
  public:
    void put(std::int64_t value) {
        std::uint64_t bits =
            (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; bits > 127; bits >>= 7) bytes_ += static_cast<char>((bits & 127) | 128);
        bytes_ += static_cast<char>(bits);
    }
    [[nodiscard]] std::string base64() const;

  private:
    std::string bytes_;
};

std::string number_stream::base64() const {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes_.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = i; j < i + 3; ++j)
            group = group << 8 | (j < bytes_.size() ? static_cast<unsigned char>(bytes_[j]) : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j <= bytes_.size() ? letters[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

using steps3 = std::array<std::uint32_t, 3>;

/// [V] for each point the first point in its cube of a grid; corners of marked faces stay.
std::vector<std::uint32_t> cluster(std::span<const steps3> points, const std::vector<bool>& fixed,
                                   std::uint32_t cubes) {
    std::unordered_map<std::uint64_t, std::uint32_t> first_in_cube;
    std::vector<std::uint32_t> leader(points.size());
    const std::uint32_t edge = grid_steps / cubes + 1;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::uint64_t key = 0;
        for (const std::uint32_t step : points[i]) key = key << 21 | step / edge;
        leader[i] = fixed[i] ? i : first_in_cube.try_emplace(key, i).first->second;
    }
    return leader;
}

struct thinned {
    std::vector<std::uint32_t> leader{};  ///< [V]
    std::vector<std::uint32_t>
        faces{};  ///< ascending: what was found, and context with three corners
    std::size_t left_out = 0;
};

bool is_context(const scene& shown, std::span<const std::uint8_t> kind, std::size_t at) {
    return shown.classes[kind[kind.size() == 1 ? 0 : at]].context;
}

/// Joins points in ever larger cubes until few enough faces of the context are left.
thinned thin_out(const scene& shown, const scene_mesh& m, std::span<const steps3> points,
                 std::size_t limit) {
    const std::span<const tf::face> faces = m.mesh.faces;
    std::vector<bool> found(faces.size()), fixed(points.size(), false);
    std::size_t found_count = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        found[f] = !m.value.empty() || !is_context(shown, m.kind, f);
        if (!found[f]) continue;
        ++found_count;
        for (const std::uint32_t corner : faces[f]) fixed[corner] = true;
    }
    const std::size_t context = faces.size() - found_count;
    thinned result;
    // Where all fits, every face stays, even one that is a line on the grid.
    const bool all = context <= limit;
    for (std::uint32_t cubes = grid_steps; true; cubes = cubes > 400 ? 400 : cubes * 3 / 4) {
        if (all) {
            result.leader.resize(points.size());
            std::iota(result.leader.begin(), result.leader.end(), 0U);
        } else {
            result.leader = cluster(points, fixed, cubes);
        }
        result.faces.clear();
        std::size_t room = cubes > 2 ? faces.size() : limit;
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            const auto [x, y, z] = std::array{
                result.leader[faces[f][0]], result.leader[faces[f][1]], result.leader[faces[f][2]]};
            if (!found[f] && !all && (x == y || y == z || z == x || room == 0)) continue;
            if (!found[f]) --room;
            result.faces.push_back(f);
        }
        result.left_out = faces.size() - result.faces.size();
        if (all || cubes <= 2 || result.faces.size() - found_count <= limit) return result;
    }
}

/// Packs one item after the other.
class packer {
  public:
    packer(const scene& shown, const scene_limits& limits)
        : shown_(shown), limits_(limits), box_(box_of(shown, false)), grid_(box_) {
        for (const scene_mesh& m : shown.meshes)
            for (std::size_t f = 0; f < m.mesh.faces.size(); ++f)
                if (m.value.empty() && is_context(shown, m.kind, f)) ++context_faces_;
        for (const scene_dots& d : shown.dots) dots_ += d.points.size();
    }

    json mesh(const scene_mesh& m);
    json lines(const scene_lines& l);
    json dots(const scene_dots& d);
    /// What is left: the frame of it all.
    void finish(packed_scene& packed);

  private:
    void put_point(const steps3& point, steps3& last) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            stream_.put(std::int64_t{point[axis]} - std::int64_t{last[axis]});
        last = point;
    }
    /// A millionth of the map's range a step; 0 is no value.
    void put_value(double value) {
        const scene_map& map = *shown_.map;
        const double share = (value - map.low) / std::max(map.high - map.low, 1e-300);
        const double steps = std::round(std::clamp(share, -1e3, 1e3) * 1e6);
        stream_.put(std::isnan(share) ? 0
                                      : static_cast<std::int64_t>(steps) + (steps >= 0.0 ? 1 : 0));
    }
    void put_group(std::uint32_t group) {
        stream_.put(group == no_number ? -1 : std::int64_t{group});
    }
    void put_number(std::span<const std::uint32_t> numbers, std::size_t at, std::int64_t& last) {
        std::int64_t number = numbers.empty() ? static_cast<std::int64_t>(at) : numbers[at];
        if (number == no_number) number = -1;
        stream_.put(number - last);
        last = number;
    }

    const scene& shown_;
    const scene_limits limits_;
    tf::box3 box_;
    lattice grid_;
    number_stream stream_{};
    std::size_t context_faces_ = 0;
    std::size_t dots_ = 0;
    std::size_t faces_left_out_ = 0;
    std::size_t dots_left_out_ = 0;
};

json packer::mesh(const scene_mesh& m) {
    std::vector<steps3> points;
    points.reserve(m.mesh.points.size());
    for (const tf::point3& p : m.mesh.points) points.push_back(grid_.at(p));
    const std::size_t share =
        context_faces_ <= limits_.faces
            ? m.mesh.faces.size()
            : limits_.faces * m.mesh.faces.size() / std::max<std::size_t>(context_faces_, 1);
    const thinned kept = thin_out(shown_, m, points, share);
    faces_left_out_ += kept.left_out;

    // Points in the order in which faces use them.
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> place(points.size(), unused), used;
    steps3 last{};
    for (const std::uint32_t f : kept.faces)
        for (const std::uint32_t corner : m.mesh.faces[f]) {
            const std::uint32_t leader = kept.leader[corner];
            if (place[leader] != unused) continue;
            place[leader] = static_cast<std::uint32_t>(used.size());
            used.push_back(leader);
            put_point(points[leader], last);
        }
    if (!m.value.empty())
        for (const std::uint32_t p : used) put_value(m.value[p]);
    std::int64_t last_corner = 0, last_number = 0;
    for (const std::uint32_t f : kept.faces) {
        for (const std::uint32_t corner : m.mesh.faces[f]) {
            const std::int64_t at = place[kept.leader[corner]];
            stream_.put(at - last_corner);
            last_corner = at;
        }
        put_number(m.number, f, last_number);
        stream_.put(m.kind[m.kind.size() == 1 ? 0 : f]);
        if (!m.group_word.empty()) put_group(m.group[f]);
    }
    return {{"name", m.name},
            {"word", "face"},
            {"points", used.size()},
            {"faces", kept.faces.size()},
            {"ghost", m.ghost},
            {"variant", m.variant},
            {"has_values", !m.value.empty()},
            {"group_word", m.group_word}};
}

json packer::lines(const scene_lines& l) {
    steps3 last{};
    std::int64_t last_number = 0;
    for (std::size_t i = 0; i < l.ends.size(); ++i) {
        for (const tf::point3& end : l.ends[i]) put_point(grid_.at(end), last);
        if (!l.word.empty()) put_number(l.number, i, last_number);
    }
    return {{"class", l.kind}, {"count", l.ends.size()}, {"word", l.word},  {"labeled", l.labeled},
            {"text", l.text},  {"variant", l.variant},   {"width", l.width}};
}

json packer::dots(const scene_dots& d) {
    // Of context, every so many that the limit holds.
    const std::size_t stride = (dots_ + limits_.dots - 1) / std::max<std::size_t>(limits_.dots, 1);
    std::size_t count = 0;
    steps3 last{};
    std::int64_t last_number = 0;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
        const tf::point3& p = d.points[i];
        if (!is_finite(p) || (stride > 1 && i % stride != 0 && is_context(shown_, d.kind, i))) {
            ++dots_left_out_;
            continue;
        }
        ++count;
        put_point(grid_.at(p), last);
        put_number(d.number, i, last_number);
        stream_.put(d.kind[d.kind.size() == 1 ? 0 : i]);
        if (!d.group_word.empty()) put_group(d.group[i]);
        if (!d.value.empty()) put_value(d.value[i]);
        for (std::size_t axis = 0; axis < 3 && !d.normal.empty(); ++axis)
            stream_.put(static_cast<std::int64_t>(std::round(d.normal[i][axis] * 1000.0)));
    }
    return {{"word", d.word},
            {"count", count},
            {"group_word", d.group_word},
            {"has_values", !d.value.empty()},
            {"has_normals", !d.normal.empty()},
            {"variant", d.variant},
            {"width", d.width}};
}

void packer::finish(packed_scene& packed) {
    json& header = packed.header;
    const auto size = grid_.at(box_.max);
    header["low"] = box_.min;
    header["size"] = size;
    header["steps"] = std::max({size[0], size[1], size[2], 1U});
    header["step"] = grid_.step();
    header["left_out"] = json::array();
    const auto leave_out = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0)
            header["left_out"].push_back({{"count", count}, {"one", one}, {"many", many}});
    };
    leave_out(faces_left_out_, "other face", "other faces");
    leave_out(dots_left_out_, "point", "points");
    packed.geometry = stream_.base64();
}

json map_entry(const std::optional<scene_map>& map) {
    if (!map) return nullptr;
    return {{"name", map->name},
            {"low", map->low},
            {"high", map->high},
            {"colors", map->colors},
            {"band", map->band ? json(*map->band) : json(nullptr)}};
}

json table_entry(const scene_table& table) {
    json rows = json::array();
    for (const scene_row& row : table.rows) {
        rows.push_back({{"cells", row.cells}});
        if (row.box) rows.back()["box"] = {row.box->min, row.box->max};
    }
    return {
        {"title", table.title}, {"columns", table.columns}, {"rows", rows}, {"note", table.note}};
}

json histogram_entry(const scene_histogram& h) {
    json marks = json::array();
    for (const auto& [at, text] : h.marks) marks.push_back({{"at", at}, {"text", text}});
    return {{"title", h.title},
            {"low", h.low},
            {"high", h.high},
            {"counts", h.counts},
            {"marks", marks},
            {"note", h.note},
            {"logarithmic", h.logarithmic}};
}

}  // namespace

packed_scene pack(const scene& shown, const scene_limits& limits) {
    packed_scene packed;
    json& header = packed.header;
    header = {{"format", "treeform-scene/1"},
              {"unit_name", shown.unit},
              {"y_is_up", shown.y_is_up},
              {"place_word", shown.place_word.empty() ? "place" : shown.place_word}};
    for (const char* list : {"classes", "meshes", "lines", "dots", "arrows", "labels", "histograms",
                             "tables", "facts"})
        header[list] = json::array();
    const std::vector<bool> mapped = mapped_classes(shown);
    for (std::size_t k = 0; k < shown.classes.size(); ++k) {
        const scene_class& c = shown.classes[k];
        header["classes"].push_back({{"name", c.name},
                                     {"color", c.color},
                                     {"count", c.count},
                                     {"context", c.context},
                                     {"mapped", bool{mapped[k]}},
                                     {"shown", c.shown}});
    }
    packer to(shown, limits);
    for (const scene_mesh& m : shown.meshes) header["meshes"].push_back(to.mesh(m));
    for (const scene_lines& l : shown.lines) header["lines"].push_back(to.lines(l));
    for (const scene_dots& d : shown.dots) header["dots"].push_back(to.dots(d));
    for (const scene_arrow& a : shown.arrows)
        header["arrows"].push_back(
            {{"from", a.from}, {"to", a.to}, {"text", a.text}, {"class", a.kind}});
    for (const scene_label& l : shown.labels)
        header["labels"].push_back({{"at", l.at}, {"text", l.text}, {"class", l.kind}});
    for (const scene_histogram& h : shown.histograms)
        header["histograms"].push_back(histogram_entry(h));
    for (const scene_table& t : shown.tables) header["tables"].push_back(table_entry(t));
    for (const auto& [name, value] : shown.facts)
        header["facts"].push_back(json::array({name, value}));
    header["map"] = map_entry(shown.map);
    to.finish(packed);
    return packed;
}

}  // namespace tools
