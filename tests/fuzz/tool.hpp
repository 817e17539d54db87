#pragma once
/// \file
/// A whole tool, run in this process on the bytes of a file.

#include <span>

namespace treeform::fuzz {

/// What @out.EXT holds where it is written: a file that can be read; faces that have nothing but
/// corners and edges in common, once equal corners are one; such faces without an open edge; parts
/// of such faces each.
enum class kept_promise { read, clean, solid, solids };

/// What is said of a run, as words with one blank between them. A word that begins with @ is a file
/// in the folder of the run: @in the bytes, under a name with the extension that they suggest,
/// @other a cube; and every output, of which @out.EXT is the mesh.
struct tool_command {
    const char* words;
    kept_promise mesh = kept_promise::read;
};

/// Those of the tool that the target is for.
[[nodiscard]] std::span<const tool_command> tool_commands();

}  // namespace treeform::fuzz
