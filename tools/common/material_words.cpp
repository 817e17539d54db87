#include "tools/common/material_words.hpp"

#include "tools/common/console.hpp"
#include <treeform/mesh/carry.hpp>

#include <string>
#include <vector>

namespace tools {

void warn_of_ambiguous_materials(job& work, std::span<const tf::mesh_file* const> inputs) {
    const std::vector<std::string> names = tf::ambiguous_materials(inputs);
    if (names.empty()) return;
    work.warn("materials", "inputs with different material files name " +
                               (names.size() == 1 ? "material " + names.front()
                                                  : counted(names.size(), "material", "materials") +
                                                        ", such as " + names.front() + ",") +
                               " alike; an OBJ has one of a name");
}

}  // namespace tools
