#include "bench/page.hpp"
#include "bench/workload.hpp"

#include <array>

namespace tf::bench {

// One file each, named by the id. A new workload is a file, a declaration, a line below, and a line
// in CMakeLists.txt.
void tree_build(const setting& setting, const contest_visitor& visit);          // b1
void self_intersections(const setting& setting, const contest_visitor& visit);  // b5
void files(const setting& setting, const contest_visitor& visit);               // b8
void predicates(const setting& setting, const contest_visitor& visit);          // b9
void build_by_peers(const setting& setting, const contest_visitor& visit);      // f2
void build_by_threads(const setting& setting, const contest_visitor& visit);    // f5
void strategies(const setting& setting, const contest_visitor& visit);          // f6

section draw_build_by_peers(const std::vector<outcome>& outcomes, const std::string& machine);
section draw_build_by_threads(const std::vector<outcome>& outcomes, const std::string& machine);
section draw_strategies(const std::vector<outcome>& outcomes, const std::string& machine);

std::span<const workload> workloads() {
    static const std::array all{
        workload{"B1", "tree build: triangles as arrays -> tree, boxes included", tree_build},
        workload{"B5", "self-intersections: arrays -> classified pairs, tree included",
                 self_intersections},
        workload{"B8", "files: read and write, page cache warm", files},
        workload{"B9", "predicates and triangle pairs, by family of hard cases", predicates},
        workload{"F2", "tree build beside CGAL and FCL, by size", build_by_peers,
                 draw_build_by_peers},
        workload{"F5", "tree build by threads", build_by_threads, draw_build_by_threads},
        workload{"F6", "tree build by selection algorithm", strategies, draw_strategies},
    };
    return all;
}

}  // namespace tf::bench
