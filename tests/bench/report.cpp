#include "bench/report.hpp"

#include "bench/peers/versions.hpp"
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/version.hpp>

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace treeform::bench {
namespace {

double value_of(const unit& unit, double seconds) {
    return unit.is_rate ? unit.scale / seconds : unit.scale * seconds;
}

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
}

/// How many times as long as treeform with `threads` threads; empty where that did not run.
std::string ratio(const measured& row, const std::vector<measured>& rows, unsigned threads) {
    for (const measured& other : rows)
        if (other.who == "treeform" && other.threads == threads)
            return fmt::format("{:.2f}x", row.median / other.median);
    return {};
}

/// Counts in full, shares to three digits.
std::string joined(const std::vector<figure>& figures) {
    std::string text;
    for (const auto& [unit, value] : figures)
        text += value == std::floor(value) ? fmt::format("  {:.0f} {}", value, unit)
                                           : fmt::format("  {:.3g} {}", value, unit);
    return text;
}

void print_block(const contest& contest, std::size_t size, const std::vector<measured>& results) {
    const auto print_row = [](const auto&... cells) {
        fmt::print("  {:<30}{:>4}{:>11}{:>11}{:>11}{:>5}{:>10}{:>9}{:>9}{:>9}\n", cells...);
    };
    const auto value = [&](double seconds) {
        return fmt::format("{:.4g}", value_of(contest.unit, seconds));
    };
    fmt::print("\n{}, size {}\n", contest.name, size);
    print_row("who", "thr", contest.unit.name, "fastest", "slowest", "runs", "peak MB", "error",
              "/tf 1t", "/tf 2t");
    for (const measured& row : results) {
        print_row(row.who, row.threads, value(row.median), value(row.low), value(row.high),
                  row.runs, row.peak_mb ? fmt::format("{:.1f}", *row.peak_mb) : "",
                  row.error ? fmt::format("{:.2g}", *row.error) : "", ratio(row, results, 1),
                  ratio(row, results, 2));
        if (!row.figures.empty()) fmt::print("      {}\n", joined(row.figures));
    }
}

std::string heads_of(const contest& contest, std::size_t size,
                     const std::vector<measured>& results) {
    std::string heads = fmt::format("{:<34}", "size " + std::to_string(size));
    for (const measured& row : results)
        heads += row.who == "treeform"
                     ? fmt::format("{:>10}{:>8}{:>9}", "treeform", "MB", "error")
                     : fmt::format("{:>18}{:>8}{:>8}{:>9}", row.who, "/tf", "MB", "error");
    return heads + "  " + contest.unit.name;
}

void print_line(const contest& contest, const std::vector<measured>& results) {
    std::string line = fmt::format("{:<34}", contest.name);
    for (const measured& row : results) {
        const std::string value = fmt::format("{:.4g}", value_of(contest.unit, row.median));
        line += row.who == "treeform" ? fmt::format("{:>10}", value)
                                      : fmt::format("{:>18}{:>8}", value, ratio(row, results, 1));
        line += fmt::format("{:>8}{:>9}", row.peak_mb ? fmt::format("{:.1f}", *row.peak_mb) : "",
                            row.error ? fmt::format("{:.2g}", *row.error) : "");
    }
    for (const measured& row : results) line += joined(row.figures);
    fmt::print("{}\n", line);
}

/// What follows "key" and a colon on a line of a file of /proc.
std::string field(const char* path, const std::string& key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(key)) {
            const std::size_t at = line.find_first_not_of(" \t", line.find(':') + 1);
            return at == std::string::npos ? std::string() : line.substr(at);
        }
    return "unknown";
}

std::ofstream open(const std::string& path) {
    std::ofstream file(path);
    if (!file) throw std::runtime_error("cannot write " + path);
    return file;
}

}  // namespace

csv_report::csv_report(const std::string& folder) : file_(open(folder + "/bench.csv")) {
    file_ << "id,case,size,threads,who,value,unit,peak_mb,error\n" << std::flush;
}

void csv_report::add(const std::string& id, const contest& contest, std::size_t size,
                     const std::vector<measured>& results) {
    for (const measured& row : results) {
        const std::string keys =
            fmt::format("{},{},{},{},{}", id, contest.name, size, row.threads, row.who);
        file_ << fmt::format("{},{:.6g},{},{},{}\n", keys, value_of(contest.unit, row.median),
                             contest.unit.name, number(row.peak_mb), number(row.error));
        for (const figure& figure : row.figures)
            file_ << fmt::format("{},{:.10g},{},,\n", keys, figure.value, figure.unit);
    }
    file_ << std::flush;
}

void table::add(const contest& contest, std::size_t size, const std::vector<measured>& results) {
    const bool serial = std::all_of(results.begin(), results.end(),
                                    [](const auto& row) { return row.threads == 1; });
    const bool short_names = std::all_of(results.begin(), results.end(),
                                         [](const auto& row) { return row.who.size() < 18; });
    if (!serial || !short_names || results.size() > 4) {
        print_block(contest, size, results);
    } else {
        const std::string columns = heads_of(contest, size, results);
        if (columns != columns_) fmt::print("\n{}\n", columns);
        columns_ = columns;
        print_line(contest, results);
    }
    std::fflush(stdout);
}

std::string machine_name() {
#ifdef __clang__
    const std::string compiler = "clang " + std::to_string(__clang_major__);
#else
    const std::string compiler = fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    return fmt::format("treeform {}.{}.{}, {}, {} threads, {}", TREEFORM_VERSION_MAJOR,
                       TREEFORM_VERSION_MINOR, TREEFORM_VERSION_PATCH,
                       field("/proc/cpuinfo", "model name"), thread_count(), compiler);
}

void write_machine(const std::string& folder) {
    std::ofstream file = open(folder + "/machine.txt");
    struct utsname system {};
    ::uname(&system);
    file << "processor: " << field("/proc/cpuinfo", "model name") << '\n'
         << "threads at hand: " << thread_count() << '\n'
         << "memory: " << field("/proc/meminfo", "MemTotal") << '\n'
         << "kernel: " << system.sysname << ' ' << system.release << ' ' << system.machine << '\n'
         << "load average at the start: ";
    std::string load;
    std::getline(std::ifstream("/proc/loadavg"), load);
    file << load << '\n'
#ifdef __clang__
         << "compiler: clang " << __clang_version__ << '\n'
#else
         << "compiler: g++ " << __VERSION__ << '\n'
#endif
         << "flags: " << TREEFORM_BENCH_FLAGS << '\n'
         << "treeform " << TREEFORM_VERSION_MAJOR << '.' << TREEFORM_VERSION_MINOR << '.'
         << TREEFORM_VERSION_PATCH << '\n'
         << cgal_name() << '\n'
         << assimp_name() << '\n'
         << fcl_name() << '\n'
         << nanoflann_name() << '\n';
}

}  // namespace treeform::bench
