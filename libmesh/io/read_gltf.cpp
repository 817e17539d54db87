#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/json_depth.hpp>
#include <libmesh/io/parse_gltf.hpp>
#include <libmesh/io/place_gltf.hpp>
#include <libmesh/io/readers.hpp>
#include <treeform/mesh/read.hpp>

#include <string>

namespace treeform::detail::io {

namespace {

[[nodiscard]] mesh_file read_gltf_1(const source& in, const std::filesystem::path& path,
                                    const parts_gltf& parts) {
    if (!reads_scenes())
        in.fail(
            "glTF 1.0 needs a build with assimp; gltf-pipeline -i IN -o OUT converts it to 2.0");
    return read_scene(in, path, parts.is_version_1 ? "glb" : "gltf");
}

}  // namespace

mesh_file read_gltf(const source& in, const std::filesystem::path& path) {
    const parts_gltf parts = parts_of_gltf(in);
    refuse_deep_json(in, parts.json);
    const model_gltf model =
        parts.is_version_1 ? model_gltf{.is_version_1 = true} : parse_gltf(in, parts.json);
    if (model.is_version_1) return read_gltf_1(in, path, parts);
    buffers_gltf buffers(in, path, model, parts);
    mesh_file file = place_gltf(in, model, buffers);
    file.format = parts.json.data() == in.begin() ? "gltf" : "glb";
    if (parts.trailing > 0)
        file.warnings.push_back({"trailing-bytes", std::to_string(parts.trailing) +
                                                       " bytes after the end of the GLB ignored"});
    return file;
}

}  // namespace treeform::detail::io
