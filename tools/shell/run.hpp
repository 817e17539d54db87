#pragma once
/// \file
/// One run of a tool: its inputs one after the other, its report, its exit status.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/entries.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/guard.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// For people: the path, or "standard input" for "-".
[[nodiscard]] std::string name_of_input(const std::string& path);

/// The work on one input, or on all where they are one set (`common_options::joined`); then `path`
/// is that of the first, and the report names none.
class job {
  public:
    job(const std::string& path, const common_options& options, console& out, guard& keeper,
        std::map<std::string, double>& seconds);

    /// Reads the input and enters what is known of it in `entry`. \throws failure
    [[nodiscard]] tf::mesh_file read();
    /// Reads `input` and enters format, digest and precision in `about`; says none of its warnings.
    /// Names of material and texture files are as seen from the output's folder. The first call
    /// for a set of several inputs reads all of its files, at the same time.
    [[nodiscard]] tf::mesh_file read(const std::string& input, json& about);

    /// Adds the time from now to the end of the returned object's life to the report's `step`.
    class timer {
      public:
        explicit timer(double& sum);
        ~timer();
        timer(const timer&) = delete;
        timer& operator=(const timer&) = delete;

      private:
        double& sum_;
        double start_;
    };
    [[nodiscard]] timer time(const std::string& step) { return timer(seconds[step]); }

    /// For library calls: shows progress, and asks them to stop when the tool has to.
    [[nodiscard]] tf::progress_callback progress(std::string_view step);

    /// After such a call: \throws failure (stopped) where it was `cancelled`, or the tool has to
    void call_ended(bool cancelled = false);

    /// mm, cm, m, in, ft or um, as --units has it, or as what was read declares; empty where
    /// neither does, or files differ.
    [[nodiscard]] std::string unit() const;

    /// A remark for the person and for the report.
    void warn(const std::string& code, const std::string& text);
    /// The remarks of a reader or writer; `whose` stands ahead of each.
    void warn(const std::vector<tf::io_warning>& remarks, const std::string& whose = {});
    /// Says how many `things` ("face", "faces") of an input were left out, if any.
    void warn_of_non_finite(std::uint64_t count, const char* one, const char* many,
                            const std::string& whose = {});

    const std::string& path;
    std::string name;  ///< of the input, for people: "part.stl", "standard input", "3 inputs"
    const common_options& options;
    console& out;
    guard& keeper;
    std::map<std::string, double>& seconds;  ///< of the report, by step
    json entry;                              ///< of the report's `files`
    /// Finished files that get their names after all others, unless the body throws.
    std::vector<std::unique_ptr<output_file>> last_outputs{};

  private:
    /// What came of reading a file that has not been asked for yet.
    struct read_ahead {
        std::string input{};
        tf::mesh_file file{};
        std::string digest{};
        std::exception_ptr error{};
        bool taken = false;
    };
    [[nodiscard]] read_ahead read_one(const std::string& input) const;
    [[nodiscard]] read_ahead take(const std::string& input);
    void compare_units(const std::string& input, const tf::mesh_file& file);

    std::vector<read_ahead> ahead_;
    std::uint64_t size_ = 0;  ///< what has been read, for people who wait
    bool has_faces_ = false;
    std::string unit_{};  ///< the line of the first file that has one
    bool warned_of_units_ = false;
};

/// Parses the command line and calls `body` for each input. What `body` returns or throws becomes
/// the input's status: a `failure` its own, an `io_error` bad_input, no memory `stopped`, anything
/// else `bug`. Work goes on with the next input, except after `stopped`. The exit status is the
/// gravest of all.
///
/// `steps` names the keys of the report's "seconds", which are there even where they are 0.
[[nodiscard]] int run(command_line& line, common_options& options,
                      const std::vector<std::string>& steps, int argc, const char* const* argv,
                      const std::function<void()>& check_options,
                      const std::function<exit_status(job&)>& body);

}  // namespace tools
