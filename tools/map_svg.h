#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/map_data.h"
#include "tools/provenance.h"

namespace parity::tools {

/// The map as a picture: values as colours, the border in white on black, theory dashed.
std::string map_svg(const Map& map, const MapData& data, const Provenance& provenance);

/// Provenance in lines that begin with #, then one line a node: x, y, value, failed (0 or 1).
std::string map_csv(const Map& map, const MapData& data, const Provenance& provenance);

/// Everything, with the pieces of the border.
nlohmann::json map_json(const Map& map, const MapData& data, const Provenance& provenance);

}  // namespace parity::tools
