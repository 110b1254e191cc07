#pragma once

#include <numbers>

#include "cpu_reference/shading/behind.h"
#include "cpu_reference/shading/lookup.h"
#include "cpu_reference/shading/triple.h"
#include "geometry/albedo_table.h"

namespace parity::cpu {

constexpr double least_n_dot_v = 1e-4;

/// Reflectance of the border of a layer of index 1.5.
constexpr double coat_f0 = 0.04;

/// A point of a surface with all its layers. Real is double or Interval.
template <class Real>
struct Surface {
  Triple<Real> normal;  ///< unit, on the side of the eye
  Triple<Real> to_eye;
  Real n_dot_v{};

  Triple<Real> diffuse;  ///< albedo
  Triple<Real> f0;
  Real f90{1.0};
  Real body_f0{}, body_f90{};  ///< of the border over the diffuse part, in its largest channel
  Real roughness{};
  Real alpha_squared{};  ///< roughness^4
  Real metallic{};
  bool metal = false;                 ///< anywhere
  Triple<Real> plastic_f0, metal_f0;  ///< what f0 is mixed from
  Triple<Real> albedo;                ///< of the table: slope, offset, mean

  bool stretched = false;
  Triple<Real> along, across;
  Real alpha_along{}, alpha_across{};

  bool coated = false;
  Triple<Real> coat_normal;
  Real coat_roughness{}, coat_n_dot_v{}, coat_weight{};

  bool fibrous = false;
  Triple<Real> sheen;
  Real sheen_roughness{}, sheen_albedo{};

  bool transmits = false;
  Triple<Real> tint;  ///< what passes through the body
  Real transmission{};
  bool thick = false;
  bool see_through = false;  ///< what is behind is blended
  Real index{1.5};
  Real depth{};           ///< m, along the refracted ray
  Triple<Real> position;  ///< relative to the eye
};

/// D V of an isotropic GGX: glTF 2.0, B.3.2.
template <class Real>
Real isotropic_lobe(const Real& alpha_squared, const Real& n_dot_h, const Real& n_dot_l,
                    const Real& n_dot_v) {
  const Real one_less = Real(1.0) - alpha_squared;
  const Real shape = Real(1.0) - square(n_dot_h) * one_less;
  const Real d = alpha_squared / (rounded<Real>(std::numbers::pi) * square(shape));
  const Real toward_eye = n_dot_l * square_root(square(n_dot_v) * one_less + alpha_squared);
  const Real toward_light = n_dot_v * square_root(square(n_dot_l) * one_less + alpha_squared);
  return d * (Real(0.5) / (toward_eye + toward_light));
}

/// D V of a GGX stretched along the tangent. Source: KHR_materials_anisotropy, "Implementation".
template <class Real>
Real stretched_lobe(const Surface<Real>& s, const Triple<Real>& l, const Triple<Real>& h,
                    const Real& n_dot_h, const Real& n_dot_l) {
  const Real spread = square(dot(s.along, h) / s.alpha_along) +
                      square(dot(s.across, h) / s.alpha_across) + square(n_dot_h);
  const Real area = s.alpha_along * s.alpha_across;
  const Real d = Real(1.0) / (rounded<Real>(std::numbers::pi) * area * square(spread));
  const auto slant = [&](const Triple<Real>& w, const Real& cosine) {
    return square_root(square(s.alpha_along * dot(s.along, w)) +
                       square(s.alpha_across * dot(s.across, w)) + square(cosine));
  };
  return d * (Real(0.5) / (n_dot_l * slant(s.to_eye, s.n_dot_v) + s.n_dot_v * slant(l, n_dot_l)));
}

/// What several bounces between the microfacets of a metal add. Source: Kulla & Conty 2017.
template <class Real>
Triple<Real> bounced_lobe(const Surface<Real>& s, const Real& n_dot_l) {
  const Triple<Real> toward_light = tabulated_albedo(albedo_table(), n_dot_l, s.roughness);
  const Real& mean = s.albedo.z;
  const Real lost =
      (Real(1.0) - (toward_light.x + toward_light.y)) * (Real(1.0) - (s.albedo.x + s.albedo.y));
  const Real lobe = lost / (rounded<Real>(std::numbers::pi) * most(Real(1.0) - mean, Real(1e-6)));
  const auto channel = [&](const Real& f0) {
    const Real f = f0 + (Real(1.0) - f0) * rounded<Real>(1.0 / 21);
    return lobe * (square(f) * mean / (Real(1.0) - f * (Real(1.0) - mean)));
  };
  return {channel(s.metal_f0.x), channel(s.metal_f0.y), channel(s.metal_f0.z)};
}

/// Charlie's distribution times the visibility of Neubelt & Pettineo, for a white sheen.
template <class Real>
Real sheen_lobe(const Surface<Real>& s, const Real& n_dot_h, const Real& n_dot_l) {
  const Real inverse = Real(1.0) / square(s.sheen_roughness);
  const Real sine2 = most(Real(1.0) - square(n_dot_h), Real(1e-7));
  const Real d = (Real(2.0) + inverse) * exp2_of(Real(0.5) * inverse * log2_of(sine2)) /
                 rounded<Real>(2 * std::numbers::pi);
  return d / (Real(4.0) * (n_dot_l + s.n_dot_v - n_dot_l * s.n_dot_v));
}

/// BRDF of all layers times the cosine of the light. Source: glTF 2.0, B.3; KHR_materials_*.
template <class Real>
Triple<Real> reflected(const Surface<Real>& s, const Triple<Real>& to_light, const Real& n_dot_l) {
  const Triple<Real> h = normalized(s.to_eye + to_light);
  const Real n_dot_h = clamped(dot(s.normal, h), 0, 1);
  const Real v_dot_h = clamped(dot(s.to_eye, h), 0, 1);
  const Real lobe = s.stretched ? stretched_lobe(s, to_light, h, n_dot_h, n_dot_l)
                                : isotropic_lobe(s.alpha_squared, n_dot_h, n_dot_l, s.n_dot_v);
  const Real fresnel = fifth_power(clamped(Real(1.0) - v_dot_h, 0, 1));
  const Triple<Real> f = s.f0 + (all(s.f90) - s.f0) * fresnel;
  const Real entering = Real(1.0) - (s.body_f0 + (s.body_f90 - s.body_f0) * fresnel);
  Triple<Real> diffuse = s.diffuse * (entering * rounded<Real>(std::numbers::inv_pi));
  if (s.transmits) diffuse = diffuse * (Real(1.0) - s.transmission);
  Triple<Real> sum = diffuse + f * lobe;
  if (s.metal) sum = sum + bounced_lobe(s, n_dot_l) * s.metallic;
  if (s.fibrous) {
    const Real toward_light = tabulated_sheen(albedo_table(), n_dot_l, s.sheen_roughness);
    const Real taken = largest(s.sheen) * most(s.sheen_albedo, toward_light);
    sum = sum * most(Real(1.0) - taken, Real(0.0)) + s.sheen * sheen_lobe(s, n_dot_h, n_dot_l);
  }
  sum = sum * n_dot_l;
  if (!s.coated) return sum;
  const Real coat_n_dot_l = clamped(dot(s.coat_normal, to_light), 0, 1);
  const Real coat_n_dot_h = clamped(dot(s.coat_normal, h), 0, 1);
  sum = sum * (Real(1.0) - s.coat_weight);
  if (vanishes(coat_n_dot_l)) return sum;
  const Real coat =
      isotropic_lobe(square(square(s.coat_roughness)), coat_n_dot_h, coat_n_dot_l, s.coat_n_dot_v);
  return sum + all(s.coat_weight * coat * coat_n_dot_l);
}

/// Light from all around: radiance of mirrors by direction and roughness, irradiance over pi by
/// normal; the same everywhere without a picture of it.
struct Surroundings {
  dvec3 uniform{0.0};
  const EnvironmentLight* light = nullptr;
  const BehindPicture* behind = nullptr;  ///< what is opaque; may be null
  dvec3 eye{0.0};
};

template <class Real>
Triple<Real> mirror_radiance(const Surroundings& around, const Triple<Real>& direction,
                             const Real& roughness) {
  return around.light ? mirrored(*around.light, direction, roughness)
                      : triple<Real>(around.uniform);
}

template <class Real>
Triple<Real> mean_radiance(const Surroundings& around, const Triple<Real>& normal) {
  return around.light ? irradiance_over_pi(*around.light, normal) : triple<Real>(around.uniform);
}

/// Where most of the light of a rough mirror comes from, of any length: the mirror's way, which
/// gives way to the normal as roughness grows.
/// Source: Lagarde & de Rousiers 2014, "Moving Frostbite to PBR", 4.9.3.
template <class Real>
Triple<Real> reflection(const Triple<Real>& to_eye, const Triple<Real>& normal,
                        const Real& roughness) {
  const Triple<Real> mirror = normal * (Real(2.0) * dot(normal, to_eye)) - to_eye;
  const Real smooth = most(Real(1.0) - square(roughness), Real(0.0));
  const Real part = smooth * (square_root(smooth) + square(roughness));
  return normal * (Real(1.0) - part) + mirror * part;
}

/// Light from all around as a lobe gathers it, and its albedo by slope and offset in F0.
template <class Real>
struct Gathered {
  Triple<Real> radiance;
  Real slope{}, offset{};
};

/// GGX's slopes along the stretch have the distribution x / sqrt(1 + x^2) in units of its width
/// there; eight half vectors stand in the middle of an eighth of it each. A tap is as rough as the
/// lobe is across at its slope, at least as half vectors are apart; light is weighed by its cosine.
/// The mirror of the isotropic surface counts a thousandth, so that there is always something.
template <class Real>
Gathered<Real> gather_streak(const Surface<Real>& s, const Surroundings& around) {
  constexpr int taps = 8;
  const Triple<Real> eye =
      s.to_eye - s.normal * (Real(2.0) * least(dot(s.normal, s.to_eye), Real(0.0)));
  const auto slant = [&](const Triple<Real>& w, const Real& cosine) {
    return square_root(square(s.alpha_along * dot(s.along, w)) +
                       square(s.alpha_across * dot(s.across, w)) + square(cosine));
  };
  const Real eye_slant = slant(eye, s.n_dot_v);
  const Real little = rounded<Real>(0.001);
  Gathered<Real> sum{
      mirror_radiance(around, reflection(s.to_eye, s.normal, s.roughness), s.roughness) * little};
  Real weight = little;
  for (int k = 0; k < taps; ++k) {
    const double part = (k + 0.5) / taps, x = 2 * part - 1, rise = 1 / std::sqrt(1 - x * x);
    const Triple<Real> h =
        normalized(s.normal + s.along * (s.alpha_along * rounded<Real>(x * rise)));
    const Real up = most(dot(s.normal, h), rounded<Real>(0.01));
    const Real facing = most(dot(eye, h), Real(0.0));
    const Triple<Real> light = h * (Real(2.0) * facing) - eye;
    const Real cosine = most(dot(s.normal, light), Real(0.0));
    const Real across = s.alpha_across * rounded<Real>(rise) * up;
    const Real apart = s.alpha_along * rounded<Real>(std::pow(rise, 3) / taps) * square(up);
    const Real wide = least(most(across, apart), Real(1.0));
    sum.radiance = sum.radiance + mirror_radiance(around, light, square_root(wide)) * cosine;
    weight = weight + cosine;
    const Real both = cosine * eye_slant + s.n_dot_v * slant(light, cosine);
    const Real share = cosine * facing * Real(2.0 / taps) / (up * both);
    const Real grazing = fifth_power(clamped(Real(1.0) - facing, 0, 1));
    sum.slope = sum.slope + share * (Real(1.0) - grazing);
    sum.offset = sum.offset + share * grazing;
  }
  const Real all_back = most(sum.slope + sum.offset, Real(1.0));
  const Real inverse = Real(1.0) / weight;
  return {sum.radiance * inverse, sum.slope / all_back, sum.offset / all_back};
}

/// The same of an isotropic surface by one lookup and the table.
template <class Real>
Gathered<Real> gather(const Surface<Real>& s, const Surroundings& around) {
  if (s.stretched) return gather_streak(s, around);
  return {mirror_radiance(around, reflection(s.to_eye, s.normal, s.roughness), s.roughness),
          s.albedo.x, s.albedo.y};
}

/// Where the light that a sheen sends to the eye comes from in the mean, a unit vector: from the
/// eye's side of the normal, the lower the smoother the fibres are. The factor fits the mean
/// direction of the lobe.
template <class Real>
Triple<Real> sheen_direction(const Surface<Real>& s) {
  const Triple<Real> aside = s.to_eye - s.normal * dot(s.normal, s.to_eye);
  const Real r = s.sheen_roughness;
  return normalized(s.normal + aside * (rounded<Real>(0.24) / (r * square_root(r))));
}

/// The way of the eye's ray within a surface that light passes: refracted unless it is thin.
template <class Real>
Triple<Real> way_through(const Surface<Real>& s) {
  if (!s.thick) return s.to_eye * Real(-1.0);
  const Real ratio = Real(1.0) / s.index;
  const Real cosine = dot(s.normal, s.to_eye);
  const Real inside =
      square_root(most(Real(1.0) - square(ratio) * (Real(1.0) - square(cosine)), Real(0.0)));
  return s.normal * (ratio * cosine - inside) - s.to_eye * ratio;
}

/// What comes from all around, and how much of what is behind is to be seen.
template <class Real>
struct Surrounded {
  Triple<Real> radiance;
  Real open{};  ///< 0 to 1
};

/// What passes a surface: the opaque where it is, else the surroundings. What all channels pass
/// alike of what is empty behind the surface both straight and refracted is left to blending,
/// unless a picture of the surroundings fills it; without a picture of the opaque, wherever that
/// is.
template <class Real>
Surrounded<Real> passed(const Surface<Real>& s, const Surroundings& around,
                        const Triple<Real>& passing) {
  const Real rough = s.roughness * clamped(Real(2.0) * s.index - Real(2.0), 0.0, 1.0);
  const Triple<Real> way = way_through(s);
  const Triple<Real> beyond = mirror_radiance(around, way, rough);
  Real open{0.0};
  if (s.see_through) open = clamped(smallest(passing), 0.0, 1.0 - 1.0 / 256);
  if (around.behind == nullptr) return {(passing - all(open)) * beyond, open};
  const auto seen = picture_behind(*around.behind, around.eye, s.position + way * s.depth, rough);
  const Real empty = Real(1.0) - seen[3];
  const auto straight = picture_behind(*around.behind, around.eye, s.position, Real(0.0));
  open = around.light ? Real(0.0) : open * empty * (Real(1.0) - straight[3]);
  return {
      passing * Triple<Real>{seen[0], seen[1], seen[2]} + (passing * empty - all(open)) * beyond,
      open};
}

/// Source: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based
/// Lighting"; KHR_materials_*.
///
/// @param openness  share of the light that is not mirrored that arrives.
template <class Real>
Surrounded<Real> surrounded(const Surface<Real>& s, const Surroundings& around, double openness) {
  const Gathered<Real> mirror = gather(s, around);
  const Triple<Real> mean = mean_radiance(around, s.normal) * Real(openness);
  const Real lost = Real(1.0) - (mirror.slope + mirror.offset);
  const auto once = [&](const Real& f0, const Real& f90) {
    return f0 * mirror.slope + f90 * mirror.offset;
  };
  const auto several = [&](const Real& f0, const Real& f90) {
    const Real f = f0 + (f90 - f0) * rounded<Real>(1.0 / 21);
    return once(f0, f90) * f / (Real(1.0) - lost * f) * lost;
  };
  const auto mixed = [&](const Real& plastic, const Real& metal) {
    const Real dielectric = several(plastic, s.body_f90) * (Real(1.0) - s.metallic);
    return s.metal ? dielectric + several(metal, Real(1.0)) * s.metallic : dielectric;
  };
  const Triple<Real> single{once(s.f0.x, s.f90), once(s.f0.y, s.f90), once(s.f0.z, s.f90)};
  const Triple<Real> more{mixed(s.plastic_f0.x, s.metal_f0.x), mixed(s.plastic_f0.y, s.metal_f0.y),
                          mixed(s.plastic_f0.z, s.metal_f0.z)};
  const Real entering = Real(1.0) - once(s.body_f0, s.body_f90) - several(s.body_f0, s.body_f90);
  Surrounded<Real> result{{}, Real(0.0)};
  Triple<Real> body = s.diffuse * mean * entering;
  if (s.transmits) {
    const Triple<Real> passing = s.tint * (entering * s.transmission);
    const Surrounded<Real> through = passed(s, around, passing);
    result.open = through.open;
    body = body * (Real(1.0) - s.transmission) + through.radiance;
  }
  result.radiance = single * mirror.radiance + more * mean + body;
  if (s.fibrous) {
    const Real keep = most(Real(1.0) - largest(s.sheen) * s.sheen_albedo, Real(0.0));
    const Triple<Real> light = mean_radiance(around, sheen_direction(s)) * Real(openness);
    result.radiance = result.radiance * keep + s.sheen * s.sheen_albedo * light;
    result.open = result.open * keep;
  }
  if (s.coated) {
    const Triple<Real> albedo = tabulated_albedo(albedo_table(), s.coat_n_dot_v, s.coat_roughness);
    const Triple<Real> coat = mirror_radiance(
        around, reflection(s.to_eye, s.coat_normal, s.coat_roughness), s.coat_roughness);
    const Real keep = Real(1.0) - s.coat_weight;
    result.radiance = result.radiance * keep + coat * (s.coat_weight * (albedo.x + albedo.y));
    result.open = result.open * keep;
  }
  return result;
}

}  // namespace parity::cpu
