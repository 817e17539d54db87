#include <libmesh/io/bytes_gltf.hpp>

namespace treeform::detail::io {

bool reads_draco() { return false; }

void unpack_draco(buffers_gltf& buffers, std::size_t mesh, const primitive_gltf&) {
    buffers.fail("meshes", mesh,
                 "needs the extension KHR_draco_mesh_compression, which this build does not read; "
                 "gltf-transform copy IN OUT unpacks it");
}

}  // namespace treeform::detail::io
