// Values between the points of a staggered grid, and where fluid comes from. Needs fluid/grid.glsl.
// Source: notes 10.4; Stam 1999; Bridson 2015, chapter 3.

float read_field(FluidFaces faces, ref_float field, uint axis, uint index) {
  return axis < 3u ? read_face(faces, axis, index) : field.at[index];
}

/// The lower point around a coordinate, the upper one, and how far between them. Beyond the outermost
/// points the value there stands, or that of the other end of a periodic axis.
void between(FluidScene scene, uint d, int count, float at, out int low, out int high, out float part) {
  if (wraps(scene, d)) {
    const int period = int(scene.cells[d]);
    const float whole = floor(at);
    low = int(whole) % period;
    low += low < 0 ? period : 0;
    high = low + 1 == period ? 0 : low + 1;
    part = at - whole;
    return;
  }
  const float inside = clamp(at, 0.0, float(count - 1));
  low = min(int(inside), max(count - 2, 0));
  high = min(low + 1, count - 1);
  part = inside - float(low);
}

struct Sampled {
  float value;
  float low;  ///< smallest and largest of the points around
  float high;
};

/// A field at a place, in cells from the domain's corner; axis 3: of cells.
Sampled sample_field(FluidScene scene, FluidFaces faces, ref_float field, uint axis, vec3 place) {
  const ivec3 size = points_of(scene.cells, axis);
  ivec3 low, high;
  vec3 part;
  for (uint d = 0u; d < 3u; ++d) {
    precise float at = place[d] - (d == axis ? 0.0 : 0.5);
    between(scene, d, size[d], at, low[d], high[d], part[d]);
  }
  Sampled result = Sampled(0.0, 3.4e38, -3.4e38);
  precise float value = 0.0;
  const uint corners = scene.cells.z == 1u ? 4u : 8u;
  for (uint k = 0u; k < corners; ++k) {
    const bvec3 up = bvec3((k & 1u) != 0u, (k & 2u) != 0u, (k & 4u) != 0u);
    const float v = read_field(faces, field, axis, point_index(size, mix(low, high, up)));
    const vec3 weights = mix(1.0 - part, part, up);
    value += weights.x * weights.y * (corners == 4u ? 1.0 : weights.z) * v;
    result.low = min(result.low, v);
    result.high = max(result.high, v);
  }
  result.value = value;
  return result;
}

vec3 velocity_at(FluidScene scene, FluidFaces velocity, vec3 place) {
  vec3 u = vec3(0.0);
  for (uint d = 0u; d < 3u; ++d)
    if (scene.cells[d] > 1u || wraps(scene, d))
      u[d] = sample_field(scene, velocity, velocity.x, d, place).value;
  return u;
}

/// Where the fluid at a place was `cells_per_speed` (step / spacing) ago: Runge-Kutta of order 2
/// (midpoint) or 3 (Ralston).
vec3 trace_back(FluidScene scene, FluidFaces velocity, vec3 place, float cells_per_speed) {
  const vec3 first = velocity_at(scene, velocity, place);
  const vec3 second = velocity_at(scene, velocity, place - 0.5 * cells_per_speed * first);
  if (scene.back_trace == 2u) return place - cells_per_speed * second;
  const vec3 third = velocity_at(scene, velocity, place - 0.75 * cells_per_speed * second);
  return place - cells_per_speed * (2.0 * first + 3.0 * second + 4.0 * third) / 9.0;
}

/// In cells from the domain's corner.
vec3 place_of(uint axis, ivec3 at) {
  return vec3(at) + vec3(axis == 0u ? 0.0 : 0.5, axis == 1u ? 0.0 : 0.5, axis == 2u ? 0.0 : 0.5);
}
