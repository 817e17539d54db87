#include "support/stress_files.hpp"

#include "support/stress_meshes.hpp"
#include "support/stress_placement.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::test {
namespace {

bool within(const mesh& m, double largest) {
    return std::ranges::all_of(m.points, [&](const point3& p) {
        return std::abs(p.x) <= largest && std::abs(p.y) <= largest && std::abs(p.z) <= largest;
    });
}

class stress_folder {
  public:
    explicit stress_folder(std::filesystem::path folder)
        : folder_(std::move(folder)), index_(folder_ / "index.csv") {
        index_ << "file,family,placement,precision,points,faces\n";
    }

    /// `name` is FAMILY-SIZE.
    void add(mesh shape, const std::string& name, const std::string& placement, bool single) {
        constexpr std::array largest{std::numeric_limits<double>::max(),
                                     double{std::numeric_limits<float>::max()}};
        if (!within(shape, largest[single ? 1 : 0])) return;
        const std::string kind = single ? "float" : "double";
        const std::string file = name + '-' + placement + '-' + kind + ".ply";
        index_ << file << ',' << name.substr(0, name.find('-')) << ',' << placement << ',' << kind
               << ',' << shape.points.size() << ',' << shape.faces.size() << '\n';
        write(folder_ / file, {.mesh = std::move(shape)},
              {.precision = single ? precision::float32 : precision::float64});
        ++written_;
    }

    std::size_t close() {
        index_.close();
        if (!index_) throw io_error((folder_ / "index.csv").string() + ": cannot be written");
        return written_;
    }

  private:
    std::filesystem::path folder_;
    std::ofstream index_;
    std::size_t written_ = 0;
};

}  // namespace

std::size_t write_stress_files(const std::filesystem::path& folder,
                               std::span<const stress_family> families, std::size_t most_faces) {
    std::filesystem::create_directories(folder);
    stress_folder to(folder);
    for (std::size_t f = 0; f < stress_family_count; ++f) {
        const auto family = static_cast<stress_family>(f);
        if (!families.empty() && std::ranges::find(families, family) == families.end()) continue;
        for (std::size_t faces = 100; faces <= most_faces; faces *= 10) {
            const mesh plain = stress_mesh(family, faces, 1);
            const std::string size_name =
                std::string(name_of(family)) + '-' + std::to_string(faces);
            for (auto [name, where] : named_placements())
                for (const bool single : {false, true}) {
                    where.single = single;
                    to.add(placed(plain, where), size_name, name, single);
                }
        }
    }
    return to.close();
}

}  // namespace treeform::test
