// Broken input of any kind: an io_error, never a crash, a hang or memory out of proportion. What a
// sanitizer would see is the point of these tests; run them in the asan preset too.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/packages.hpp>

#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
// The library that reads scenes keeps what it had of a damaged file when it gives up.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }
#endif

namespace {

struct sample {
    std::string name;
    std::string bytes;
};

/// A small file with polygons, colors and parts in every format and encoding that we write.
std::vector<sample> samples() {
    const std::string ply =
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 5\nproperty double x\nproperty float y\n"
        "property int z\nproperty list uchar short tags\nelement face 2\nproperty list uchar int "
        "vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element edge 1\nproperty int v\nend_header\n0.1 0 0 0\n1 0 0 2 -1 5\n1 1 0 0\n0 1 0 0\n"
        "-1 0.5 3 0\n3 0 1 2 255 0 0\n4 0 2 3 4 1 2 3\n7\n";
    tf::mesh_file file = tf::read(std::as_bytes(std::span(ply)), "a.ply", {});
    std::vector<sample> all{
        {"a.ply", ply},
        {"a.obj",
         "mtllib m.mtl\n# c\no a\nv 0 0 0 1 1 1\nv 1e0 +0 0 1 1 1\nv 0 1. 0 1 1 1\nvt 0 0\nvn 0 0 "
         "1\n"
         "g b\nusemtl c\nf 1/1/1 2//1 \\\n3\nf -1 -2 -3 1\nl 1 2\n"},
        {"a.xyz", "3\n1,2,3\n4, 5, 6\n7,8,nan\n"},
        {"b.xyz", "x y z\n1 2 3 4\n5 6 7 8\n"},
        {"a.csv", "\"id\",z,y,\"a b\",x\n7,3,2,0.5,1\n8,6,5,-1,4\n"},
        {"b.pcd",
         "VERSION .7\nFIELDS x y z _ n h\nSIZE 4 8 2 1 8 4\nTYPE F F I U U F\nCOUNT 1 1 1 3 1 2\n"
         "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA binary\n" +
             std::string(66, 'n')},
        {"a.off",
         "STCNOFF # c\n3 1 0\n0 0 0 0 0 1 255 0 0 0.5 1\n1 0 0 0 0 1 1 2 3 0 0\n"
         "0 1 0 0 0 1 1 2 3 0 0\n3 0 1 2 1 0 0.5\n"}};
    for (const char* const format : {"ply", "stl", "obj", "off", "xyz", "csv", "pcd"})
        for (const bool ascii : {false, true})
            all.push_back({std::string("a.") + format,
                           tf::write_to_memory(file, {.format = format, .ascii = ascii})});
    file.format = "ply-binary-be";
    all.push_back({"a.ply", tf::write_to_memory(file, {.format = "ply"})});
    file.format = "pcd-binary-compressed";
    all.push_back({"a.pcd", tf::write_to_memory(file, {.format = "pcd"})});
    return all;
}

/// True when the bytes are a mesh whose corners are points, false when they are refused.
bool reads(const std::string& bytes, const std::string& name) {
    try {
        const auto file = tf::read(std::as_bytes(std::span(bytes)), name, {});
        for (const tf::face& f : file.mesh.faces)
            for (const std::uint32_t corner : f) REQUIRE(corner < file.mesh.points.size());
        // Packed points can be more than bytes, but not without bound.
        REQUIRE(file.mesh.points.size() <= (name.ends_with(".pcd") ? 30 : 1) * bytes.size());
        // Whatever is accepted can be written, its attributes too.
        for (const char* const format : {"ply", "pcd", "csv"})
            (void)tf::write_to_memory(file, {.format = format});
        return true;
    } catch (const tf::io_error& e) {
        REQUIRE(std::string_view(e.what()).starts_with(name));
        return false;
    }
}

/// The bytes in a block of their own size, so that a sanitizer sees one byte too many.
bool reads_exactly(const std::string& bytes, const std::string& name) {
    std::vector<std::byte> block(bytes.size());
    if (!bytes.empty()) std::memcpy(block.data(), bytes.data(), bytes.size());
    try {
        (void)tf::read(block, name, {});
        return true;
    } catch (const tf::io_error&) {
        return false;
    }
}

/// What is said of bytes that are refused; nothing when they are read.
std::string refusal(const std::string& bytes, const std::string& name) {
    try {
        (void)tf::read(std::as_bytes(std::span(bytes)), name, {});
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

}  // namespace

TEST_CASE("hostile: a file cut after any byte is read or refused") {
    for (const sample& s : samples()) {
        CAPTURE(s.name);
        CHECK(reads(s.bytes, s.name));
        for (std::size_t size = 0; size < s.bytes.size(); ++size) {
            const std::string cut = s.bytes.substr(0, size);
            const bool read = reads(cut, s.name);
            CHECK(reads_exactly(cut, s.name) == read);
            // Binary STL shows whole triangles by its size; binary PLY says how long it is.
            if (s.bytes.starts_with("treeform"))
                CHECK(read == (size > 84 && (size - 84) % 50 == 0));
            if (s.bytes.starts_with("ply\nformat bin") ||
                s.bytes.find("DATA binary") != std::string::npos)
                CHECK_FALSE(read);
        }
    }
}

TEST_CASE("hostile: files with changed, doubled and lost bytes are read or refused") {
    const auto all = samples();
    std::mt19937 random(1);
    const auto pick = [&](std::size_t count) { return random() % count; };
    constexpr std::string_view likely = "0123456789 -+.eE/\\#\n\r\t,nif\xff\x7f\x80";
    std::size_t accepted = 0;
    for (int round = 0; round < 30'000; ++round) {
        const sample& s = all[pick(all.size())];
        std::string bytes = s.bytes;
        for (std::size_t change = 0; change <= pick(4); ++change) {
            const std::size_t at = pick(bytes.size());
            switch (pick(4)) {
                case 0:
                    bytes[at] = static_cast<char>(random());
                    break;
                case 1:
                    bytes[at] = likely[pick(likely.size())];
                    break;
                case 2:
                    bytes.erase(at, 1 + pick(8));
                    break;
                default:
                    bytes.insert(at, s.bytes.substr(pick(s.bytes.size()), 1 + pick(8)));
            }
            if (bytes.empty()) bytes = "x";
        }
        accepted += reads(bytes, s.name) ? 1U : 0U;
    }
    CHECK(accepted > 1000);  // else the changes are too wild to reach deep
}

TEST_CASE("hostile: counts that the bytes cannot hold are refused before room is made for them") {
    const std::string vertex =
        "element vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\n";
    for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string head = "ply\nformat " + encoding + " 1.0\n";
        CHECK_FALSE(reads(head + vertex + "end_header\n0 0 0\n", "a.ply"));
        CHECK_FALSE(reads(head + "element vertex 99999999999999999999\nproperty float x\n"
                                 "property float y\nproperty float z\nend_header\n",
                          "a.ply"));
        CHECK_FALSE(reads(head + "element vertex 0\nproperty float x\nproperty float y\nproperty "
                                 "float z\nelement face 1\nproperty list int int vertex_indices\n"
                                 "end_header\n\xff\xff\xff\x7f",
                          "a.ply"));
    }
    CHECK_FALSE(reads("OFF\n400000000000 4 0\n0 0 0\n", "a.off"));
    CHECK_FALSE(reads("OFF\n1 1 0\n0 0 0\n2000000000 0 0 0\n", "a.off"));
    std::string stl(84 + 50, '\0');
    stl.replace(80, 4, "\xff\xff\xff\xff");
    CHECK(tf::read(std::as_bytes(std::span(stl)), "a.stl", {}).mesh.faces.size() == 1);
    CHECK_FALSE(reads(stl + "x", "a.stl"));
}

TEST_CASE(
    "hostile: glTF that nests without end is refused at a byte, brackets in strings are not") {
    const std::string deep(200'000, '[');
    CHECK(refusal(deep, "a.gltf").starts_with("a.gltf: byte 500: "));
    const std::string glb = "glTF" + test::little_endian(2, 4) +
                            test::little_endian(20 + deep.size(), 4) +
                            test::little_endian(deep.size(), 4) + "JSON" + deep;
    CHECK(refusal(glb, "a.glb").starts_with("a.glb: byte 520: "));
    CHECK(refusal(glb.substr(0, 300), "a.glb") == "a.glb: truncated");
    CHECK(refusal(glb.substr(0, 18), "a.glb") == "a.glb: truncated");
    CHECK(refusal("{\"a\\\"\":{},\"b\":" + deep, "a.gltf").starts_with("a.gltf: byte 513: "));
    const std::string named = R"({"asset":{"version":"2.0","generator":"\"[[)" + deep +
                              R"("},"scene":0,"scenes":[{"nodes":[]}],"nodes":[]})";
    CHECK(refusal(named, "a.gltf").find("nested") == std::string::npos);
    std::string wide = "[";
    for (int i = 0; i < 1000; ++i) wide += "[{}],";
    wide += "[]]";
    CHECK(refusal(wide, "a.gltf").find("nested") == std::string::npos);
}

TEST_CASE("hostile: what is named as a scene of one format goes to no other's loader") {
    if (!tf::reads_scenes()) return;
    for (const char* name : {"a.glb", "a.gltf", "a.3mf", "a.dae", "a.fbx"})
        CHECK_FALSE(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", name).empty());
    // LightWave's and Irrlicht's scenes would open other files with any loader.
    for (const char* name : {"a.lws", "a.irr"})
        CHECK(refusal("LWSC\n3\n\nLoadObjectLayer 1 b.x3d\n", name)
                  .find("not in a supported format") != std::string::npos);
}

TEST_CASE("hostile: glTF whose nodes form an endless chain or a ring is refused") {
    const auto chain = [](int length, int last) {
        std::string text =
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
        for (int n = 1; n < length; ++n) text += "{\"children\":[" + std::to_string(n) + "]},";
        return text + (last < 0 ? "{}" : "{\"children\":[" + std::to_string(last) + "]}") + "]}";
    };
    CHECK(refusal(chain(100'000, -1), "a.gltf") ==
          "a.gltf: node 1000 is more than 1000 levels deep");
    CHECK(refusal(chain(100'000, 0), "a.gltf") == "a.gltf: a node is its own descendant");
    CHECK(refusal(chain(900, -1), "a.gltf").find("deep") == std::string::npos);
    CHECK(refusal(chain(1000, -1), "a.gltf").find("deep") == std::string::npos);
}

TEST_CASE("hostile: XML, FBX and DirectX that nest without end are refused, wide ones are not") {
    if (!tf::reads_scenes()) return;
    const auto times = [](std::size_t count, const std::string& text) {
        std::string all;
        for (std::size_t i = 0; i < count; ++i) all += text;
        return all;
    };
    const auto deep = [](const std::string& bytes, const char* name) {
        const std::string said = refusal(bytes, name);
        CHECK(said.find("$$$") == std::string::npos);
        return said.find("nested more than 1000 levels deep") != std::string::npos;
    };
    const std::string xml = "<?xml version=\"1.0\"?><!-- </a> --><X3D profile=\"a>b\"><Scene>";
    const std::string shape =
        "<Shape><IndexedFaceSet coordIndex=\"0 1 2 -1\"><Coordinate point=\"0 0 0 1 0 0 0 1 0\"/>"
        "</IndexedFaceSet></Shape>";
    const auto x3d = [&](std::size_t levels, const std::string& more) {
        return xml + times(levels, "<Group>" + more) + shape + times(levels, "</Group>") +
               "</Scene></X3D>";
    };
    CHECK(!deep(x3d(900, ""), "a.dae"));
    CHECK(!deep(xml + times(2000, "<Group>" + shape + "</Group>") + "</Scene></X3D>", "a.dae"));
    CHECK(refusal(xml + "<Group/>" + shape + "</Scene></X3D>", "a.x3d")
              .find("not in a supported format") != std::string::npos);
    CHECK(!refusal(xml + "<Group/>" + shape + "</Scene></X3D>", "a.xml").empty());
    for (const char* more :
         {"", "<!-- </Group> -->", "<Group DEF='</Group>'/>", "<![CDATA[</a>]]>"})
        for (const char* name : {"a.dae", "a.amf", "a.3ds"}) CHECK(deep(x3d(100'000, more), name));
    std::string wide = "\xFF\xFE";
    for (const char c : x3d(100'000, "")) wide += {c, '\0'};
    CHECK(deep(wide, "a.dae"));
    for (const char* little : {"x", "xof ", "xof 030", "xof 0303txt", "<", "<>", "</", ";FBX", "F"})
        for (const char* name : {"a.dae", "a.x", "a.fbx"}) CHECK(!refusal(little, name).empty());

    const std::string fbx = "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n}\n";
    CHECK(deep(fbx + times(100'000, "A: { ; }\n"), "a.fbx"));
    CHECK(deep(fbx + times(100'000, "A: \"}\" {\n"), "a.fbx"));
    CHECK_FALSE(deep(fbx + times(5000, "A: {\n}\n"), "a.fbx"));
    CHECK(deep("xof 0303txt 0032\n" + times(100'000, "Frame { # }\n // }\n"), "a.x"));
    for (const int width : {4, 8}) {
        const auto binary = [&](std::size_t levels) {
            std::string bytes = "Kaydara FBX Binary  " + std::string("\0\x1a\0", 3) +
                                test::little_endian(width == 8 ? 7500 : 7400, 4);
            const std::size_t record = width == 8 ? 26 : 14, total = bytes.size() + levels * record;
            for (std::size_t i = 0; i < levels; ++i)
                bytes += test::little_endian(total, width) +
                         std::string(width == 8 ? 16 : 8, '\0') + "\1A";
            return bytes;
        };
        CHECK(deep(binary(100'000), "a.fbx"));
        CHECK_FALSE(deep(binary(900), "a.fbx"));
    }
}
