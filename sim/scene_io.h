#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/scene.h"

/// Scenes of fluids in JSON files; docs/simulation.md describes them key by key.
namespace parity {

/// A scene from JSON text. Everything is checked: unknown, missing and repeated keys, types,
/// numbers that are not finite or out of their range, counts that no machine could hold, shapes
/// outside the domain, solids that leave no room.
///
/// @param name  of the file, for messages.
/// @throws InputError  one line: file, JSON path, value, and what was expected.
SimScene decode_sim_scene(std::string_view text, const std::string& name);

/// The same from a file of at most 1 MiB.
///
/// @throws InputError  missing, a folder, too large, or as decode_sim_scene.
SimScene load_sim_scene(const std::filesystem::path& path);

/// What decides the course of a simulation as one line of JSON (not its duration, pictures and
/// output): runs with equal text take equal steps.
std::string physics_text(const SimScene& scene);

}  // namespace parity
