#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/prism.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/readers.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace treeform {
namespace detail::io {
namespace {

constexpr std::uint32_t cylinder_sides = 96;
constexpr int sphere_halvings = 4;
/// Far above the rounding of the few operations that lead to a coordinate (2^-48), far below what
/// anybody measures: with it, a shape is around the true one in the coordinates as rounded.
constexpr double outward = 1.0 + 0x1p-40;

point3 unit(const point3& p) { return base::scaled(p, 1.0 / std::sqrt(base::dot(p, p))); }

mesh icosahedron() {
    const double g = std::numbers::phi;
    mesh made;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g})
            for (const point3& p : {point3{0, s, t}, point3{s, t, 0}, point3{t, 0, s}})
                made.points.push_back(unit(p));
    // Corners are neighbors when they are 2 apart, in units before scaling: cosine 1 / sqrt(5).
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return base::dot(made.points[a], made.points[b]) > 0.4;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
                const auto &p = made.points[a], &q = made.points[b], &r = made.points[c];
                const bool outside = base::dot(p, base::cross(q, r)) > 0.0;
                made.faces.push_back(outside ? face{a, b, c} : face{a, c, b});
            }
    return made;
}

/// Each face into four, new corners on the unit sphere.
mesh halved(mesh of) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, added] =
            middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(of.points.size()));
        if (added) of.points.push_back(unit(base::plus(of.points[a], of.points[b])));
        return at->second;
    };
    std::vector<face> faces;
    for (const auto& [a, b, c] : of.faces) {
        const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
        faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    of.faces = std::move(faces);
    return of;
}

/// Twelve faces; exact if half of each size is exact.
mesh box_shape(const std::array<double, 3>& size) {
    mesh made;
    for (const double z : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
            for (const double x : {-0.5, 0.5})
                made.points.push_back({x * size[0], y * size[1], z * size[2]});
    made.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return made;
}

/// A prism of 96 sides that contains the cylinder about z, from -length / 2 to length / 2. Its
/// corners are up to 0.054 % of the radius outside of the cylinder.
mesh cylinder_shape(double radius, double length) {
    const double out = radius / std::cos(std::numbers::pi / cylinder_sides) * outward;
    return geometry::prism({{{0, 0, -0.5 * length}, {0, 0, 0.5 * length}}},
                           {{{1, 0, 0}, {0, 1, 0}}}, out, cylinder_sides);
}

/// 5,120 faces that contain the sphere; no point is further outside than 0.13 % of the radius.
mesh sphere_shape(double radius) {
    mesh made = icosahedron();
    for (int i = 0; i < sphere_halvings; ++i) made = halved(std::move(made));
    double least = 1.0;  // distance of a face's plane from the center
    for (const auto& [a, b, c] : made.faces) {
        const point3& p = made.points[a];
        const point3 normal =
            unit(base::cross(base::minus(made.points[b], p), base::minus(made.points[c], p)));
        least = std::min(least, base::dot(normal, p));
    }
    const double out = radius / least * outward;
    for (point3& p : made.points) p = base::scaled(p, out);
    return made;
}

}  // namespace
}  // namespace detail::io

namespace {

using links_by_name = std::map<std::string, std::uint32_t, std::less<>>;

/// Names folders up: where a file's own packages may be.
constexpr int most_folders_up = 64;

class urdf_reader {
  public:
    urdf_reader(const std::filesystem::path& path,
                std::span<const std::filesystem::path> package_folders, bool visual)
        : path_(path), package_folders_(package_folders), visual_(visual) {}

    [[nodiscard]] urdf_robot read() {
        std::ifstream in(path_, std::ios::binary);
        if (!in) throw io_error(path_.string(), {errno, std::generic_category()});
        std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
        const pugi::xml_parse_result parsed =
            document_.load_buffer_inplace(text.data(), text.size(), pugi::parse_default);
        if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
        if (!parsed)
            fail("byte " + std::to_string(parsed.offset) +
                 ": invalid XML: " + parsed.description());
        const pugi::xml_node root = document_.child("robot");
        if (!root) fail("no <robot>: not a URDF file? (run xacro first)");
        robot_.name = root.attribute("name").value();
        for (const pugi::xml_node link : root.children("link")) read_link(link);
        if (robot_.links.empty()) fail("the robot has no link");
        for (const pugi::xml_node joint : root.children("joint")) read_joint(joint);
        order_joints();
        return std::move(robot_);
    }

  private:
    [[noreturn]] void fail(const std::string& why) const {
        throw io_error(path_.string() + ": " + why);
    }

    [[nodiscard]] std::string name_of(pugi::xml_node node, const std::string& what) const {
        std::string name = node.attribute("name").value();
        if (name.empty()) fail("a " + what + " has no name");
        return name;
    }

    /// As many numbers as there are defaults.
    template <std::size_t N>
    [[nodiscard]] std::array<double, N> numbers(pugi::xml_node node, const char* attribute,
                                                std::array<double, N> values,
                                                const std::string& whose) const {
        const pugi::xml_attribute given = node.attribute(attribute);
        if (!given) return values;
        const std::string_view text(given.value());
        const char *at = text.data(), *const end = text.data() + text.size();
        const auto skip_blanks = [&] {
            while (at != end && detail::io::is_space(*at)) ++at;
        };
        const auto refuse = [&] {
            fail(whose + ": " + attribute + "=\"" + std::string(text.substr(0, 60)) +
                 "\": expected " + std::to_string(N) + " finite numbers");
        };
        for (double& value : values) {
            skip_blanks();
            const auto number = detail::io::parse_number(at, end);
            if (number.end == nullptr || !std::isfinite(number.value)) refuse();
            value = number.value;
            at = number.end;
        }
        skip_blanks();
        if (at != end) refuse();
        return values;
    }

    [[nodiscard]] point3 vector(pugi::xml_node node, const char* attribute, const point3& value,
                                const std::string& whose) const {
        const auto v = numbers<3>(node, attribute, {value.x, value.y, value.z}, whose);
        return {v[0], v[1], v[2]};
    }

    /// The child <origin>: first about x, then y, then z, then the translation.
    [[nodiscard]] transform<3> origin_of(pugi::xml_node node, const std::string& whose) const {
        const pugi::xml_node origin = node.child("origin");
        const point3 t = vector(origin, "xyz", {}, whose), a = vector(origin, "rpy", {}, whose);
        const double sx = std::sin(a.x), cx = std::cos(a.x), sy = std::sin(a.y), cy = std::cos(a.y),
                     sz = std::sin(a.z), cz = std::cos(a.z);
        transform<3> at;
        at.rows = {{{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, t.x},
                    {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx, t.y},
                    {-sy, cy * sx, cy * cx, t.z}}};
        return at;
    }

    void read_link(pugi::xml_node node) {
        const std::string name = name_of(node, "link");
        const auto number = static_cast<std::uint32_t>(robot_.links.size());
        if (!numbers_.emplace(name, number).second) fail("two links have the name " + name);
        robot_.links.push_back(name);
        for (const pugi::xml_node one : node.children(visual_ ? "visual" : "collision"))
            read_shape(one, number, "link " + name);
    }

    void read_shape(pugi::xml_node node, std::uint32_t link, const std::string& whose) {
        const pugi::xml_node geometry = node.child("geometry"), mesh = geometry.child("mesh");
        if (!mesh) return make_shape(node, geometry.first_child(), link, whose);
        const point3 s = vector(mesh, "scale", {1.0, 1.0, 1.0}, whose);
        transform<3> scale;
        for (std::size_t k = 0; k < 3; ++k) scale.rows[k][k] = s[k];
        robot_.meshes.push_back({link,
                                 mesh_file_of(mesh.attribute("filename").value(), whose),
                                 origin_of(node, whose).after(scale),
                                 {}});
    }

    [[nodiscard]] double length(pugi::xml_node node, const char* attribute,
                                const std::string& whose) const {
        const double value = numbers<1>(node, attribute, {0.0}, whose)[0];
        if (!(value > 0.0)) fail(whose + ": " + attribute + " is missing, or not greater than 0");
        return value;
    }

    void make_shape(pugi::xml_node node, pugi::xml_node shape, std::uint32_t link,
                    const std::string& whose) {
        const std::string kind = shape.name(), of = whose + ": a " + kind;
        mesh made;
        if (kind == "box") {
            const auto size = numbers<3>(shape, "size", {}, of);
            if (!(std::min({size[0], size[1], size[2]}) > 0.0))
                fail(of + ": size is missing, or not greater than 0");
            made = detail::io::box_shape(size);
        } else if (kind == "cylinder") {
            made = detail::io::cylinder_shape(length(shape, "radius", of),
                                              length(shape, "length", of));
        } else if (kind == "sphere") {
            made = detail::io::sphere_shape(length(shape, "radius", of));
        } else {
            robot_.skipped.push_back(whose + ": " +
                                     (kind.empty() ? "empty geometry" : "a " + kind) +
                                     " is not supported");
            return;
        }
        if (!detail::base::all_finite(made.points)) fail(of + ": is too large");
        if (kind != "box")
            robot_.approximated.push_back(of + " is replaced by " +
                                          std::to_string(made.faces.size()) +
                                          " triangles that enclose it");
        robot_.meshes.push_back({link, {}, origin_of(node, whose), std::move(made)});
    }

    [[nodiscard]] std::filesystem::path mesh_file_of(const std::string& name,
                                                     const std::string& whose) const {
        if (name.empty()) fail(whose + ": a mesh has no filename");
        const std::filesystem::path folder =
            std::filesystem::absolute(path_).lexically_normal().parent_path();
        std::vector<std::filesystem::path> tried;
        constexpr std::string_view package = "package://", file = "file://";
        if (name.starts_with(package)) {
            const std::filesystem::path full = name.substr(package.size());
            const std::filesystem::path rest = full.lexically_relative(*full.begin());
            for (const auto& in : package_folders_)
                tried.insert(tried.end(), {in / full, in / rest});
            std::filesystem::path up = folder;
            for (int i = 0; i < most_folders_up; ++i) {
                tried.insert(tried.end(), {up / full, up / rest});
                if (up == up.parent_path()) break;
                up = up.parent_path();
            }
        } else {
            const std::filesystem::path given =
                name.starts_with(file) ? name.substr(file.size()) : name;
            tried.push_back(given.is_absolute() ? given : folder / given);
        }
        std::error_code ignored;
        for (const auto& one : tried)
            if (std::filesystem::is_regular_file(one, ignored)) return one.lexically_normal();
        fail(whose + ": its mesh " + name + " was not found" +
             (name.starts_with(package) ? "; give the folder of its package" : ""));
    }

    [[nodiscard]] std::uint32_t link_of(pugi::xml_node joint, const char* end,
                                        const std::string& whose) const {
        const std::string_view name = joint.child(end).attribute("link").value();
        const auto found = numbers_.find(name);
        if (found == numbers_.end())
            fail(whose + ": its " + end + " link \"" + std::string(name) + "\" does not exist");
        return found->second;
    }

    void read_joint(pugi::xml_node node) {
        constexpr std::array<std::string_view, 4> kinds{"fixed", "revolute", "continuous",
                                                        "prismatic"};
        urdf_joint joint{.name = name_of(node, "joint")};
        const std::string whose = "joint " + joint.name;
        if (!joint_names_.emplace(joint.name, 0).second)
            fail("two joints have the name " + joint.name);
        const std::string_view kind = node.attribute("type").value();
        const auto at = std::find(kinds.begin(), kinds.end(), kind);
        if (at == kinds.end())
            fail(whose + ": type \"" + std::string(kind) +
                 "\" is not supported, only fixed, revolute, continuous and prismatic");
        joint.kind = static_cast<urdf_joint_kind>(at - kinds.begin());
        joint.parent = link_of(node, "parent", whose);
        joint.child = link_of(node, "child", whose);
        joint.origin = origin_of(node, whose);
        joint.axis = vector(node.child("axis"), "xyz", {1.0, 0.0, 0.0}, whose);
        const double length = std::hypot(joint.axis.x, joint.axis.y, joint.axis.z);
        if (joint.kind != urdf_joint_kind::fixed && !(length > 0.0 && std::isfinite(length)))
            fail(whose + ": its axis has no direction");
        if (length > 0.0)
            joint.axis = {joint.axis.x / length, joint.axis.y / length, joint.axis.z / length};
        if (const pugi::xml_node limit = node.child("limit");
            limit &&
            (joint.kind == urdf_joint_kind::revolute || joint.kind == urdf_joint_kind::prismatic))
            joint.limits = {numbers<1>(limit, "lower", {0.0}, whose)[0],
                            numbers<1>(limit, "upper", {0.0}, whose)[0]};
        if (const pugi::xml_node mimic = node.child("mimic")) {
            joint.mimics = mimic.attribute("joint").value();
            joint.mimic_multiplier = numbers<1>(mimic, "multiplier", {1.0}, whose)[0];
            joint.mimic_offset = numbers<1>(mimic, "offset", {0.0}, whose)[0];
        }
        robot_.joints.push_back(std::move(joint));
    }

    /// Parents ahead of their children; joints of one link in the order of the file.
    void order_joints() {
        const std::size_t links = robot_.links.size();
        std::vector<std::vector<std::size_t>> below(links);
        std::vector<bool> has_parent(links);
        for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
            const urdf_joint& joint = robot_.joints[i];
            if (has_parent[joint.child])
                fail("link " + robot_.links[joint.child] + " is the child of two joints");
            has_parent[joint.child] = true;
            below[joint.parent].push_back(i);
        }
        std::vector<std::uint32_t> reached;
        for (std::uint32_t link = 0; link < links; ++link)
            if (!has_parent[link]) reached.push_back(link);
        std::vector<urdf_joint> ordered;
        for (std::size_t next = 0; next < reached.size(); ++next)
            for (const std::size_t i : below[reached[next]]) {
                reached.push_back(robot_.joints[i].child);
                ordered.push_back(robot_.joints[i]);
            }
        if (reached.size() != links) fail("joints form a cycle");
        robot_.joints = std::move(ordered);
        for (const urdf_joint& joint : robot_.joints)
            if (!joint.mimics.empty() && !joint_names_.contains(joint.mimics))
                fail("joint " + joint.name + " mimics " + joint.mimics + ", which does not exist");
    }

    std::filesystem::path path_;
    std::span<const std::filesystem::path> package_folders_;
    bool visual_;
    pugi::xml_document document_{};
    urdf_robot robot_{};
    links_by_name numbers_{}, joint_names_{};
};

/// The motion of a joint with this value.
transform<3> motion_of(const urdf_joint& joint, double value) {
    const point3& u = joint.axis;
    if (joint.kind == urdf_joint_kind::prismatic)
        return transform<3>::translation(point3{u.x * value, u.y * value, u.z * value});
    if (joint.kind == urdf_joint_kind::fixed) return {};
    const double s = std::sin(value), c = std::cos(value), r = 1.0 - c;
    transform<3> turn;
    turn.rows = {{{c + u.x * u.x * r, u.x * u.y * r - u.z * s, u.x * u.z * r + u.y * s, 0.0},
                  {u.y * u.x * r + u.z * s, c + u.y * u.y * r, u.y * u.z * r - u.x * s, 0.0},
                  {u.z * u.x * r - u.y * s, u.z * u.y * r + u.x * s, c + u.z * u.z * r, 0.0}}};
    return turn;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> urdf_robot::adjacent() const {
    std::vector<bool> has_mesh(links.size());
    for (const urdf_mesh& mesh : meshes) has_mesh[mesh.link] = true;
    // The link above each that has a mesh; parents come ahead of their children.
    std::vector<std::optional<std::uint32_t>> above(links.size());
    std::vector<std::array<std::uint32_t, 2>> pairs;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        pairs.push_back({std::min(a, b), std::max(a, b)});
    };
    for (const urdf_joint& joint : joints) {
        add(joint.parent, joint.child);
        above[joint.child] = has_mesh[joint.parent] ? joint.parent : above[joint.parent];
        if (above[joint.child] && has_mesh[joint.child]) add(*above[joint.child], joint.child);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

std::vector<std::array<std::uint32_t, 2>> urdf_robot::adjacent(
    std::span<const urdf_mesh> parts) const {
    std::map<std::uint32_t, std::uint32_t> part_of;  // by link
    for (std::uint32_t p = 0; p < parts.size(); ++p) part_of[parts[p].link] = p;
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto& [a, b] : adjacent())
        if (part_of.contains(a) && part_of.contains(b)) pairs.push_back({part_of[a], part_of[b]});
    return pairs;
}

urdf_robot read_urdf(const std::filesystem::path& path,
                     std::span<const std::filesystem::path> package_folders, bool visual) {
    return urdf_reader(path, package_folders, visual).read();
}

std::vector<transform<3>> urdf_robot::link_transforms(
    const std::map<std::string, double>& values) const {
    const std::string name = "treeform::link_transforms: ";
    std::map<std::string_view, const urdf_joint*> joint_of;
    for (const urdf_joint& joint : joints) joint_of[joint.name] = &joint;
    for (const auto& [joint, value] : values) {
        const auto found = joint_of.find(joint);
        if (found == joint_of.end())
            throw std::invalid_argument(name + "there is no joint " + joint);
        if (found->second->kind == urdf_joint_kind::fixed)
            throw std::invalid_argument(name + "joint " + joint + " is fixed");
        if (!std::isfinite(value))
            throw std::invalid_argument(name + "the value of joint " + joint + " is not finite");
    }
    const auto value = [&](const urdf_joint& joint) {
        if (const auto own = values.find(joint.name); own != values.end()) return own->second;
        if (joint.mimics.empty()) return 0.0;
        const auto other = values.find(joint.mimics);
        const double followed = other == values.end() ? 0.0 : other->second;
        return joint.mimic_multiplier * followed + joint.mimic_offset;
    };
    std::vector<transform<3>> at(links.size());
    for (const urdf_joint& joint : joints)
        at[joint.child] =
            at[joint.parent].after(joint.origin.after(motion_of(joint, value(joint))));
    return at;
}

std::vector<urdf_mesh> urdf_robot::parts(
    const std::function<mesh(const std::filesystem::path&)>& mesh_of_file) const {
    std::vector<mesh> of_link(links.size());
    for (const urdf_mesh& one : meshes) {
        const mesh from = one.file.empty() ? one.shape : mesh_of_file(one.file);
        mesh& to = of_link[one.link];
        const auto first = static_cast<std::uint32_t>(to.points.size());
        for (const point3& p : from.points) to.points.push_back(one.place(p));
        detail::io::append_faces(to.faces, from.faces, first, one.place.mirrors());
    }
    std::vector<urdf_mesh> made;
    for (std::uint32_t link = 0; link < of_link.size(); ++link)
        if (!of_link[link].faces.empty())
            made.push_back({.link = link, .shape = std::move(of_link[link])});
    return made;
}

}  // namespace treeform
