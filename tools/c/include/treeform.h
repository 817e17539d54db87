#pragma once
/// \file
/// treeform in C: includes all headers, one for each subject.

#include <treeform/c/assembly.h>
#include <treeform/c/attributes.h>
#include <treeform/c/base.h>
#include <treeform/c/cuts.h>
#include <treeform/c/files.h>
#include <treeform/c/intersections.h>
#include <treeform/c/layouts.h>
#include <treeform/c/mesh.h>
#include <treeform/c/nearness.h>
#include <treeform/c/placement.h>
#include <treeform/c/properties.h>
#include <treeform/c/shapes.h>
#include <treeform/c/solids.h>
#include <treeform/c/streams.h>
#include <treeform/c/trees.h>
#include <treeform/c/weld.h>
