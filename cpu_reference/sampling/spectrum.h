#pragma once

#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity::cpu {

/// The discrete Fourier transform of a complex picture, F(u, v) = sum f(x, y) exp(-2 pi i (u x / w
/// + v y / h)); frequency 0 at (0, 0), u / w cycles a pixel. Any size.
///
/// @param inverse  with exp(+...), divided by w h: undoes the other.
/// @throws std::invalid_argument  empty.
///
/// Source: notes 1.8; Cooley & Tukey 1965 (decimation in time, recursive, any factors).
Grid<dvec2> fourier_transform(const Grid<dvec2>& values, bool inverse);

/// The same by its definition, along each axis. O(w h (w + h)).
Grid<dvec2> fourier_sum(const Grid<dvec2>& values, bool inverse);

/// A grey picture as complex values, its mean taken away, under a Gaussian window of an eighth of
/// each side: the spectrum of a cosine is then a Gaussian of 1.3 bins, with sidelobes below 1e-3,
/// whatever its frequency. Its amplitude is divided by the mean of the window.
Grid<dvec2> windowed(const Grid<double>& picture);

/// A cosine in a real picture. Frequency in cycles a pixel, x >= 0, and y > 0 if x is 0.
struct SpectrumPeak {
  dvec2 frequency{0.0};
  double amplitude = 0;  ///< of the cosine
};

/// The strongest `count` peaks of a spectrum (of a real picture), strongest first: frequencies
/// whose magnitude no neighbour exceeds. Frequency 0 does not count. The place between bins and
/// the height there are the parabola's through the logarithms of the peak and its neighbours.
std::vector<SpectrumPeak> spectrum_peaks(const Grid<dvec2>& spectrum, int count);

/// What a sinusoid of frequency `f` looks like in samples at `rate` a unit: the frequency
/// |f - k rate|, k the integer that makes it least; at most rate / 2.
///
/// Source: notes 1.8; Shannon 1949.
/// Erratum: notes 1.8 call "sampling below the signal frequency" aliasing; it is sampling below
/// twice that frequency.
double alias_frequency(double f, double rate);

/// Apparent turn of a wheel of `spokes` from frame to frame, rad/s, in [-pi, pi] / (spokes T), when
/// it turns by `omega` rad/s and a frame is taken every `period` seconds.
///
/// Source: notes 1.8: omega modulo 2 pi / (spokes T), the value nearest 0.
double apparent_turn(double omega, int spokes, double period);

}  // namespace parity::cpu
