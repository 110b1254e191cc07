#pragma once

#include "sim/drawing.h"

namespace parity::cpu {

/// A picture of a simulation: particles as shaded balls, solids and a floor, light dimmed by a
/// volume, smoke in it.
///
///   sample   the middle of one of samples x samples squares of a pixel; a pixel is their mean
///   surface  the nearest of particles, solids and the floor along the ray
///   shading  color (max(n.l, 0) sun S L + sky(n) A) + shine max(n.h, 0)^40 sun S; sky(n) goes from
///            ground to sky colour with n.y; faded into the horizon by 1 - exp(-(t / fade)^2)
///   L        0 if the ray towards the sun meets a solid
///   S, A     what the volume lets through of sun and sky, one and a half cells off the surface:
///            linear between cells inside it; outside, S where the ray towards the sun enters, A at
///            the nearest point of the volume, going to 1 within a quarter of its height
///   smoke    along the ray in steps of 0.6 cells, value v at the middle of each: 1 - exp(-v w) of
///            medium (phase sun S L + A (sky + ground) / 2) is added, exp(-v w) of the rest passes;
///            ends when 1/500 is left
///
/// S and A of cells by short characteristics from the top down: the light at the point where the
/// way up crosses the next layer, linear between its cells, times exp(-w (v + v') / 2).
///
/// @return  linear RGB, alpha 1.
/// @throws std::invalid_argument  as check_drawn_scene.
///
/// Source: notes 6.1, 7.2; Max 1995, "Optical models for direct volume rendering"; Kunasz & Auer
/// 1988, "Short characteristic integration of radiative transfer problems".
Grid<dvec4> draw_scene(const DrawnScene& scene);

}  // namespace parity::cpu
