#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// A folder that goes away.
class robot_folder {
  public:
    robot_folder() {
        path_ = std::filesystem::temp_directory_path() /
                ("treeform_urdf_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
        std::filesystem::create_directories(path_ / "arm" / "meshes");
        std::ofstream(path_ / "arm" / "meshes" / "a.stl") << "solid\nendsolid\n";
    }
    ~robot_folder() { std::filesystem::remove_all(path_); }
    robot_folder(const robot_folder&) = delete;
    robot_folder& operator=(const robot_folder&) = delete;

    [[nodiscard]] std::filesystem::path write(const std::string& text,
                                              const std::string& name = "arm/robot.urdf") const {
        std::ofstream(path_ / name) << text;
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string robot(const std::string& inside) {
    return "<?xml version=\"1.0\"?><robot name=\"r\">" + inside + "</robot>";
}

std::string joint(const std::string& name, const std::string& type, const std::string& from,
                  const std::string& to, const std::string& more = {}) {
    return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + from +
           "\"/><child link=\"" + to + "\"/>" + more + "</joint>";
}

const std::string three = "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>";

void check_near(const tf::point3& p, const tf::point3& q) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(p[k] - q[k]) < 1e-15);
}

/// What `read_urdf` says of this text, without the path.
std::string urdf_refusal(const std::string& text) {
    const robot_folder folder;
    const auto path = folder.write(text);
    try {
        static_cast<void>(tf::read_urdf(path));
    } catch (const tf::io_error& error) {
        return std::string(error.what()).substr(path.string().size() + 2);
    }
    return {};
}

}  // namespace

TEST_CASE("urdf: a chain of joints of each kind puts links where the joints say") {
    const robot_folder folder;
    const auto path = folder.write(
        robot("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/><link "
              "name=\"e\"/>" +
              joint("slide", "prismatic", "b", "c",
                    "<axis xyz=\"0 2 0\"/><limit lower=\"-1\" upper=\"3\"/>") +
              joint("turn", "revolute", "a", "b",
                    "<origin xyz=\"1 0 0\" rpy=\"0 0 1.5707963267948966\"/><axis xyz=\"0 0 1\"/>") +
              joint("weld", "fixed", "c", "d", "<origin xyz=\"0 0 5\"/>") +
              joint("spin", "continuous", "d", "e")));
    const tf::urdf_robot r = tf::read_urdf(path);
    CHECK(r.name == "r");
    CHECK(r.links == std::vector<std::string>{"a", "b", "c", "d", "e"});
    CHECK(r.joints[0].name == "turn");  // parents come ahead
    CHECK((*r.joints[1].limits)[1] == 3.0);
    using pairs = std::vector<std::array<std::uint32_t, 2>>;
    CHECK(r.adjacent() == pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    const auto rest = r.link_transforms({});
    CHECK(rest[0] == tf::transform<3>{});
    check_near(rest[1](tf::point3{1, 0, 0}), {1, 1, 0});
    check_near(rest[3](tf::point3{0, 0, 0}), {1, 0, 5});
    const std::map<std::string, double> values{
        {"slide", 2.0}, {"turn", -0.5 * std::numbers::pi}, {"spin", 0.5 * std::numbers::pi}};
    const auto moved = r.link_transforms(values);
    check_near(moved[1](tf::point3{1, 0, 0}), {2, 0, 0});
    check_near(moved[2](tf::point3{0, 0, 0}), {1, 2, 0});
    check_near(moved[4](tf::point3{0, 1, 0}), {1, 2, 6});
}

TEST_CASE("urdf: roll, pitch and yaw are about the fixed axes x, y and z, in this order") {
    const robot_folder folder;
    const auto path =
        folder.write(robot("<link name=\"a\"/><link name=\"b\"/>" +
                           joint("j", "fixed", "a", "b",
                                 "<origin rpy=\"1.5707963267948966 1.5707963267948966 0\"/>")));
    const auto at = tf::read_urdf(path).link_transforms({});
    check_near(at[1](tf::point3{0, 1, 0}), {1, 0, 0});  // about x to z, then about y to x
    check_near(at[1](tf::point3{1, 0, 0}), {0, 0, -1});
}

TEST_CASE("urdf: a joint that mimics another follows it, unless it has a value of its own") {
    const robot_folder folder;
    const auto path = folder.write(robot(
        three + joint("p", "prismatic", "a", "b") +
        joint("q", "prismatic", "a", "c", "<mimic joint=\"p\" multiplier=\"-2\" offset=\"1\"/>")));
    const auto r = tf::read_urdf(path);
    const auto x = [&](const std::map<std::string, double>& values) {
        return r.link_transforms(values)[2].rows[0][3];
    };
    CHECK(x({}) == 1.0);
    CHECK(x({{"p", 3.0}}) == -5.0);
    CHECK(x({{"p", 3.0}, {"q", 7.0}}) == 7.0);
}

TEST_CASE("urdf: meshes are found beside the file, in packages, and where it is said") {
    const robot_folder folder;
    const auto with = [&](const std::string& name, const std::string& more = {}) {
        return robot(
            "<link name=\"a\"><collision><origin xyz=\"0 0 1\"/><geometry><mesh filename=\"" +
            name + "\" scale=\"2 2 -1\"/></geometry></collision>" + more + "</link>");
    };
    for (const std::string name :
         {"meshes/a.stl", "package://arm/meshes/a.stl", "package://other/meshes/a.stl"}) {
        CAPTURE(name);
        const auto r = tf::read_urdf(folder.write(with(name)));
        REQUIRE(r.meshes.size() == 1);
        CHECK(r.meshes[0].file.filename() == "a.stl");
        CHECK(r.meshes[0].place(tf::point3{1, 1, 1}) == tf::point3{2, 2, 0});
    }
    std::filesystem::create_directories(folder.path() / "elsewhere");
    const auto away = folder.write(with("package://meshes/a.stl"), "elsewhere/robot.urdf");
    CHECK_THROWS_AS(static_cast<void>(tf::read_urdf(away)), tf::io_error);
    const std::filesystem::path packages = folder.path() / "arm";
    CHECK(tf::read_urdf(away, {&packages, 1}).meshes.size() == 1);
    const auto r = tf::read_urdf(folder.write(with(
        "meshes/a.stl", "<collision><geometry><capsule radius=\"1\"/></geometry></collision>")));
    CHECK(r.skipped == std::vector<std::string>{"link a: a capsule is not supported"});
    constexpr bool visual = true;
    CHECK(tf::read_urdf(folder.write(with("meshes/a.stl")), {}, visual).meshes.empty());
}

TEST_CASE("urdf: parts are the links that have faces, each one mesh in the frame of its link") {
    const robot_folder folder;
    const auto box = [](const char* x) {
        return "<collision><origin xyz=\"" + std::string(x) +
               " 0 0\"/><geometry><box size=\"2 2 2\"/></geometry></collision>";
    };
    const auto link = [](const char* name, const std::string& shapes) {
        return "<link name=\"" + std::string(name) + "\">" + shapes + "</link>";
    };
    const auto r = tf::read_urdf(
        folder.write(robot(link("a", box("0")) + link("b", "") + link("c", box("5") + box("9")) +
                           link("d", box("1")) + joint("p", "fixed", "a", "b") +
                           joint("q", "fixed", "b", "c") + joint("r", "fixed", "c", "d"))));
    const auto no_file = [](const std::filesystem::path&) -> tf::mesh {
        throw std::logic_error("there is no file");
    };
    const std::vector<tf::urdf_mesh> made = r.parts(no_file);
    const auto links_of = [](const std::vector<tf::urdf_mesh>& parts) {
        std::vector<std::uint32_t> links;
        for (const tf::urdf_mesh& part : parts) links.push_back(part.link);
        return links;
    };
    REQUIRE(links_of(made) == std::vector<std::uint32_t>{0, 2, 3});
    using pairs = std::vector<std::array<std::uint32_t, 2>>;
    CHECK(r.adjacent(made) == pairs{{0, 1}, {1, 2}});
    CHECK(made[1].shape.points.size() == 16);
    CHECK(made[1].shape.faces.size() == 24);
    CHECK(tf::bounding_box(made[1].shape.points)->min == tf::point3{4, -1, -1});
    CHECK(tf::bounding_box(made[1].shape.points)->max == tf::point3{10, 1, 1});
    CHECK(tf::signed_volume(made[1].shape) == 16.0);
    // Links without faces are no parts, whatever they are joined to.
    auto only_files = r;
    for (tf::urdf_mesh& one : only_files.meshes) one.file = std::to_string(one.link);
    std::vector<std::string> asked;
    const auto parts = only_files.parts([&](const std::filesystem::path& path) {
        asked.push_back(path.string());
        return path == "3" ? r.meshes[0].shape : tf::mesh{};
    });
    CHECK(asked == std::vector<std::string>{"0", "2", "2", "3"});
    CHECK(links_of(parts) == std::vector<std::uint32_t>{3});
    CHECK(only_files.adjacent(parts).empty());
}

TEST_CASE("urdf: a scale that mirrors turns faces over") {
    const robot_folder folder;
    const auto part_scaled_by = [&](const std::string& scale) {
        const auto r = tf::read_urdf(folder.write(
            robot("<link name=\"a\"><collision><geometry><mesh filename=\"meshes/a.stl\" scale=\"" +
                  scale + "\"/></geometry></collision></link>")));
        return r
            .parts([](const std::filesystem::path&) {
                tf::mesh tetrahedron;
                tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
                tetrahedron.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
                return tetrahedron;
            })
            .at(0)
            .shape;
    };
    for (const char* scale : {"2 2 1.5", "2 2 -1.5", "-2 -2 1.5", "-2 -2 -1.5"}) {
        CAPTURE(scale);
        CHECK(tf::signed_volume(part_scaled_by(scale)) == doctest::Approx(1.0));
    }
}

TEST_CASE("urdf: boxes are exact, cylinders and spheres are closed meshes around them") {
    const robot_folder folder;
    const auto link = [](const std::string& shape) {
        return robot("<link name=\"a\"><collision><origin xyz=\"0 0 1\"/><geometry>" + shape +
                     "</geometry></collision></link>");
    };
    const auto made = [&](const std::string& shape) {
        auto r = tf::read_urdf(folder.write(link(shape)));
        REQUIRE(r.meshes.size() == 1);
        CHECK(r.meshes[0].file.empty());
        CHECK(r.skipped.empty());
        CHECK(r.meshes[0].place(tf::point3{}) == tf::point3{0, 0, 1});
        CHECK(r.approximated.size() == (shape.starts_with("<box") ? 0U : 1U));
        tf::mesh mesh = std::move(r.meshes[0].shape);
        CHECK_FALSE(tf::find_solid_defects(mesh).any());
        return mesh;
    };
    const tf::mesh box = made("<box size=\"1 2 0.5\"/>");
    CHECK(tf::signed_volume(box) == 1.0);

    const double radius = 0.3, length = 0.7;
    const tf::mesh cylinder = made("<cylinder radius=\"0.3\" length=\"0.7\"/>");
    const double true_volume = std::numbers::pi * radius * radius * length;
    CHECK(tf::signed_volume(cylinder) > true_volume);
    CHECK(tf::signed_volume(cylinder) < true_volume * 1.0011);
    for (const tf::face& f : cylinder.faces)  // middles of edges are out of the cylinder
        for (std::size_t i = 0; i < 3; ++i) {
            const auto &p = cylinder.points[f[i]], &q = cylinder.points[f[(i + 1) % 3]];
            if (p.z != q.z || f[i] % 96 == 0 || f[(i + 1) % 3] % 96 == 0) continue;
            CHECK(std::hypot(p.x, p.y) < radius * 1.00054);
            if (std::abs(static_cast<int>(f[i]) - static_cast<int>(f[(i + 1) % 3])) == 1)
                CHECK(std::hypot((p.x + q.x) / 2, (p.y + q.y) / 2) >= radius);
        }

    const tf::mesh sphere = made("<sphere radius=\"0.3\"/>");
    CHECK(sphere.faces.size() == 5120);
    for (const tf::point3& p : sphere.points) CHECK(std::hypot(p.x, p.y, p.z) < radius * 1.0013);
    CHECK(tf::closest_point(sphere, tf::point3{})->distance >= radius);

    for (const std::string wrong :
         {"<box size=\"1 2\"/>", "<box size=\"1 2 0\"/>", "<box/>", "<sphere/>",
          "<sphere radius=\"-1\"/>", "<cylinder radius=\"1\"/>", "<sphere radius=\"nan\"/>",
          "<sphere radius=\"1.797e308\"/>"}) {
        CAPTURE(wrong);
        CHECK(urdf_refusal(link(wrong)).starts_with("link a: a "));
    }
}

TEST_CASE("urdf: links are adjacent across links without meshes") {
    const robot_folder folder;
    const auto link = [](const std::string& name, bool mesh) {
        return "<link name=\"" + name + "\">" +
               (mesh ? "<collision><geometry><mesh "
                       "filename=\"meshes/a.stl\"/></geometry></collision>"
                     : "") +
               "</link>";
    };
    const auto r = tf::read_urdf(
        folder.write(robot(link("a", true) + link("b", false) + link("c", true) + link("d", true) +
                           joint("j", "fixed", "a", "b") + joint("k", "fixed", "b", "c") +
                           joint("l", "continuous", "c", "d"))));
    using pairs = std::vector<std::array<std::uint32_t, 2>>;
    CHECK(r.adjacent() == pairs{{0, 1}, {0, 2}, {1, 2}, {2, 3}});
}

TEST_CASE("urdf: what is wrong is named") {
    CHECK(urdf_refusal("<robot").starts_with("byte "));
    CHECK(urdf_refusal("<a/>") == "no <robot>: not a URDF file? (run xacro first)");
    CHECK(urdf_refusal(robot("")) == "the robot has no link");
    CHECK(urdf_refusal(robot("<link/>")) == "a link has no name");
    CHECK(urdf_refusal(robot("<link name=\"a\"/><link name=\"a\"/>")) ==
          "two links have the name a");
    CHECK(urdf_refusal(robot(three + joint("j", "floating", "a", "b"))) ==
          "joint j: type \"floating\" is not supported, only fixed, revolute, continuous and "
          "prismatic");
    CHECK(urdf_refusal(robot(three + joint("j", "fixed", "a", "x"))) ==
          "joint j: its child link \"x\" does not exist");
    CHECK(urdf_refusal(robot(three + joint("j", "fixed", "a", "b") +
                             joint("j", "fixed", "a", "c"))) == "two joints have the name j");
    CHECK(urdf_refusal(
              robot(three + joint("j", "fixed", "a", "b") + joint("k", "fixed", "c", "b"))) ==
          "link b is the child of two joints");
    CHECK(urdf_refusal(robot(three + joint("j", "fixed", "a", "b") +
                             joint("k", "fixed", "b", "a"))) == "joints form a cycle");
    CHECK(urdf_refusal(robot(three + joint("j", "revolute", "a", "b", "<axis xyz=\"0 0 0\"/>"))) ==
          "joint j: its axis has no direction");
    CHECK(urdf_refusal(robot(three + joint("j", "fixed", "a", "b", "<origin xyz=\"1 nan 0\"/>"))) ==
          "joint j: xyz=\"1 nan 0\": expected 3 finite numbers");
    CHECK(urdf_refusal(robot(three + joint("j", "fixed", "a", "b", "<origin xyz=\"1 2 3 4\"/>"))) ==
          "joint j: xyz=\"1 2 3 4\": expected 3 finite numbers");
    CHECK(urdf_refusal(robot("<link name=\"a\"><collision><geometry><mesh filename=\"no.stl\"/>"
                             "</geometry></collision></link>")) ==
          "link a: its mesh no.stl was not found");
    CHECK_THROWS_AS(static_cast<void>(tf::read_urdf("/no/such.urdf")), tf::io_error);
}

TEST_CASE("urdf: values of joints that are not there, fixed or not finite are refused") {
    const robot_folder folder;
    const auto r = tf::read_urdf(folder.write(
        robot(three + joint("j", "fixed", "a", "b") + joint("k", "continuous", "a", "c"))));
    const auto with = [&](const std::pair<const std::string, double>& one) {
        static_cast<void>(r.link_transforms({one}));
    };
    CHECK_THROWS_WITH_AS(with({"x", 1.0}), "treeform::link_transforms: there is no joint x",
                         std::invalid_argument);
    CHECK_THROWS_AS(with({"j", 1.0}), std::invalid_argument);
    CHECK_THROWS_AS(with({"k", std::nan("")}), std::invalid_argument);
    CHECK_NOTHROW(with({"k", 1.0}));
}

TEST_CASE("urdf: every prefix of a file is read or refused, none ends the program") {
    const robot_folder folder;
    const std::string whole = robot(
        "<link name=\"a\"><collision><geometry><mesh filename=\"meshes/a.stl\"/></geometry>"
        "</collision></link><link name=\"b\"/>" +
        joint("j", "revolute", "a", "b", "<origin xyz=\"1 2 3\"/><limit lower=\"1\"/>"));
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_THROWS_AS(static_cast<void>(tf::read_urdf(folder.write(whole.substr(0, length)))),
                        tf::io_error);
    CHECK(tf::read_urdf(folder.write(whole)).joints.size() == 1);
}
