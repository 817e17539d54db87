#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/words.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/point_search.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tools {
namespace {

/// Numbers of classes.
struct mark {
    enum number : std::uint8_t { faces, alone, of_two, of_few, of_some, of_many, dropped, way };
};

mark::number mark_of(std::uint32_t size) {
    if (size < 2) return mark::alone;
    if (size == 2) return mark::of_two;
    if (size < 5) return mark::of_few;
    return size < 10 ? mark::of_some : mark::of_many;
}

/// Points that are kept, by the sizes of their groups, and those that became one of them.
void add_points(scene& shown, const tf::mesh_file& file, const welding& w) {
    const std::vector<std::uint32_t>& group = w.result.groups.group_of_point;
    const std::vector<tf::point3>& places = w.result.file.mesh.points;
    std::vector<std::uint32_t> size(w.distinct(), 0);
    for (const std::uint32_t g : group) ++size[g];
    // Of a cloud of millions, all are thinned out alike.
    const bool many = w.points > 2'000'000;
    for (std::size_t k = mark::of_two; k <= mark::dropped; ++k) shown.classes[k].context = many;
    scene_dots kept{.points = places, .number = w.result.vertex_source};
    std::array<std::uint64_t, mark::way> counts{};
    for (std::size_t g = 0; g < size.size(); ++g) {
        kept.kind.push_back(mark_of(size[g]));
        if (is_finite(places[g])) ++counts[kept.kind.back()];
    }
    kept.group_word = "merged of";
    kept.group = std::move(size);
    shown.dots.push_back(std::move(kept));

    scene_dots gone{.group_word = "now point"};
    gone.width = 4.0;
    scene_lines ways{.kind = mark::way};
    ways.width = 1.0;
    for (std::uint32_t p = 0; p < group.size(); ++p) {
        if (w.keeps(p)) continue;
        const tf::point3 &from = file.mesh.points[p], &to = places[group[p]];
        gone.points.push_back(from);
        gone.kind.push_back(mark::dropped);
        gone.number.push_back(p);
        gone.group.push_back(group[p]);
        gone.value.push_back(std::hypot(from.x - to.x, from.y - to.y, from.z - to.z));
        if (!many && gone.value.back() > 0.0) ways.ends.push_back({from, to});
    }
    counts[mark::dropped] = gone.points.size();
    for (std::size_t k = mark::alone; k <= mark::dropped; ++k)
        shown.classes[k].count = counted(counts[k], "point", "points");
    if (w.result.statistics.max_displacement > 0.0)
        shown.map = {.name = "moved by",
                     .high = w.result.statistics.max_displacement,
                     .colors = {"#2c7bb6", "#ffd23f", "#d7191c"}};
    else
        gone.value.clear();
    shown.dots.push_back(std::move(gone));
    shown.lines.push_back(std::move(ways));
}

/// How far each of some points is from the nearest other place.
void add_distances(scene& shown, const tf::mesh_file& file, const welding& w) {
    constexpr std::size_t most = 100'000, bins = 60;
    std::vector<std::array<double, 3>> places;
    for (const std::uint32_t p : tf::find_equal_points(file.mesh.points).first_of_group)
        if (const tf::point3& at = file.mesh.points[p]; is_finite(at))
            places.push_back({at.x, at.y, at.z});
    if (places.size() < 2) return;
    const tf::point_search<3> search(places);
    const std::size_t step = (places.size() + most - 1) / most;
    std::vector<std::array<double, 3>> asked;
    for (std::size_t i = 0; i < places.size(); i += step) asked.push_back(places[i]);
    std::vector<double> distances;
    for (const auto& near : search.k_nearest(asked, 2).answers)
        if (near.distance > 0.0) distances.push_back(near.distance);
    if (distances.empty()) return;
    const auto [low, high] = std::ranges::minmax(distances);
    scene_histogram shape{.title = "Distance from each point to its nearest neighbor",
                          .low = low * 0.99,
                          .high = std::max(high, w.tolerance) * 1.01,
                          .counts = std::vector<std::uint64_t>(bins, 0),
                          .logarithmic = true};
    if (w.tolerance > 0.0) shape.low = std::min(shape.low, w.tolerance * 0.9);
    for (const double d : distances) {
        const double share = std::log(d / shape.low) / std::log(shape.high / shape.low);
        ++shape.counts[std::min(bins - 1, static_cast<std::size_t>(share * double{bins}))];
    }
    if (w.tolerance > 0.0) shape.marks.emplace_back(w.tolerance, "tolerance " + brief(w.tolerance));
    shape.note =
        "The scale is logarithmic. A tolerance inside a gap of the histogram merges only points "
        "that are meant to be one.";
    const std::uint64_t equal = w.points - w.result.statistics.non_finite - places.size();
    if (equal > 0)
        shape.note += " " + counted(equal, "point has", "points have") +
                      " the coordinates of an earlier one and not in the histogram.";
    if (step > 1) shape.note += " It samples one point in " + grouped(step) + ".";
    shown.histograms.push_back(std::move(shape));
}

}  // namespace

void write_page(job& work, const tf::mesh_file& file, const welding& w,
                const weld_request& request) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-weld");
    shown.verdict = verdict(w, request);
    shown.good = true;
    shown.classes = {{"faces", "#c9ced6", counted(w.triangles, "face", "faces"), true},
                     {"merged with none", "#6b7686", {}, true},
                     {"two points in one", "#1f9e89"},
                     {"3 or 4 in one", "#3f6fd8"},
                     {"5 to 9 in one", "#8a3ffc"},
                     {"10 or more in one", "#d81fbf"},
                     {"dropped", "#e02020"},
                     {"ways", "#10131a"}};
    if (w.triangles > 0) {
        scene_mesh mesh{.mesh = file.mesh, .kind = {mark::faces}, .number = file.face_of_triangle};
        const auto finite = [&](std::uint32_t p) { return is_finite(file.mesh.points[p]); };
        const bool all = std::ranges::all_of(
            file.mesh.faces, [&](const tf::face& f) { return std::ranges::all_of(f, finite); });
        if (all) shown.meshes.push_back(std::move(mesh));
    }
    add_points(shown, file, w);
    add_distances(shown, file, w);
    shown.facts.insert(shown.facts.end() - 1,
                       {{"tolerance", request.settings.tolerance.given + " (" + brief(w.tolerance) +
                                          " in file units)"},
                        {"rule", rule_in_words(request.settings.options)}});
    write_page(work, std::move(shown));
}

}  // namespace tools
