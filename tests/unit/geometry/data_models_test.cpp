/// \file
/// The models in data/ have the defects that data/expected.csv gives them: worked out by hand for
/// all but two_spheres.stl, whose count an exact kernel gave.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

const std::filesystem::path folder = test::data_folder();

/// faces, faces without area, then the pairs by kind: a row of expected.csv.
std::vector<std::uint64_t> measured(const std::filesystem::path& path) {
    const tf::mesh_file file = tf::read(path);
    const tf::mesh mesh = file.indexed ? file.mesh : tf::join_equal_points(file.mesh);
    std::vector<std::uint64_t> row{mesh.faces.size(),
                                   tf::find_invalid_faces(mesh).degenerate_faces.size()};
    const auto found = tf::self_intersections(mesh);
    row.insert(row.end(), found.counts.begin(), found.counts.end());
    return row;
}

std::vector<std::uint64_t> numbers_after_name(const std::string& line) {
    std::istringstream fields(line.substr(line.find(',')));
    std::vector<std::uint64_t> numbers;
    char comma = 0;
    for (std::uint64_t number = 0; fields >> comma >> number;) numbers.push_back(number);
    return numbers;
}

}  // namespace

TEST_CASE("data: each model has the defects that expected.csv says, and no other") {
    std::ifstream expected(folder / "expected.csv");
    std::string line;
    std::getline(expected, line);
    REQUIRE(line ==
            "file,faces,faces_without_area,crossing,overlap,fold,duplicate,pierce,touching,"
            "degenerate");
    int models = 0;
    for (; std::getline(expected, line); ++models) {
        CAPTURE(line);
        CHECK(measured(folder / line.substr(0, line.find(','))) == numbers_after_name(line));
    }
    CHECK(models == 14);
}
