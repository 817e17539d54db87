// Files large enough to be read and written by pieces: nothing shows of that.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace {

constexpr std::size_t facets = 40000;  // of some 110 bytes in seven lines

tf::point3 corner(std::size_t facet, std::size_t number) {
    return {static_cast<double>(facet), static_cast<double>(number), 0.5};
}

/// A text STL; `between` gives what stands ahead of a facet.
std::string text_stl(const std::function<std::string(std::size_t)>& between) {
    std::string text = "solid first\n";
    for (std::size_t f = 0; f < facets; ++f) {
        text += between(f) + "facet normal 0 0 1\n outer loop\n";
        for (std::size_t c = 0; c < 3; ++c) {
            const tf::point3 p = corner(f, c);
            text += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " 0.5\n";
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid first\n";
}

std::string before(std::size_t facet, std::size_t wanted, std::string_view text) {
    return facet == wanted ? std::string(text) : std::string();
}

tf::mesh_file read_stl(std::string_view bytes) {
    return tf::read(std::as_bytes(std::span(bytes)), "large.stl", {});
}

void check_facets(const tf::mesh_file& file) {
    REQUIRE(file.mesh.faces.size() == facets);
    REQUIRE(file.mesh.points.size() == 3 * facets);
    for (std::size_t f = 0; f < facets; ++f)
        for (std::uint32_t c = 0; c < 3; ++c) {
            REQUIRE(file.mesh.faces[f][c] == 3 * f + c);
            REQUIRE(file.mesh.points[3 * f + c] == corner(f, c));
        }
}

std::string stl_refusal(std::string_view bytes) {
    try {
        (void)read_stl(bytes);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

}  // namespace

TEST_CASE("large text STL: every facet is read, in order, on any number of threads") {
    const std::string text = text_stl([](std::size_t) { return ""; });
    check_facets(read_stl(text));
    const tf::thread_scope one(1);
    check_facets(read_stl(text));
}

TEST_CASE("large text STL: solids end and begin within pieces") {
    const tf::mesh_file file = read_stl(text_stl([](std::size_t f) {
        return f > 0 && f % 9001 == 0 ? "endsolid\nsolid s" + std::to_string(f) + "\n"
                                      : std::string();
    }));
    check_facets(file);
    REQUIRE(file.attributes.parts.size() == 5);
    for (std::size_t i = 1; i < 5; ++i) {
        CHECK(file.attributes.parts[i].object == "s" + std::to_string(9001 * i));
        CHECK(file.attributes.parts[i].first_face == 9001 * i);
    }
}

TEST_CASE("large text STL: many small solids are read whole") {
    const tf::mesh_file file =
        read_stl(text_stl([](std::size_t) { return "endsolid\n\n solid facet\n"; }));
    check_facets(file);
    CHECK(file.attributes.parts.size() == facets + 1);
}

TEST_CASE("large text STL: what is unusual is counted, the first of it named by its line") {
    const tf::mesh_file file = read_stl(text_stl([](std::size_t f) {
        return before(f, 20000, std::string_view("\0\0\n", 3)) + before(f, 30000, " \0 ");
    }));
    check_facets(file);
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].text == "2 zero bytes between words read as blanks");
    std::string text = text_stl([](std::size_t) { return ""; });
    for (const std::size_t facet : {std::size_t{35000}, std::size_t{15000}}) {
        std::size_t at = 0;
        const std::string line = "vertex " + std::to_string(corner(facet, 0).x) + " 0";
        at = text.find("endfacet", text.find(line));
        text.insert(at + 8, " words here");
    }
    const tf::mesh_file stray = read_stl(text);
    check_facets(stray);
    REQUIRE(stray.warnings.size() == 1);
    CHECK(stray.warnings[0].text ==
          "4 words after 'endloop' or 'endfacet' ignored, the first in line 105008");
}

TEST_CASE("large text STL: what is wrong is named by its line, the first of it") {
    const auto with = [](std::string_view wrong) {
        return stl_refusal(text_stl([&](std::size_t f) {
            return before(f, 25000, wrong) + before(f, 39000, "nonsense\n");
        }));
    };
    CHECK(
        with("facet normal\nfacet\n outer loop\n vertex 1 2 x\n").starts_with("large.stl:175005:"));
    CHECK(with("face\n") == "large.stl:175002: expected 'facet', found 'face'");
    CHECK(with("facet normal 0 0 0\nouter loop\nendloop\n") ==
          "large.stl:175004: facet with 0 vertices");
    std::string cut = text_stl([](std::size_t) { return ""; });
    cut.resize(cut.size() - std::string_view("endsolid first\n").size());
    CHECK(stl_refusal(cut) == "large.stl:280002: the file ends without 'endsolid': truncated?");
}

TEST_CASE("large meshes: written and read again, they are the same on any number of threads") {
    tf::mesh_file file = read_stl(text_stl([](std::size_t) { return ""; }));
    file.attributes.parts = {{.object = "a", .first_face = 0}, {.object = "b", .first_face = 9999}};
    for (const char* const format : {"stl", "obj", "ply"})
        for (const bool ascii : {false, true}) {
            CAPTURE(format);
            CAPTURE(ascii);
            const tf::write_options options{.format = format, .ascii = ascii};
            const std::string bytes = tf::write_to_memory(file, options);
            {
                const tf::thread_scope one(1);
                REQUIRE(tf::write_to_memory(file, options) == bytes);
            }
            const tf::mesh_file again =
                tf::read(std::as_bytes(std::span(bytes)), std::string("large.") + format, {});
            CHECK(again.mesh.points == file.mesh.points);
            CHECK(again.mesh.faces == file.mesh.faces);
            if (format == std::string_view("ply") || !(ascii || format == std::string_view("obj")))
                continue;
            REQUIRE(again.attributes.parts.size() == 2);
            CHECK(again.attributes.parts[1].first_face == 9999);
        }
}
