#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

/// The names of GLM that Parity uses. Column vectors, right-handed, clip depth 0 (near) to 1 (far).
/// Quaternions print and store as (x, y, z, w); `quat(w, x, y, z)` constructs.
namespace parity {

using glm::dmat2, glm::dmat3, glm::dmat4;
using glm::dvec2, glm::dvec3, glm::dvec4;
using glm::ivec2, glm::ivec3, glm::ivec4;
using glm::mat2, glm::mat3, glm::mat4;
using glm::quat, glm::dquat;
using glm::u8vec4;
using glm::uvec2, glm::uvec3, glm::uvec4;
using glm::vec2, glm::vec3, glm::vec4;

}  // namespace parity
