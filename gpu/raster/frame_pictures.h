#pragma once

#include <vector>

#include "geometry/frame.h"
#include "gpu/core/buffer.h"
#include "shaders/raster/scene_layout.h"

namespace parity::gpu {

/// The pictures that a frame is lit by, on the device: its environment, shadow maps, openness, and
/// what is behind glass. Uploaded once for all frames that share them.
class FramePictures {
 public:
  FramePictures(Context& context, const Frame& frame);

  BufferRef<SceneEnvironment> environment() const { return environment_; }
  /// Of a shadow of the frame, map after map.
  BufferRef<float> shadow_depths(std::size_t shadow) const { return shadow_depths_[shadow]; }
  BufferRef<float> openness() const { return openness_; }
  /// Level after level.
  BufferRef<vec4> behind() const { return behind_; }

 private:
  Buffer<vec4> mirrors_;  ///< of the environment
  Buffer<vec4> irradiance_;
  Buffer<SceneEnvironment> environment_;
  std::vector<Buffer<float>> shadow_depths_;
  Buffer<float> openness_;
  Buffer<vec4> behind_;
};

}  // namespace parity::gpu
