#include "tools/common/folds.hpp"

#include "tools/common/console.hpp"
#include <treeform/tf.hpp>

#include <string>

namespace tools {

void warn_of_folds(job& work, const tf::rounding_defects& harm, bool to_single) {
    std::string text;
    if (harm.collapsed > 0)
        text = counted(harm.collapsed, "face has", "faces have") + " no area any more";
    if (harm.meeting > 0)
        text += (text.empty() ? "" : ", ") + counted(harm.meeting, "pair", "pairs") + " of faces " +
                (harm.meeting == 1 ? "meets" : "meet") + " that did not";
    if (text.empty()) return;
    work.warn("folded",
              "by rounding, " + text + "; " +
                  (to_single ? "--precision double, in a format that has it, may keep them"
                             : "nearer to the origin they would stay"));
}

}  // namespace tools
