#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A folder of its own, with a cloud in it.
class stream_folder {
  public:
    explicit stream_folder(std::size_t count)
        : path_(fs::temp_directory_path() / ("weld_stream_test-" + std::to_string(::getpid()))) {
        fs::remove_all(path_);
        fs::create_directory(path_);
        test::random random(3);
        tf::mesh_file file;
        for (std::size_t i = 0; i < count; ++i)
            file.mesh.points.push_back({random.unit(), random.unit(), 0.1 * random.unit()});
        tf::write(input(), file);
        points_ = file.mesh.points;
    }
    ~stream_folder() { fs::remove_all(path_); }
    stream_folder(const stream_folder&) = delete;
    stream_folder& operator=(const stream_folder&) = delete;

    [[nodiscard]] fs::path input() const { return path_ / "in.ply"; }
    [[nodiscard]] tf::cloud_inputs inputs() const { return {.paths = {input()}}; }
    [[nodiscard]] fs::path output() const { return path_ / "out.ply"; }
    [[nodiscard]] fs::path work() const { return path_ / "work"; }
    [[nodiscard]] const std::vector<tf::point3>& points() const { return points_; }

    [[nodiscard]] tf::weld_stream_options options(bool chain = false) const {
        tf::weld_stream_options o;
        o.tolerance = 0.02;
        o.chain = chain;
        o.folder = work();
        o.points_per_tile = 300;
        return o;
    }

  private:
    fs::path path_;
    std::vector<tf::point3> points_{};
};

std::string content_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("weld_stream: files, map and counts are what weld gives") {
    const stream_folder folder(2000);
    for (const bool chain : {false, true}) {
        std::vector<std::uint32_t> map;
        tf::weld_stream_outputs outputs;
        outputs.welded = {folder.output(), {}};
        outputs.map = [&](std::span<const std::uint64_t> next) {
            for (const std::uint64_t n : next) map.push_back(static_cast<std::uint32_t>(n));
        };
        const auto streamed = tf::weld_stream(folder.inputs(), outputs, folder.options(chain));
        const auto whole = tf::weld(folder.points(), {.tolerance = 0.02, .chain = chain});
        CHECK(streamed.status == tf::status::ok);
        CHECK(streamed.survey.points == 2000);
        CHECK(streamed.survey.tiles > 3);
        CHECK(streamed.kept == whole.mesh.points.size());
        CHECK(streamed.statistics.groups == whole.statistics.groups);
        CHECK(streamed.statistics.max_displacement == whole.statistics.max_displacement);
        CHECK(map == whole.groups.group_of_point);
        CHECK(tf::read(folder.output()).mesh.points == whole.mesh.points);
        CHECK_FALSE(fs::exists(folder.work()));
        const std::string bytes = content_of(folder.output());
        fs::remove(folder.output());
        tf::weld_stream(folder.input(), folder.output(), folder.options(chain));
        CHECK(content_of(folder.output()) == bytes);
    }
}

TEST_CASE("weld_stream: a relative tolerance is a share of the diagonal") {
    const stream_folder folder(500);
    tf::weld_stream_options options = folder.options();
    options.tolerance = 0.05;
    options.relative = true;
    const auto streamed = tf::weld_stream(folder.inputs(), tf::weld_stream_outputs{}, options);
    const double length = 0.05 * tf::bounding_box(folder.points())->diagonal();
    CHECK(streamed.survey.tolerance == length);
    CHECK(streamed.kept == tf::weld(folder.points(), {.tolerance = length}).mesh.points.size());
}

TEST_CASE("weld_stream: wherever it is cancelled nothing is written, and the next call goes on") {
    const stream_folder folder(1500);
    const auto whole = tf::weld(folder.points(), {.tolerance = 0.02});
    for (const char* const at : {"survey", "scatter", "weld", "borders", "write"}) {
        CAPTURE(at);
        tf::weld_stream_outputs outputs;
        outputs.welded = {folder.output(), {}};
        tf::weld_stream_options options = folder.options();
        options.progress = [&](std::string_view step, double share) {
            return step != at || share < 0.5;
        };
        CHECK(tf::weld_stream(folder.inputs(), outputs, options).status == tf::status::cancelled);
        CHECK_FALSE(fs::exists(folder.output()));
        const bool has_tiles = at != std::string("survey") && at != std::string("scatter");
        CHECK(fs::exists(folder.work()) == has_tiles);
        options.progress = {};
        const auto again = tf::weld_stream(folder.inputs(), outputs, options);
        CHECK(again.survey.continued == has_tiles);
        CHECK(tf::read(folder.output()).mesh.points == whole.mesh.points);
        fs::remove(folder.output());
    }
}

TEST_CASE("weld_stream: what it cannot work with is refused") {
    const stream_folder folder(100);
    tf::weld_stream_options options = folder.options();
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        options.tolerance = bad;
        CHECK_THROWS_AS(tf::weld_stream(folder.inputs(), tf::weld_stream_outputs{}, options),
                        std::invalid_argument);
    }
    options.tolerance = 0.1;
    CHECK_THROWS_AS(
        tf::weld_stream({.paths = {folder.output()}}, tf::weld_stream_outputs{}, options),
        tf::io_error);
    fs::create_directory(folder.work());
    std::ofstream(folder.work() / "letter.txt") << "dear";
    try {
        tf::weld_stream(folder.inputs(), tf::weld_stream_outputs{}, options);
        FAIL("not refused");
    } catch (const tf::io_error& error) {
        CHECK(error.why() == tf::io_error::kind::folder_foreign);
        CHECK(error.path() == folder.work());
    }
    fs::remove_all(folder.work());
    const tf::shared_weld holds(folder.inputs(), options);
    try {
        tf::weld_stream(folder.inputs(), tf::weld_stream_outputs{}, options);
        FAIL("not refused");
    } catch (const tf::io_error& error) {
        CHECK(error.why() == tf::io_error::kind::folder_in_use);
    }
}

TEST_CASE("state_reader: gives back what was put in, and notices what is not whole") {
    tf::detail::stream::state_writer writer;
    writer.number(7);
    writer.text("a name of some length");
    writer.text("");
    writer.point({1.0, -0.0, 2.5});
    const std::string bytes = writer.bytes();
    {
        tf::detail::stream::state_reader reader(bytes);
        CHECK(reader.number() == 7);
        CHECK(reader.text() == "a name of some length");
        CHECK(reader.text().empty());
        CHECK(reader.point() == tf::point3{1.0, -0.0, 2.5});
        CHECK(reader.whole());
        CHECK(reader.number() == 0);
        CHECK_FALSE(reader.whole());
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string harmed = bytes;
        harmed[i] = static_cast<char>(harmed[i] ^ 1);
        CHECK_FALSE(tf::detail::stream::state_reader(harmed).whole());
        CHECK_FALSE(tf::detail::stream::state_reader(bytes.substr(0, i)).whole());
    }
}
