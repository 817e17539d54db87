// 3MF against lib3mf, by which most programs write and read it: what it writes is read as it is
// meant, and what is written here it reads without a warning, to the same effect.

#include <libmesh/attributes/scene_parts.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/skip.hpp>
#include <support/solids.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#ifdef TREEFORM_LIB3MF
#include <Model/COM/NMR_DLLInterfaces.h>
#endif

namespace {

void set_bytes(tf::mesh_file& file, const char* element, std::size_t rows, const char* name,
               const std::vector<std::uint8_t>& values) {
    file.attributes.find_or_add(element, rows).set(tf::column::of<std::uint8_t>(name, values));
}

#ifdef TREEFORM_LIB3MF

void must(int result) { REQUIRE(result == 0); }

/// One of lib3mf's objects.
class handle {
  public:
    handle() = default;
    handle(const handle&) = delete;
    handle(handle&& other) noexcept : of_(std::exchange(other.of_, nullptr)) {}
    handle& operator=(const handle&) = delete;
    handle& operator=(handle&&) = delete;
    ~handle() {
        if (of_ != nullptr) NMR::lib3mf_release(of_);
    }
    /// For a call that makes one.
    template <class F>
    static handle of(const F& make) {
        handle made;
        must(make(&made.of_));
        return made;
    }
    operator NMR::PLib3MFBase*() const { return of_; }  // NOLINT: as its functions take it

  private:
    NMR::PLib3MFBase* of_ = nullptr;
};

handle new_model() {
    return handle::of([](auto* to) { return NMR::lib3mf_createmodel(to); });
}

handle add_mesh(const handle& model, const tf::mesh& mesh, const char* name) {
    handle object =
        handle::of([&](auto* to) { return NMR::lib3mf_model_addmeshobject(model, to); });
    std::vector<NMR::MODELMESHVERTEX> vertices;
    std::vector<NMR::MODELMESHTRIANGLE> triangles;
    for (const tf::point3& p : mesh.points)
        vertices.push_back(
            {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}});
    for (const tf::face& f : mesh.faces) triangles.push_back({{f[0], f[1], f[2]}});
    must(NMR::lib3mf_meshobject_setgeometry(object, vertices.data(),
                                            static_cast<DWORD>(vertices.size()), triangles.data(),
                                            static_cast<DWORD>(triangles.size())));
    must(NMR::lib3mf_object_setnameutf8(object, name));
    return object;
}

/// The identity, with another diagonal and a translation.
NMR::MODELTRANSFORM placed_at(std::array<float, 3> scale, std::array<float, 3> to) {
    NMR::MODELTRANSFORM t{};
    for (std::size_t k = 0; k < 3; ++k) {
        t.m_fFields[k][k] = scale[k];
        t.m_fFields[k][3] = to[k];
    }
    return t;
}

void build(const handle& model, const handle& object, NMR::MODELTRANSFORM* transform = nullptr) {
    (void)handle::of(
        [&](auto* to) { return NMR::lib3mf_model_addbuilditem(model, object, transform, to); });
}

tf::mesh_file read_back(const handle& model) {
    const handle writer =
        handle::of([&](auto* to) { return NMR::lib3mf_model_querywriter(model, "3mf", to); });
    ULONG64 size = 0;
    must(NMR::lib3mf_writer_getstreamsize(writer, &size));
    std::vector<std::byte> bytes(size);
    must(NMR::lib3mf_writer_writetobuffer(writer, reinterpret_cast<BYTE*>(bytes.data()), size));
    tf::mesh_file file = tf::read(bytes, "a.3mf", {});
    CHECK(file.format == "3mf");
    CHECK(file.warnings.empty());
    return file;
}

/// What lib3mf reads of a file that is written here.
struct seen_object {
    std::string name{};
    tf::mesh mesh{};
    std::vector<std::array<std::uint32_t, 3>> colors{};  ///< [F] of corners, 0xRRGGBBAA
};

std::uint32_t packed(const NMR::MODELMESHCOLOR_SRGB& c) {
    return std::uint32_t{c.m_Red} << 24 | std::uint32_t{c.m_Green} << 16 |
           std::uint32_t{c.m_Blue} << 8 | c.m_Alpha;
}

std::array<std::uint32_t, 3> colors_seen(const handle& model, const handle& properties,
                                         std::uint32_t f) {
    NMR::eModelPropertyType type = NMR::MODELPROPERTYTYPE_NONE;
    must(NMR::lib3mf_propertyhandler_getpropertytype(properties, f, &type));
    if (type == NMR::MODELPROPERTYTYPE_COLOR) {
        NMR::MODELMESH_TRIANGLECOLOR_SRGB color{};
        must(NMR::lib3mf_propertyhandler_getcolor(properties, f, &color));
        return {packed(color.m_Colors[0]), packed(color.m_Colors[1]), packed(color.m_Colors[2])};
    }
    if (type != NMR::MODELPROPERTYTYPE_BASEMATERIALS) return {};
    DWORD group = 0, index = 0;
    must(NMR::lib3mf_propertyhandler_getbasematerial(properties, f, &group, &index));
    const handle materials = handle::of(
        [&](auto* to) { return NMR::lib3mf_model_getbasematerialbyid(model, group, to); });
    NMR::MODELMESHCOLOR_SRGB c{};
    must(NMR::lib3mf_basematerial_getdisplaycolor(materials, index, &c.m_Red, &c.m_Green, &c.m_Blue,
                                                  &c.m_Alpha));
    return {packed(c), packed(c), packed(c)};
}

seen_object look_at(const handle& model, const handle& object) {
    seen_object seen;
    std::array<char, 256> name{};
    ULONG size = 0;
    must(NMR::lib3mf_object_getnameutf8(object, name.data(), name.size(), &size));
    seen.name = name.data();
    DWORD points = 0, faces = 0;
    must(NMR::lib3mf_meshobject_getvertexcount(object, &points));
    must(NMR::lib3mf_meshobject_gettrianglecount(object, &faces));
    for (DWORD v = 0; v < points; ++v) {
        NMR::MODELMESHVERTEX p{};
        must(NMR::lib3mf_meshobject_getvertex(object, v, &p));
        seen.mesh.points.push_back({p.m_fPosition[0], p.m_fPosition[1], p.m_fPosition[2]});
    }
    const handle properties = handle::of(
        [&](auto* to) { return NMR::lib3mf_meshobject_createpropertyhandler(object, to); });
    for (DWORD f = 0; f < faces; ++f) {
        NMR::MODELMESHTRIANGLE t{};
        must(NMR::lib3mf_meshobject_gettriangle(object, f, &t));
        seen.mesh.faces.push_back({t.m_nIndices[0], t.m_nIndices[1], t.m_nIndices[2]});
        seen.colors.push_back(colors_seen(model, properties, f));
    }
    return seen;
}

/// The objects of the build, which lib3mf reads strictly and without a warning.
std::vector<seen_object> seen_by_lib3mf(const tf::mesh_file& file, DWORD unit) {
    std::string bytes = tf::write_to_memory(file, {.format = "3mf"});
    const handle model = new_model();
    const handle reader =
        handle::of([&](auto* to) { return NMR::lib3mf_model_queryreader(model, "3mf", to); });
    must(NMR::lib3mf_reader_setstrictmodeactive(reader, 1));
    must(NMR::lib3mf_reader_readfrombuffer(reader, reinterpret_cast<BYTE*>(bytes.data()),
                                           bytes.size()));
    DWORD warnings = 0, seen_unit = 0;
    must(NMR::lib3mf_reader_getwarningcount(reader, &warnings));
    CHECK(warnings == 0);
    must(NMR::lib3mf_model_getunit(model, &seen_unit));
    CHECK(seen_unit == unit);
    const handle items =
        handle::of([&](auto* to) { return NMR::lib3mf_model_getbuilditems(model, to); });
    std::vector<seen_object> all;
    BOOL more = 0;
    for (must(NMR::lib3mf_builditemiterator_movenext(items, &more)); more != 0;
         must(NMR::lib3mf_builditemiterator_movenext(items, &more))) {
        const handle item = handle::of(
            [&](auto* to) { return NMR::lib3mf_builditemiterator_getcurrent(items, to); });
        all.push_back(look_at(model, handle::of([&](auto* to) {
                                  return NMR::lib3mf_builditem_getobjectresource(item, to);
                              })));
    }
    return all;
}

#endif

}  // namespace

#ifdef TREEFORM_LIB3MF

TEST_CASE("lib3mf writes: a mesh, its unit and its name are read") {
    constexpr std::array<const char*, 6> units{"micron", "millimeter", "centimeter",
                                               "inch",   "foot",       "meter"};
    for (DWORD unit = 0; unit < units.size(); ++unit) {
        const handle model = new_model();
        must(NMR::lib3mf_model_setunit(model, unit));
        build(model, add_mesh(model, test::box(1, 2, 3.5), "k\xc3\xb6nig & <more>"));
        const tf::mesh_file file = read_back(model);
        CHECK(file.mesh == test::box(1, 2, 3.5));
        CHECK(file.attributes.obj_info ==
              std::vector<std::string>{std::string("unit ") + units[unit]});
        REQUIRE(file.attributes.parts.size() == 1);
        CHECK(file.attributes.parts[0].object == "k\xc3\xb6nig & <more>");
    }
}

TEST_CASE("lib3mf writes: items and components are where their transforms put them") {
    const handle model = new_model();
    const handle box = add_mesh(model, test::box(1, 2, 3), "box");
    const handle both =
        handle::of([&](auto* to) { return NMR::lib3mf_model_addcomponentsobject(model, to); });
    must(NMR::lib3mf_object_setnameutf8(both, "both"));
    auto aside = placed_at({1, 1, 1}, {10, 0, 0});
    auto mirrored = placed_at({-1, 1, 1}, {0, 0, 5});
    for (NMR::MODELTRANSFORM* t : {&aside, &mirrored})
        (void)handle::of(
            [&](auto* to) { return NMR::lib3mf_componentsobject_addcomponent(both, box, t, to); });
    auto large = placed_at({2, 2, 2}, {0, 100, 0});
    build(model, both, &large);
    build(model, box, &mirrored);
    const tf::mesh_file file = read_back(model);
    REQUIRE(file.mesh.points.size() == 24);
    const auto boxes = [&](std::size_t first) {
        return *tf::bounding_box(std::span(file.mesh.points).subspan(first, 8));
    };
    CHECK(boxes(0) == tf::box3{{20, 100, 0}, {22, 104, 6}});
    CHECK(boxes(8) == tf::box3{{-2, 100, 10}, {0, 104, 16}});
    CHECK(boxes(16) == tf::box3{{-1, 0, 5}, {0, 2, 8}});
    const auto parts = tf::scene_parts(file.mesh, file.attributes.parts);
    REQUIRE(parts.size() == 3);
    const std::array<double, 3> volumes{48, 48, 6};
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(tf::signed_volume(tf::submesh(file.mesh, parts[i].faces).mesh) ==
              doctest::Approx(volumes[i]));
}

TEST_CASE("lib3mf writes: base materials are materials and colors") {
    const handle model = new_model();
    const handle materials =
        handle::of([&](auto* to) { return NMR::lib3mf_model_addbasematerialgroup(model, to); });
    DWORD red = 0, blue = 0, group = 0;
    must(NMR::lib3mf_basematerial_addmaterialutf8(materials, "red PLA", 255, 0, 0, &red));
    must(NMR::lib3mf_basematerial_addmaterialutf8(materials, "blue", 0, 0, 255, &blue));
    must(NMR::lib3mf_basematerial_getresourceid(materials, &group));
    const handle box = add_mesh(model, test::box(1, 1, 1), "box");
    {
        const handle usual = handle::of(
            [&](auto* to) { return NMR::lib3mf_object_createdefaultpropertyhandler(box, to); });
        must(NMR::lib3mf_defaultpropertyhandler_setbasematerial(usual, group, red));
        const handle of_faces = handle::of(
            [&](auto* to) { return NMR::lib3mf_meshobject_createpropertyhandler(box, to); });
        for (DWORD f = 0; f < 12; ++f)
            must(NMR::lib3mf_propertyhandler_setbasematerial(of_faces, f, group,
                                                             f < 6 ? red : blue));
    }
    build(model, box);
    const tf::mesh_file file = read_back(model);
    REQUIRE(file.attributes.parts.size() == 2);
    CHECK(file.attributes.parts[0].material == "red PLA");
    CHECK(file.attributes.parts[1] ==
          tf::named_faces{.object = "box", .material = "blue", .first_face = 6});
    const std::vector<int> half{255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0};
    CHECK(test::whole_values(file, "face", "red") == half);
    CHECK(test::whole_values(file, "face", "green") == std::vector<int>(12, 0));
    CHECK(test::whole_values(file, "face", "blue") == std::vector<int>(half.rbegin(), half.rend()));
}

TEST_CASE("lib3mf writes: colors of faces and of their corners are read") {
    for (const bool of_corners : {false, true}) {
        const handle model = new_model();
        const tf::mesh shape = test::box(1, 1, 1);
        const handle box = add_mesh(model, shape, "box");
        {
            const handle colors = handle::of(
                [&](auto* to) { return NMR::lib3mf_meshobject_createpropertyhandler(box, to); });
            std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> all(12);
            for (std::uint32_t f = 0; f < 12; ++f)
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t number = of_corners ? shape.faces[f][k] : f;
                    all[f].m_Colors[k] = {static_cast<BYTE>(10 * number), 20, 30, 128};
                }
            must(NMR::lib3mf_propertyhandler_setgradientcolorarray(colors, all.data()));
            // It writes no object whose faces have properties, and itself none.
            const handle usual = handle::of(
                [&](auto* to) { return NMR::lib3mf_object_createdefaultpropertyhandler(box, to); });
            must(NMR::lib3mf_defaultpropertyhandler_setcolorrgba(usual, 1, 2, 3, 255));
        }
        build(model, box);
        const tf::mesh_file file = read_back(model);
        const char* const where = of_corners ? "vertex" : "face";
        std::vector<int> reds;
        for (int i = 0; i < (of_corners ? 8 : 12); ++i) reds.push_back(10 * i);
        CHECK(test::whole_values(file, where, "red") == reds);
        CHECK(test::whole_values(file, where, "blue") == std::vector<int>(reds.size(), 30));
        CHECK(test::whole_values(file, where, "alpha") == std::vector<int>(reds.size(), 128));
    }
}

TEST_CASE("lib3mf reads: parts, names and units as they are written") {
    tf::mesh_file file;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const tf::mesh box = test::box(1, 1 + i, 0.1);
        file.attributes.parts.push_back(
            {.object = "part <" + std::to_string(i) + "> \xc3\xa4 & \"more\"",
             .first_face = 12 * i});
        for (const tf::point3& p : box.points) file.mesh.points.push_back({p.x + 2 * i, p.y, p.z});
        for (const tf::face& f : box.faces)
            file.mesh.faces.push_back({8 * i + f[0], 8 * i + f[1], 8 * i + f[2]});
    }
    file.stored_faces = 36;
    file.attributes.obj_info = {"unit inch"};
    const auto seen = seen_by_lib3mf(file, NMR::MODELUNIT_INCH);
    REQUIRE(seen.size() == 3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        CHECK(seen[i].name == file.attributes.parts[i].object);
        CHECK(seen[i].mesh.points.size() == 8);
        CHECK(seen[i].mesh.faces == test::box(1, 1, 1).faces);
        CHECK(tf::signed_volume(seen[i].mesh) == doctest::Approx(0.1 * (1 + i)));
    }
}

TEST_CASE("lib3mf reads: materials with the colors of their faces") {
    tf::mesh_file file{.mesh = test::box(1, 1, 1)};
    file.stored_faces = 12;
    file.attributes.parts = {{.object = "box", .material = "a & b", .first_face = 0},
                             {.object = "box", .material = "c", .first_face = 6}};
    const std::vector<std::uint8_t> reds{255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0};
    set_bytes(file, "face", 12, "red", reds);
    set_bytes(file, "face", 12, "green", std::vector<std::uint8_t>(12, 7));
    set_bytes(file, "face", 12, "blue", {reds.rbegin(), reds.rend()});
    set_bytes(file, "face", 12, "alpha", std::vector<std::uint8_t>(12, 128));
    const auto seen = seen_by_lib3mf(file, NMR::MODELUNIT_MILLIMETER);
    REQUIRE(seen.size() == 1);
    for (std::size_t f = 0; f < 12; ++f)
        CHECK(seen[0].colors[f][0] == (f < 6 ? 0xff070080U : 0x0007ff80U));
}

TEST_CASE("lib3mf reads: colors of faces, and of points") {
    tf::mesh_file faces{.mesh = test::box(1, 1, 1)};
    faces.stored_faces = 12;
    tf::mesh_file points = faces;
    std::vector<std::uint8_t> numbers;
    for (std::uint8_t i = 0; i < 12; ++i) numbers.push_back(static_cast<std::uint8_t>(20 * i));
    for (const char* name : {"red", "green", "blue"}) {
        set_bytes(faces, "face", 12, name, numbers);
        set_bytes(points, "vertex", 8, name, {numbers.begin(), numbers.begin() + 8});
    }
    const auto gray = [](std::uint32_t i) { return 20 * i * 0x01010100U | 0xffU; };
    const auto seen_faces = seen_by_lib3mf(faces, NMR::MODELUNIT_MILLIMETER).at(0);
    const auto seen_points = seen_by_lib3mf(points, NMR::MODELUNIT_MILLIMETER).at(0);
    for (std::uint32_t f = 0; f < 12; ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(seen_faces.colors[f][k] == gray(f));
            CHECK(seen_points.colors[f][k] == gray(points.mesh.faces[f][k]));
        }
}

#else

TEST_CASE("lib3mf writes and reads 3MF") { SKIP_CASE("lib3mf-dev is not installed"); }

#endif

TEST_CASE("3mf: the packages of openscad-testing-data are solids") {
    const std::filesystem::path folder = "/usr/share/openscad/testdata";
    if (!std::filesystem::is_directory(folder))
        SKIP_CASE("Debian's openscad-testing-data is not installed");
    std::size_t read = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".3mf") continue;
        CAPTURE(entry.path().string());
        const tf::mesh_file file = tf::read(entry.path());
        CHECK(file.warnings.empty());
        CHECK_FALSE(tf::find_open_edge(file.mesh).has_value());
        CHECK(tf::signed_volume(file.mesh) > 0.0);
        ++read;
    }
    CHECK(read > 0);
}
