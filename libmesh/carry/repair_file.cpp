#include <treeform/mesh/carry.hpp>

#include <utility>

namespace treeform {

repaired_file repair_file(const carry_source& input, const repair_options& options) {
    repair_result made = repair(input.file->mesh, options);
    repaired_file result;
    for (const std::uint32_t f : made.face_source)
        result.face_source.push_back(f == repair_result::none ? f : input.stored_face(f));
    for (open_edge& e : made.certificate.open)
        if (e.face.index != repair_result::none) e.face.index = input.stored_face(e.face.index);
    result.file.mesh = std::move(made.mesh);
    result.file.stored_faces = result.file.mesh.faces.size();
    result.file.stored_as = made.certificate.precision;
    result.file.format = input.file->format;
    carry(result.file, input, made.face_source, made.vertex_source);
    result.certificate = std::move(made.certificate);
    result.statistics = made.statistics;
    return result;
}

}  // namespace treeform
