#include "bench/peers/cgal_files.hpp"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>
#include <vector>

namespace treeform::bench {

struct cgal_soup {
    std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
};

std::shared_ptr<const cgal_soup> cgal_read(const std::string& path) {
    auto soup = std::make_shared<cgal_soup>();
    if (!CGAL::IO::read_polygon_soup(path, soup->points, soup->polygons))
        throw std::runtime_error("CGAL cannot read " + path);
    return soup;
}

mesh mesh_of(const std::shared_ptr<const cgal_soup>& soup) {
    mesh mesh;
    for (const auto& p : soup->points) mesh.points.push_back({p.x(), p.y(), p.z()});
    for (const auto& f : soup->polygons)
        if (f.size() == 3)
            mesh.faces.push_back({static_cast<std::uint32_t>(f[0]),
                                  static_cast<std::uint32_t>(f[1]),
                                  static_cast<std::uint32_t>(f[2])});
    return mesh;
}

std::function<void()> cgal_writer(const mesh& mesh, const std::string& path,
                                  const file_kind& kind) {
    auto soup = std::make_shared<cgal_soup>();
    for (const point3& p : mesh.points) soup->points.emplace_back(p.x, p.y, p.z);
    for (const face& f : mesh.faces) soup->polygons.push_back({f[0], f[1], f[2]});
    return [soup, path, binary = !kind.ascii] {
        if (!CGAL::IO::write_polygon_soup(
                path, soup->points, soup->polygons,
                CGAL::parameters::use_binary_mode(binary).stream_precision(9)))
            throw std::runtime_error("CGAL cannot write " + path);
    };
}

}  // namespace treeform::bench
