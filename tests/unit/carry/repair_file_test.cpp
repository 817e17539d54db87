#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

/// A file of objects of these names.
tf::mesh_file scene(const std::vector<std::pair<std::string, tf::mesh>>& objects) {
    tf::mesh_file file;
    for (const auto& [name, mesh] : objects) {
        const auto first = static_cast<std::uint32_t>(file.mesh.points.size());
        file.attributes.parts.push_back(
            {.object = name, .first_face = static_cast<std::uint32_t>(file.mesh.faces.size())});
        file.mesh.points.insert(file.mesh.points.end(), mesh.points.begin(), mesh.points.end());
        for (const auto& [a, b, c] : mesh.faces)
            file.mesh.faces.push_back({first + a, first + b, first + c});
    }
    file.stored_faces = file.mesh.faces.size();
    return file;
}

tf::mesh box_at(double x) { return test::moved(test::box(1, 1, 1), {x, 0, 0}); }

tf::mesh without(tf::mesh mesh, std::size_t face) {
    mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(face));
    return mesh;
}

std::vector<std::string> names_of(const tf::repaired_file& made) {
    std::vector<std::string> names;
    for (const tf::repaired_part& part : made.parts) names.push_back(part.name);
    return names;
}

}  // namespace

TEST_CASE("repair_file: objects that overlap stay two solids, or become one") {
    const tf::mesh_file file = scene({{"a", box_at(0)}, {"b", box_at(0.5)}});
    const tf::repaired_file each = tf::repair_file({&file});
    CHECK(each.certificate);
    CHECK(each.file.mesh == file.mesh);
    CHECK(each.file.attributes.parts == file.attributes.parts);
    CHECK(names_of(each) == std::vector<std::string>{"a", "b"});
    CHECK(each.parts[1].first_face == 12);
    CHECK(each.parts[1].faces == 12);
    CHECK(each.statistics.volume_after == doctest::Approx(2.0));

    const tf::repaired_file one = tf::repair_file({&file}, {.as_one = true});
    CHECK(one.certificate);
    CHECK(one.parts.empty());
    CHECK(tf::signed_volume(one.file.mesh) == doctest::Approx(1.5));
}

TEST_CASE("repair_file: an inlay keeps the wall that it has in common with its neighbor") {
    const tf::mesh_file file = scene({{"a", box_at(0)}, {"b", without(box_at(1), 0)}});
    const tf::repaired_file made = tf::repair_file({&file});
    CHECK(made.certificate);
    CHECK(made.parts.size() == 2);
    CHECK(made.statistics.holes == 1);
    CHECK(made.parts[1].statistics.holes == 1);
    CHECK(made.file.mesh.faces.size() == 24);
    CHECK(std::ranges::count(made.face_source, tf::repair_result::none) == 1);
    CHECK(made.face_source[12] == 12);
    REQUIRE(made.file.attributes.parts.size() == 2);
    CHECK(made.file.attributes.parts[1].first_face == 12);
}

TEST_CASE("repair_file: objects that are patches of one surface are one part") {
    const tf::mesh box = box_at(0);
    tf::mesh top{box.points, {box.faces.begin(), box.faces.begin() + 5}};
    tf::mesh rest{box.points, {box.faces.begin() + 5, box.faces.end()}};
    const tf::mesh_file file = scene({{"top", top}, {"other", box_at(0.5)}, {"rest", rest}});
    const tf::repaired_file made = tf::repair_file({&file});
    CHECK(made.certificate);
    CHECK(names_of(made) == std::vector<std::string>{"top", "other"});
    CHECK(made.statistics.holes == 0);
    CHECK(made.parts[0].faces == 12);
    CHECK(tf::find_solid_defects({&file}).message() == "no defects");
    CHECK(tf::find_solid_defects(file.mesh).meeting_pairs > 0);
}

TEST_CASE("repair_file: a part that is no solid is named, with the numbers of the file") {
    tf::mesh_file file =
        scene({{"good", box_at(0)},
               {"sheet", {{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {6, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}}},
               {"also good", box_at(0.5)}});
    const tf::repaired_file made = tf::repair_file({&file});
    CHECK(made.certificate.status == tf::status::open_input);
    CHECK(made.certificate.open_count == 4);
    for (const tf::operand_element& face : made.certificate.open_faces)
        CHECK((face.index == 12 || face.index == 13));
    REQUIRE(made.parts.size() == 3);
    CHECK(made.parts[1].certificate.status == tf::status::open_input);
    CHECK(made.parts[2].certificate);
    CHECK(tf::find_solid_defects({&file}).boundary_edges == 4);

    const tf::repaired_file cancelled =
        tf::repair_file({&file}, {.progress = [](double) { return false; }});
    CHECK(cancelled.certificate.status == tf::status::cancelled);
    CHECK(tf::find_solid_defects({&file}, [](double) { return false; }).status ==
          tf::status::cancelled);
}

TEST_CASE("repair_file: coplanar faces are merged, but not where that would mix values") {
    const tf::mesh pair = test::together(box_at(0), box_at(0.5));
    tf::mesh_file file{.mesh = pair};
    file.stored_faces = pair.faces.size();
    const auto faces_made = [&] {
        const tf::repaired_file made = tf::repair_file({&file});
        CHECK(made.certificate);
        CHECK(made.is_kept.size() == 24);
        CHECK(std::ranges::count(made.is_kept, 0) == 4);  // the two ends within
        return made.file.mesh.faces.size();
    };
    const tf::attribute_source source{&file, {}};
    const auto set = [&](const char* element, const std::vector<std::int32_t>& values) {
        file.attributes.find_or_add(element, values.size())
            .set(tf::column::of<std::int32_t>("number", values));
    };
    CHECK(faces_made() == 12);
    std::vector<std::int32_t> numbers(24, 1);
    set("face", numbers);
    CHECK_FALSE(tf::attribute_sources(source).merging_mixes_values());
    CHECK(faces_made() == 12);
    numbers[23] = 2;
    set("face", numbers);
    CHECK(tf::attribute_sources(source).merging_mixes_values());
    const std::size_t as_cut = faces_made();
    CHECK(as_cut > 12);
    CHECK(as_cut == tf::repair(pair, {.keep_cuts = true}).mesh.faces.size());
    file.attributes = {};
    set("vertex", std::vector<std::int32_t>(16, 1));
    CHECK(tf::attribute_sources(source).merging_mixes_values());
    CHECK(faces_made() == as_cut);
}

TEST_CASE("repair_file: parts of one value each are merged, each in itself") {
    const tf::mesh pair = test::together(box_at(0), box_at(0.5));
    tf::mesh_file file = scene({{"a", pair}, {"b", test::moved(pair, {5, 0, 0})}});
    std::vector<std::int32_t> numbers(48, 1);
    std::fill(numbers.begin() + 24, numbers.end(), 2);
    file.attributes.find_or_add("face", 48).set(tf::column::of<std::int32_t>("number", numbers));
    const tf::repaired_file made = tf::repair_file({&file});
    CHECK(made.file.mesh.faces.size() == 24);
    CHECK(std::ranges::count(made.is_kept, 0) == 8);
    CHECK(tf::repair_file({&file}, {.as_one = true}).file.mesh.faces.size() > 24);
}
