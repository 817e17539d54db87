#include "bindings.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "steps.hpp"
#include "words.hpp"
#include <treeform/mesh/curves.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

constexpr words<tf::pair_kind_count> kind_words{"crossing", "overlap",  "fold",      "duplicate",
                                                "pierce",   "touching", "degenerate"};

tf::pair_kinds kinds_of(const std::vector<std::string>& names) {
    tf::pair_kinds kinds;
    for (const std::string& name : names)
        kinds = kinds + choice<tf::pair_kind>("kinds", kind_words, name);
    return kinds;
}

/// `pairs`, `kinds` and `counts` of a result.
template <class Result>
py::dict found(const Result& result) {
    py::dict made;
    made["pairs"] = column(result.pairs, [](const tf::face_pair& pair) {
        return std::array<std::uint32_t, 2>{pair.a, pair.b};
    });
    made["kinds"] = column(result.pairs, [](const tf::face_pair& pair) {
        return static_cast<std::uint8_t>(pair.kind);
    });
    py::dict counts;
    for (std::size_t i = 0; i < kind_words.size(); ++i) counts[kind_words[i]] = result.counts[i];
    made["counts"] = counts;
    return made;
}

std::vector<tf::face_pair> pairs_of(const ids_array& pairs, const array_of<std::uint8_t>& kinds) {
    const auto numbers = rows_of<std::array<std::uint32_t, 2>>(pairs);
    const auto kind = rows_of<std::uint8_t>(kinds);
    if (kind.size() != numbers.size()) throw std::invalid_argument("kinds: one for each pair");
    std::vector<tf::face_pair> all;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (kind[i] >= kind_words.size())
            throw std::invalid_argument("kinds: " + std::to_string(kind[i]) + " at " +
                                        std::to_string(i) + " is none");
        all.push_back({numbers[i][0], numbers[i][1], static_cast<tf::pair_kind>(kind[i])});
    }
    return all;
}

py::dict self_intersections(const held_mesh& mesh, const std::vector<std::string>& kinds,
                            const std::string& vertices, bool first_only, std::size_t limit) {
    tf::self_intersection_options options{.vertices = identity_of(vertices),
                                          .first_only = first_only,
                                          .kinds = kinds_of(kinds),
                                          .limit = limit};
    return found(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return mesh.with([&](const auto& m) { return tf::self_intersections(m, options); });
    }));
}

/// How to search a file, from Python.
struct search_settings {
    std::vector<std::string> kinds{};
    std::optional<std::string> vertices{};
    std::string format{};
    std::uint64_t memory = 0;
    std::filesystem::path folder{};
    std::uint64_t faces_per_tile = 0;

    [[nodiscard]] tf::stream_search_options options() const {
        tf::stream_search_options made{.kinds = kinds_of(kinds),
                                       .format = format,
                                       .memory = memory,
                                       .folder = folder,
                                       .faces_per_tile = faces_per_tile};
        if (vertices) made.vertices = identity_of(*vertices);
        return made;
    }
};

py::dict as_dict(tf::stream_search_result&& result) {
    py::dict made = found(result.found);
    std::vector<std::uint32_t> numbers(result.part.mesh.faces.size());
    for (std::size_t f = 0; f < numbers.size(); ++f)
        numbers[f] = result.part.face_in_file(static_cast<std::uint32_t>(f));
    made["face_in_file"] = as_array(std::move(numbers));
    made["points"] = as_array(std::move(result.part.mesh.points));
    made["faces"] = as_array(std::move(result.part.mesh.faces));
    made["stored_faces"] = result.stored_faces;
    made["dropped"] = result.part.dropped;
    made["tiles"] = result.tiles;
    return made;
}

py::dict self_intersections_of_file(const std::filesystem::path& path,
                                    const search_settings& settings, const py::object& team) {
    tf::stream_search_options options = settings.options();
    options.team = team_of(team);
    const at_work here(team);
    return as_dict(run([&](const tf::progress_callback& report) {
        options.progress = [&](std::string_view step, double share) {
            return !report || report(step == "scatter" ? share / 2 : 0.5 + share / 2);
        };
        return tf::self_intersections_of_file(path, options);
    }));
}

using search_in_steps = work_in_steps<tf::stream_search>;

std::unique_ptr<search_in_steps> search_of(const std::filesystem::path& path,
                                           const search_settings& settings) {
    tf::stream_search_options options = settings.options();
    return run([&](const tf::progress_callback&) {
        return std::make_unique<search_in_steps>([&](const step_progress& progress) {
            options.progress = std::ref(progress);
            return tf::stream_search(path, options);
        });
    });
}

void add_search_in_steps(py::module_& module) {
    py::class_<search_settings>(module, "SearchSettings")
        .def(py::init([](std::vector<std::string> kinds, std::optional<std::string> vertices,
                         std::string format, std::uint64_t memory, std::filesystem::path folder,
                         std::uint64_t faces_per_tile) {
            return search_settings{std::move(kinds), std::move(vertices), std::move(format),
                                   memory,           std::move(folder),   faces_per_tile};
        }));
    py::class_<search_in_steps>(module, "SearchInSteps")
        .def("scatter",
             [](search_in_steps& all) {
                 return all.step([](tf::stream_search& search) {
                     return search.scatter() == tf::status::ok ? search.tiles() : 0;
                 });
             })
        .def("tiles",
             [](search_in_steps& all) {
                 return all.step([](tf::stream_search& search) { return search.tiles(); });
             })
        .def("unfinished",
             [](search_in_steps& all) {
                 return all.step([](tf::stream_search& search) { return search.unfinished(); });
             })
        .def("search_tile",
             [](search_in_steps& all, std::size_t tile) {
                 all.step([=](tf::stream_search& search) { return search.search_tile(tile); });
             })
        .def(
            "finish",
            [](search_in_steps& all) {
                return as_dict(all.step([](tf::stream_search& search) { return search.finish(); }));
            })
        .def("remove_folder",
             [](search_in_steps& all) {
                 all.step([](tf::stream_search& search) {
                     search.remove_folder();
                     return true;
                 });
             })
        .def("close", &search_in_steps::close);
    module.def("search_of", &search_of);
}

py::tuple group_pairs(const held_mesh& mesh, const ids_array& pairs,
                      const array_of<std::uint8_t>& kinds) {
    const std::vector<tf::face_pair> all = pairs_of(pairs, kinds);
    tf::intersection_regions groups =
        run([&](const tf::progress_callback&) { return tf::group_pairs(mesh.view(), all); });
    py::list regions;
    for (tf::intersection_region& one : groups.regions)
        regions.append(py::make_tuple(as_array(std::move(one.faces)), as_array(one.min),
                                      as_array(one.max), one.pairs));
    return py::make_tuple(regions, as_array(std::move(groups.region_of_pair)));
}

py::tuple intersection_paths(const held_mesh& mesh, const ids_array& pairs,
                             const array_of<std::uint8_t>& kinds) {
    const std::vector<tf::face_pair> all = pairs_of(pairs, kinds);
    tf::curve_network net =
        run([&](const tf::progress_callback&) { return tf::intersection_paths(mesh.view(), all); });
    py::list paths;
    for (tf::curve_path& one : net.paths)
        paths.append(py::make_tuple(as_array(std::move(one.points)), one.closed));
    return py::make_tuple(
        column(net.points,
               [](const tf::curve_point& p) {
                   return std::array<double, 3>{p.position.x, p.position.y, p.position.z};
               }),
        paths);
}

py::dict mesh_intersections(const held_mesh& a, const held_mesh& b,
                            const std::vector<std::string>& kinds, bool first_only,
                            std::size_t limit, const array_of<double>& move_a,
                            const array_of<double>& move_b) {
    tf::mesh_intersection_options options{.move_a = transform_of(move_a),
                                          .move_b = transform_of(move_b),
                                          .first_only = first_only,
                                          .kinds = kinds_of(kinds),
                                          .limit = limit};
    return found(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return with_both(a, b, [&](const auto& m, const auto& n) {
            return tf::mesh_intersections(m, n, options);
        });
    }));
}

py::array faces_in_box(const held_mesh& mesh, const array_of<double>& min,
                       const array_of<double>& max) {
    return as_array(run([&](const tf::progress_callback&) {
        return tf::faces_in_box(mesh.view(), point_of(min), point_of(max));
    }));
}

}  // namespace

void add_intersections(py::module_& module) {
    module.attr("KINDS") = py::cast(kind_words);
    module.def("self_intersections", &self_intersections);
    module.def("self_intersections_of_file", &self_intersections_of_file);
    module.def("group_pairs", &group_pairs);
    module.def("intersection_paths", &intersection_paths);
    module.def("mesh_intersections", &mesh_intersections);
    module.def("faces_in_box", &faces_in_box);
    add_search_in_steps(module);
}

}  // namespace binding
