#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/json_depth.hpp>
#include <libmesh/io/parse_gltf.hpp>
#include <libmesh/io/place_gltf.hpp>
#include <libmesh/io/readers.hpp>

#include <string>

namespace treeform::detail::io {

mesh_file read_gltf(const source& in, const std::filesystem::path& path) {
    const parts_gltf parts = parts_of_gltf(in);
    refuse_deep_json(in, parts.json);
    const model_gltf model = parse_gltf(in, parts.json);
    buffers_gltf buffers(in, path, model, parts);
    mesh_file file = place_gltf(in, model, buffers);
    file.format = parts.json.data() == in.begin() ? "gltf" : "glb";
    if (parts.trailing > 0)
        file.warnings.push_back({"trailing-bytes", std::to_string(parts.trailing) +
                                                       " bytes behind the end of the GLB ignored"});
    return file;
}

}  // namespace treeform::detail::io
