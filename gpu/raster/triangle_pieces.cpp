#include "gpu/raster/triangle_pieces.h"

#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {

TrianglePieces::TrianglePieces(Context& context, const RasterTarget& target,
                               std::uint32_t depth_mode, std::uint32_t triangle_capacity)
    : target_(target),
      depth_mode_(depth_mode),
      triangle_capacity_(triangle_capacity),
      count_pieces_(context, shaders::raster_piece_count_comp),
      set_up_(context, shaders::raster_piece_setup_comp),
      prefix_sum_(context, std::size_t{triangle_capacity} + 1),
      offsets_(context, std::size_t{triangle_capacity} + 1),
      count_(context, 1),
      pieces_(context, std::size_t{triangle_capacity} + 1024) {}

void TrianglePieces::record(Commands& commands, const TriangleSource& source) {
  const std::uint32_t triangles = source.triangle_count;
  if (triangles > triangle_capacity_ || source.first_element < 1)
    throw std::invalid_argument("TrianglePieces::record: triangle_count is " +
                                std::to_string(triangles) + ", first_element is " +
                                std::to_string(source.first_element) + ", must be at most " +
                                std::to_string(triangle_capacity_) + " and at least 1");
  commands.dispatch(count_pieces_, {triangles + 1}, {source, target_, offsets_});
  prefix_sum_.record(commands, offsets_, triangles + 1);
  commands.copy(offsets_, count_, triangles, 0, 1);
  commands.dispatch(set_up_, {triangles},
                    {source, target_, offsets_, pieces_, capacity(), depth_mode_});
}

bool TrianglePieces::fit(Context& context) {
  const std::uint32_t count = count_.read()[0];
  if (count <= capacity()) return true;
  pieces_ = {};
  pieces_ = Buffer<TrianglePiece>(context, std::size_t{count} + count / 4);
  return false;
}

}  // namespace parity::gpu
