/// \file
/// Clouds welded by several that share one folder: a team, or processes that do not know of each
/// other. Whoever does it, and however often some are killed, the bytes are those of one.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/random.hpp>
#include <support/thread_team.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;

using test::killed;

/// What a run has written: files by their names.
std::vector<std::string> contents(const fs::path& folder, const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (const std::string& name : names) {
        std::ifstream in(folder / name, std::ios::binary);
        all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return all;
}

struct job {
    tf::cloud_inputs inputs{};
    tf::weld_stream_options options{};
    std::function<tf::weld_stream_outputs()> outputs{};
};

tf::weld_stream_result weld_alone(const job& work) {
    return tf::weld_stream(work.inputs, work.outputs(), work.options);
}

/// As a team; one is killed after so many steps, if any. Returns what the first one knows.
std::optional<tf::weld_stream_result> weld_as_team(const job& work, std::size_t size,
                                                   std::size_t victim = 0, int steps = 0) {
    std::optional<tf::weld_stream_result> first;
    const bool all_lived = test::run_as_team(size, [&](const tf::communicator& team) {
        tf::weld_stream_options options = work.options;
        options.communicator = team;
        if (team.rank == victim && steps > 0)
            options.step_done = [left = steps]() mutable {
                if (--left == 0) throw killed();
            };
        auto result = tf::weld_stream(work.inputs, work.outputs(), options);
        if (team.rank == 0) first = std::move(result);
    });
    return all_lived ? first : std::nullopt;
}

/// As processes that do not know of each other.
tf::weld_stream_result weld_shared(const job& work, test::random& random) {
    const tf::weld_stream_options& options = work.options;
    std::size_t tiles = 0;
    for (int twice = 0; twice < 2; ++twice) {
        tf::shared_weld one(work.inputs, options);
        if (twice == 1) CHECK(one.take_survey() == tf::status::ok);
        CHECK(one.scatter() == tf::status::ok);
        tiles = one.tiles();
        CHECK(one.survey().tiles == tiles);
        CHECK(one.unfinished().size() == tiles);
    }
    std::vector<std::size_t> order;
    for (std::size_t t = 0; t < 2 * tiles; ++t) order.push_back(t / 2);
    random.shuffle(order);
    std::vector<std::thread> threads;
    for (std::size_t part = 0; part < 3; ++part)
        threads.emplace_back([&, part] {
            for (std::size_t i = part; i < order.size(); i += 3)
                static_cast<void>(tf::shared_weld(work.inputs, options).weld_tile(order[i]));
        });
    for (std::thread& t : threads) t.join();
    tf::shared_weld last(work.inputs, options);
    CHECK(last.unfinished().empty());
    const tf::weld_stream_result result = last.finish(work.outputs());
    CHECK(result.status == tf::status::ok);
    last.remove_folder();
    return result;
}

/// Clouds that are hard in one way each.
std::vector<std::vector<tf::point3>> families(std::size_t count, test::random& random) {
    std::vector<std::vector<tf::point3>> all(9);
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
    for (std::size_t i = 0; i < count; ++i) {
        const tf::point3 p{random.unit(), random.unit(), random.unit()};
        const auto x = static_cast<double>(i) / static_cast<double>(count);
        all[0].push_back(p);                          // shuffled
        all[1].push_back({x, 0.1 * p.y, 0.1 * p.z});  // sorted
        all[2].push_back(i % 2 == 0 ? p : tf::point3{0.5 + 0.02 * p.x, 0.5, p.z * 0.02});
        all[3].push_back({2 * p.x, 0.001 * p.y, 0.0});                 // a line
        all[4].push_back({p.x, p.y, 0.25});                            // a plane
        all[5].push_back(i % 3 == 0 ? p : tf::point3{0.5, 0.5, 0.5});  // equal points
        // Rows that hang on those before them, of points and of small heaps.
        all[7].push_back({0.012 * static_cast<double>(i % side) + 0.004 * p.x,
                          0.012 * static_cast<double>(i / side) + 0.004 * p.y, 0.0});
        all[8].push_back({0.02 * static_cast<double>(i / 4 % (side / 2)) + 0.008 * p.x,
                          0.02 * static_cast<double>(i / 4 / (side / 2)) + 0.008 * p.y,
                          0.008 * p.z});
        all[6].push_back({0.05 * static_cast<double>(random.below(12)),
                          0.05 * static_cast<double>(random.below(12)),
                          i % 50 == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0});
    }
    return all;
}

/// A folder with a cloud in two files, and what is written there.
class team_folder : public test::own_folder {
  public:
    team_folder() : own_folder("weld_team_test") {}

    void put(const std::vector<tf::point3>& points, test::random& random) const {
        const std::size_t half = points.size() / 2 - 3;
        for (const bool second : {false, true}) {
            tf::mesh_file file;
            file.mesh.points.assign(points.begin() + (second ? std::ptrdiff_t(half) : 0),
                                    second ? points.end() : points.begin() + std::ptrdiff_t(half));
            const std::size_t rows = file.mesh.points.size();
            tf::element& vertices = file.attributes.find_or_add("vertex", rows);
            std::vector<float> shade(rows);
            for (float& x : shade) x = 0.25F * static_cast<float>(random.below(4));
            vertices.set(tf::column::of<float>("shade", shade));
            tf::write(input(second), file);
        }
    }
    [[nodiscard]] fs::path input(bool second) const { return path / (second ? "b.ply" : "a.ply"); }
    [[nodiscard]] job work(const std::string& format) const {
        job work;
        work.inputs.paths = {input(false), input(true)};
        work.options.folder = path / "work";
        work.outputs = [this, format] {
            tf::weld_stream_outputs outputs;
            outputs.welded = {path / ("welded." + format), {}};
            outputs.removed = {path / ("removed." + format), {}};
            return outputs;
        };
        return work;
    }
    [[nodiscard]] std::vector<std::string> take(const std::string& format) const {
        const std::vector<std::string> names{"welded." + format, "removed." + format};
        auto all = contents(path, names);
        for (const std::string& name : names) fs::remove(path / name);
        return all;
    }
};

void check_counts(const tf::weld_stream_result& a, const tf::weld_stream_result& b) {
    CHECK(a.kept == b.kept);
    CHECK(a.statistics.groups == b.statistics.groups);
    CHECK(a.statistics.max_displacement == b.statistics.max_displacement);
    CHECK(a.survey.points == b.survey.points);
    CHECK(a.survey.non_finite == b.survey.non_finite);
    CHECK(a.survey.box == b.survey.box);
    CHECK(a.survey.fits_float32 == b.survey.fits_float32);
    CHECK(a.survey.warnings.size() == b.survey.warnings.size());
    CHECK(a.mergeable == b.mergeable);
}

using change = std::function<void(tf::weld_stream_options&)>;
const std::vector<change> choices{
    [](auto&) {},
    [](auto& o) { o.same = {{.property = "shade", .tolerance = 0.25}}; },
    [](auto& o) {
        o.order_by = "shade";
        o.highest_first = true;
    },
    [](auto& o) { o.order_by = "y"; },
    [](auto& o) { o.keep = tf::weld_keep::mean; },
    [](auto& o) { o.keep = tf::weld_keep::last; },
    [](auto& o) {
        o.keep = tf::weld_keep::highest;
        o.keep_by = "shade";
    },
    [](auto& o) {
        o.tolerance = 0.01;
        o.relative = true;
    }};

}  // namespace

TEST_CASE("weld_team: any number of processes write what one writes") {
    test::random random(11);
    const team_folder folder;
    std::size_t turn = 0;
    for (const auto& points : families(500, random)) {
        folder.put(points, random);
        for (const bool chain : {false, true})
            for (const std::size_t c : {std::size_t{0}, 1 + turn % (choices.size() - 1)}) {
                const std::string format = ++turn % 3 == 0 ? "csv" : "ply";
                job work = folder.work(format);
                work.options.tolerance = 0.02;
                work.options.chain = chain;
                choices[c](work.options);
                work.options.points_per_tile = 60 + 40 * (turn % 4);
                CAPTURE(turn);
                CAPTURE(c);
                const auto one = weld_alone(work);
                const auto expected = folder.take(format);
                const std::size_t size = std::array{2U, 4U, 7U}[turn % 3];
                CAPTURE(size);
                const auto several = weld_as_team(work, size);
                REQUIRE(several);
                check_counts(*several, one);
                CHECK(folder.take(format) == expected);
                CHECK_FALSE(fs::exists(work.options.folder));
                if (turn % 4 != 0) continue;
                check_counts(weld_shared(work, random), one);
                CHECK(folder.take(format) == expected);
            }
    }
}

TEST_CASE("weld_team: more processes than there are bundles") {
    test::random random(24);
    const team_folder folder;
    folder.put(families(300, random)[7], random);
    job work = folder.work("ply");
    work.options.tolerance = 0.03;
    work.options.points_per_tile = 20;
    const auto one = weld_alone(work);
    const auto expected = folder.take("ply");
    const auto several = weld_as_team(work, 70);
    REQUIRE(several);
    check_counts(*several, one);
    CHECK(folder.take("ply") == expected);
}

TEST_CASE("weld_team: killed at any step, another number of processes goes on to the same bytes") {
    test::random random(12);
    const team_folder folder;
    const auto all = families(400, random);
    std::size_t continued = 0;
    for (int round = 0; round < 16; ++round) {
        CAPTURE(round);
        folder.put(all[random.below(all.size())], random);
        job work = folder.work("ply");
        work.options.tolerance = 0.03;
        work.options.chain = random.below(2) != 0;
        choices[static_cast<std::size_t>(round) % choices.size()](work.options);
        work.options.points_per_tile = 60;
        const auto one = weld_alone(work);
        const auto expected = folder.take("ply");
        std::optional<tf::weld_stream_result> several;
        for (int tries = 0; !several; ++tries) {
            const std::size_t size = 1 + random.below(5);
            several = weld_as_team(work, size, random.below(size),
                                   tries < 3 ? 1 + static_cast<int>(random.below(8)) : 0);
        }
        continued += several->survey.continued ? 1 : 0;
        check_counts(*several, one);
        CHECK(folder.take("ply") == expected);
    }
    CHECK(continued > 3);
}

TEST_CASE("weld_team: text is read from where the share of each begins") {
    test::random random(21);
    const team_folder folder;
    const auto points = families(700, random);
    for (std::size_t round = 0; round < 12; ++round) {
        CAPTURE(round);
        const std::string format = std::array{"xyz", "csv", "ply", "pcd"}[round % 4];
        job work = folder.work(round % 3 == 0 ? format : "ply");
        work.inputs.paths.clear();
        for (std::size_t i = 0; i < 1 + round % 3; ++i) {
            tf::mesh_file file;
            const auto& of_file = points[(round + i) % points.size()];
            file.mesh.points.assign(of_file.begin() + std::ptrdiff_t(random.below(690)),
                                    of_file.end());
            const std::size_t rows = file.mesh.points.size();
            tf::element& vertices = file.attributes.find_or_add("vertex", rows);
            std::vector<float> shade(rows);
            for (float& x : shade) x = 0.25F * static_cast<float>(random.below(4));
            vertices.set(tf::column::of<float>("shade", shade));
            work.inputs.paths.push_back(folder.path / (std::to_string(i) + "." + format));
            tf::write(work.inputs.paths.back(), file, {.ascii = true});
        }
        const std::string out = work.outputs().welded->first.extension().string().substr(1);
        work.options.tolerance = 0.02;
        work.options.points_per_tile = 80;
        choices[round % choices.size()](work.options);
        for (tf::weld_condition& c : work.options.same)
            if (format == "xyz") c.property = "column_4";
        if (format == "xyz")
            for (std::string* name : {&work.options.order_by, &work.options.keep_by})
                if (*name == "shade") *name = "column_4";
        const auto one = weld_alone(work);
        const auto expected = folder.take(out);
        for (const std::size_t size : {2U, 5U}) {
            CAPTURE(size);
            static_cast<void>(weld_as_team(work, size, random.below(size), 2));  // killed
            const auto several = weld_as_team(work, size);
            REQUIRE(several);
            check_counts(*several, one);
            CHECK(folder.take(out) == expected);
        }
    }
}

TEST_CASE("weld_team: of faults in text, all say the first") {
    const team_folder folder;
    const auto said = [&](const std::string& name, const std::string& text, std::size_t size) {
        job work = folder.work("ply");
        work.inputs.paths = {folder.path / name};
        std::ofstream(work.inputs.paths[0], std::ios::binary) << text;
        try {
            static_cast<void>(size == 1 ? weld_alone(work) : *weld_as_team(work, size));
        } catch (const tf::io_error& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    const auto lines = [](const std::vector<std::size_t>& faults, const std::string& fault) {
        std::string text;
        for (std::size_t i = 0; i < 400; ++i)
            text += std::ranges::count(faults, i) > 0
                        ? fault
                        : std::to_string(i) + " 2 " + std::to_string(i * i % 17) + " 4\n";
        return text;
    };
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 400\nproperty double x\nproperty double y\n"
        "property double z\nproperty double t\nend_header\n";
    for (const std::vector<std::size_t>& faults :
         std::vector<std::vector<std::size_t>>{{17}, {390}, {120, 130, 310}, {399}, {210, 290}})
        for (const std::string fault : {"1 2\n", "1 x 3 4\n", "1 2 3 4,5\n"})
            for (const bool as_ply : {false, true}) {
                const std::string name = as_ply ? "in.ply" : "in.xyz";
                const std::string text = (as_ply ? ply : "") + lines(faults, fault);
                const std::string one = said(name, text, 1);
                CAPTURE(one);
                const std::size_t line = faults[0] + 1 + (as_ply ? 8 : 0);
                CHECK(one.find(name + ":" + std::to_string(line) + ": ") != std::string::npos);
                for (const std::size_t size : {2U, 3U, 7U}) CHECK(said(name, text, size) == one);
            }
    // What is a fault in an even text is none where it is uneven: then it is not looked at.
    const std::string uneven = lines({30}, "1 2 3\n") + lines({300}, "1 2 3 4x\n");
    CHECK(said("in.xyz", uneven, 1) == "nothing");
    CHECK(said("in.xyz", uneven, 4) == "nothing");
    const std::string short_of = "900\n" + lines({}, "");
    CHECK(said("in.pts", short_of, 1).find("in.pts:402: ") != std::string::npos);
    CHECK(said("in.pts", short_of, 3) == said("in.pts", short_of, 1));
}

TEST_CASE("weld_team: maps and labels are those of one") {
    enum class asked { label, map, map_file };
    test::random random(13);
    const team_folder folder;
    const auto all = families(600, random);
    std::size_t turn = 0;
    for (const asked what : {asked::label, asked::map, asked::map_file})
        for (const change& choose : choices) {
            CAPTURE(++turn);
            folder.put(all[turn % all.size()], random);
            job work = folder.work("ply");
            work.options.tolerance = 0.05;
            work.options.chain = turn % 2 != 0;
            choose(work.options);
            work.options.points_per_tile = 150;
            std::vector<std::uint64_t> map;
            std::mutex one_at_a_time;
            std::set<std::thread::id> writers;
            work.outputs = [&, files = work.outputs] {
                tf::weld_stream_outputs outputs = files();
                if (what == asked::label) {
                    outputs.label = "group";
                } else if (what == asked::map) {
                    outputs.map = [&](auto next) {
                        map.insert(map.end(), next.begin(), next.end());
                    };
                } else {
                    outputs.map_path = folder.path / "map.csv";
                    outputs.map_text = [&](std::uint64_t first, auto numbers) {
                        const std::lock_guard lock(one_at_a_time);
                        writers.insert(std::this_thread::get_id());
                        std::string text;
                        for (const std::uint64_t n : numbers)
                            text += std::to_string(first++) + "," + std::to_string(n) + "\n";
                        return text;
                    };
                }
                return outputs;
            };
            weld_alone(work);
            const auto expected = folder.take("ply");
            const auto expected_text = contents(folder.path, {"map.csv"});
            CHECK(expected_text.front().empty() == (what != asked::map_file));
            fs::remove(folder.path / "map.csv");
            const auto expected_map = std::exchange(map, {});
            writers.clear();
            const std::size_t size = std::array{2U, 3U, 7U}[turn % 3];
            REQUIRE(weld_as_team(work, size));
            if (what == asked::map_file) CHECK(writers.size() == size);
            CHECK(folder.take("ply") == expected);
            CHECK(map == expected_map);
            CHECK(contents(folder.path, {"map.csv"}) == expected_text);
            fs::remove(folder.path / "map.csv");
        }
}

TEST_CASE("weld_team: LAZ has whole chunks, whoever has the points of each") {
    test::random random(17);
    const team_folder folder;
    std::size_t turn = 0;
    // Of points that are mostly dropped at first, several processes have less than a chunk.
    for (const double equal : {0.0, 0.6})
        for (const change& choose : {choices[0], choices[3], choices[4]}) {
            CAPTURE(++turn);
            std::vector<tf::point3> points(180'000);
            for (std::size_t i = 0; i < points.size(); ++i)
                if (static_cast<double>(i) >= equal * static_cast<double>(points.size()))
                    points[i] = {random.unit(), random.unit(), random.unit()};
            folder.put(points, random);
            job work = folder.work("laz");
            work.options.as_las = true;
            work.options.tolerance = 0.01;
            choose(work.options);
            work.options.points_per_tile = 60'000;
            if (turn % 3 == 0)
                work.outputs = [files = work.outputs] {
                    tf::weld_stream_outputs outputs = files();
                    outputs.label = "group";
                    return outputs;
                };
            weld_alone(work);
            const auto expected = folder.take("laz");
            CHECK(expected[0].size() > 100'000);
            const std::size_t size = std::array{2U, 4U, 7U}[turn % 3];
            CAPTURE(size);
            REQUIRE(weld_as_team(work, size));
            CHECK(folder.take("laz") == expected);
        }
}

TEST_CASE("weld_team: what is not there, or of another job, is refused in words") {
    test::random random(14);
    const team_folder folder;
    folder.put(families(300, random)[0], random);
    job work = folder.work("ply");
    work.options.tolerance = 0.05;
    work.options.points_per_tile = 60;
    const auto says = [](const std::function<void()>& step) -> std::string {
        try {
            step();
        } catch (const tf::io_error& error) {
            return error.what();
        }
        return "";
    };
    const auto has = [](const std::string& text, const char* words) {
        return text.find(words) != std::string::npos;
    };
    {
        tf::shared_weld early(work.inputs, work.options);
        for (const auto& step :
             std::vector<std::function<void()>>{[&] { static_cast<void>(early.weld_tile(0)); },
                                                [&] { static_cast<void>(early.tiles()); },
                                                [&] { static_cast<void>(early.unfinished()); },
                                                [&] { early.finish(work.outputs()); }})
            CHECK(has(says(step), "contains no tiles of this"));
    }
    CHECK_FALSE(fs::exists(work.options.folder));
    {
        tf::shared_weld one(work.inputs, work.options);
        REQUIRE(one.take_survey() == tf::status::ok);
        CHECK(has(says([&] { tf::shared_weld(work.inputs, work.options); }), "is in use"));
        REQUIRE(one.scatter() == tf::status::ok);
        CHECK_THROWS_AS(static_cast<void>(one.weld_tile(one.tiles())), std::out_of_range);
        CHECK(has(says([&] { static_cast<void>(one.weld()); }), "tiles 0, 1, 2"));
        CHECK(has(says([&] { one.finish(work.outputs()); }), "tiles 0, 1, 2"));
    }
    work.options.tolerance = 0.06;
    tf::shared_weld other(work.inputs, work.options);
    CHECK(has(says([&] { static_cast<void>(other.take_survey()); }),
              "contains tiles of another input"));
}
