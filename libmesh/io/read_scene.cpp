#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/readers.hpp>
#include <treeform/mesh/read.hpp>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

constexpr std::size_t deepest_scene = 1000;
constexpr std::size_t npos = std::string_view::npos;

/// `at` is where the thousand and first level begins.
[[noreturn]] void refuse_depth(const source& in, std::size_t at) {
    in.fail("byte " + std::to_string(at) + ": nested more than " + std::to_string(deepest_scene) +
            " levels deep");
}

/// Behind the next `end` from `at` on; the end of the text where there is none.
std::size_t behind(std::string_view text, std::string_view end, std::size_t at) {
    const std::size_t found = text.find(end, at);
    return found == npos ? text.size() : found + end.size();
}

/// Behind the tag that begins at `at`; a '>' in quotes is not its end.
std::size_t end_of_tag(std::string_view xml, std::size_t at) {
    while ((at = xml.find_first_of(">\"'", at)) != npos) {
        if (xml[at] == '>') return at + 1;
        at = behind(xml, xml.substr(at, 1), at + 1);
    }
    return xml.size();
}

void refuse_deep_tags(const source& in, std::string_view xml) {
    std::size_t depth = 0;
    for (std::size_t at = xml.find('<'); at != npos; at = xml.find('<', at)) {
        const std::string_view rest = xml.substr(at);
        if (rest.starts_with("<!--")) {
            at = behind(xml, "-->", at);
        } else if (rest.starts_with("<![CDATA[")) {
            at = behind(xml, "]]>", at);
        } else if (rest.starts_with("<?")) {
            at = behind(xml, "?>", at);
        } else if (rest.starts_with("</") || rest.starts_with("<!")) {
            depth -= rest[1] == '/' && depth > 0 ? 1 : 0;
            at = behind(xml, ">", at);
        } else {
            const std::size_t end = end_of_tag(xml, at);
            if (xml[end - 1] != '>' || xml[end - 2] != '/') ++depth;
            if (depth > deepest_scene) refuse_depth(in, at);
            at = end;
        }
    }
}

/// Braces, except for those in double quotes and, to the end of the line, behind a character of
/// `comment` or two slashes, if that has one.
void refuse_deep_braces(const source& in, std::string_view text, const std::string& comment) {
    std::size_t depth = 0;
    const std::string special = "{}\"" + comment;
    for (std::size_t at = text.find_first_of(special); at != npos;
         at = text.find_first_of(special, at)) {
        const char c = text[at++];
        const bool two = text.substr(at).starts_with('/');
        if (comment.find(c) != npos && (c != '/' || two)) at = behind(text, "\n", at);
        if (c == '"') at = behind(text, "\"", at);
        if (c == '{' && ++depth > deepest_scene) refuse_depth(in, at - 1);
        if (c == '}' && depth > 0) --depth;
    }
}

/// A record of binary FBX: where it ends, how many properties it has and how many bytes they are,
/// its name and they, and what it holds; a record of zeros ends a list of them.
template <class Size>
void refuse_deep_records(const source& in, std::string_view fbx) {
    constexpr std::size_t head = 3 * sizeof(Size) + 1;
    std::vector<std::uint64_t> ends{fbx.size()};
    std::size_t at = 27;
    while (fbx.size() - at >= head) {
        while (ends.size() > 1 && at >= ends.back()) ends.pop_back();
        const char* const record = fbx.data() + at;
        const std::uint64_t end = base::load<Size, std::endian::little>(record);
        const std::uint64_t bytes =
            base::load<Size, std::endian::little>(record + 2 * sizeof(Size));
        const std::uint64_t name = static_cast<unsigned char>(record[head - 1]);
        at += head;
        if (end == 0) continue;
        if (end < at || end > fbx.size() || bytes > end - at || name > end - at - bytes) return;
        at += bytes + name;
        if (at == end) continue;
        ends.push_back(end);
        if (ends.size() > deepest_scene) refuse_depth(in, at);
    }
}

/// Refuses XML (DAE, AMF and others), FBX in text or binary, and DirectX in text that nest more
/// than a thousand levels deep, detected by content: the loaders are recursive, and would exhaust
/// the stack. Other errors are left to the loaders.
///
/// \throws io_error
/// \cost   O(size) time; none for other formats
void refuse_deep_scene(const source& scene) {
    const std::string_view all(scene.begin(), scene.size());
    constexpr std::string_view fbx = "Kaydara FBX Binary";
    if (all.starts_with(fbx) && all.size() > 27) {
        const auto version = base::load<std::uint32_t, std::endian::little>(all.data() + 23);
        if (version >= 7500) return refuse_deep_records<std::uint64_t>(scene, all);
        return refuse_deep_records<std::uint32_t>(scene, all);
    }
    if (all.starts_with("xof ") && all.size() > 11 && all.substr(8, 3) == "txt")
        return refuse_deep_braces(scene, all, "#/");
    // In UTF-16 and UTF-32, what matters here is plain characters with zeros between them.
    const std::string_view start = all.substr(0, 512);
    std::string narrow;
    const bool wide = start.find('\0') != npos;
    std::copy_if(start.begin(), start.end(), std::back_inserter(narrow),
                 [](char c) { return c != '\0'; });
    const std::size_t first = narrow.find_first_not_of("\xEF\xBB\xBF\xFE\xFF \t\r\n");
    const char begin = first == npos ? '\0' : narrow[first];
    if ((begin == ';' || begin == 'F') && narrow.find("FBX") != npos)
        return refuse_deep_braces(scene, all, ";");
    if (begin != '<') return;
    if (!wide) return refuse_deep_tags(scene, all);
    std::string text;
    std::copy_if(all.begin(), all.end(), std::back_inserter(text),
                 [](char c) { return c != '\0'; });
    refuse_deep_tags(scene, text);
}

[[nodiscard]] transform<3> place_of(const aiNode& node) {
    transform<3> place;
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned col = 0; col < 4; ++col)
            place.rows[row][col] = static_cast<double>(node.mTransformation[row][col]);
    return place;
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
        transform<3> place;
    };

    /// Depth first, in the order of the file, on a stack of our own: files may nest deeply.
    void add_nodes() {
        std::vector<placed> stack{
            {scene_.mRootNode, transform<3>{}.after(place_of(*scene_.mRootNode))}};
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
                stack.push_back({child, now.place.after(place_of(*child))});
            }
        }
    }

    void add_mesh(const aiMesh& mesh, const transform<3>& place) {
        auto& points = file_.mesh.points;
        const std::size_t first = points.size();
        if (first + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
            in_.fail("more vertices than 32-bit numbers can name");
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiVector3D& at = mesh.mVertices[v];
            points.push_back(moved(place, {at.x, at.y, at.z}));
        }
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
