#include <treeform/tree/version.hpp>

#define TREEFORM_TEXT_OF_TOKEN(token) #token
#define TREEFORM_TEXT_OF(macro) TREEFORM_TEXT_OF_TOKEN(macro)

namespace treeform {

static_assert(TREEFORM_VERSION_MINOR < 1000 && TREEFORM_VERSION_PATCH < 1000,
              "a version number has three digits for each of these");

int version() noexcept { return TREEFORM_VERSION; }

const char* version_string() noexcept {
    return TREEFORM_TEXT_OF(TREEFORM_VERSION_MAJOR) "." TREEFORM_TEXT_OF(
        TREEFORM_VERSION_MINOR) "." TREEFORM_TEXT_OF(TREEFORM_VERSION_PATCH);
}

}  // namespace treeform
