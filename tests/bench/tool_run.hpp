#pragma once
/// \file
/// The command line tools of this build as processes of their own.

#include "bench/workload.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace treeform::bench {

/// A file, or a folder with what is in it, that is removed with its last user.
class scratch {
  public:
    explicit scratch(std::string path) : path_(std::move(path)) {}
    scratch(const scratch&) = delete;
    scratch& operator=(const scratch&) = delete;
    ~scratch();
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

/// The job that runs `tool` ("tf-weld") on one thread, from files to the file `output`, and tells
/// its peak memory. Starting the process is timed with it. `output` is removed afterwards; `inputs`
/// are kept as long as the job is.
/// The job throws std::runtime_error when the tool ends with a status that is neither 0 nor 1, or
/// without its output.
[[nodiscard]] job tool_job(const std::string& tool, std::vector<std::string> arguments,
                           const std::string& output, std::shared_ptr<const void> inputs);

}  // namespace treeform::bench
