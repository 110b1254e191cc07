#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// Velocity of faces as the weighted mean of the particles around, by linear weights; 0 where none
/// is. Keeps momentum: the sum over faces of weight times velocity is that of the particles.
struct FaceTransfer {
  FaceFields velocity;
  FaceFields weight;  ///< in particles
};
FaceTransfer particles_to_faces(const FluidProblem& problem, const LiquidParticles& particles);

/// One step of a liquid of particles, by FLIP or APIC: to the faces, gravity, projection, back, and
/// a move by the midpoint rule with the gradient of the velocity at the particle.
///
/// Mass: particles are never made or lost. Momentum: both transfers keep it to rounding.
/// Source: Zhu & Bridson 2005; Jiang et al. 2015.
FluidState liquid_step(const FluidProblem& problem, const FluidState& state, double seconds);

}  // namespace parity::cpu
