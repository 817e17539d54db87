#pragma once
/// \file
/// The volumes of two solids and of their intersection, from the faces that bound any of them.

#include <libmesh/base/double_double.hpp>
#include <libmesh/topology/volume.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// Each face is added once, to its kind: the faces that bound the same solids in the same
/// orientation.
class volumes_by_kind {
  public:
    /// Whether a place is in the first and in the second solid.
    using is_in_both = std::array<std::uint8_t, 2>;

    static constexpr std::uint8_t of_nothing = 13;  ///< the kind of faces that bound no solid
    static std::uint8_t kind_of(const is_in_both& front, const is_in_both& behind) {
        const int first = behind[0] - front[0], second = behind[1] - front[1],
                  both = (behind[0] & behind[1]) - (front[0] & front[1]);
        return static_cast<std::uint8_t>(of_nothing + first + 3 * second + 9 * both);
    }

    /// \param kind of a face
    /// \same  on any number of threads
    template <class Kind>
    void add(mesh_view surface, const Kind& kind) {
        const std::size_t before = parts_.size();
        parts_.resize(before + chunk_count(surface.faces.size(), light_grain));
        for_chunks(
            surface.faces.size(), light_grain,
            [&](std::size_t begin, std::size_t end, std::size_t c) {
                std::array<std::vector<face>, kinds> faces;
                for (std::size_t f = begin; f < end; ++f)
                    if (const std::uint8_t k = kind(f); k != of_nothing)
                        faces[k].push_back(surface.faces[f]);
                for (std::size_t k = 0; k < kinds; ++k)
                    parts_[before + c][k] = topology::six_volumes({surface.points, faces[k]});
            });
    }

    /// Six times the volumes of the first solid, the second, and their intersection.
    [[nodiscard]] std::array<double, 3> six() const {
        std::array<double, 3> result{};
        for (std::size_t solid = 0, step = 1; solid < 3; ++solid, step *= 3) {
            base::double_double all;
            for (const auto& part : parts_)
                for (std::size_t k = 0; k < kinds; ++k)
                    if (const std::size_t way = k / step % 3; way != 1)
                        all = all + (way == 2 ? part[k] : -part[k]);
            result[solid] = all.high;
        }
        return result;
    }

  private:
    static constexpr std::size_t kinds = 27;
    std::vector<std::array<base::double_double, kinds>> parts_{};
};

}  // namespace treeform::detail::boolean
