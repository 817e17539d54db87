/// \file
/// Compressed PCD read and written by a team: each rank unpacks and packs its share, and the bytes
/// are those of one.

#include <libmesh/stream/joined_points.hpp>
#include <treeform/mesh/attribute_sources.hpp>
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
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace stream = treeform::detail::stream;

using test::bytes_of;
using test::put;

/// With a property that packs well, and coordinates that do not.
tf::mesh_file shaded_cloud(std::size_t count, test::random& random) {
    tf::mesh_file file;
    file.format = "pcd-binary-compressed";
    std::vector<float> shade;
    for (std::size_t i = 0; i < count; ++i) {
        file.mesh.points.push_back({random.unit(), random.unit(), random.unit()});
        shade.push_back(0.25F * static_cast<float>(random.below(4)));
    }
    file.attributes.find_or_add("vertex", count).set(tf::column::of<float>("shade", shade));
    return file;
}

/// The values of the points, field by field.
std::string packed_values(const tf::mesh_file& file) {
    std::string all;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const tf::point3& p : file.mesh.points) {
            const double value = p[axis];
            all.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
    const auto& shade = file.attributes.find("vertex")->columns.front().values;
    return all.append(reinterpret_cast<const char*>(shade.data()), shade.size());
}

/// What each of a team says against the file when they unpack it; nothing where all is well.
std::set<std::string> unpack(const fs::path& pcd, const fs::path& to, std::size_t size) {
    std::mutex one_at_a_time;
    std::set<std::string> said;
    std::size_t ended = 0;
    CHECK(test::run_as_team(size, [&](const tf::communicator& threads) {
        const stream::communicator all(threads);
        stream::cancellable_progress pace({});
        if (all.is_root()) put(to, "");
        std::string words;
        try {
            stream::unpack_in_turn(pcd, to, all, pace);
        } catch (const tf::io_error& error) {
            words = error.what();
        }
        const std::lock_guard lock(one_at_a_time);
        said.insert(words);
        ++ended;
    }));
    CHECK(ended == size);
    said.erase("");
    return said;
}

std::string refusal(const fs::path& path) {
    try {
        static_cast<void>(tf::read(path));
    } catch (const tf::io_error& error) {
        return error.what();
    }
    return "";
}

struct packing_job {
    tf::cloud_inputs inputs{};
    tf::weld_stream_options options{};
    tf::weld_stream_outputs outputs{};
};

/// One is killed after so many steps, if any. Returns whether all have come to the end.
bool packed_as_team(const packing_job& work, std::size_t size, std::size_t victim = 0,
                    int steps = 0) {
    return test::run_as_team(size, [&](const tf::communicator& team) {
        tf::weld_stream_options options = work.options;
        options.communicator = team;
        if (team.rank == victim && steps > 0)
            options.step_done = [left = steps]() mutable {
                if (--left == 0) throw test::killed();
            };
        try {
            static_cast<void>(tf::weld_stream(work.inputs, work.outputs, options));
        } catch (const tf::io_error&) {  // the first one, when killed, takes its files with it
            if (steps == 0) throw;
            throw test::killed();
        }
    });
}

}  // namespace

TEST_CASE("packed_pcd: unpacked in turn by any number") {
    test::random random(31);
    const test::own_folder folder("packed_pcd_test");
    const fs::path pcd = folder.path / "in.pcd";
    for (const std::size_t count : std::vector<std::size_t>{0, 1, 3, 2000, 300'000}) {
        CAPTURE(count);
        const tf::mesh_file file = shaded_cloud(count, random);
        put(pcd, tf::write_to_memory(file, {.format = "pcd"}));
        for (const std::size_t size : {1U, 2U, 4U, 7U}) {
            CHECK(unpack(pcd, folder.path / "out", size).empty());
            CHECK((bytes_of(folder.path / "out") == packed_values(file)));
        }
    }
}

TEST_CASE("packed_pcd: where packed bytes are damaged, all say what one says") {
    test::random random(32);
    const test::own_folder folder("packed_pcd_damaged_test");
    const fs::path pcd = folder.path / "in.pcd";
    const tf::mesh_file file = shaded_cloud(2000, random);
    const std::string whole = tf::write_to_memory(file, {.format = "pcd"});
    const std::size_t head = whole.find("binary_compressed\n") + 18;
    std::size_t refused = 0;
    for (int round = 0; round < 60; ++round) {
        std::string bytes = whole;
        if (round < 40)
            for (int i = 0; i < 3; ++i)
                bytes[head + 8 + random.below(bytes.size() - head - 8)] =
                    static_cast<char>(random.bits());
        else if (round < 50)
            bytes[head + random.below(8)] = static_cast<char>(random.bits());  // a length
        else
            bytes.resize(head + random.below(bytes.size() - head));
        put(pcd, bytes);
        const std::string one = refusal(pcd);
        for (const std::size_t size : {1U, 2U, 4U, 7U}) {
            CAPTURE(size);
            const auto said = unpack(pcd, folder.path / "out", size);
            CHECK(said == (one.empty() ? std::set<std::string>{} : std::set{one}));
            CHECK(fs::file_size(folder.path / "out") <= packed_values(file).size());
        }
        refused += one.empty() ? 0 : 1;
    }
    CHECK(refused > 20);
}

TEST_CASE(
    "packed_pcd: welded by any number of processes, and after a kill, it is what one writes") {
    test::random random(33);
    const test::own_folder folder("packed_pcd_weld_test");
    const fs::path& path = folder.path;
    std::size_t continued = 0;
    for (std::size_t round = 0; round < 8; ++round) {
        CAPTURE(round);
        packing_job work;
        work.inputs.paths = {path / "a.pcd"};
        if (round % 2 == 1) work.inputs.paths.push_back(path / "b.pcd");
        if (round == 5) work.inputs.paths.push_back(path / "c.pcd");  // no points
        for (const fs::path& input : work.inputs.paths)
            put(input, tf::write_to_memory(
                           shaded_cloud(input.filename() == "c.pcd" ? 0 : 1500 + random.below(500),
                                        random),
                           {.format = "pcd"}));
        work.options.folder = path / "work";
        work.options.tolerance = 0.05;
        work.options.points_per_tile = 300;
        if (round % 3 == 1) work.options.chain = true;
        if (round % 4 == 2) work.options.keep = tf::weld_keep::mean;
        if (round % 4 == 3) {
            work.options.order_by = "shade";
            work.options.highest_first = true;
        }
        work.outputs.welded = {path / "welded.pcd", {}};
        work.outputs.removed = {path / "removed.pcd", {}};
        const auto take = [&] {
            std::vector<std::string> all;
            for (const auto* out : {&work.outputs.welded, &work.outputs.removed}) {
                all.push_back(bytes_of((*out)->first));
                fs::remove((*out)->first);
            }
            return all;
        };
        std::vector<tf::mesh_file> files;
        for (const fs::path& input : work.inputs.paths) files.push_back(tf::read(input));
        const std::vector<std::string> names(files.size(), "a");
        const tf::mesh_file whole = tf::concatenate_files(files, names);
        REQUIRE(packed_as_team(work, 1));
        const auto expected = take();
        CHECK(expected[0].find("DATA binary_compressed") != std::string::npos);
        CHECK(expected[1].find("DATA binary_compressed") != std::string::npos);
        if (round == 0) {  // in memory
            tf::file_weld_result in_memory = tf::weld(whole, {.tolerance = 0.05});
            CHECK((tf::write_to_memory(in_memory.file, {.format = "pcd"}) == expected[0]));
        }
        for (const std::size_t size : {2U, 4U, 7U}) {
            CAPTURE(size);
            REQUIRE(packed_as_team(work, size));
            CHECK((take() == expected));
            CHECK_FALSE(fs::exists(work.options.folder));
            const int steps = 1 + static_cast<int>(random.below(5));
            if (!packed_as_team(work, size, random.below(size), steps)) {
                // What a run has left that was killed for good.
                put(work.options.folder / "unpacked.0", "half of it");
                put(work.options.folder / "values.welded", std::string(100'000, '?'));
                REQUIRE(packed_as_team(work, 1 + random.below(5)));
                ++continued;
            }
            CHECK((take() == expected));
            CHECK_FALSE(fs::exists(work.options.folder));
        }
    }
    CHECK(continued > 5);
}

TEST_CASE("packed_pcd: one damaged input is named, and nothing stays") {
    test::random random(34);
    const test::own_folder folder("packed_pcd_one_test");
    packing_job work;
    work.inputs.paths = {folder.path / "a.pcd", folder.path / "b.pcd"};
    put(work.inputs.paths[0], tf::write_to_memory(shaded_cloud(900, random), {.format = "pcd"}));
    std::string bytes = tf::write_to_memory(shaded_cloud(900, random), {.format = "pcd"});
    std::fill(bytes.end() - 3000, bytes.end(), '\xff');
    put(work.inputs.paths[1], bytes);
    const std::string one = refusal(work.inputs.paths[1]);
    REQUIRE(one.find("the packed data are damaged") != std::string::npos);
    work.options.folder = folder.path / "work";
    work.outputs.welded = {folder.path / "welded.pcd", {}};
    // The header says all that there is to know before: it is not unpacked for that.
    CHECK(work.inputs.outline().attributes.find("vertex")->rows == 1800);
    for (const std::size_t size : {1U, 4U}) {
        std::string said;
        try {
            static_cast<void>(packed_as_team(work, size));
        } catch (const tf::io_error& error) {
            said = error.what();
        }
        CHECK(said == one);
        CHECK_FALSE(fs::exists(work.options.folder));
        CHECK_FALSE(fs::exists(folder.path / "welded.pcd"));
    }
}
