/// \file
/// seeds FOLDER: writes what the fuzzers start from, a folder a target: small meshes of every
/// family of trouble as files of each format, and the numbers of hard pairs for the targets that
/// decide. Beside each, FOLDER/new/TARGET is for what a fuzzer finds.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <support/gltf.hpp>
#include <support/las_bytes.hpp>
#include <support/packages.hpp>
#include <support/stress_families.hpp>
#include <support/stress_meshes.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using tf::test::stress_family;

constexpr std::array formats{"3mf", "csv", "glb", "las", "obj", "off", "pcd", "ply", "stl", "xyz"};
constexpr std::array deciders{"predicates",
                              "implicit_points",
                              "triangle_triangle",
                              "self_intersections",
                              "boolean",
                              "cut",
                              "repair",
                              "weld"};

void write(const std::filesystem::path& path, std::string_view content) {
    std::ofstream out(path, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

/// Points as `tf::fuzz::bytes` reads them: new ones, of any doubles.
class encoder {
  public:
    void byte(int value) { text_ += static_cast<char>(value); }
    void coordinate(double x) {
        byte(7);
        const auto bits = std::bit_cast<std::uint64_t>(x);
        for (int shift = 0; shift < 64; shift += 8) byte(static_cast<int>(bits >> shift & 0xff));
    }
    void point(const tf::point3& p) {
        byte(0);
        for (std::size_t axis = 0; axis < 3; ++axis) coordinate(p[axis]);
    }
    void points(const tf::triangle3& t) {
        for (const tf::point3& p : t) point(p);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
};

/// A mesh of few faces, as the targets read it that take any.
std::string encoded(std::string_view target, const tf::mesh& mesh) {
    encoder to;
    if (target == "repair")
        for (const int option : {1, 0, 1}) to.byte(option);  // outer, in doubles, any shape
    to.byte(static_cast<int>(mesh.points.size()) - 1);
    for (const tf::point3& p : mesh.points) to.point(p);
    to.byte(static_cast<int>(mesh.faces.size()));
    for (const tf::face& f : mesh.faces)
        for (const std::uint32_t corner : f) to.byte(static_cast<int>(corner));
    return to.text();
}

/// Two solids over the corners of a pair: tetrahedra, boxes or octahedra.
std::string encoded_solids(const tf::test::triangle_pair& pair, int kind) {
    const auto& [a, b] = pair;
    encoder to;
    for (const int option : {0, 0, 0, 7}) to.byte(option);  // the union, in doubles, all asked
    for (const auto& [first, second] : {std::pair{a, b}, std::pair{b, a}}) {
        to.byte(0);  // one solid
        to.byte(kind);
        if (kind == 1) {
            to.point(first[0]);
            to.point(second[1]);
        } else {
            to.points(first);
            if (kind == 0) to.point(second[0]);
            if (kind == 2) to.points(second);
        }
    }
    return to.text();
}

/// Three triangles of a family, as what the target of that name reads.
std::string encoded(std::string_view target, tf::test::stress_stream& stream) {
    const auto first = stream.next();
    const auto second = stream.next();
    encoder to;
    if (target == "implicit_points") {
        to.byte(2);  // a line and a plane
        to.points(first.a);
        to.points(first.b);
        to.byte(3);  // three planes
        to.points(first.b);
        to.points(second.a);
        to.points(first.a);
        to.byte(0);
        to.point(second.b[0]);
        to.points(second.b);
    } else {
        if (target == "weld") {
            for (int i = 0; i < 2; ++i) to.byte(0);
            to.coordinate(0.25);
        }
        for (const tf::triangle3* t : {&first.a, &first.b, &second.a}) to.points(*t);
    }
    return to.text();
}

/// Every other corner has texture coordinates by its point, every third one a normal.
tf::mesh_file with_corner_values(tf::mesh mesh) {
    constexpr std::uint32_t none = tf::corner_values::none;
    tf::mesh_file file{.mesh = std::move(mesh)};
    tf::corner_values& corners = file.attributes.corners;
    corners.normals = {{0, 0, 1}, {0, 0.6, -0.8}};
    for (const tf::point3& p : file.mesh.points) corners.texture.push_back({p.x, 0.5, 0.0});
    std::uint32_t n = 0;
    for (const tf::face& f : file.mesh.faces) {
        tf::face& texture = corners.texture_of_corner.emplace_back();
        tf::face& normals = corners.normal_of_corner.emplace_back();
        for (std::size_t k = 0; k < 3; ++k, ++n) {
            texture[k] = n % 2 == 0 ? f[k] : none;
            normals[k] = n % 3 == 0 ? n % 2 : none;
        }
    }
    file.attributes.material_files = {"a.mtl"};
    file.attributes.parts = {{.material = "b", .first_face = 0}};
    return file;
}

/// Files that are read though they are not as their format says: target, name, content.
std::vector<std::array<std::string, 3>> odd_files() {
    using namespace std::string_literals;
    const tf::mesh_file file{.mesh = stress_mesh(static_cast<stress_family>(0), 12, 1)};
    std::string counted = write_to_memory(file, {.format = "stl"});
    std::string text = write_to_memory(file, {.format = "stl", .ascii = true});
    std::vector<std::array<std::string, 3>> all{{"read_stl", "trailing", counted + "x"}};
    ++counted[80];
    all.push_back({"read_stl", "wrong-count", counted});
    text.insert(text.find("endloop") + 7, " 3");
    all.push_back({"read_stl", "stray-words", text});
    text.insert(text.find("endfacet"), "\0\0"s);
    all.push_back({"read_stl", "zero-bytes", text + std::string(64, '\0')});
    all.push_back(
        {"read_obj", "hexadecimal", "v 0x1.8p1 -0x.1 0X1P-3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"});
    all.push_back({"read_ply", "strips",
                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                   "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                   "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n"});
    // Each point with a list, faces of several lengths, and elements ahead and behind.
    std::string blocks =
        "ply\nformat binary_little_endian 1.0\nelement camera 2\nproperty short view\n"
        "element vertex 40\nproperty float x\nproperty list uchar uchar seen\nproperty float y\n"
        "property float z\nelement face 30\nproperty list uchar uchar vertex_indices\n"
        "property list uchar float texcoord\nelement edge 3\nproperty uchar vertex1\nend_header\n"
        "abcd";
    for (unsigned i = 0; i < 40; ++i)
        blocks += std::string(4, '\1') + static_cast<char>(i % 3) + std::string(8 + i % 3, '\2');
    for (unsigned i = 0; i < 30; ++i)
        blocks +=
            static_cast<char>(3 + i % 3) + std::string(3 + i % 3, static_cast<char>(i)) + '\0';
    all.push_back({"read_blocks", "lists", blocks + "abc"});
    all.push_back(
        {"read_blocks", "text",
         "ply\nformat ascii 1.0\nelement camera 1\nproperty short view\nelement vertex 5\n"
         "property float x\nproperty float y\nproperty float z\nelement face 4\n"
         "property list uchar int vertex_indices\nend_header\n7\n0 0 0\n1 0 0\n\n0 1 0\n"
         "1 1 0\n0x1p3 0 1\n3 0 1 2\n4 0 1 2 3\n3 2 3 4\n3 0 1 4\n"});
    all.push_back(
        {"read_urdf", "arm",
         "<?xml version=\"1.0\"?>\n<robot name=\"r\"><link name=\"a\"><collision><origin "
         "xyz=\"0 0 1\" rpy=\"0.1 0 -3\"/><geometry><box size=\"1 2 .5\"/></geometry></collision>"
         "</link><link name=\"b\"><collision><geometry><cylinder radius=\"0.1\" length=\"2e-1\"/>"
         "</geometry></collision><collision><geometry><sphere radius=\"3\"/></geometry></collision>"
         "</link><link name=\"c\"/><joint name=\"i\" type=\"revolute\"><parent link=\"a\"/>"
         "<child link=\"b\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\"/></joint>"
         "<joint name=\"j\" type=\"prismatic\"><parent link=\"b\"/><child link=\"c\"/>"
         "<mimic joint=\"i\" multiplier=\"2\" offset=\"1\"/></joint></robot>\n"});
    all.push_back({"read_urdf", "mesh",
                   "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh "
                   "filename=\"package://a/b.stl\" scale=\"1 1 -1\"/></geometry></visual></link>"
                   "</robot>"});
    return all;
}

/// Model parts of 3MF packages, with what treeform does not write itself.
void write_model_parts(const std::filesystem::path& to) {
    const std::string leaf = "<object id=\"1\" name=\"a\">" + test::tetrahedron_3mf + "</object>";
    const std::string item = "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 5 .5 -5e-1\"/>";
    const auto model = [](const std::string& resources, const std::string& items) {
        return test::model_text(
            "<resources>" + resources + "</resources><build>" + items + "</build>",
            " unit=\"inch\" requiredextensions=\"p m\"");
    };
    write(to / "model-components",
          model(leaf + "<object id=\"2\" partnumber=\"b\"><components><component objectid=\"1\"/>"
                       "<component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"
                       "</components></object>",
                item + "<item objectid=\"1\" partnumber=\"c\"/>"));
    std::string colored = leaf;
    colored.replace(colored.find(" name"), 0, " pid=\"5\" pindex=\"1\"");
    colored.insert(colored.find(" v1="), " pid=\"6\" p1=\"0\" p2=\"1\" p3=\"0\"");
    colored.insert(colored.rfind(" v1="), " pid=\"7\" p1=\"0\"");
    write(to / "model-colors",
          model("<basematerials id=\"5\"><base name=\"x\" displaycolor=\"#102030\"/>"
                "<base name=\"y\" displaycolor=\"#10203040\"/></basematerials>"
                "<m:colorgroup id=\"6\"><m:color color=\"#FFFFFF\"/><m:color color=\"#000000\"/>"
                "</m:colorgroup><m:texture2dgroup id=\"7\" texid=\"8\">"
                "<m:tex2coord u=\"0\" v=\"1\"/></m:texture2dgroup>" +
                    colored,
                "<item objectid=\"1\"/>"));
    write(to / "model-path", model(leaf, "<item objectid=\"1\" p:path=\"/3D/3dmodel.model\"/>"));
}

/// GLB with what treeform does not write itself.
void write_gltf_files(const std::filesystem::path& to) {
    test::gltf_file file = test::gltf_cube(
        R"(,"name":"a","scale":[1,-2,3],"children":[1],"extensions":{"EXT_mesh_gpu_instancing":)"
        R"({"attributes":{"TRANSLATION":4,"ROTATION":5}}})");
    file.add(std::vector<std::uint8_t>(32, 7), test::gltf_uint8, "VEC4", R"(,"normalized":true)");
    file.add(std::vector<float>(16, 0.5F), test::gltf_float, "VEC2");
    file.add<float>({0, 0, 0, 5, 0, 0}, test::gltf_float, "VEC3");
    file.add<float>({0, 0, 0, 1, 0, 1, 0, 1}, test::gltf_float, "VEC4");
    file.add_view(test::bytes_of_values<std::uint8_t>({6, 7}));
    file.add_view(test::bytes_of_values<float>({1, 1, 3, 0, 1, 3}));
    file.add_accessor(0, test::gltf_float, 8, "VEC3",
                      R"(,"sparse":{"count":2,"indices":{"bufferView":6,"componentType":5121},)"
                      R"("values":{"bufferView":7}})");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":6,"COLOR_0":2,"TEXCOORD_0":3,"NORMAL":0)",
                  R"(,"indices":1,"material":0,"mode":5)");
    file.nodes.push_back(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,9,9,9,1]})");
    file.more = R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
                R"("extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":0.5}}}}}],)";
    write(to / "gltf", file.glb());
    write(to / "gltf-text", file.embedded());
}

/// Points of every format, plain and packed, with extra bytes and records.
void write_las_files(const std::filesystem::path& to) {
    for (unsigned format = 0; format <= 10; ++format) {
        test::las_bytes las{.minor = format >= 6   ? 4u
                                     : format >= 4 ? 3u
                                                   : 2u,
                            .format = format,
                            .record_size = test::las_sizes[format] + format % 3};
        las.add_record("LASF_Projection", 2112, "GEOGCS[]");
        if (las.minor == 4) las.add_extended("someone", 1, "abc");
        const std::string bytes =
            las.file(test::las_points(test::las_family::scan, format, las.record_size, 30, format));
        const tf::mesh_file file = tf::read(std::as_bytes(std::span(bytes)), "seed", "las");
        const std::string name = "format-" + std::to_string(format);
        write(to / name, bytes);
        write(to / (name + "-packed"), write_to_memory(file, {.format = "laz"}));
    }
}

void write_seeds(const std::filesystem::path& folder) {
    const auto folder_of = [&](const std::string& target) {
        std::filesystem::create_directories(folder / "new" / target);
        std::filesystem::create_directories(folder / target);
        return folder / target;
    };
    for (const char* const format : formats) {
        const auto to = folder_of(std::string("read_") + format);
        for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
            const auto family = static_cast<stress_family>(f);
            const tf::mesh_file file{.mesh = stress_mesh(family, 12, 1)};
            for (const bool ascii : {false, true})
                write(to / (std::string(name_of(family)) + (ascii ? "-ascii" : "")),
                      write_to_memory(file, {.format = format, .ascii = ascii}));
        }
        if (format == std::string_view("3mf")) write_model_parts(to);
        if (format == std::string_view("las")) write_las_files(to);
        if (format == std::string_view("glb")) write_gltf_files(to);
        const tf::mesh_file textured =
            with_corner_values(stress_mesh(static_cast<stress_family>(0), 12, 1));
        if (format == std::string_view("obj") || format == std::string_view("ply") ||
            format == std::string_view("glb"))
            for (const bool ascii : {false, true})
                write(to / (ascii ? "textured-ascii" : "textured"),
                      write_to_memory(textured, {.format = format, .ascii = ascii}));
    }
    for (const auto& [target, name, content] : odd_files())
        write(folder_of(target) / name, content);
    for (const char* const target : deciders) {
        const auto to = folder_of(target);
        for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
            const auto family = static_cast<stress_family>(f);
            tf::test::stress_stream stream(family, 1);
            for (int i = 0; i < 6; ++i) {
                const std::string_view name(target);
                const bool takes_mesh = name == "self_intersections" || name == "repair";
                const auto seed = static_cast<std::uint64_t>(i);
                write(to / (std::string(name_of(family)) + '-' + std::to_string(i)),
                      takes_mesh          ? encoded(name, stress_mesh(family, 12, seed))
                      : name == "boolean" ? encoded_solids(stream.next(), i % 3)
                                          : encoded(name, stream));
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) throw std::runtime_error("seeds FOLDER");
        write_seeds(argv[1]);
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
