#pragma once
/// \file
/// Work that may crash or never end, tried in a process of its own first.

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace treeform::bench {

enum class ending { done, failed, crashed, late };
[[nodiscard]] std::string_view name_of(ending ending);

/// How `work` ends in a copy of this process: `failed` where it throws or returns false, `crashed`
/// by a signal, `late` where it takes longer than `seconds`. What it computes is lost. It may use
/// one thread.
[[nodiscard]] ending ending_of(const std::function<bool()>& work, double seconds);

/// [count] the values of `work`, computed in copies of this process that go on behind each number
/// at which one crashed or took longer than a second: its value is `lost`.
[[nodiscard]] std::vector<signed char> values_of(
    std::size_t count, const std::function<signed char(std::size_t)>& work, signed char lost);

}  // namespace treeform::bench
