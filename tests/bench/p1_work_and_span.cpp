/// \file
/// P1: work, span and their ratio, the parallelism, of the main verbs. The ratio bounds how many
/// threads can be of use: on as many, a verb takes at most twice its span. One thread tells it, so
/// it says on two cores what sixty-four would have to do.
///
/// A program of its own, in which `span_recorder.cpp` stands in for the loops on all threads.

#include "bench/models.hpp"
#include "bench/span_places.hpp"
#include "bench/span_recorder.hpp"
#include "bench/subdivide.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace treeform::bench {
namespace {

/// Each face cut into four at the middles of its edges: what meets meets still, in more faces.
mesh quartered(const mesh& m) {
    mesh result{.points = m.points, .faces = {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] =
            middle_of.emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.points.size()));
        if (is_new) {
            const point3 p = m.points[a], q = m.points[b];
            result.points.push_back({0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)});
        }
        return at->second;
    };
    for (const auto& [a, b, c] : m.faces) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const face& f : {face{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
            result.faces.push_back(f);
    }
    return result;
}

struct two_meshes {
    shared_mesh a, b;
};

two_meshes with_turned(const setting& setting, const std::string& name, double degrees,
                       const std::function<mesh()>& make) {
    const shared_mesh a = cached(setting, name, make);
    return {a, std::make_shared<mesh>(turned(*a, degrees / 45.0 * std::atan(1.0)))};
}

/// A scan that meets itself nowhere, and its like.
two_meshes clean_scans(const setting& setting) {
    const model scan = setting.effort == effort::full
                           ? model{"clean/armadillo_29k.obj", "400k", 400'000}
                           : model{"", "2k", 2'000};
    return with_turned(setting, name_of(setting, scan), 45,
                       [&] { return mesh(*load(setting, scan)); });
}

/// A scan of about a million faces, some hundred of which meet others of it.
two_meshes meeting_scans(const setting& setting) {
    return with_turned(setting, "meeting_scan", 18, [&] {
        const shared_mesh human = load_real(setting, "selfint/human_14k.obj");
        if (setting.effort == effort::full && human) return quartered(quartered(quartered(*human)));
        mesh sphere = *load(setting, {"", "2k", 2'000});  // with one inside that comes out
        const auto given = static_cast<std::uint32_t>(sphere.points.size());
        for (std::uint32_t p = 0; p < given; ++p) {
            point3 moved = sphere.points[p];
            moved.x += 0.3;
            sphere.points.push_back(moved);
        }
        const std::size_t faces = sphere.faces.size();
        for (std::size_t f = 0; f < faces; ++f) {
            const auto [a, b, c] = sphere.faces[f];
            sphere.faces.push_back({a + given, b + given, c + given});
        }
        return sphere;
    });
}

/// Three points of its own for each face, as STL has them.
mesh soup_of(const mesh& m) {
    mesh soup;
    for (const face& f : m.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t p : f) soup.points.push_back(m.points[p]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

struct verb {
    std::string name;
    std::function<std::size_t()> size;
    std::function<job()> prepare;
};

std::vector<verb> verbs_of(const std::string& of, const std::function<two_meshes()>& load) {
    const auto size = [=] {
        const two_meshes given = load();
        return given.a->faces.size() + given.b->faces.size();
    };
    const auto one = [=] { return load().a->faces.size(); };
    std::vector<verb> verbs;
    const auto add = [&](const char* name, const auto& how_many, const auto& prepare) {
        verbs.push_back({fmt::format("{}, {}", name, of), how_many, prepare});
    };
    add("union", size,
        [=] { return make_job([given = load()] { return unite(*given.a, *given.b); }); });
    add("union, prepared", size, [=] {
        const two_meshes given = load();
        const auto a = std::make_shared<prepared_mesh>(prepared_mesh::borrow(*given.a));
        const auto b = std::make_shared<prepared_mesh>(prepared_mesh::borrow(*given.b));
        (void)unite(*a, *b);
        return make_job([given, a, b] { return unite(*a, *b); });
    });
    add("prepare", one, [=] {
        return make_job([given = load()] {
            prepared_mesh ready = prepared_mesh::borrow(*given.a);
            (void)unite(ready, mesh{});
            return ready;
        });
    });
    add("embed curves", size, [=] {
        return make_job([given = load()] {
            return split(std::array<mesh_view, 2>{*given.a, *given.b});
        });
    });
    const auto with_pairs = [=](const auto& ask) {
        const two_meshes given = load();
        const auto both =
            std::make_shared<mesh>(join_meshes(std::array<mesh_view, 2>{*given.a, *given.b}));
        return make_job([=, found = self_intersections(*both)] { return ask(*both, found.pairs); });
    };
    add("curves as segments", size, [=] {
        return with_pairs([](const mesh& m, const auto& p) { return intersection_curves(m, p); });
    });
    add("curves as paths", size, [=] {
        return with_pairs([](const mesh& m, const auto& p) { return intersection_paths(m, p); });
    });
    add("self-intersections", one,
        [=] { return make_job([given = load()] { return self_intersections(*given.a); }); });
    add("weld", one, [=] { return make_job([soup = soup_of(*load().a)] { return weld(soup); }); });
    add("tree", one,
        [=] { return make_job([given = load()] { return build_face_tree(*given.a); }); });
    return verbs;
}

int run(int argc, char** argv) {
    CLI::App app("Work, span and parallelism of the main verbs, told by one thread.", "span");
    setting setting;
    std::string only;
    std::string out;
    bool tiny = false;
    std::size_t places = 0;
    int runs = 5;
    app.add_option("VERB", only, "only verbs whose names hold this");
    app.add_flag("--tiny", tiny, "only see that everything runs");
    app.add_option("--runs", runs, "of which the shortest counts, for work and span each");
    app.add_option("--where", places, "so many places with the largest share of the span");
    app.add_option("--out", out, "a table, comma-separated");
    app.add_option("--models", setting.models_dir, "folder of real models");
    app.add_option("--cache", setting.cache_dir, "folder for models made here")->required();
    CLI11_PARSE(app, argc, argv);
    if (tiny) setting.effort = effort::tiny;
    setting.cache_dir += std::string("/") + cache_version;
    std::filesystem::create_directories(setting.cache_dir);

    std::vector<verb> verbs = verbs_of("clean", [&] { return clean_scans(setting); });
    for (verb& v : verbs_of("meeting", [&] { return meeting_scans(setting); }))
        verbs.push_back(std::move(v));
    std::string table = "verb,faces,work ms,span ms,parallelism\n";
    fmt::print("{:28} {:>9} {:>9} {:>9} {:>11}\n", "P1", "faces", "work, ms", "span, ms",
               "parallelism");
    for (const verb& v : verbs) {
        if (v.name.find(only) == std::string::npos) continue;
        const job job = v.prepare();
        const auto recorded = [&](double every) {
            work_and_span result = record(job.run, every);
            job.discard();
            return result;
        };
        (void)recorded(0.0);  // memory is at hand then
        work_and_span best = recorded(0.0);
        for (int i = 1; i < runs; ++i) {
            const work_and_span next = recorded(0.0);
            best.work = std::min(best.work, next.work);
            best.span = std::min(best.span, next.span);
        }
        const std::size_t size = v.size();
        fmt::print("{:28} {:9} {:9.2f} {:9.3f} {:11.1f}\n", v.name, size, 1e3 * best.work,
                   1e3 * best.span, best.parallelism());
        table += fmt::format("\"{}\",{},{:.3f},{:.3f},{:.2f}\n", v.name, size, 1e3 * best.work,
                             1e3 * best.span, best.parallelism());
        if (places > 0) {
            constexpr double every = 1e-4;
            std::vector<std::vector<void*>> samples;
            for (int i = 0; i < runs; ++i)
                for (auto& calls : recorded(every).samples) samples.push_back(std::move(calls));
            for (const span_place& place : places_of(samples, places))
                fmt::print("    {:8.3f} ms  {}\n",
                           1e3 * every * static_cast<double>(place.samples) / runs, place.calls);
        }
        std::fflush(stdout);
    }
    if (!out.empty()) {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(out.c_str(), "w"),
                                                                   &std::fclose);
        if (!file) throw std::runtime_error("cannot write " + out);
        fmt::print(file.get(), "{}", table);
    }
    return 0;
}

}  // namespace
}  // namespace treeform::bench

int main(int argc, char** argv) {
    try {
        return treeform::bench::run(argc, argv);
    } catch (const std::exception& failure) {
        fmt::print(stderr, "span: {}\n", failure.what());
        return 1;
    }
}
