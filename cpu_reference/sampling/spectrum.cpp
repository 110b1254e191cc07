#include "cpu_reference/sampling/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace parity::cpu {
namespace {

using Complex = std::complex<double>;
using Line = std::vector<Complex>;

/// exp(2 pi i k / n), k modulo n, the angle in the first turn.
Complex root(std::size_t k, std::size_t n, double sign) {
  return std::polar(1.0, sign * 2 * std::numbers::pi * double(k % n) / double(n));
}

std::size_t smallest_factor(std::size_t n) {
  for (std::size_t p = 2; p * p <= n; ++p)
    if (n % p == 0) return p;
  return n;
}

/// out[k] = sum over i < n of in[i stride] w^(i k): the transforms of every p-th input, p the least
/// factor of n, put together. roots[k] are those of the whole line.
void transform(const Complex* in, std::size_t stride, Complex* out, std::size_t n,
               const Line& roots) {
  if (n == 1) {
    *out = *in;
    return;
  }
  const std::size_t p = smallest_factor(n), m = n / p, whole = roots.size();
  for (std::size_t r = 0; r < p; ++r) transform(in + r * stride, stride * p, out + r * m, m, roots);
  Line parts(p);
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t r = 0; r < p; ++r) parts[r] = out[r * m + k] * roots[r * k * (whole / n)];
    for (std::size_t q = 0; q < p; ++q) {
      Complex sum = parts[0];
      for (std::size_t r = 1; r < p; ++r) sum += parts[r] * roots[(r * q % p) * (whole / p)];
      out[q * m + k] = sum;
    }
  }
}

Line fast_line(const Line& in, double sign) {
  Line roots;
  for (std::size_t k = 0; k < in.size(); ++k) roots.push_back(root(k, in.size(), sign));
  Line out(in.size());
  transform(in.data(), 1, out.data(), in.size(), roots);
  return out;
}

Line summed_line(const Line& in, double sign) {
  Line out(in.size());
  for (std::size_t k = 0; k < in.size(); ++k)
    for (std::size_t i = 0; i < in.size(); ++i) out[k] += in[i] * root(i * k, in.size(), sign);
  return out;
}

template <typename TransformLine>
Grid<dvec2> transform_lines(const Grid<dvec2>& values, bool inverse,
                            const TransformLine& transform_line) {
  if (values.empty()) throw std::invalid_argument("cpu::fourier_transform: the picture is empty");
  const int w = values.width(), h = values.height();
  const double sign = inverse ? 1 : -1;
  const double scale = inverse ? 1.0 / double(values.size()) : 1.0;
  Grid<dvec2> result = values;
  const auto along = [&](int lines, int count, const auto& at) {
#pragma omp parallel for if (std::size_t(lines) * std::size_t(count) > 65536)
    for (int l = 0; l < lines; ++l) {
      Line line;
      for (int i = 0; i < count; ++i) line.emplace_back(at(l, i).x, at(l, i).y);
      line = transform_line(line, sign);
      for (int i = 0; i < count; ++i) {
        const Complex c = line[std::size_t(i)];
        at(l, i) = dvec2(c.real(), c.imag());
      }
    }
  };
  along(h, w, [&](int l, int i) -> dvec2& { return result(i, l); });
  along(w, h, [&](int l, int i) -> dvec2& { return result(l, i); });
  for (dvec2& value : result) value *= scale;
  return result;
}

struct Top {
  double place = 0;  ///< from the middle value, in [-1/2, 1/2]
  double rise = 0;   ///< above the middle value
};

/// The top of the parabola through three values.
Top parabola_top(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  if (!(bend < 0)) return {};
  const double place = std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
  const double most = std::log(0.5 * std::numbers::pi);  // without a window, half a bin away
  return {place, std::min(0.25 * (after - before) * place, most)};
}

}  // namespace

Grid<dvec2> fourier_transform(const Grid<dvec2>& values, bool inverse) {
  return transform_lines(values, inverse, fast_line);
}

Grid<dvec2> fourier_sum(const Grid<dvec2>& values, bool inverse) {
  return transform_lines(values, inverse, summed_line);
}

Grid<dvec2> windowed(const Grid<double>& picture) {
  const int w = picture.width(), h = picture.height();
  const auto window = [](int i, int count) {
    const double t = (i + 0.5 - 0.5 * count) / (0.125 * count);
    return count > 1 ? std::exp(-0.5 * t * t) : 1.0;
  };
  double weights = 0, sum = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const double weight = window(x, w) * window(y, h);
      weights += weight;
      sum += weight * picture(x, y);
    }
  Grid<dvec2> result{w, h};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      result(x, y) = {(picture(x, y) - sum / weights) * window(x, w) * window(y, h) *
                          double(picture.size()) / weights,
                      0};
  return result;
}

std::vector<SpectrumPeak> spectrum_peaks(const Grid<dvec2>& spectrum, int count) {
  const int w = spectrum.width(), h = spectrum.height();
  const auto magnitude = [&](int u, int v) {
    return glm::length(spectrum((u + w) % w, (v + h) % h));
  };
  std::vector<SpectrumPeak> peaks;
  for (int v = -(h - 1) / 2; v <= h / 2; ++v)
    for (int u = 0; u <= w / 2; ++u) {
      const double here = magnitude(u, v);
      if ((u == 0 && v <= 0) || !(here > 0)) continue;
      bool is_top = true;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) is_top = is_top && magnitude(u + du, v + dv) <= here;
      if (!is_top) continue;
      const auto logarithm = [&](int du, int dv) {
        return std::log(magnitude(u + du, v + dv) + 1e-12 * here);
      };
      const Top x =
          w > 2 ? parabola_top(logarithm(-1, 0), logarithm(0, 0), logarithm(1, 0)) : Top{};
      const Top y =
          h > 2 ? parabola_top(logarithm(0, -1), logarithm(0, 0), logarithm(0, 1)) : Top{};
      peaks.push_back({{(u + x.place) / w, (v + y.place) / h},
                       2 * here * std::exp(x.rise + y.rise) / double(spectrum.size())});
    }
  std::ranges::stable_sort(peaks, std::greater{}, &SpectrumPeak::amplitude);
  if (peaks.size() > std::size_t(std::max(count, 0))) peaks.resize(std::size_t(count));
  return peaks;
}

double alias_frequency(double f, double rate) { return std::abs(std::remainder(f, rate)); }

double apparent_turn(double omega, int spokes, double period) {
  return std::remainder(omega, 2 * std::numbers::pi / (spokes * period));
}

}  // namespace parity::cpu
