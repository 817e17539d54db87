#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-place/place.hpp"
#include <treeform/mesh/deviation.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tools {
namespace {

/// Numbers of classes.
struct mark {
    enum number : std::uint8_t {
        moving,
        start,
        fixed,
        penetrates,
        touches,
        is_near,
        contact,
        travel,
        shortest_way,
        bed
    };
};

/// Whether the page is about how far MOVING is from the fixed meshes.
bool measures(const placing& p) {
    return p.settings.mode == place_mode::measure || p.settings.mode == place_mode::align;
}

std::vector<scene_class> classes_of(const placing& p) {
    const tf::body_file& file = p.moving.files[0];
    return {
        {file.label, "#f2a65a", {}, true},
        {"where it was", "#7d8590", {}, true},
        {p.fixed.files.size() == 1 ? p.fixed.files[0].label : "fixed", "#b4bac2", {}, true},
        {"penetrating", "#e02020"},
        {"touching", "#ecd000"},
        {"within the clearance", "#00a0c0"},
        {"contacts", "#d81fbf",
         p.at.contacts.empty() ? ""
                               : counted(p.at.contact_count, "pair of faces", "pairs of faces")},
        {"travel", "#1d4ed8"},
        {"nearest points", "#7c1d6f"},
        {"bed", "#8fae8b", {}, true}};
}

std::string in_unit(const scene& shown, double value) {
    return brief(value) + (shown.unit.empty() ? "" : " " + shown.unit);
}

/// By `mesh_relation`: behind `mark::penetrates`, or none.
constexpr std::array<int, 5> place_of_relation{-1, 1, 0, 2, -1};

/// A body as faces, or as dots where it is a cloud. Its points may be elsewhere.
void add_body(scene& shown, const tf::body_set& set, std::size_t body, tf::points_view points,
              mark::number plain, std::span<const tf::mesh_relation> relations,
              std::vector<double> values = {}) {
    const tf::prepared_mesh& shape = set.shapes[body];
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint8_t> kinds;
    for (std::uint32_t f = 0; f < shape.indexed_view().faces.size(); ++f) {
        numbers.push_back(set.face_in_file(body, f));
        const auto how = relations.empty() ? tf::mesh_relation::disjoint : relations[f];
        const int worse = place_of_relation[static_cast<std::size_t>(how)];
        kinds.push_back(
            static_cast<std::uint8_t>(worse < 0 ? int{plain} : mark::penetrates + worse));
    }
    if (shape.is_cloud())
        shown.dots.push_back({.points = {points.begin(), points.end()},
                              .kind = std::move(kinds),
                              .number = std::move(numbers),
                              .value = std::move(values)});
    else
        shown.meshes.push_back({.mesh = {points, shape.indexed_view().faces},
                                .kind = std::move(kinds),
                                .number = std::move(numbers),
                                .name = set.label(body),
                                .value = std::move(values),
                                .ghost = plain == mark::start});
}

tf::point3 center_of(const tf::box3& box) {
    return {0.5 * box.min.x + 0.5 * box.max.x, 0.5 * box.min.y + 0.5 * box.max.y,
            0.5 * box.min.z + 0.5 * box.max.z};
}

/// What MOVING's points are from the fixed meshes, and the colors of that.
std::optional<tf::deviation_result> find_distances(job& work, const placing& p,
                                                   tf::points_view points) {
    const auto is_cloud = [](const tf::prepared_mesh& m) { return m.is_cloud(); };
    if (p.fixed.shapes.empty() || std::ranges::any_of(p.fixed.shapes, is_cloud)) return {};
    const std::span<const tf::face> faces = tf::mesh_ref(p.moving.shapes[0]).view().faces;
    auto found = tf::deviation(tf::mesh_view{points, faces}, p.fixed.shapes,
                               {.both_ways = false, .progress = work.progress("page")});
    work.call_ended(found && found->status == tf::status::cancelled);
    return found;
}

void add_deviation(scene& shown, const placing& p, const tf::deviation_result& r) {
    const auto& band = p.settings.deviation.band;
    double scale = r.p99 > 0.0 ? r.p99 : r.max;
    if (band) scale = std::max(std::abs((*band)[0]), std::abs((*band)[1])) * 1.5;
    shown.map = {.name = r.is_signed ? "signed distance" : "distance",
                 .low = r.is_signed ? -scale : 0.0,
                 .high = scale > 0.0 ? scale : 1.0,
                 .colors = {"#2166ac", "#f7f7f7", "#b2182b"},
                 .band = band};
    if (!r.is_signed) shown.map->colors = {"#f7f7f7", "#f4a582", "#b2182b"};
    scene_histogram shape{.title = "Distances of the points",
                          .low = r.lowest,
                          .high = r.highest,
                          .counts = r.histogram};
    if (band)
        for (const double end : *band) shape.marks.emplace_back(end, "band " + brief(end));
    shown.histograms.push_back(std::move(shape));
    scene_table table{.title = "Deviation", .columns = {"what", "value"}};
    const std::initializer_list<std::pair<const char*, double>> values{
        {"mean", r.mean},       {"root mean square", r.rms}, {"50 % within", r.p50},
        {"95 % within", r.p95}, {"99 % within", r.p99},      {"least", r.lowest},
        {"greatest", r.highest}};
    for (const auto& [name, value] : values) table.rows.push_back({.cells = {name, value}});
    if (r.band_counts) table.rows.push_back({.cells = {"out of the band", out_of_band(r)}});
    shown.tables.push_back(std::move(table));
}

void add_clearance(scene& shown, const placing& p, const tf::deviation_result& r) {
    double high = p.at.clearance > 0.0 ? 4.0 * p.at.clearance : r.p50;
    if (!(high > 0.0)) high = r.max > 0.0 ? r.max : 1.0;
    shown.map = {.name = "clearance",
                 .high = high,
                 .colors = {"#d7191c", "#fdae61", "#ffffbf", "#abd9e9", "#2c7bb6"}};
}

/// A square as large as the view needs, at the height of the bed.
tf::mesh bed_under(const tf::box3& box, double height) {
    const tf::point3 c = center_of(box);
    const double half = 0.7 * std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    return {{{c.x - half, c.y - half, height},
             {c.x + half, c.y - half, height},
             {c.x + half, c.y + half, height},
             {c.x - half, c.y + half, height}},
            {{0, 1, 2}, {0, 2, 3}}};
}

void add_travel(scene& shown, const job& work, const placing& p, const tf::box3& from,
                const tf::box3& to) {
    tf::point3 begin = center_of(from), end = center_of(to);
    std::string words;
    if (const json& depth = work.entry["depth"]; depth.is_object()) {
        const json& move = depth["move"];
        end = {begin.x + move[0].get<double>(), begin.y + move[1].get<double>(),
               begin.z + move[2].get<double>()};
        words = "moved out by " + in_unit(shown, depth["bound"].get<double>());
    }
    const double way = std::hypot(end.x - begin.x, end.y - begin.y, end.z - begin.z);
    if (!(way > 0.0)) return;
    if (words.empty()) words = in_unit(shown, p.at.travel > 0.0 ? p.at.travel : way);
    shown.arrows.push_back({begin, end, words, mark::travel});
}

void add_contacts(scene& shown, const placing& p) {
    scene_dots dots{.word = "contact"};
    dots.width = 7.0;
    for (const tf::placement_contact& c : p.at.contacts) {
        dots.points.push_back(c.point);
        dots.normal.push_back(c.normal);
    }
    dots.kind = {mark::contact};
    if (!dots.points.empty()) shown.dots.push_back(std::move(dots));
    if (!p.at.nearest || !(p.at.nearest->surface_distance > 0.0)) return;
    const auto& how = *p.at.nearest;
    shown.lines.push_back({.kind = mark::shortest_way,
                           .ends = {{how.on_a.point, how.on_b.point}},
                           .word = "nearest points",
                           .labeled = "length",
                           .text = in_unit(shown, how.surface_distance),
                           .width = 3.0});
    shown.dots.push_back({.points = {how.on_a.point, how.on_b.point},
                          .kind = {mark::shortest_way},
                          .word = "nearest point",
                          .width = 6.0});
}

/// The map of distances, and the value of each point.
std::vector<double> add_map(scene& shown, const placing& p, const tf::deviation_result& r) {
    std::vector<double> values = r.distances;
    if (measures(p)) {
        add_deviation(shown, p, r);
        return values;
    }
    add_clearance(shown, p, r);
    for (double& v : values) v = std::abs(v);
    return values;
}

/// How faces lie; where there is no place, where they are.
std::vector<std::vector<tf::mesh_relation>> face_relations(const placing& p) {
    if (p.fixed.shapes.empty() || p.settings.mode == place_mode::align) return {};
    const tf::prepared_mesh& shape = p.moving.shapes[0];
    const double clearance = p.used(p.settings.clearance);
    const tf::placement at =
        p.at ? p.at : tf::measure_in_place(shape, p.fixed.shapes, {.clearance = clearance});
    return at.face_relations(shape, p.fixed.shapes);
}

/// Parts in the colors of their files, with their names above.
void add_parts(scene& shown, const tf::body_set& parts, const tf::packing& found,
               std::span<const std::string> labels, std::uint8_t no_place) {
    scene_table table{.title = "Parts", .columns = {"part", "file", "plate", "position"}};
    for (std::size_t i = 0; i < parts.shapes.size(); ++i) {
        const tf::packed_part& at = found.parts[i];
        const tf::body_file& file = parts.file_of(i);
        const auto number = std::min<std::size_t>(
            static_cast<std::size_t>(std::ranges::find(labels, file.label) - labels.begin()),
            labels.size() - 1);
        const std::uint8_t kind = at.placed ? static_cast<std::uint8_t>(number) : no_place;
        scene_mesh mesh{.mesh = {at.points, parts.shapes[i].indexed_view().faces},
                        .kind = {kind},
                        .name = parts.label(i),
                        .ghost = !at.placed};
        for (std::uint32_t f = 0; f < mesh.mesh.faces.size(); ++f)
            mesh.number.push_back(parts.face_in_file(i, f));
        shown.meshes.push_back(std::move(mesh));
        const tf::box3 box = tf::bounding_box(at.points).value_or(tf::box3{});
        tf::point3 top = center_of(box);
        top.z = box.max.z;
        shown.labels.push_back({top, stem_of(file.label), kind});
        table.rows.push_back({.cells = {i, file.label, at.placed ? json(at.plate) : json("none"),
                                        in_words(box.min) + " to " + in_words(box.max)},
                              .box = box});
    }
    shown.tables.push_back(std::move(table));
}

/// The rims of plates, and with a height their boxes.
void add_plates(scene& shown, const tf::pack_options& options, const tf::packing& found,
                std::uint8_t kind) {
    scene_lines rim{.kind = kind};
    for (unsigned k = 0; k < std::max(found.plates_used, 1U); ++k) {
        const double x = options.corner.x + k * options.plate_step.x;
        const double y = options.corner.y + k * options.plate_step.y;
        const double z = found.bed, height = options.size.z;
        const std::array<tf::point3, 4> corners{{{x, y, z},
                                                 {x + options.size.x, y, z},
                                                 {x + options.size.x, y + options.size.y, z},
                                                 {x, y + options.size.y, z}}};
        const auto above = [&](tf::point3 p) { return tf::point3{p.x, p.y, p.z + height}; };
        for (std::size_t i = 0; i < 4; ++i) {
            const tf::point3 &a = corners[i], &b = corners[(i + 1) % 4];
            rim.ends.push_back({a, b});
            if (!std::isfinite(height)) continue;
            rim.ends.push_back({a, above(a)});
            rim.ends.push_back({above(a), above(b)});
        }
        shown.labels.push_back({corners[0], "plate " + std::to_string(k), kind});
    }
    shown.lines.push_back(std::move(rim));
}

}  // namespace

void write_page(job& work, const placing& p, const tf::deviation_result* known) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-place");
    shown.title = work.name + ": " + name_of(p.settings.mode);
    // Down to a bed is -z in every format.
    if (p.settings.mode == place_mode::drop || p.settings.mode == place_mode::lay)
        shown.y_is_up = false;
    shown.verdict = sentence(p);
    shown.good = p.at && (!p.aligned || p.aligned->converged) &&
                 p.at.relation != tf::mesh_relation::penetrating;
    shown.classes = classes_of(p);
    const tf::prepared_mesh& shape = p.moving.shapes[0];
    const tf::points_view before = shape.indexed_view().points;
    const bool moves = p.at && p.settings.mode != place_mode::measure && !p.at.points.empty();
    const tf::points_view points = moves ? tf::points_view(p.at.points) : before;

    std::optional<tf::deviation_result> found;
    if (p.at && known == nullptr) found = find_distances(work, p, points);
    if (found) known = &*found;
    std::vector<double> values;
    if (known != nullptr) values = add_map(shown, p, *known);
    if (known != nullptr && p.settings.mode == place_mode::measure &&
        (known->band_counts || shape.is_cloud())) {
        shown.verdict += "; 95% within " + in_unit(shown, known->p95) +
                         band_in_words(*known, p.settings.deviation);
        if (known->band_counts) shown.good = out_of_band(*known) == 0;
    }
    // With a band, distances are what one looks for, not the faces that meet.
    const bool of_band = known != nullptr && known->band_counts && measures(p);
    std::vector<std::vector<tf::mesh_relation>> relations;
    if (!of_band) relations = face_relations(p);
    relations.resize(1 + p.fixed.shapes.size());
    add_body(shown, p.moving, 0, points, mark::moving, relations[0], std::move(values));
    const tf::box3 from = tf::bounding_box(before).value_or(tf::box3{});
    const tf::box3 to = tf::bounding_box(points).value_or(tf::box3{});
    if (moves && from != to) add_body(shown, p.moving, 0, before, mark::start, {});
    for (std::size_t i = 0; i < p.fixed.shapes.size(); ++i)
        add_body(shown, p.fixed, i, p.fixed.shapes[i].indexed_view().points, mark::fixed,
                 relations[1 + i]);
    // What is measured is seen through the fixed meshes: half of it may be inside.
    if (known != nullptr && measures(p) && (shape.is_cloud() || of_band))
        for (std::size_t m = shape.is_cloud() ? 0 : 1; m < shown.meshes.size(); ++m)
            shown.meshes[m].ghost = true;
    tf::mesh floor;
    if (p.at.bed || p.laid) floor = bed_under(to, p.at.bed.value_or(to.min.z));
    if (!floor.faces.empty())
        shown.meshes.push_back(
            {.mesh = floor, .kind = {mark::bed}, .name = "the bed", .ghost = true});
    add_travel(shown, work, p, from, to);
    if (!of_band) add_contacts(shown, p);
    write_page(work, std::move(shown));
}

void write_page(job& work, const place_settings& settings, const tf::body_set& parts,
                const tf::packing& found) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-place");
    shown.title = work.name + ": pack";
    shown.y_is_up = false;  // the plates lie flat
    shown.verdict = found.message();
    shown.good = found.not_placed.empty();
    constexpr std::size_t most = 200;
    std::vector<std::string> labels;  // of files, a class each
    for (const tf::body_file& file : parts.files)
        if (std::ranges::find(labels, file.label) == labels.end() && labels.size() < most)
            labels.push_back(file.label);
    for (std::size_t i = 0; i < labels.size(); ++i)
        shown.classes.push_back({labels[i], scene_color(i), {}, true});
    const auto no_place = static_cast<std::uint8_t>(labels.size());
    const auto plate = static_cast<std::uint8_t>(labels.size() + 1);
    shown.classes.push_back({"without a place", "#7d8590", {}, true});
    shown.classes.push_back({"plates", "#10131a"});
    add_parts(shown, parts, found, labels, no_place);
    add_plates(shown, pack_options_of(settings.pack), found, plate);
    shown.place_word = "part";
    write_page(work, std::move(shown));
}

}  // namespace tools
