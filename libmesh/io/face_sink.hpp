#pragma once
/// \file
/// Receives the corners of stored faces, and cuts polygons into fans.

#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// Adds a warning with the number of faces with fewer than three corners, if there are any.
inline void remark_on_short_faces(std::uint64_t count, std::vector<io_warning>& warnings) {
    if (count > 0)
        warnings.push_back(
            {"short-faces", std::to_string(count) + (count == 1 ? " face" : " faces") +
                                " with fewer than three corners left out; faces are numbered "
                                "without them"});
}

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

    /// Ends the face. A face with fewer than three corners is dropped and gets no number; then
    /// returns false.
    bool finish() {
        if (corners_ < 3) {
            ++short_faces_;
            return false;
        }
        auto& stored = file_.face_of_triangle;
        if (corners_ > 3 && stored.empty()) {
            stored.resize(file_.stored_faces);
            std::iota(stored.begin(), stored.end(), std::uint32_t{0});
        }
        if (corners_ > 3 || !stored.empty())
            stored.insert(stored.end(), corners_ - 2,
                          static_cast<std::uint32_t>(file_.stored_faces));
        ++file_.stored_faces;
        return true;
    }

    void remark(std::vector<io_warning>& warnings) const {
        remark_on_short_faces(short_faces_, warnings);
    }

  private:
    mesh_file& file_;
    std::size_t short_faces_ = 0;
    std::size_t corners_ = 0;
    std::uint32_t first_ = 0;
    std::uint32_t previous_ = 0;
};

}  // namespace treeform::detail::io
