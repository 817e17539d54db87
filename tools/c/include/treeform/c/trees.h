#pragma once
/// \file
/// Trees of your own data, in the plane and in space: points (nearest, k nearest, within a radius,
/// pairs) and boxes (overlapping pairs, queries, nearest).

#include <treeform/c/base.h>

/// A tree over points, with a copy of them.
typedef struct treeform_point_tree treeform_point_tree;

// made of the headers of C++:
//   point_tree_create() point_tree_size() point_tree_nearest()
/// A tree over `points` [count][dimensions]; 2 or 3 dimensions.
TREEFORM_C_API treeform_code treeform_point_tree_create(const double* points, size_t count,
                                                        uint32_t dimensions,
                                                        treeform_point_tree** tree);

/// Number of points.
TREEFORM_C_API treeform_code treeform_point_tree_size(const treeform_point_tree* tree,
                                                      size_t* result);

/// The `k` nearest points of each of `queries` [count][dimensions], nearest first, within `radius`
/// (inclusive; infinite for none): `ids` [count][k] and `distances` [count][k], either of which
/// may be null. If there are fewer, the remaining ids are `TREEFORM_NONE` and distances infinite.
/// Equally near points are ordered by number.
TREEFORM_C_API treeform_code treeform_point_tree_nearest(const treeform_point_tree* tree,
                                                         const double* queries, size_t count,
                                                         size_t k, double radius, uint32_t* ids,
                                                         double* distances);
// end

/// A point near a query.
typedef struct treeform_neighbor {
    uint32_t id;
    double distance;
} treeform_neighbor;

/// Lists of neighbors. List i is that of query i: neighbors[begin[i]] ...
/// neighbors[begin[i + 1] - 1].
typedef struct treeform_neighbors {
    void* owner;
    const size_t* begin;  ///< [count + 1]
    const treeform_neighbor* neighbors;
    size_t count;  ///< queries
} treeform_neighbors;

// made of the headers of C++:
//   point_tree_within()
/// All points within `radius` (inclusive) of each query, nearest first.
TREEFORM_C_API treeform_code treeform_point_tree_within(const treeform_point_tree* tree,
                                                        const double* queries, size_t count,
                                                        double radius,
                                                        treeform_neighbors** neighbors);
// end

/// Pairs of numbers.
typedef struct treeform_id_pairs {
    void* owner;
    const uint32_t* pairs;  ///< [count][2] ascending
    size_t count;
} treeform_id_pairs;

// made of the headers of C++:
//   point_tree_pairs()
/// All pairs of points within `radius` (inclusive) of each other, each once, the lower number
/// first.
TREEFORM_C_API treeform_code treeform_point_tree_pairs(const treeform_point_tree* tree,
                                                       double radius, treeform_id_pairs** pairs);
// end

/// A tree over closed boxes, with a copy of them.
typedef struct treeform_box_tree treeform_box_tree;

// made of the headers of C++:
//   box_tree_create() box_tree_size() box_tree_pairs() box_tree_pairs_of()
/// A tree over the boxes from `mins` [count][dimensions] to `maxs` [count][dimensions]; 2 or 3
/// dimensions. Returns `TREEFORM_INVALID` for a box that is not finite, or whose min exceeds its
/// max.
TREEFORM_C_API treeform_code treeform_box_tree_create(const double* mins, const double* maxs,
                                                      size_t count, uint32_t dimensions,
                                                      treeform_box_tree** tree);

/// Number of boxes.
TREEFORM_C_API treeform_code treeform_box_tree_size(const treeform_box_tree* tree, size_t* result);

/// All pairs of boxes that have a common point, each once, the lower number first; exact.
TREEFORM_C_API treeform_code treeform_box_tree_pairs(const treeform_box_tree* tree,
                                                     treeform_id_pairs** pairs);

/// All pairs of a box of `a` and a box of `b` that have a common point; exact.
TREEFORM_C_API treeform_code treeform_box_tree_pairs_of(const treeform_box_tree* a,
                                                        const treeform_box_tree* b,
                                                        treeform_id_pairs** pairs);
// end

/// Lists of numbers: the numbers for query i are ids[begin[i]] ... ids[begin[i + 1] - 1].
typedef struct treeform_id_lists {
    void* owner;
    const size_t* begin;  ///< [count + 1]
    const uint32_t* ids;
    size_t count;  ///< queries
} treeform_id_lists;

// made of the headers of C++:
//   box_tree_query() box_tree_rays() box_tree_nearest()
/// The boxes that have a common point with each of the query boxes [count], ascending; exact. A
/// query may be infinite; one whose min exceeds its max matches nothing.
TREEFORM_C_API treeform_code treeform_box_tree_query(const treeform_box_tree* tree,
                                                     const double* mins, const double* maxs,
                                                     size_t count, treeform_id_lists** lists);

/// The boxes that each ray meets, ascending. Rays are origin + t direction with t >= 0, for
/// `origins` and `directions` [count][dimensions]. No box is missed; boxes that a ray misses by
/// less than the rounding of 32-bit floats may be included.
TREEFORM_C_API treeform_code treeform_box_tree_rays(const treeform_box_tree* tree,
                                                    const double* origins, const double* directions,
                                                    size_t count, treeform_id_lists** lists);

/// The `k` boxes nearest to each of `points` [count][dimensions], within `radius`; results as in
/// `treeform_point_tree_nearest`. The distance of a point inside a box is 0.
TREEFORM_C_API treeform_code treeform_box_tree_nearest(const treeform_box_tree* tree,
                                                       const double* points, size_t count, size_t k,
                                                       double radius, uint32_t* ids,
                                                       double* distances);
// end
