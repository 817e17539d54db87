#pragma once
/// \file
/// What a tool shows of a job: a scene, as a page and as a picture.

#include "tools/picture/scene.hpp"
#include "tools/shell/run.hpp"
#include <treeform/tf.hpp>

namespace tools {

/// A scene with what all tools say of the job: the file, its digest, the program and its version.
[[nodiscard]] scene scene_of(const job& work, const char* tool);

/// Writes the page to where --html says, and the picture to where --png does. They get their names
/// when the job is done: nothing is shown of a mesh that could not be written. Files are named in
/// it without their folders, unless two have the same name.
/// \throws failure (bad_output)
void write_page(job& work, scene shown);

}  // namespace tools
