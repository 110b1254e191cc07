#pragma once

#include <string>

#include "tools/sim_run.h"

/// Files for ParaView and other programs.
namespace parity::tools {

/// Particles with velocity (and pressure) as binary little-endian PLY points.
std::string encode_particles_ply(const SimContent& content);

/// Particles as VTK XML PolyData (.vtp), raw appended data.
std::string encode_vtp(const SimContent& content);

/// Cells as VTK XML ImageData (.vti), raw appended data: velocity, pressure, smoke, temperature and
/// solid as far as they are there.
///
/// Source: Kitware, "VTK File Formats".
std::string encode_vti(const SimContent& content);

}  // namespace parity::tools
