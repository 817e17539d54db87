#pragma once
/// \file
/// The folders of real models and clouds that some tests read.

#include <support/skip.hpp>
#include <support/truth.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace test {

/// TREEFORM_MODELS_DIR; empty, and the test case counts as skipped, where there is none.
inline std::filesystem::path models_folder() {
    std::filesystem::path folder = TREEFORM_MODELS_DIR;
    if (folder.empty()) skip("TREEFORM_MODELS_DIR is not set");
    return folder;
}

/// TREEFORM_CLOUDS_DIR; empty, and the test case counts as skipped, where there is none.
inline std::filesystem::path clouds_folder() {
    std::filesystem::path folder = TREEFORM_CLOUDS_DIR;
    if (folder.empty()) skip("TREEFORM_CLOUDS_DIR is not set");
    return folder;
}

/// The files that TRUTH.csv of the folder has rows of, each once.
inline std::set<std::string> files_with_truth(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const truth_row& row : read_truth(folder / "TRUTH.csv")) files.insert(row.text("file"));
    return files;
}

}  // namespace test
