#include "bench/tool_run.hpp"

#include "bench/measure.hpp"

#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace treeform::bench {

scratch::~scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

job tool_job(const std::string& tool, std::vector<std::string> arguments, const std::string& output,
             std::shared_ptr<const void> inputs) {
    std::vector<std::string> command{TREEFORM_RUN_MEASURED,
                                     std::string(TREEFORM_TOOLS_DIR) + "/" + tool + "/" + tool};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"-q", "-j1", "-o", output});
    const auto last_peak = std::make_shared<std::optional<double>>();
    const auto result = std::make_shared<const scratch>(output);
    return {
        .run =
            [=] {
                std::istringstream printed(text_printed_by(command).value_or(""));
                int status = -1;
                double bytes = 0;
                printed >> status >> bytes;
                if ((status != 0 && status != 1) || !std::filesystem::exists(output))
                    throw std::runtime_error(tool + " ended with status " + std::to_string(status));
                *last_peak = bytes / 1e6;
            },
        .discard = [=] { std::filesystem::remove(result->path()); },
        .peak_mb = [=, kept = std::move(inputs)] { return *last_peak; }};
}

}  // namespace treeform::bench
