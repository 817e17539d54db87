#pragma once
/// \file
/// What the bench says: a table for people, CSV for programs.

#include "bench/measure.hpp"
#include "bench/workload.hpp"

#include <fstream>
#include <string>
#include <vector>

namespace treeform::bench {

/// Writes DIR/bench.csv row by row, so that a run that is cut short leaves what it measured:
/// id,case,size,threads,who,value,unit,peak_mb,error with `value` a median. A figure of a
/// contestant is a row of its own with the same keys and another unit.
class csv_report {
  public:
    /// \throws std::runtime_error when the file cannot be written
    explicit csv_report(const std::string& folder);
    void add(const std::string& id, const contest& contest, std::size_t size,
             const std::vector<measured>& results);

  private:
    std::ofstream file_;
};

/// Prints contests as they come: a block each, or a line each where up to four contestants of short
/// names run on one thread. Times are medians; a block has the fastest and the slowest run too.
/// Behind them stands how many times as long as treeform it took.
class table {
  public:
    void add(const contest& contest, std::size_t size, const std::vector<measured>& results);

  private:
    std::string columns_;  ///< heads of the lines printed last
};

/// Version, processor, threads at hand and compiler, in a line.
[[nodiscard]] std::string machine_name();

/// Writes DIR/machine.txt: processor, threads, memory, compiler, versions of the peers.
void write_machine(const std::string& folder);

}  // namespace treeform::bench
