#pragma once
/// \file
/// The folders of real models and clouds that some tests read. The environment says where they are;
/// where it says nothing, the build does. A variable that is set to nothing means that there are
/// none.

#include <support/skip.hpp>
#include <support/truth.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace test {

bool has_models();
bool has_clouds();

/// TREEFORM_MODELS_DIR and TREEFORM_CLOUDS_DIR. \throws std::logic_error when there is none
std::filesystem::path models_folder();
std::filesystem::path clouds_folder();

/// data/ of the sources.
std::filesystem::path data_folder();

/// The files that TRUTH.csv of the folder has rows of, each once.
inline std::set<std::string> files_with_truth(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const truth_row& row : read_truth(folder / "TRUTH.csv")) files.insert(row.text("file"));
    return files;
}

}  // namespace test

/// First in a test case that reads real models, or clouds: without them, it is skipped.
#define NEEDS_MODELS() \
    if (!test::has_models()) SKIP_CASE("TREEFORM_MODELS_DIR is not set")
#define NEEDS_CLOUDS() \
    if (!test::has_clouds()) SKIP_CASE("TREEFORM_CLOUDS_DIR is not set")
