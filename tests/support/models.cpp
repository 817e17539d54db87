#include <support/models.hpp>

#include <cstdlib>
#include <stdexcept>

namespace test {
namespace {

std::filesystem::path folder_of(const char* variable, const char* built_in) {
    const char* said = std::getenv(variable);
    return said != nullptr ? said : built_in;
}

std::filesystem::path models() { return folder_of("TREEFORM_MODELS_DIR", TREEFORM_MODELS_DIR); }
std::filesystem::path clouds() { return folder_of("TREEFORM_CLOUDS_DIR", TREEFORM_CLOUDS_DIR); }

std::filesystem::path known(const std::filesystem::path& folder) {
    if (folder.empty()) throw std::logic_error("a test did not ask whether there are models");
    return folder;
}

}  // namespace

bool has_models() { return !models().empty(); }
bool has_clouds() { return !clouds().empty(); }
std::filesystem::path models_folder() { return known(models()); }
std::filesystem::path clouds_folder() { return known(clouds()); }
std::filesystem::path data_folder() { return TREEFORM_DATA_DIR; }

}  // namespace test
