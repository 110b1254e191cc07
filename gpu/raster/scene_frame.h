#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/frame.h"
#include "gpu/core/buffer.h"
#include "gpu/raster/frame_pictures.h"
#include "gpu/raster/painter.h"
#include "gpu/raster/scene_buffers.h"

namespace parity::gpu {

/// Host copy of what is blended: its elements are sorted anew for every frame.
class BlendedPrimitives {
 public:
  explicit BlendedPrimitives(const Scene& scene);

  /// Elements of all blended draws, farthest centroid first, equal ones in the order of the scene:
  /// draw and first index of each. Sorted on the device.
  std::vector<uvec2> order(Context& context, const Frame& frame);

 private:
  struct Elements {
    Topology topology = Topology::triangles;
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;
  };
  std::map<std::pair<int, int>, Elements> elements_;  ///< by mesh and primitive
  std::optional<PainterOrder> sorter_;
  std::size_t capacity_ = 0;  ///< of the sorter
};

/// A frame on the device: what all its shaders read.
class SceneFrame {
 public:
  /// @param pictures  of the frame, or of one that differs from it in its view only; outlive this.
  /// @throws std::invalid_argument  logarithmic depth without a far plane.
  SceneFrame(Context& context, const SceneBuffers& scene, BlendedPrimitives& blended,
             const Frame& frame, const FramePictures& pictures);

  const SceneArgs& args() const { return args_; }
  /// The same for one draw: what it is drawn from and its material stand first.
  SceneArgs args_of(std::size_t draw) const;
  bool has_placed_lights() const { return has_placed_lights_; }
  bool has_shadows() const { return has_shadows_; }
  const std::vector<SceneDraw>& draws() const { return draws_; }
  const std::vector<uvec2>& order() const { return order_; }
  std::uint64_t triangle_count() const { return triangle_count_; }

 private:
  std::vector<SceneDraw> draws_;  ///< as Frame::draws
  std::vector<uvec2> order_;
  Buffer<SceneDraw> draw_buffer_;
  Buffer<SceneLight> light_buffer_;
  Buffer<uvec2> order_buffer_;
  Buffer<SceneShadow> shadow_buffer_;
  Buffer<SceneScreen> screen_;
  SceneArgs args_{};
  bool has_shadows_ = false;
  bool has_placed_lights_ = false;  ///< points or spots
  std::uint64_t triangle_count_ = 0;
};

}  // namespace parity::gpu
