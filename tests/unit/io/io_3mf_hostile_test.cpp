// 3MF packages with faults of every kind: refused by name, part and place.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/packages.hpp>

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using test::package_3mf;
using test::tetrahedron_3mf;

/// What is said of bytes that are refused, without the file's name; nothing when they are read.
/// The bytes are in a block of their own size, so that a sanitizer sees one byte too many.
std::string refusal_of_3mf(const std::string& bytes) {
    std::vector<std::byte> block(bytes.size());
    if (!bytes.empty()) std::memcpy(block.data(), bytes.data(), bytes.size());
    try {
        const tf::mesh_file file = tf::read(block, "a.3mf", "3mf");
        for (const tf::face& f : file.mesh.faces)
            for (const std::uint32_t corner : f) REQUIRE(corner < file.mesh.points.size());
        return {};
    } catch (const tf::io_error& e) {
        const std::string_view said = e.what();
        REQUIRE(said.starts_with("a.3mf: "));
        return std::string(said.substr(7));
    }
}

std::string hostile_model(const std::string& resources, const std::string& items,
                          const std::string& attributes = {}) {
    return package_3mf(test::model_text(
        "<resources>" + resources + "</resources><build>" + items + "</build>", attributes));
}

const std::string one = "<object id=\"1\">" + tetrahedron_3mf + "</object>";
const std::string built = "<item objectid=\"1\"/>";

/// A package whose mesh has `from` replaced.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = one;
    const std::size_t at = text.find(from);
    REQUIRE(at != text.npos);
    return hostile_model(text.replace(at, from.size(), to), built);
}

std::string component(int id, const std::string& more = {}) {
    return "<component objectid=\"" + std::to_string(id) + "\" " + more + "/>";
}

std::string assembly(int id, const std::string& components) {
    return "<object id=\"" + std::to_string(id) + "\"><components>" + components +
           "</components></object>";
}

/// True when `what` was said, of the model part.
bool says(const std::string& said, const std::string& what) {
    INFO(said);
    CHECK(said.starts_with("3D/3dmodel.model: "));
    CHECK(said.find(what) != said.npos);
    return said.starts_with("3D/3dmodel.model: ") && said.find(what) != said.npos;
}

}  // namespace

TEST_CASE("3mf hostile: a package cut after any byte is refused") {
    const std::string whole = hostile_model(one, built);
    REQUIRE(refusal_of_3mf(whole).empty());
    const tf::mesh_file file = tf::read(std::as_bytes(std::span(whole)), "a.3mf", {});
    for (const std::string& bytes : {whole, tf::write_to_memory(file, {.format = "3mf"})})
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            CAPTURE(bytes.size() - size);
            CHECK_FALSE(refusal_of_3mf(bytes.substr(0, size)).empty());
        }
}

TEST_CASE("3mf hostile: a model part cut after any byte is refused") {
    const std::string text =
        test::model_text("<resources>" + one + "</resources><build>" + built + "</build>");
    for (std::size_t size = 0; size < text.size(); ++size)
        CHECK(says(refusal_of_3mf(package_3mf(text.substr(0, size))), "invalid XML"));
}

TEST_CASE("3mf hostile: a package with any byte changed is read or refused by its name") {
    const std::string whole = hostile_model(one, built);
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const int mask : {0xff, 1, 32}) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ mask);
            refused += refusal_of_3mf(bytes).empty() ? 0U : 1U;
        }
    CHECK(refused > whole.size());
}

TEST_CASE("3mf hostile: what is no package is refused") {
    CHECK(refusal_of_3mf("").find("empty") != std::string::npos);
    CHECK(refusal_of_3mf("v 0 0 0\n").find("not a ZIP archive") != std::string::npos);
    CHECK_FALSE(refusal_of_3mf(test::zip_of({})).empty());
    CHECK(refusal_of_3mf(test::zip_of({{.name = "a.txt", .bytes = "a"}})).find("_rels/.rels") !=
          std::string::npos);
    CHECK(refusal_of_3mf(test::zip_of({test::relationships_to("/3D/none.model")}))
              .starts_with("_rels/.rels: byte "));
    test::zip_member none = test::relationships_to("/a.model");
    none.bytes = "<Relationships/>";
    CHECK(refusal_of_3mf(test::zip_of({none})).find("no relationship") != std::string::npos);
    test::zip_member two = test::relationships_to("/a.model");
    two.bytes.insert(two.bytes.find("</"),
                     two.bytes.substr(two.bytes.find("<Relationship "),
                                      two.bytes.find("</") - two.bytes.find("<Relationship ")));
    CHECK(refusal_of_3mf(test::zip_of({two, {.name = "a.model", .bytes = ""}}))
              .find("second root model") != std::string::npos);
}

TEST_CASE("3mf hostile: names that leave the archive, or are there twice, are refused") {
    const std::string good =
        test::model_text("<resources>" + one + "</resources><build>" + built + "</build>");
    for (const char* name : {"../a", "a/../b", "/a", "a//b", "..", "./a", "a\\b", "", "/"})
        CHECK(refusal_of_3mf(package_3mf(good, {{.name = name, .bytes = "x"}}))
                  .find("the archive has") != std::string::npos);
    CHECK(refusal_of_3mf(package_3mf(good, {{.name = "3D/3DMODEL.model", .bytes = good}}))
              .find("in the archive twice") != std::string::npos);
    CHECK(refusal_of_3mf(package_3mf(good, {{.name = "3D/", .bytes = ""},
                                            {.name = "a..b/c...d", .bytes = ""}}))
              .empty());
}

TEST_CASE("3mf hostile: members that are encrypted or lie about their size are refused") {
    const std::string good =
        test::model_text("<resources>" + one + "</resources><build>" + built + "</build>");
    const auto with = [&](const test::zip_member& root) {
        return refusal_of_3mf(test::zip_of({test::relationships_to("/3D/3dmodel.model"), root}));
    };
    const char* const name = "3D/3dmodel.model";
    CHECK(says(with({.name = name, .bytes = good, .flags = 1}), "encrypted"));
    CHECK(says(with({.name = name, .bytes = good, .method = 12}), "method 12"));
    CHECK(says(with({.name = name, .bytes = good, .more_announced = 1}), "announces"));
    CHECK(says(with({.name = name, .bytes = good, .method = 8}), "damaged"));
    CHECK(says(with({.name = name, .bytes = good, .method = 8, .more_announced = 0x7fffffff}),
               "announces"));
}

TEST_CASE("3mf hostile: a deflated model that announces other than it has is refused") {
    const std::string whole = hostile_model(one, built);
    const tf::mesh_file file = tf::read(std::as_bytes(std::span(whole)), "a.3mf", {});
    const std::string bytes = tf::write_to_memory(file, {.format = "3mf"});
    // The model is the last member of the directory: its size is 24 bytes behind the signature.
    const std::size_t directory = bytes.rfind("PK\x01\x02");
    const std::size_t local = bytes.rfind("PK\x03\x04");
    for (const int change : {-1, 1, -100, 100}) {
        std::string lying = bytes;
        for (const std::size_t at : {directory + 24, local + 22}) {
            const int low = static_cast<unsigned char>(lying[at]) +
                            256 * static_cast<unsigned char>(lying[at + 1]) + change;
            lying.replace(at, 2, test::little_endian(static_cast<std::size_t>(low), 2));
        }
        CHECK(refusal_of_3mf(lying).starts_with("3D/3dmodel.model: "));
    }
}

TEST_CASE("3mf hostile: document types are refused, entities are no text") {
    const std::string content = "<resources>" + one + "</resources><build>" + built + "</build>";
    const std::string text = test::model_text(content);
    CHECK(says(refusal_of_3mf(package_3mf("<!DOCTYPE a [<!ENTITY b \"c\">]>" + text)),
               "document type"));
    CHECK(says(refusal_of_3mf(package_3mf("<!DOCTYPE model>" + text)), "document type"));
    CHECK(says(refusal_of_3mf(changed("x=\"0\"", "x=\"&b;\"")), "is not a number"));
    CHECK(refusal_of_3mf(changed("x=\"0\"", "x=\"&#48;\"")).empty());
}

TEST_CASE("3mf hostile: coordinates that are no finite numbers are refused at their byte") {
    for (const char* bad : {"nan", "inf", "-infinity", "1e999", "", "1,5", "0x10", "1 2", "1.#IND"})
        CHECK(says(refusal_of_3mf(changed("x=\"0\"", "x=\"" + std::string(bad) + "\"")),
                   "byte 262: <vertex> x='"));
    CHECK(says(refusal_of_3mf(changed("x=\"0\"", "")), "<vertex> has no x"));
    CHECK(says(refusal_of_3mf(changed("v2=\"2\"", "")), "<triangle> has no v2"));
    CHECK(
        says(refusal_of_3mf(changed("v2=\"2\"", "v2=\"4\"")), "v2=4 is out of range: there are 4"));
    for (const char* bad : {"-1", "4294967296", "1.0", "", "x"})
        CHECK(says(refusal_of_3mf(changed("v2=\"2\"", "v2=\"" + std::string(bad) + "\"")), "v2='"));
}

TEST_CASE("3mf hostile: references to nothing are refused") {
    CHECK(says(refusal_of_3mf(hostile_model(one, "<item objectid=\"2\"/>")), "is not an object"));
    CHECK(says(refusal_of_3mf(hostile_model(one, "<item/>")), "<item> has no objectid"));
    CHECK(says(refusal_of_3mf(hostile_model("<object>" + tetrahedron_3mf + "</object>", "")),
               "has no id"));
    CHECK(says(refusal_of_3mf(hostile_model(one + one, built)), "id of another object"));
    CHECK(says(refusal_of_3mf(hostile_model("<object id=\"1\"/>", built)),
               "neither a mesh nor components"));
    CHECK(says(refusal_of_3mf(hostile_model("<object id=\"1\"><mesh/></object>", built)),
               "has no vertices or no triangles"));
    CHECK(says(
        refusal_of_3mf(hostile_model(one + assembly(2, component(3)), "<item objectid=\"2\"/>")),
        "objectid=3 is not an object"));
    CHECK(says(refusal_of_3mf(changed("v3=\"1\"", "v3=\"1\" pid=\"9\" p1=\"0\"")), "pid=9"));
    const std::string group =
        "<basematerials id=\"9\"><base name=\"a\" displaycolor=\"#000000\"/>"
        "</basematerials>";
    const auto with_group = [&](const std::string& properties) {
        std::string text = one;
        text.insert(text.find(" v1="), properties);
        return refusal_of_3mf(hostile_model(group + text, built));
    };
    CHECK(with_group(" pid=\"9\" p1=\"0\"").empty());
    CHECK(says(with_group(" pid=\"9\" p1=\"1\""), "property 1 is out of range"));
    CHECK(says(with_group(" pid=\"9\" p1=\"0\" p3=\"2\""), "property 2 is out of range"));
    CHECK(says(with_group(" pid=\"9\""), "has a pid but no p1"));
    CHECK(says(refusal_of_3mf(hostile_model(
                   "<basematerials id=\"9\"><base name=\"a\"/></basematerials>" + one, built)),
               "has no displaycolor"));
    CHECK(says(refusal_of_3mf(
                   hostile_model("<basematerials id=\"9\"><base name=\"a\" displaycolor=\"red\"/>"
                                 "</basematerials>" +
                                     one,
                                 built)),
               "not a color"));
}

TEST_CASE("3mf hostile: transforms are twelve finite numbers that keep points finite") {
    for (const char* bad : {"", "1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0",
                            "1 0 0 0 1 0 0 0 1 0 0 nan", "1,0,0,0,1,0,0,0,1,0,0,0"})
        CHECK(says(refusal_of_3mf(hostile_model(
                       one, "<item objectid=\"1\" transform=\"" + std::string(bad) + "\"/>")),
                   "transform"));
    std::string far = one;
    far.replace(far.find("x=\"1\""), 5, "x=\"1e200\"");
    CHECK(says(refusal_of_3mf(hostile_model(far,
                                            "<item objectid=\"1\" "
                                            "transform=\"1e200 0 0 0 1 0 0 0 1 0 0 0\"/>")),
               "beyond the range of doubles"));
}

TEST_CASE("3mf hostile: extensions that are required and unknown are refused by name") {
    const std::string declared = " xmlns:b=\"http://example.org/beams\" requiredextensions=\"m b\"";
    CHECK(says(refusal_of_3mf(hostile_model(one, built, declared)),
               "requires the extension 'b' (http://example.org/beams)"));
    CHECK(says(refusal_of_3mf(hostile_model(one, built, " requiredextensions=\"z\"")),
               "the extension 'z'"));
    CHECK(refusal_of_3mf(hostile_model(one, built, " requiredextensions=\" p  m \"")).empty());
    CHECK(says(refusal_of_3mf(hostile_model(one, built, " unit=\"parsec\"")), "unit"));
    CHECK(says(refusal_of_3mf(package_3mf("<model/>")), "is not the model of a 3MF"));
}

TEST_CASE("3mf hostile: objects in themselves, deep ones and multitudes are refused") {
    CHECK(says(refusal_of_3mf(hostile_model(assembly(1, component(1)), built)),
               "component of itself"));
    CHECK(says(
        refusal_of_3mf(hostile_model(assembly(1, component(2)) + assembly(2, component(1)), built)),
        "component of itself"));
    const auto chain = [](int length, int times) {
        std::string all = one;
        for (int id = 2; id <= length; ++id) {
            std::string components;
            for (int i = 0; i < times; ++i) components += component(id - 1);
            all += assembly(id, components);
        }
        return all;
    };
    const auto item = [](int id) { return "<item objectid=\"" + std::to_string(id) + "\"/>"; };
    CHECK(refusal_of_3mf(hostile_model(chain(900, 1), item(900))).empty());
    CHECK(says(refusal_of_3mf(hostile_model(chain(5000, 1), item(5000))), "components deep"));
    // Each object known before the one around it: no level of the search is deep.
    CHECK(says(refusal_of_3mf(hostile_model(chain(1100, 1), item(900) + item(1100))),
               "components deep"));
    CHECK(refusal_of_3mf(hostile_model(chain(10, 2), item(10))).empty());
    CHECK(says(refusal_of_3mf(hostile_model(chain(64, 2), item(64))), "objects in the build"));
    CHECK(says(refusal_of_3mf(hostile_model(chain(64, 10), item(64))), "objects in the build"));
}

TEST_CASE("3mf hostile: paths lead from the root to other model parts, and no further") {
    const auto with = [](const std::string& path, const std::string& part) {
        return refusal_of_3mf(
            package_3mf(test::model_text("<resources/><build><item objectid=\"1\" p:path=\"" +
                                         path + "\"/></build>"),
                        {{.name = "3D/a.model", .bytes = part}}));
    };
    const auto part = [](const std::string& object) {
        return test::model_text("<resources>" + object + "</resources><build/>");
    };
    CHECK(with("/3D/a.model", part(one)).empty());
    CHECK(with("/3D/b.model", part(one)) == "3D/b.model: is not in the archive");
    CHECK(with("/../../etc/passwd", part(one)).find("is not in the archive") != std::string::npos);
    CHECK(says(with("3D/a.model", part(one)), "does not start with '/'"));
    CHECK(with("/3D/a.model", part("")).find("has no object 1") != std::string::npos);
    CHECK(with("/3D/a.model", part(assembly(1, component(1, "p:path=\"/3D/a.model\""))))
              .find("only the root model may have") != std::string::npos);
    CHECK(with("/3D/a.model", part(assembly(1, component(1)))).find("component of itself") !=
          std::string::npos);
}
