#include <libmesh/base/point_math.hpp>
#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/read.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t deepest_node = 1000;
constexpr std::uint64_t most_numbered_gltf = std::numeric_limits<std::uint32_t>::max();

/// Parents before children: the depth of a node is known when its parent has been seen.
void refuse_no_tree(const source& in, const model_gltf& model) {
    std::vector<unsigned char> has_parent(model.nodes.size(), 0);
    for (const node_gltf& node : model.nodes)
        for (const std::size_t child : node.children)
            if (std::exchange(has_parent[child], 1) != 0)
                in.fail("node " + std::to_string(child) + " has two parents");
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < has_parent.size(); ++n)
        if (has_parent[n] == 0) order.push_back(n);
    std::vector<std::size_t> depth(model.nodes.size(), 1);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t node = order[i];
        if (depth[node] > deepest_node)
            in.fail("node " + std::to_string(node) + " is more than " +
                    std::to_string(deepest_node) + " levels deep");
        for (const std::size_t child : model.nodes[node].children) {
            depth[child] = depth[node] + 1;
            order.push_back(child);
        }
    }
    if (order.size() < model.nodes.size()) in.fail("a node is its own descendant");
}

struct placed_node {
    std::size_t node = 0;
    transform<3> place{};
};

/// The nodes of the scene, depth first in the order of the file.
[[nodiscard]] std::vector<placed_node> nodes_of_scene(const source& in, const model_gltf& model) {
    std::vector<unsigned char> is_placed(model.nodes.size(), 0);
    std::vector<placed_node> stack;
    for (auto root = model.roots.rbegin(); root != model.roots.rend(); ++root)
        stack.push_back({*root, model.nodes[*root].transform});
    std::vector<placed_node> all;
    while (!stack.empty()) {
        const placed_node now = stack.back();
        stack.pop_back();
        if (std::exchange(is_placed[now.node], 1) != 0)
            in.fail("node " + std::to_string(now.node) + " is in the scene twice");
        const auto& children = model.nodes[now.node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            stack.push_back({*child, now.place.after(model.nodes[*child].transform)});
        all.push_back(now);
    }
    return all;
}

/// Transforms of EXT_mesh_gpu_instancing.
[[nodiscard]] std::vector<transform<3>> instances_of(buffers_gltf& buffers, std::size_t number,
                                                     const instances_gltf& instances) {
    std::vector<transform<3>> all;
    std::vector<point3> translations;
    std::vector<point3> scales;
    std::vector<std::array<double, 4>> rotations;
    const auto read = [&](const std::optional<std::size_t>& accessor, std::size_t components,
                          auto&& add) {
        if (!accessor) return;
        const values_gltf values(buffers, *accessor);
        if (values.components() != components || (!all.empty() && values.size() != all.size()))
            buffers.fail("nodes", number,
                         "has instance attributes that do not match in type or length");
        all.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) add(values, i);
    };
    const auto to_points = [](std::vector<point3>& points) {
        return [&points](const values_gltf& v, std::size_t i) {
            points.push_back({v.at(i, 0), v.at(i, 1), v.at(i, 2)});
        };
    };
    read(instances.translation, 3, to_points(translations));
    read(instances.scale, 3, to_points(scales));
    read(instances.rotation, 4, [&](const values_gltf& v, std::size_t i) {
        rotations.push_back({v.at(i, 0), v.at(i, 1), v.at(i, 2), v.at(i, 3)});
        if (!is_rotation(rotations.back()))
            buffers.fail("nodes", number, "has an instance with an invalid rotation");
    });
    if (all.empty()) buffers.fail("nodes", number, "has instances without attributes");
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = transform_of(translations.empty() ? point3{} : translations[i],
                              rotations.empty() ? std::array<double, 4>{0, 0, 0, 1} : rotations[i],
                              scales.empty() ? point3{1, 1, 1} : scales[i]);
    return all;
}

/// The transformed normal, of length 1; or 0.
[[nodiscard]] point3 turned(const transform<3>& t, const point3& normal) {
    if (t == transform<3>{}) return normal;
    const auto row = [&](std::size_t k) {
        return point3{t.rows[k % 3][0], t.rows[k % 3][1], t.rows[k % 3][2]};
    };
    // The cofactors are the inverse transpose times the determinant, whose sign must not count.
    point3 there;
    for (std::size_t axis = 0; axis < 3; ++axis)
        there[axis] = base::dot(base::cross(row(axis + 1), row(axis + 2)), normal);
    const double length = std::hypot(there.x, there.y, there.z);
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    return base::scaled(there, (t.mirrors() ? -1.0 : 1.0) / length);
}

/// What an eye sees of linear light (sRGB).
[[nodiscard]] double seen(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

[[nodiscard]] std::uint8_t whole_byte(double value) {
    return static_cast<std::uint8_t>(value > 0.0 ? std::min(std::round(value), 255.0) : 0.0);
}

/// The meshes of all nodes of the scene, transformed, each as a part with a unique name: that of
/// the node, else of the mesh. Transformed points are doubles; others are as stored. Faces of
/// mirrored parts are flipped.
///
/// \pre    the nodes are a tree
/// \throws io_error for what does not fit
class placer_gltf {
  public:
    placer_gltf(const source& in, buffers_gltf& buffers)
        : in_(in), model_(buffers.model()), buffers_(buffers) {}

    [[nodiscard]] mesh_file place() {
        file_.indexed = false;
        file_.stored_as = precision::float32;
        const std::vector<placed_node> nodes = nodes_of_scene(in_, model_);
        plan(nodes);
        for (const placed_node& n : nodes) place(n);
        if (file_.mesh.points.empty() && !model_.meshes.empty())
            in_.fail("the scene shows no mesh");
        file_.stored_faces = file_.mesh.faces.size();
        // A number is no name, and one part needs none to be told from others.
        auto& parts = file_.attributes.parts;
        if (parts.size() == 1 && is_nameless_) parts[0].object.clear();
        store_attributes();
        remark(nodes);
        return std::move(file_);
    }

  private:
    /// A mesh that is shown. What it decodes to is kept until it is shown for the last time.
    struct shown_mesh {
        outline_gltf outline{};
        std::uint64_t times = 0;
        std::optional<local_mesh_gltf> local{};
        bool fits_float = true;
    };

    /// Counts before there is room made.
    void plan(const std::vector<placed_node>& nodes) {
        std::uint64_t points = 0;
        std::uint64_t faces = 0;
        for (const placed_node& n : nodes) {
            const node_gltf& node = model_.nodes[n.node];
            if (!node.mesh) continue;
            const auto [at, is_new] = shown_.try_emplace(*node.mesh);
            if (is_new) at->second.outline = outline_of(buffers_, *node.mesh, survey_);
            std::uint64_t times = 1;
            if (node.instances) {
                instances_[n.node] = instances_of(buffers_, n.node, *node.instances);
                times = instances_[n.node].size();
            }
            at->second.times += times;
            for (std::uint64_t i = 0; i < times; ++i) {
                points += at->second.outline.points;
                faces += at->second.outline.faces;
                if (points > most_numbered_gltf || faces > most_numbered_gltf)
                    in_.fail("more points or faces than 32-bit numbers can name");
            }
        }
        reserve_large(file_.mesh.points, points);
        reserve_large(file_.mesh.faces, faces);
    }

    void place(const placed_node& n) {
        const node_gltf& node = model_.nodes[n.node];
        if (!node.mesh) return;
        if (!node.instances) return show(n.node, n.place);
        for (const transform<3>& t : instances_[n.node]) show(n.node, n.place.after(t));
    }

    void show(std::size_t number, const transform<3>& t) {
        const std::size_t mesh = *model_.nodes[number].mesh;
        shown_mesh& shown = shown_[mesh];
        if (!shown.local) {
            shown.local = decode(buffers_, mesh, shown.outline, survey_);
            shown.fits_float = fits_float32(shown.local->points);
        }
        if (!shown.fits_float) file_.stored_as = precision::float64;
        if (!shown.local->faces.empty()) add_part(number);
        add(number, *shown.local, t);
        if (--shown.times == 0) shown.local.reset();
    }

    void add(std::size_t number, const local_mesh_gltf& local, const transform<3>& t) {
        const auto first = static_cast<std::uint32_t>(file_.mesh.points.size());
        for (const point3& p : local.points) {
            const point3 there = moved(t, p);
            if (!base::is_finite(there) && base::is_finite(p))
                in_.fail("node " + std::to_string(number) +
                         ": its transform moves the mesh beyond the range of doubles");
            file_.mesh.points.push_back(there);
        }
        append_faces(file_.mesh.faces, local.faces, first, t.mirrors());
        for (const point3& n : local.normals) {
            const point3 there = turned(t, n);
            normals_.push_back({static_cast<float>(there.x), static_cast<float>(there.y),
                                static_cast<float>(there.z)});
        }
        texture_.insert(texture_.end(), local.texture.begin(), local.texture.end());
        colors_.insert(colors_.end(), local.colors.begin(), local.colors.end());
        materials_.insert(materials_.end(), local.materials.begin(), local.materials.end());
    }

    void add_part(std::size_t number) {
        const node_gltf& node = model_.nodes[number];
        const std::string& given = node.name.empty() ? model_.meshes[*node.mesh].name : node.name;
        is_nameless_ = given.empty();
        file_.attributes.parts.push_back(
            {.object = names_.name(given.empty() ? "nodes[" + std::to_string(number) + ']' : given),
             .first_face = static_cast<std::uint32_t>(file_.mesh.faces.size())});
    }

    void store_attributes() {
        store_colors_of_faces();
        if (normals_.empty() && texture_.empty() && colors_.empty()) return;
        const std::size_t count = file_.mesh.points.size();
        auto& columns = file_.attributes.find_or_add("vertex", count).columns;
        for (std::size_t k = 0; k < 3 && !normals_.empty(); ++k)
            columns.push_back(column_of<float>(std::array{"nx", "ny", "nz"}[k], count,
                                               [&](std::size_t i) { return normals_[i][k]; }));
        for (std::size_t k = 0; k < 2 && !texture_.empty(); ++k)
            columns.push_back(column_of<float>(std::array{"s", "t"}[k], count,
                                               [&](std::size_t i) { return texture_[i][k]; }));
        const std::size_t channels = colors_.empty() ? 0 : survey_.channels();
        for (std::size_t k = 0; k < channels; ++k) {
            column c{.name = std::array{"red", "green", "blue", "alpha"}[k],
                     .type = *survey_.color_type};
            const std::size_t size = size_of(c.type);
            c.values.resize(count * size);
            for (std::size_t i = 0; i < count; ++i)
                std::memcpy(c.values.data() + i * size, colors_.data() + (i * channels + k) * size,
                            size);
            columns.push_back(std::move(c));
        }
    }

    /// Those of their materials, as numbers for the eye; white where there is none. No columns
    /// where no material has a color.
    void store_colors_of_faces() {
        std::array<double, 4> white{1, 1, 1, 1};
        const auto color_of = [&](std::size_t m) {
            return m == 0 ? white : model_.materials[m - 1].color.value_or(white);
        };
        const auto has_color = [&](std::size_t m) {
            return m > 0 && model_.materials[m - 1].color.has_value();
        };
        if (std::ranges::none_of(materials_, has_color)) return;
        const bool is_opaque =
            std::ranges::all_of(materials_, [&](std::size_t m) { return color_of(m)[3] >= 1.0; });
        auto& columns = file_.attributes.find_or_add("face", materials_.size()).columns;
        bool is_rounded = false;
        for (std::size_t k = 0; k < (is_opaque ? 3U : 4U); ++k) {
            std::vector<std::uint8_t> values(materials_.size());
            for (std::size_t f = 0; f < values.size(); ++f) {
                const double channel = color_of(materials_[f])[k];
                const double share = 255.0 * (k < 3 ? seen(channel) : channel);
                values[f] = whole_byte(share);
                // Four digits of a dark color lead so near to a byte.
                is_rounded = is_rounded || !(std::abs(share - values[f]) < 0.25);
            }
            columns.push_back(
                column::of<std::uint8_t>(std::array{"red", "green", "blue", "alpha"}[k], values));
        }
        if (is_rounded) warn("colors", "colors of materials are rounded to 8 bits");
    }

    void warn(const char* code, std::string text) {
        file_.warnings.push_back({code, std::move(text)});
    }

    void remark(const std::vector<placed_node>& nodes) {
        const auto counted = [&](std::uint64_t count, const char* what) {
            if (count > 0) warn("skipped-elements", std::to_string(count) + what);
        };
        counted(survey_.lines, " lines were not read, only their points");
        counted(survey_.corners_left_over,
                " corners after the last complete triangle were not read");
        counted(survey_.without_positions, " primitives without positions were not read");
        remark_unseen(nodes);
        const auto mixed = [&](std::uint64_t with, const char* of, const char* instead) {
            if (with > 0 && with < survey_.points)
                warn("attributes", std::string("only some meshes have ") + of +
                                       "; the points of the others got " + instead);
        };
        mixed(survey_.with_normals, "normals", "0 0 0");
        mixed(survey_.with_texture, "texture coordinates", "0 0");
        mixed(survey_.with_colors, "colors", "white");
        const auto unread = [&](const std::set<std::string>& all, const char* of) {
            std::string names;
            for (const std::string& name : all) names += (names.empty() ? "" : ", ") + name;
            if (!names.empty()) warn("attributes", std::string(of) + " not read: " + names);
        };
        unread(survey_.unread, "attributes of points");
        unread(survey_.unread_of_faces, "properties of faces in extras");
        if (model_.has_textures) warn("materials", "textures of materials were not read");
    }

    void remark_unseen(const std::vector<placed_node>& nodes) {
        const auto has_mesh = [](const node_gltf& n) { return n.mesh.has_value(); };
        const auto all = std::count_if(model_.nodes.begin(), model_.nodes.end(), has_mesh);
        bool has_skin = false;
        std::ptrdiff_t seen = 0;
        for (const placed_node& n : nodes) {
            const node_gltf& node = model_.nodes[n.node];
            seen += has_mesh(node) ? 1 : 0;
            has_skin = has_skin || (has_mesh(node) && node.has_skin);
        }
        if (all > seen)
            warn("not-built", std::to_string(all - seen) +
                                  " nodes with meshes are not in the default scene and were not "
                                  "read");
        if (survey_.morphs || has_skin)
            warn("not-applied", std::string(survey_.morphs && has_skin ? "morph targets and skins"
                                            : has_skin                 ? "skins"
                                                                       : "morph targets") +
                                    " are not applied: meshes have their unmodified shape");
    }

    const source& in_;
    const model_gltf& model_;
    buffers_gltf& buffers_;
    mesh_file file_{};
    survey_gltf survey_{};
    std::map<std::size_t, shown_mesh> shown_{};
    std::map<std::size_t, std::vector<transform<3>>> instances_{};
    std::vector<std::array<float, 3>> normals_{};
    std::vector<std::array<float, 2>> texture_{};
    std::vector<std::byte> colors_{};
    std::vector<std::size_t> materials_{};  ///< [F]
    name_giver names_{};
    bool is_nameless_ = false;
};

}  // namespace

mesh_file read_gltf(const source& in, const std::filesystem::path& path) {
    const parts_gltf parts = parts_of_gltf(in);
    const model_gltf model = parse_gltf(in, parts.json, parts.is_version_1);
    if (model.is_version_1) {
        if (!reads_scenes())
            in.fail(
                "glTF 1.0 needs a build with assimp; gltf-pipeline -i IN -o OUT converts it to "
                "2.0");
        return read_scene(in, path, parts.is_version_1 ? "glb" : "gltf");
    }
    buffers_gltf buffers(in, path, model, parts);
    refuse_no_tree(in, model);
    mesh_file file = placer_gltf(in, buffers).place();
    file.format = parts.json.data() == in.begin() ? "gltf" : "glb";
    if (parts.trailing > 0)
        file.warnings.push_back({"trailing-bytes", std::to_string(parts.trailing) +
                                                       " bytes after the end of the GLB ignored"});
    return file;
}

}  // namespace treeform::detail::io
