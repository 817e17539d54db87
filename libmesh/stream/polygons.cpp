#include <libmesh/stream/polygons.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace treeform::detail::stream {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

class rejoiner {
  public:
    rejoiner(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners)
        : file_(file),
          polygon_(polygon),
          unlike_corners_(unlike_corners),
          last_face_(file.mesh.points.size(), none) {}

    void run() {
        const auto& faces = file_.mesh.faces;
        file_.stored_face.resize(faces.size());
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            if (!continues(f)) begin_face(f);
            last_face_[faces[f][2]] = face();
            file_.stored_face[f] = face();
        }
        for (element& e : file_.attributes.elements)
            if (e.name == "face") e = e.gathered(first_triangle_);
        for (part& part : file_.attributes.parts)
            part.first_face = part.first_face < file_.stored_face.size()
                                  ? file_.stored_face[part.first_face]
                                  : static_cast<std::uint32_t>(first_triangle_.size());
        file_.stored_faces = first_triangle_.size();
    }

  private:
    [[nodiscard]] std::uint32_t face() const {
        return static_cast<std::uint32_t>(first_triangle_.size() - 1);
    }

    [[nodiscard]] bool continues(std::uint32_t f) const {
        if (f == 0 || polygon_[f] != polygon_[f - 1]) return false;
        const corner_values& corners = file_.attributes.corners;
        return continues(file_.mesh.faces, f) && continues(corners.texture_of_corner, f) &&
               continues(corners.normal_of_corner, f) &&
               !(unlike_corners_ && last_face_[file_.mesh.faces[f][2]] == face());
    }

    /// Corners that became one point may still have values that differ.
    [[nodiscard]] static bool continues(const std::vector<treeform::face>& faces, std::uint32_t f) {
        return faces.empty() || (faces[f][0] == faces[f - 1][0] && faces[f][1] == faces[f - 1][2]);
    }

    void begin_face(std::uint32_t f) {
        first_triangle_.push_back(f);
        for (const std::uint32_t corner : file_.mesh.faces[f]) last_face_[corner] = face();
    }

    mesh_file& file_;
    std::span<const std::uint32_t> polygon_;
    bool unlike_corners_;
    std::vector<std::uint32_t> last_face_;  ///< [V] the last face that has the point as a corner
    std::vector<std::uint32_t> first_triangle_{};  ///< of each face
};

}  // namespace

void rejoin_polygons(mesh_file& file, std::span<const std::uint32_t> polygon, bool unlike_corners) {
    rejoiner(file, polygon, unlike_corners).run();
}

}  // namespace treeform::detail::stream
