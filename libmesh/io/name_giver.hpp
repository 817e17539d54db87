#pragma once
/// \file
/// Makes names of parts unique.

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace treeform::detail::io {

/// Makes names unique, since parts with the same name would be one part. The second "gear" becomes
/// "gear (2)".
class name_giver {
  public:
    [[nodiscard]] std::string name(const std::string& wanted) {
        if (taken_.insert(wanted).second) return wanted;
        for (;;) {
            std::string other = wanted + " (" + std::to_string(++times_[wanted] + 1) + ")";
            if (taken_.insert(other).second) return other;
        }
    }

  private:
    std::unordered_set<std::string> taken_{};
    std::unordered_map<std::string, std::size_t> times_{};
};

}  // namespace treeform::detail::io
