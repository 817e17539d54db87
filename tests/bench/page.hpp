#pragma once
/// \file
/// DIR/index.html: what the paper says of a figure, what was measured here, and the pictures.

#include "bench/chart.hpp"
#include "bench/measure.hpp"
#include "bench/workload.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform::bench {

/// The results of one contest.
struct outcome {
    std::string name;  ///< of the contest
    std::size_t size = 0;
    bench::unit unit;
    std::vector<measured> rows;

    /// In `unit`; none when nobody of that name ran with so many threads.
    [[nodiscard]] std::optional<double> value(const std::string& who, unsigned threads = 1) const;
    /// A further value of the answer.
    [[nodiscard]] std::optional<double> figure(const std::string& who, const std::string& of) const;
};

struct picture {
    std::string file;  ///< "f2_build.svg"
    std::string svg;
};

/// What a workload has to show. Sentences are plain text.
struct section {
    std::string paper;  ///< what the paper reports; empty when it says nothing of it
    std::string ours;   ///< what was measured, in one sentence
    std::vector<picture> pictures{};
    std::vector<std::vector<std::string>> table{};  ///< the first row is the head
    std::vector<std::string> remarks{};             ///< paragraphs: what is to be seen, and why
};

/// Collects sections and writes them with their pictures.
class page {
  public:
    explicit page(std::string machine) : machine_(std::move(machine)) {}

    void add(const workload& workload, const std::vector<outcome>& outcomes);
    /// \throws std::runtime_error when a file cannot be written
    void write(const std::string& folder) const;

  private:
    std::string machine_;
    std::string body_;
    std::vector<picture> pictures_;
};

/// "5.2 times as fast as", "1.3 times as slow as": `other` and `own` are times.
[[nodiscard]] std::string compared(double own, double other);

/// A group of bars for each contest whose name ends with `suffix`, a bar for each contestant, no
/// two of one color. All contests have the same contestants. With `base`, bars are multiples of
/// the time of the contestant of that name on one thread, which stands below the group.
[[nodiscard]] bar_chart bars_by_contest(std::span<const outcome> outcomes,
                                        const std::string& suffix, const caption& caption,
                                        const std::string& base = {});

/// A curve of each contestant over the sizes of the contests, threads in its name where some ran
/// with several.
[[nodiscard]] std::vector<curve> curves_by_size(std::span<const outcome> outcomes);

}  // namespace treeform::bench
