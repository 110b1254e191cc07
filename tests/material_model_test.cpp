#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/shading/prefilter.h"
#include "cpu_reference/shading/thin_film.h"
#include "tests/renderer_scene.h"

/// What both renderers make of the material models of glTF, against closed forms.
namespace parity {
namespace {

using std::numbers::pi;

/// A square that is turned about its y axis, so that it is seen at an angle to its normal, which
/// leans toward +x.
struct TurnedSquare {
  TestScene stage;
  double angle;

  TurnedSquare(const Material& material, double degrees) : angle(degrees * pi / 180) {
    stage.scene.materials.push_back(material);
    stage.add(square(3, 0), dmat4(glm::mat3_cast(glm::angleAxis(angle, dvec3(0, 1, 0)))));
  }

  /// In the middle, by the reference and by the device.
  std::array<vec3, 2> shown(const Frame& frame) const {
    return {vec3(middle(cpu::render(stage.scene, frame).picture)),
            vec3(middle(gpu::render(test_context(), stage.scene, frame,
                                    {.elements = false, .full_float = true})))};
  }
  /// Lit from the viewer's side, at that angle.
  std::array<vec3, 2> lit() {
    stage.scene.lights.clear();
    stage.scene.nodes.resize(2);
    stage.add_light(directional(1));
    return shown(stage.frame());
  }
  std::array<vec3, 2> surrounded(const EnvironmentLight* light) const {
    Frame frame = stage.frame();
    frame.lights.clear();
    frame.ambient = vec3(1);
    if (light) frame.environment = *light;
    return shown(frame);
  }
};

Material plain(const vec3& color, float metallic, float roughness) {
  Material m;
  m.base_color = vec4(color, 1);
  m.metallic = metallic;
  m.roughness = roughness;
  return m;
}

/// 1 - slope * x toward direction (x, y, z), in the horizontal plane as everywhere.
EnvironmentLight slanted_sky(float slope) {
  Grid<vec4> picture{64, 32};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const double theta = pi * (y + 0.5) / 32, phi = 2 * pi * ((x + 0.5) / 64 - 0.5);
      picture(x, y) = vec4(vec3(float(1 - double(slope) * std::sin(theta) * std::sin(phi))), 1);
    }
  return cpu::prefilter(environment_map(picture, 64), 256);
}

TEST_F(GpuRenderer, HalfMetalIsTheMeanOfMetalAndDielectric) {
  const vec3 color{0.9f, 0.6f, 0.2f};
  const auto at = [&](float metallic) {
    return TurnedSquare(plain(color, metallic, 0.2f), 60).lit();
  };
  const auto dielectric = at(0), half = at(0.5f), metal = at(1);
  for (std::size_t side = 0; side < 2; ++side)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(half[side][c], (dielectric[side][c] + metal[side][c]) / 2, 1e-6) << c;
}

TEST_F(GpuRenderer, AColouredBorderDoesNotColourWhatIsUnderIt) {
  Material m = plain(vec3(0.5f), 0, 0.2f);
  m.ior = 3;  // F0 = 0.25
  m.specular.color = vec3(1, 0.2f, 0);
  const double degrees = 60, cosine = std::cos(degrees * pi / 180);
  // Eye and light are one direction: the half vector too.
  const double a2 = std::pow(0.2, 4), t = 1 - cosine * cosine * (1 - a2);
  const double lobe =
      a2 / (pi * t * t) * 0.25 / (cosine * std::sqrt(cosine * cosine * (1 - a2) + a2));
  const std::array<double, 3> f0{0.25, 0.05, 0};
  for (const vec3& got : TurnedSquare(m, degrees).lit())
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(got[c], ((1 - 0.25) * 0.5 / pi + f0[std::size_t(c)] * lobe) * cosine, 1e-5) << c;
}

TEST_F(GpuRenderer, ASmoothDielectricReflectsAsSchlickSays) {
  for (const double degrees : {0.0, 40.0, 60.0, 70.0, 80.0})
    for (const vec3& got : TurnedSquare(plain(vec3(0), 0, 0), degrees).surrounded(nullptr)) {
      const double rise = std::pow(1 - std::cos(degrees * pi / 180), 5);
      // The table of albedos is right to 0.004, and roughness 0.045 loses 1 % at 80 degrees.
      EXPECT_NEAR(got.x, 0.04 + 0.96 * rise, 0.008) << degrees;
    }
}

TEST_F(GpuRenderer, AMirrorUnderAFilmReflectsWhatTheFilmDoes) {
  Material m = plain(vec3(0), 0, 0);
  m.iridescence = {.factor = 1, .ior = 1.8f, .thickness_maximum = 300};
  for (const double degrees : {20.0, 50.0, 65.0}) {
    const double cosine = std::cos(degrees * pi / 180);
    const auto film = cpu::thin_film<double>(double(1.8f), 300.0, cosine, {0.04, 0.04, 0.04});
    // The table of albedos is right to 0.004; a film darker than Schlick's rise is not to be had.
    for (const vec3& got : TurnedSquare(m, degrees).surrounded(nullptr))
      expect_near(vec4(got, 1), vec4(film.x, film.y, film.z, 1), 0.015);
  }
}

/// The mean over half vectors by the quantiles of slopes of GGX, stretched along x, of light times
/// what is left of the BRDF: about the normal, which is z.
template <class Light>
double gathered(const dvec2& alpha, const dvec3& v, const Light& light) {
  constexpr int count = 300;
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double u = (i + 0.5) / count, phi = 2 * pi * (j + 0.5) / count;
      const double slope = std::sqrt(u / (1 - u));
      const dvec3 h = glm::normalize(
          dvec3(alpha.x * slope * std::cos(phi), alpha.y * slope * std::sin(phi), 1));
      const double v_h = glm::dot(v, h);
      const dvec3 l = 2 * v_h * h - v;
      if (!(v_h > 0) || !(l.z > 0)) continue;
      const auto slant = [&](const dvec3& w) {
        return std::hypot(alpha.x * w.x, alpha.y * w.y, w.z);
      };
      sum += light(l) * 2 * l.z * v_h / (h.z * (l.z * slant(v) + v.z * slant(l)));
    }
  return sum / (count * count);
}

TEST_F(GpuRenderer, StretchedMetalGathersItsStreak) {
  // White metal: what its lobe does not send back in one bounce comes back from everywhere. Eight
  // taps stand for a lobe as wide as the sky: 7 %; the plain mirror is off by 20 %.
  const EnvironmentLight sky = slanted_sky(0.9f);
  for (const double turn : {0.0, pi / 2})
    for (const double degrees : {20.0, 60.0}) {
      Material m = plain(vec3(1), 1, 0.3f);
      m.anisotropy = {.strength = 0.9f, .rotation = float(turn)};
      TurnedSquare turned(m, degrees);
      turned.stage.scene.meshes[0].primitives[0].tangents.assign(4, vec4(1, 0, 0, 1));
      const double a = degrees * pi / 180;
      const dvec2 alpha{0.09 + 0.91 * 0.81, 0.09};
      // In the frame of the stretch the eye is at -sin a of the square's own x, and the world's x
      // is (cos a, 0, sin a).
      const dvec3 v{-std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), std::cos(a)};
      const auto light = [&](const dvec3& l) {
        const double across = l.x * std::cos(turn) - l.y * std::sin(turn);
        return 1 - 0.9 * (across * std::cos(a) + l.z * std::sin(a));
      };
      const double kept = gathered(alpha, v, [](const dvec3&) { return 1.0; });
      const double want = gathered(alpha, v, light) + (1 - kept) * (1 - 0.6 * std::sin(a));
      for (const vec3& got : turned.surrounded(&sky))
        EXPECT_NEAR(got.x, want, 0.07) << turn << ", " << degrees;
    }
}

TEST_F(GpuRenderer, SheenIsLitFromTheSideOfTheEye) {
  const EnvironmentLight even = slanted_sky(0), slanted = slanted_sky(0.9f);
  const double a = pi / 3;
  // Light that a normal gathers has a mean direction of length 2/3, that of fibres of 0.57 to 0.75:
  // 0.9 times the difference. About the normal of the surface the sky is darker by 0.2.
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    Material m = plain(vec3(0), 0, 1);
    m.specular.strength = 0;
    m.sheen = {.color = vec3(1), .roughness = roughness};
    // The mean direction of Charlie's lobe: as above, by directions of light.
    const double inverse = 1 / std::pow(double(roughness), 2);
    const dvec3 v{-std::sin(a), 0, std::cos(a)};
    dvec3 mean{0.0};
    double all = 0;
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 200; ++j) {
        const double z = (i + 0.5) / 200, phi = 2 * pi * (j + 0.5) / 200, s = std::sqrt(1 - z * z);
        const dvec3 l{s * std::cos(phi), s * std::sin(phi), z};
        const double c = glm::normalize(l + v).z;
        const double share = std::pow(1 - c * c, inverse / 2) * z / (z + v.z - z * v.z);
        mean += l * share;
        all += share;
      }
    mean /= all;
    const double want = 1 - 0.9 * (mean.x * std::cos(a) + mean.z * std::sin(a));
    const TurnedSquare velvet(m, 60);
    const auto plainly = velvet.surrounded(&even), got = velvet.surrounded(&slanted);
    for (std::size_t side = 0; side < 2; ++side)
      EXPECT_NEAR(got[side].x / plainly[side].x, want, 0.09) << roughness;
  }
}

TEST_F(GpuRenderer, TheRoughestMirrorSeesTheSkyAboutItsNormal) {
  // Roughness 1 is D = 1 / pi, V = 1 / (2 (n.l + n.v)): the same all around the normal. A slant of
  // the sky across the normal takes from one side what it adds on the other; along the normal it
  // does not. Where the mirror looks, the sky is another one: 1 - 0.9 sin(2 * 60 - 60 degrees).
  const EnvironmentLight even = slanted_sky(0), slanted = slanted_sky(0.9f);
  const TurnedSquare across(plain(vec3(1), 1, 1), 0);
  const auto want = across.surrounded(&even), got = across.surrounded(&slanted);
  for (std::size_t side = 0; side < 2; ++side) EXPECT_NEAR(got[side].x / want[side].x, 1, 0.01);
  // Turned by 60 degrees, the normal is (sin, 0, cos): what is along it is 1 - 0.9 sin times the
  // mean cosine of light: 2/3 by the cosine alone, 0.6 to 0.7 with the lobe.
  const TurnedSquare aslant(plain(vec3(1), 1, 1), 60);
  const auto aslant_want = aslant.surrounded(&even), aslant_got = aslant.surrounded(&slanted);
  for (std::size_t side = 0; side < 2; ++side) {
    const double mean =
        (1 - double(aslant_got[side].x / aslant_want[side].x)) / (0.9 * std::sin(pi / 3));
    EXPECT_GT(mean, 0.55);
    EXPECT_LT(mean, 0.72);
  }
}

}  // namespace
}  // namespace parity
