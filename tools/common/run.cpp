#include "tools/common/run.hpp"

#include "tools/common/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/version.hpp>

#include <unistd.h>

#include <new>
#include <system_error>

namespace tools {
namespace {

struct outcome {
    exit_status status = done;
    std::string code;
    std::string text;
};

/// Calls `body` and names what went wrong, if anything did.
outcome attempt(const std::function<exit_status()>& body) {
    try {
        return {body(), {}, {}};
    } catch (const failure& error) {
        return {error.status(), error.code(), error.what()};
    } catch (const tf::io_error& error) {
        return {bad_input, "read", error.what()};
    } catch (const std::bad_alloc&) {
        return {stopped, "memory", "out of memory"};
    } catch (const std::system_error& error) {
        if (error.code() != std::errc::resource_unavailable_try_again)
            return {bug, "bug", std::string("internal error: ") + error.what()};
        return {stopped, "memory", "no memory for a thread"};
    } catch (const std::exception& error) {
        return {bug, "bug", std::string("internal error: ") + error.what()};
    }
}

std::string version_text(const std::string& tool) {
    std::string text = tool + " (treeform) " + tf::version_string();
#if defined(__clang__)
    text += "\nbuilt with clang " __clang_version__;
#else
    text += "\nbuilt with g++ " __VERSION__;
#endif
#ifdef NDEBUG
    return text + ", release";
#else
    return text + ", assertions on";
#endif
}

void configure(console& out, const common_options& options, const command_line& line) {
    const level most = options.quiet          ? level::error
                       : options.verbose > 1  ? level::debug
                       : options.verbose == 1 ? level::info
                                              : level::warning;
    out.configure(most, options.progress || (!options.quiet && isatty(STDERR_FILENO) == 1));
    for (const auto& path : line.outputs())
        if (path == "-") out.result_to_stderr();
    if (!options.log.empty()) out.log_to(options.log);
}

json head(const command_line& line, const common_options& options, int argc,
          const char* const* argv) {
    json report;
    report["schema"] = line.name() + "-report/1";
    report["tool"] = line.name();
    report["version"] = tf::version_string();
    report["command"] = std::vector<std::string>(argv, argv + argc);
    report["exit"] = nullptr;
    report["unit"] = options.unit;
    report["files"] = json::array();
    return report;
}

/// A name that is not UTF-8 is written with replacement characters rather than not at all.
std::string as_text(const json& report) {
    return report.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

class session {
  public:
    session(common_options& options, console& out, guard& keeper)
        : options_(options), out_(out), keeper_(keeper) {}

    exit_status work(const std::vector<std::string>& steps, json& report,
                     const std::function<exit_status(job&)>& body) {
        for (const auto& step : steps) seconds_[step] = 0.0;
        exit_status worst = done;
        bool halted = false;
        const std::vector<std::string> inputs =
            options_.joined ? std::vector<std::string>{options_.inputs.front()} : options_.inputs;
        for (const std::string& input : inputs) {
            job one(input, options_, out_, keeper_, seconds_);
            const outcome result =
                halted ? outcome{stopped, "not-started", name_of_input(input) + ": not started"}
                       : attempt([&] {
                             keeper_.check();
                             return body(one);
                         });
            finish(one, result);
            halted = halted || result.status == stopped;
            worst = graver(worst, result.status);
            report["files"].push_back(std::move(one.entry));
        }
        json& times = report["seconds"] = json::object();
        for (const auto& step : steps) times[step] = seconds_[step];
        return worst;
    }

  private:
    void finish(job& one, const outcome& result) {
        out_.end_progress();
        one.entry["exit"] = static_cast<int>(result.status);
        if (result.text.empty()) return;
        const bool by_limit = result.code == "memory" && options_.memory > 0 &&
                              result.text.find("--memory") == std::string::npos;
        const std::string text = by_limit ? "stopped by the memory limit (--memory)" : result.text;
        one.entry["error"] = {{"code", result.code}, {"text", text}};
        const bool named = text.find(name_of_input(one.path)) != std::string::npos;
        out_.error(named ? text : one.name + ": " + text);
    }

    common_options& options_;
    console& out_;
    guard& keeper_;
    std::map<std::string, double> seconds_;
};

int run_parsed(command_line& line, common_options& options, const std::vector<std::string>& steps,
               int argc, const char* const* argv, const std::function<exit_status(job&)>& body,
               console& out) {
    configure(out, options, line);
    guard keeper(line.name(), {options.timeout, options.memory});
    const tf::thread_scope threads(options.threads);
    if (!options.report.empty()) check_output(options.report, options.force);

    json report = head(line, options, argc, argv);
    session all(options, out, keeper);
    exit_status status = all.work(steps, report, body);
    if (status == found && options.exit_zero) status = done;
    report["exit"] = static_cast<int>(status);
    report["threads"] = tf::thread_count();
    report["peak_rss"] = peak_memory();
    if (!options.report.empty()) {
        output_file file(options.report, options.force, keeper);
        file.write(as_text(report));
        file.commit();
    }
    return status;
}

}  // namespace

int run(command_line& line, common_options& options, const std::vector<std::string>& steps,
        int argc, const char* const* argv, const std::function<void()>& check_options,
        const std::function<exit_status(job&)>& body) {
    console out(line.name());
    const outcome result = attempt([&] {
        line.version_text(version_text(line.name()));
        if (line.parse(argc, argv) == command_line::outcome::help_shown) return done;
        list_folders(options);
        check_common_options(line, options);
        check_options();
        check_files(line, options);
        std::error_code ignored;  // where it cannot be made, each file that goes there says so
        if (!options.output_dir.empty() && !options.dry_run)
            std::filesystem::create_directories(options.output_dir, ignored);
        return static_cast<exit_status>(run_parsed(line, options, steps, argc, argv, body, out));
    });
    if (!result.text.empty()) out.error(result.text);
    return result.status;
}

}  // namespace tools
