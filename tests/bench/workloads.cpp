#include "bench/page.hpp"
#include "bench/workload.hpp"

#include <array>

namespace treeform::bench {

// One file each, named by the id. A new workload is a file, a line of each list here, and a line in
// CMakeLists.txt.
#define TREEFORM_WORKLOAD(name) void name(const setting& setting, const contest_visitor& visit)
TREEFORM_WORKLOAD(tree_build);                 // b1
TREEFORM_WORKLOAD(poses_by_peers);             // b2
TREEFORM_WORKLOAD(near_pairs_from_arrays);     // b3
TREEFORM_WORKLOAD(nearness);                   // b4
TREEFORM_WORKLOAD(self_intersections);         // b5
TREEFORM_WORKLOAD(booleans);                   // b6
TREEFORM_WORKLOAD(placement);                  // b7
TREEFORM_WORKLOAD(files);                      // b8
TREEFORM_WORKLOAD(predicates);                 // b9
TREEFORM_WORKLOAD(crowds);                     // c1
TREEFORM_WORKLOAD(dense_knots);                // c2
TREEFORM_WORKLOAD(many_parts);                 // c3
TREEFORM_WORKLOAD(open_spheres);               // c4
TREEFORM_WORKLOAD(triangle_pairs);             // e1
TREEFORM_WORKLOAD(self_intersection_errors);   // e2
TREEFORM_WORKLOAD(distances);                  // e3
TREEFORM_WORKLOAD(solids);                     // e4
TREEFORM_WORKLOAD(weld_errors);                // e5
TREEFORM_WORKLOAD(first_contact_errors);       // e6
TREEFORM_WORKLOAD(nearest_point_errors);       // e7
TREEFORM_WORKLOAD(scaling);                    // e8
TREEFORM_WORKLOAD(stability);                  // e9
TREEFORM_WORKLOAD(build_by_peers);             // f2
TREEFORM_WORKLOAD(build_by_threads);           // f5
TREEFORM_WORKLOAD(strategies);                 // f6
TREEFORM_WORKLOAD(near_pairs_given_trees);     // f7
TREEFORM_WORKLOAD(arities);                    // f8
TREEFORM_WORKLOAD(clean_scans);                // s1
TREEFORM_WORKLOAD(memory_bound);               // s2
TREEFORM_WORKLOAD(poses);                      // t1
TREEFORM_WORKLOAD(weld);                       // w1
TREEFORM_WORKLOAD(weld_quality_by_tolerance);  // w2
#undef TREEFORM_WORKLOAD

#define TREEFORM_DRAWING(name) \
    section name(const std::vector<outcome>& outcomes, const std::string& machine)
TREEFORM_DRAWING(draw_poses_by_peers);
TREEFORM_DRAWING(draw_near_pairs_from_arrays);
TREEFORM_DRAWING(draw_nearness);
TREEFORM_DRAWING(draw_crowds);
TREEFORM_DRAWING(draw_dense_knots);
TREEFORM_DRAWING(draw_many_parts);
TREEFORM_DRAWING(draw_open_spheres);
TREEFORM_DRAWING(draw_triangle_pairs);
TREEFORM_DRAWING(draw_self_intersection_errors);
TREEFORM_DRAWING(draw_distances);
TREEFORM_DRAWING(draw_solids);
TREEFORM_DRAWING(draw_weld_errors);
TREEFORM_DRAWING(draw_first_contact_errors);
TREEFORM_DRAWING(draw_nearest_point_errors);
TREEFORM_DRAWING(draw_scaling);
TREEFORM_DRAWING(draw_stability);
TREEFORM_DRAWING(draw_build_by_peers);
TREEFORM_DRAWING(draw_build_by_threads);
TREEFORM_DRAWING(draw_strategies);
TREEFORM_DRAWING(draw_near_pairs);
TREEFORM_DRAWING(draw_arities);
TREEFORM_DRAWING(draw_clean_scans);
TREEFORM_DRAWING(draw_memory_bound);
TREEFORM_DRAWING(draw_poses);
TREEFORM_DRAWING(draw_weld_quality);
#undef TREEFORM_DRAWING

std::span<const workload> workloads() {
    static const std::array all{
        workload{"B1", "tree build: triangles as arrays -> tree, boxes included", tree_build},
        workload{"B2", "two models in random positions, beside FCL and CGAL, trees given",
                 poses_by_peers, draw_poses_by_peers},
        workload{"B3", "near pairs of points: arrays -> pairs, tree included",
                 near_pairs_from_arrays, draw_near_pairs_from_arrays},
        workload{"B4", "nearest point of a mesh, nearest points of a cloud", nearness,
                 draw_nearness},
        workload{"B5", "self-intersections: arrays -> classified pairs, tree included",
                 self_intersections},
        workload{"B6", "set operations of two solids, from arrays to arrays", booleans},
        workload{"B7", "two meshes met for the first time, and their first contact", placement},
        workload{"B8", "files: read and write, page cache warm", files},
        workload{"B9", "predicates and triangle pairs, by family of hard cases", predicates},
        workload{"C1", "union of solids that hide each other", crowds, draw_crowds},
        workload{"C2", "union of knots through each other", dense_knots, draw_dense_knots},
        workload{"C3", "plate with holes, cubes face to face, cubes at random", many_parts,
                 draw_many_parts},
        workload{"C4", "spheres that rounding left open: no solid", open_spheres,
                 draw_open_spheres},
        workload{"E1", "time against error: whether two triangles meet", triangle_pairs,
                 draw_triangle_pairs},
        workload{"E2", "time against error: self-intersections", self_intersection_errors,
                 draw_self_intersection_errors},
        workload{"E3", "time against error: distances of points and triangles", distances,
                 draw_distances},
        workload{"E4", "time against error: set operations and repair", solids, draw_solids},
        workload{"E5", "time against error: welding", weld_errors, draw_weld_errors},
        workload{"E6", "time against error: first contact", first_contact_errors,
                 draw_first_contact_errors},
        workload{"E7", "time against error: nearest points", nearest_point_errors,
                 draw_nearest_point_errors},
        workload{"E8", "time and memory by size", scaling, draw_scaling},
        workload{"E9", "whether two triangles meet, harder step by step", stability,
                 draw_stability},
        workload{"F2", "tree build beside CGAL and FCL, by size", build_by_peers,
                 draw_build_by_peers},
        workload{"F5", "tree build by threads", build_by_threads, draw_build_by_threads},
        workload{"F6", "tree build by selection algorithm", strategies, draw_strategies},
        workload{"F7", "near pairs of points, trees given", near_pairs_given_trees,
                 draw_near_pairs},
        workload{"F8", "sorted stack against heap, by arity and leaf size", arities, draw_arities},
        workload{"S1", "self-intersections of clean scans, beside the tree alone", clean_scans,
                 draw_clean_scans},
        workload{"S2", "steps beside a copy of the bytes they move", memory_bound,
                 draw_memory_bound},
        workload{"T1", "two models in random positions, beside the paper, trees given", poses,
                 draw_poses},
        workload{"W1", "welding: points within a tolerance become one, from arrays", weld},
        workload{"W2", "welding: time, pairs left and displacement, by tolerance and rule",
                 weld_quality_by_tolerance, draw_weld_quality},
    };
    return all;
}

}  // namespace treeform::bench
