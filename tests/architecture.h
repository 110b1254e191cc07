#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity {

/// What is wrong with a file of the source tree, one sentence each: includes that cross from one
/// side to the other (the table of docs/architecture.md), libraries where they do not belong, names
/// that are not snake_case, chapters that the course has not, tabs, left-overs, and paths of one
/// machine.
///
/// @param path  relative to the root, with '/': "gpu/raster/clip.cpp".
/// @param text  of the file.
std::vector<std::string> architecture_faults(const std::string& path, const std::string& text);

/// The same for a whole tree; each sentence begins with the file's name.
std::vector<std::string> tree_faults(const std::filesystem::path& root);

}  // namespace parity
