/// \file
/// S2: what memory alone would take. Beside the steps that read a mesh once, the time in which its
/// bytes can be copied: those of the faces and points, and of the tree.

#include "bench/models.hpp"
#include "bench/page.hpp"
#include "bench/workload.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

namespace treeform::bench {
namespace {

constexpr const char* build_name = "tree";
constexpr const char* self_name = "tree and self-intersections";
constexpr const char* copy_name = "copying as many bytes";

std::vector<model> scans(effort effort) {
    if (effort == effort::tiny) return {{"", "2k", 2'000}, {"", "4k", 4'000}};
    const char* scan = "clean/armadillo_29k.obj";
    std::vector<model> all{{scan, "300k", 300'000}, {scan, "1M", 1'000'000}};
    if (effort == effort::full) all.push_back({scan, "3M", 3'000'000});
    return all;
}

/// What has to be read and written at least: the mesh, and 32 bytes a face of the tree.
std::size_t least_bytes(const mesh& mesh) {
    return mesh.points.size() * sizeof(point3) + mesh.faces.size() * (sizeof(face) + 32);
}

std::vector<figure> bytes_of(const mesh& mesh) {
    return {{"bytes", static_cast<double>(least_bytes(mesh))}};
}

/// Half of the bytes are read, half are written.
job copy(const shared_mesh& mesh) {
    struct halves {
        detail::buffer<std::byte> from, to;
    };
    const auto bytes = std::make_shared<halves>();
    bytes->from.resize(least_bytes(*mesh) / 2);
    bytes->to.resize(bytes->from.size());
    std::fill_n(bytes->from.data(), bytes->from.size(), std::byte{1});
    std::fill_n(bytes->to.data(), bytes->to.size(), std::byte{0});
    return make_job(
        [bytes] {
            constexpr std::size_t piece = std::size_t{1} << 18;
            for_chunks(
                bytes->to.size(), piece, [&](std::size_t begin, std::size_t end, std::size_t) {
                    std::memcpy(bytes->to.data() + begin, bytes->from.data() + begin, end - begin);
                });
            return bytes->to[bytes->to.size() - 1];
        },
        [](std::byte last) { return last == std::byte{1} ? 0.0 : 1.0; },
        [mesh](std::byte) { return bytes_of(*mesh); });
}

contest contest_of(const setting& setting, const model& model) {
    const auto given = [=] { return load(setting, model); };
    contest contest{.name = name_of(setting, model) + "/memory",
                    .size = [=] { return given()->faces.size(); }};
    for (const unsigned threads : {1U, 2U}) {
        contest.contestants.push_back(
            {build_name, threads,
             [=] { return make_job([mesh = given()] { return build_face_tree(*mesh); }); }});
        contest.contestants.push_back({self_name, threads, [=] {
                                           return make_job([mesh = given()] {
                                               return self_intersections(
                                                   *mesh, {.vertices = vertex_identity::by_index});
                                           });
                                       }});
        contest.contestants.push_back({copy_name, threads, [=] { return copy(given()); }});
    }
    return contest;
}

}  // namespace

void memory_bound(const setting& setting, const contest_visitor& visit) {
    for (const model& model : scans(setting.effort)) visit(contest_of(setting, model));
}

section draw_memory_bound(const std::vector<outcome>& outcomes, const std::string& machine) {
    section result{.paper = "",
                   .ours =
                       "The share of the machine's memory bandwidth that a step would use if it "
                       "moved each byte once."};
    line_chart lines;
    lines.caption = {"Steps beside a copy of the bytes they have to move", machine};
    lines.x = {"triangles", true};
    lines.y = {"time, ms", true};
    lines.curves = curves_by_size(outcomes);
    result.pictures.push_back({"s2_memory_bound.svg", svg(lines)});
    result.table.push_back({"", "threads", "bytes a triangle", "copy, GB/s", "tree, GB/s",
                            "tree, % of the copy", "with self-intersections, %"});
    for (const outcome& outcome : outcomes)
        for (const unsigned threads : {1U, 2U}) {
            const auto copied = outcome.value(copy_name, threads);
            const auto built = outcome.value(build_name, threads);
            const auto searched = outcome.value(self_name, threads);
            const auto bytes = outcome.figure(copy_name, "bytes");
            if (!copied || !built || !searched || !bytes) continue;
            const auto rate = [&](double ms) { return fmt::format("{:.3g}", *bytes / ms * 1e-6); };
            const auto share = [&](double ms) {
                return fmt::format("{:.0f}", 100.0 * *copied / ms);
            };
            result.table.push_back(
                {outcome.name, fmt::format("{}", threads),
                 fmt::format("{:.0f}", *bytes / static_cast<double>(outcome.size)), rate(*copied),
                 rate(*built), share(*built), share(*searched)});
        }
    return result;
}

}  // namespace treeform::bench
