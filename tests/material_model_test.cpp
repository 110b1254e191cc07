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
  // What several bounces add is no line between the two.
  const auto at = [&](float metallic) {
    return TurnedSquare(plain(color, metallic, 0.2f), 60).lit();
  };
  const auto dielectric = at(0), half = at(0.5f), metal = at(1);
  for (std::size_t side = 0; side < 2; ++side)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(half[side][c], (dielectric[side][c] + metal[side][c]) / 2, 1e-3) << c;
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
