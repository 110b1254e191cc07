#pragma once

#include <array>
#include <memory>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/numerics/pressure_system.h"
#include "shaders/fluid/layout.h"
#include "sim/fluid.h"

namespace parity::gpu {

/// A value for each face, by axis.
class FaceBuffers {
 public:
  FaceBuffers() = default;
  FaceBuffers(Context& context, ivec3 cells);
  void write(const FaceFields& fields);
  FaceFields read(ivec3 cells) const;
  operator FluidFaces() const { return {axes_[0], axes_[1], axes_[2]}; }
  const Buffer<float>& operator[](int axis) const { return axes_[std::size_t(axis)]; }

 private:
  std::array<Buffer<float>, 3> axes_;
};

std::vector<float> floats_of(const Field& field);
Field field_of(ivec3 size, const std::vector<float>& values);

/// What a simulation keeps on the device: the scene, the clock, and fields. Memory: 4 bytes for
/// each value; a face field has one value an axis and cell, and the outermost faces.
struct FluidBuffers {
  FluidBuffers(Context& context, const FluidProblem& problem);

  /// Threads for the points of an axis; 3 stands for cells.
  Threads threads(int axis) const;
  /// One thread for each point of an axis that the step works on: of the box, or of active tiles.
  template <typename Args>
  void dispatch(Commands& commands, const Kernel<Args>& kernel, std::uint32_t axis,
                const Args& args) const {
    if (tiles) {
      tiles->dispatch(commands, kernel, axis < 3 ? tile_faces + 3 * axis : tile_cells, args);
    } else {
      commands.dispatch(kernel, threads(int(axis)), args);
    }
  }
  /// What specialises kernels for that.
  Specialization tiled() const { return {2, tiles ? 1u : 0u}; }

  ivec3 cells;
  bool with_solids;  ///< solids, air, or tiles: types and open fractions are used
  Buffer<FluidSolidRecord> solids;
  Buffer<FluidSourceRecord> sources;
  Buffer<FluidScene> scene;
  Buffer<FluidClock> clock;
  FaceBuffers velocity, other, third;
  FaceBuffers open, boundary;  ///< with solids
  Buffer<std::uint32_t> types;
  std::unique_ptr<TileLists> tiles;  ///< of a sparse fluid
};

/// The scene as the kernels see it. Throws what check_fluid_problem throws.
FluidScene scene_of(const FluidProblem& problem);

}  // namespace parity::gpu
