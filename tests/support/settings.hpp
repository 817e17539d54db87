#pragma once
/// \file
/// Numbers that the environment may give to tests.

#include <cstdint>
#include <cstdlib>

namespace test {

/// The number that the variable is set to, or `usual`.
inline std::uint64_t setting(const char* name, std::uint64_t usual) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : usual;
}

/// How many random inputs a family has: TREEFORM_STRESS_COUNT, or the usual number as many times as
/// TREEFORM_STRESS_TIMES says (default 1).
inline std::uint64_t stress_count(std::uint64_t usual) {
    return setting("TREEFORM_STRESS_COUNT", usual * setting("TREEFORM_STRESS_TIMES", 1));
}
inline std::uint64_t stress_seed() { return setting("TREEFORM_STRESS_SEED", 1); }

}  // namespace test
