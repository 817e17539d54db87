#include "bench/workload.hpp"

#include <array>

namespace tf::bench {

// One file each, named by the id. A new workload is a file, a declaration, a line below, and a line
// in CMakeLists.txt.
void tree_build(const setting& setting, const contest_visitor& visit);          // b1
void self_intersections(const setting& setting, const contest_visitor& visit);  // b5
void files(const setting& setting, const contest_visitor& visit);               // b8
void predicates(const setting& setting, const contest_visitor& visit);          // b9

std::span<const workload> workloads() {
    static const std::array all{
        workload{"B1", "tree build: triangles as arrays -> tree, boxes included", tree_build},
        workload{"B5", "self-intersections: arrays -> classified pairs, tree included",
                 self_intersections},
        workload{"B8", "files: read and write, page cache warm", files},
        workload{"B9", "predicates and triangle pairs, by family of hard cases", predicates},
    };
    return all;
}

}  // namespace tf::bench
