#pragma once
/// \file
/// Timing the contestants of a contest against each other, and the memory each of them takes.

#include "bench/workload.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace treeform::bench {

struct measured {
    std::string who;
    unsigned threads = 1;
    double median = 0.0;  ///< seconds
    double low = 0.0;     ///< seconds, the fastest run
    double high = 0.0;    ///< seconds, the slowest run
    std::size_t runs = 0;
    std::optional<double> peak_mb{};  ///< by the caller: see `own_peak_mb`
    std::optional<double> error{};
    std::vector<figure> figures{};
};

/// The times of all contestants, in their order. Each runs once to warm up, then all run in an
/// interleaved random order: 20 times those that take less than 50 ms, `long_runs` times the others
/// (2 and 2 with the least effort), and once what takes more than 10 s. Where `long_runs` is 1 and
/// the first run takes more than 2 s, it is the one that counts.
[[nodiscard]] std::vector<measured> measure(const contest& contest, const setting& setting);

/// Largest resident set of this process while `contestant` runs once, its input included, what it
/// took to make that input not. In MB of 10^6 bytes; none where the kernel does not tell.
[[nodiscard]] std::optional<double> own_peak_mb(const contestant& contestant);

/// What a process started as `program arguments...` prints; none when it cannot be started or ends
/// with another status than 0.
[[nodiscard]] std::optional<std::string> text_printed_by(const std::vector<std::string>& command);

/// The number that it prints; none when it prints something else. It is a fresh process, so that
/// nothing freed here counts as its memory.
[[nodiscard]] std::optional<double> number_printed_by(const std::vector<std::string>& command);

}  // namespace treeform::bench
