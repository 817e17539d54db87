// Made by tools/bindings of trees.h and the headers of C++: see its README.
#include <tools/c/made/structs.hpp>
#include <tools/c/trees.hpp>

namespace tf = treeform;

treeform_code treeform_point_tree_create(const double* points, size_t count, uint32_t dimensions,
                                         treeform_point_tree** tree) {
    return glue::guard([&] {
        glue::start(tree);
        return glue::give(glue::point_tree_create(points, count, dimensions), tree);
    });
}

treeform_code treeform_point_tree_size(const treeform_point_tree* tree, size_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::point_tree_size(glue::content(tree, "tree"));
    });
}

treeform_code treeform_point_tree_nearest(const treeform_point_tree* tree, const double* queries,
                                          size_t count, size_t k, double radius, uint32_t* ids,
                                          double* distances) {
    return glue::guard([&] {
        glue::point_tree_nearest(glue::content(tree, "tree"), queries, count, k, radius, ids,
                                 distances);
    });
}

treeform_code treeform_point_tree_within(const treeform_point_tree* tree, const double* queries,
                                         size_t count, double radius,
                                         treeform_neighbors** neighbors) {
    return glue::guard([&] {
        glue::start(neighbors);
        return glue::give(
            glue::point_tree_within(glue::content(tree, "tree"), queries, count, radius),
            neighbors);
    });
}

treeform_code treeform_point_tree_pairs(const treeform_point_tree* tree, double radius,
                                        treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        return glue::give(glue::point_tree_pairs(glue::content(tree, "tree"), radius), pairs);
    });
}

treeform_code treeform_box_tree_create(const double* mins, const double* maxs, size_t count,
                                       uint32_t dimensions, treeform_box_tree** tree) {
    return glue::guard([&] {
        glue::start(tree);
        return glue::give(glue::box_tree_create(mins, maxs, count, dimensions), tree);
    });
}

treeform_code treeform_box_tree_size(const treeform_box_tree* tree, size_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::box_tree_size(glue::content(tree, "tree"));
    });
}

treeform_code treeform_box_tree_pairs(const treeform_box_tree* tree, treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        return glue::give(glue::box_tree_pairs(glue::content(tree, "tree")), pairs);
    });
}

treeform_code treeform_box_tree_pairs_of(const treeform_box_tree* a, const treeform_box_tree* b,
                                         treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        return glue::give(glue::box_tree_pairs_of(glue::content(a, "a"), glue::content(b, "b")),
                          pairs);
    });
}

treeform_code treeform_box_tree_query(const treeform_box_tree* tree, const double* mins,
                                      const double* maxs, size_t count, treeform_id_lists** lists) {
    return glue::guard([&] {
        glue::start(lists);
        return glue::give(glue::box_tree_query(glue::content(tree, "tree"), mins, maxs, count),
                          lists);
    });
}

treeform_code treeform_box_tree_rays(const treeform_box_tree* tree, const double* origins,
                                     const double* directions, size_t count,
                                     treeform_id_lists** lists) {
    return glue::guard([&] {
        glue::start(lists);
        return glue::give(
            glue::box_tree_rays(glue::content(tree, "tree"), origins, directions, count), lists);
    });
}

treeform_code treeform_box_tree_nearest(const treeform_box_tree* tree, const double* points,
                                        size_t count, size_t k, double radius, uint32_t* ids,
                                        double* distances) {
    return glue::guard([&] {
        glue::box_tree_nearest(glue::content(tree, "tree"), points, count, k, radius, ids,
                               distances);
    });
}
