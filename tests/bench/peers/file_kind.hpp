#pragma once
/// \file
/// The kinds of files that are read and written.

#include <string>

namespace treeform::bench {

struct file_kind {
    std::string name;
    std::string extension;
    std::string assimp_id;  ///< of assimp's exporter
    bool ascii = false;
};

}  // namespace treeform::bench
