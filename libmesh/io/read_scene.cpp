#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scene_depth.hpp>
#include <treeform/mesh/read.hpp>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Assimp {

/// Stands in for the function of this name in assimp 5.2, whose assertions also judge the input and
/// end the process when they fail. The importer catches what is thrown here.
__attribute__((visibility("default"))) void aiAssertViolation(const char* expression,
                                                              const char* file, int line);

void aiAssertViolation(const char*, const char*, int) {
    throw std::runtime_error("parts of the file are missing or damaged");
}

}  // namespace Assimp

namespace treeform::detail::io {

namespace {

/// A node's place in the scene, row by row, in double.
using transform = std::array<std::array<double, 4>, 3>;

constexpr transform identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

[[nodiscard]] transform compose(const transform& outer, const aiMatrix4x4& inner) {
    transform product{};
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned col = 0; col < 4; ++col) {
            double sum = col == 3 ? outer[row][3] : 0.0;
            for (unsigned k = 0; k < 3; ++k)
                sum += outer[row][k] * static_cast<double>(inner[k][col]);
            product[row][col] = sum;
        }
    return product;
}

[[nodiscard]] point3 moved(const transform& t, const aiVector3D& v) {
    // Without a transform the numbers of the file must come through as they are, -0 included.
    if (t == identity) return {v.x, v.y, v.z};
    point3 p;
    for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = t[axis][0] * static_cast<double>(v.x) + t[axis][1] * static_cast<double>(v.y) +
                  t[axis][2] * static_cast<double>(v.z) + t[axis][3];
    return p;
}

/// Collects the meshes of all nodes; a mesh that several nodes show comes once for each.
class scene_reader {
  public:
    scene_reader(const source& in, const aiScene& scene) : in_(in), scene_(scene), faces_(file_) {}

    mesh_file read() {
        file_.indexed = false;
        file_.stored_as = precision::float32;
        if (scene_.mRootNode != nullptr) add_nodes();
        if (file_.mesh.points.empty()) in_.fail("no triangles found");
        if (dropped_ > 0)
            file_.warnings.push_back(
                {"skipped-elements", std::to_string(dropped_) + " points and lines were not read"});
        file_.warnings.push_back(
            {"precision",
             "read through assimp: coordinates are float32, vertices may be split, and normals, "
             "colors, texture coordinates and materials were not read"});
        return std::move(file_);
    }

  private:
    struct placed {
        const aiNode* node;
        transform place;
    };

    /// Depth first, in the order of the file, on a stack of our own: files may nest deeply.
    void add_nodes() {
        std::vector<placed> stack{
            {scene_.mRootNode, compose(identity, scene_.mRootNode->mTransformation)}};
        while (!stack.empty()) {
            const placed now = stack.back();
            stack.pop_back();
            const aiNode& node = *now.node;
            const std::size_t before = file_.stored_faces;
            for (unsigned i = 0; i < node.mNumMeshes; ++i)
                add_mesh(*scene_.mMeshes[node.mMeshes[i]], now.place);
            if (file_.stored_faces > before)
                file_.attributes.parts.push_back(
                    {.object = node.mName.length == 0 ? "" : names_.name(node.mName.C_Str()),
                     .first_face = static_cast<std::uint32_t>(before)});
            for (unsigned i = node.mNumChildren; i > 0; --i) {
                const aiNode* const child = node.mChildren[i - 1];
                stack.push_back({child, compose(now.place, child->mTransformation)});
            }
        }
    }

    void add_mesh(const aiMesh& mesh, const transform& place) {
        auto& points = file_.mesh.points;
        const std::size_t first = points.size();
        if (first + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
            in_.fail("more vertices than 32-bit numbers can name");
        for (unsigned v = 0; v < mesh.mNumVertices; ++v)
            points.push_back(moved(place, mesh.mVertices[v]));
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& corners = mesh.mFaces[f];
            if (corners.mNumIndices < 3) {
                ++dropped_;
                continue;
            }
            faces_.begin();
            for (unsigned i = 0; i < corners.mNumIndices; ++i) {
                if (corners.mIndices[i] >= mesh.mNumVertices)
                    in_.fail("a vertex index is out of range");
                faces_.add(static_cast<std::uint32_t>(first + corners.mIndices[i]));
            }
            faces_.finish();
        }
    }

    const source& in_;
    const aiScene& scene_;
    mesh_file file_{};
    face_sink faces_;
    name_giver names_{};
    std::size_t dropped_ = 0;
};

/// All that is neither geometry nor a node.
constexpr int unwanted = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                         aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                         aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                         aiComponent_CAMERAS | aiComponent_MATERIALS;

/// What the importer says, unless that is only that it could not read the file, by whatever name.
[[nodiscard]] std::string plain_reason(const std::string& said, const source& in,
                                       const std::string& hint) {
    constexpr std::string_view name_of_bytes = "$$$___magic___$$$";
    const bool about_file = said.find(name_of_bytes) != std::string::npos ||
                            said.find('"' + std::string(in.name()) + '"') != std::string::npos;
    if (!said.empty() && !about_file) return said;
    return "cannot be read as '" + hint + "': damaged or truncated";
}

/// The scene, which belongs to the importer.
[[nodiscard]] const aiScene& load_scene(Assimp::Importer& importer, const source& in,
                                        const std::filesystem::path& path,
                                        const std::string& hint) {
    constexpr unsigned steps = aiProcess_RemoveComponent;
    std::string reason;
    try {
        // glTF 1.0 in text keeps its numbers in other files, which only a path can find.
        const aiScene* const scene =
            path.empty() || hint != "gltf"
                ? importer.ReadFileFromMemory(in.begin(), in.size(), steps, hint.c_str())
                : importer.ReadFile(path.string(), steps);
        if (scene != nullptr) return *scene;
        reason = importer.GetErrorString();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        reason = error.what();
    }
    in.fail(plain_reason(reason, in, hint));
}

/// An importer with the loaders of one format only: it would ask all others, too, where those say
/// no. Never with that of X3D, which does not survive an empty group, nor with those of LightWave's
/// and Irrlicht's scenes, which open what they name with all loaders there are.
class scene_importer : public Assimp::Importer {
  public:
    explicit scene_importer(const std::string& extension) {
        for (std::size_t i = GetImporterCount(); i-- > 0;) {
            Assimp::BaseImporter* const loader = GetImporter(i);
            std::set<std::string> read;
            loader->GetExtensionList(read);
            const bool refused =
                read.contains("x3d") || read.contains("lws") || read.contains("irr");
            if (read.contains(extension) && !refused) continue;
            UnregisterLoader(loader);
            delete loader;
        }
    }
};

}  // namespace

bool scene_format(std::string_view extension) {
    // The formats that are read natively are never left to a reader that rounds them.
    constexpr std::array<std::string_view, 7> native{"stl", "obj",  "ply", "off",
                                                     "3mf", "gltf", "glb"};
    if (std::find(native.begin(), native.end(), extension) != native.end()) return false;
    return scene_importer(std::string(extension)).GetImporterCount() > 0;
}

mesh_file read_scene(const source& in, const std::filesystem::path& path,
                     std::string_view extension) {
    const std::string hint(extension);
    scene_importer importer(hint);
    if (importer.GetImporterCount() == 0) in.fail("format '" + hint + "' is not supported");
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    refuse_deep_scene(in);
    const aiScene& scene = load_scene(importer, in, path, hint);
    mesh_file file = scene_reader(in, scene).read();
    file.format = hint;
    return file;
}

}  // namespace treeform::detail::io

bool treeform::reads_scenes() { return true; }
