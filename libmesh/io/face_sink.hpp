#pragma once
/// \file
/// Takes the corners of stored faces and cuts polygons into fans.

#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <numeric>

namespace treeform::detail::io {

class face_sink {
  public:
    explicit face_sink(mesh_file& file) : file_(file) {}

    void begin() { corners_ = 0; }

    void add(std::uint32_t corner) {
        if (corners_ >= 2) file_.mesh.faces.push_back({first_, previous_, corner});
        if (corners_ == 0) first_ = corner;
        previous_ = corner;
        ++corners_;
    }

    void add_triangle(const face& f) {
        file_.mesh.faces.push_back(f);
        corners_ = 3;
        finish();
    }

    /// Ends the face and returns its number of corners; with fewer than three it is no face, and
    /// the caller must refuse it.
    std::size_t finish() {
        if (corners_ < 3) return corners_;
        auto& stored = file_.stored_face;
        if (corners_ > 3 && stored.empty()) {
            stored.resize(file_.stored_faces);
            std::iota(stored.begin(), stored.end(), std::uint32_t{0});
        }
        if (corners_ > 3 || !stored.empty())
            stored.insert(stored.end(), corners_ - 2,
                          static_cast<std::uint32_t>(file_.stored_faces));
        ++file_.stored_faces;
        return corners_;
    }

  private:
    mesh_file& file_;
    std::size_t corners_ = 0;
    std::uint32_t first_ = 0;
    std::uint32_t previous_ = 0;
};

}  // namespace treeform::detail::io
