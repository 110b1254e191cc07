#include "gpu/sampling/spectrum.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {
namespace {

std::vector<vec2> roots_of_unity(std::uint32_t count, bool inverse) {
  std::vector<vec2> roots;
  roots.reserve(count);
  const double step = (inverse ? 2 : -2) * std::numbers::pi / count;
  for (std::uint32_t k = 0; k < count; ++k)
    roots.emplace_back(std::cos(step * k), std::sin(step * k));
  return roots;
}

std::uint32_t checked_side(const char* name, int side) {
  if (side < 1 || side > 16384)
    throw std::invalid_argument(std::string("gpu::FourierTransform: ") + name + " is " +
                                std::to_string(side) + ", must be 1 to 16384");
  return std::uint32_t(side);
}

}  // namespace

std::vector<std::uint32_t> fourier_radices(std::uint32_t count) {
  std::vector<std::uint32_t> radices;
  std::uint32_t left = count;
  for (std::uint32_t factor : {4u, 2u, 3u, 5u})
    for (; left % factor == 0; left /= factor) radices.push_back(factor);
  for (std::uint32_t factor = 7; left > 1; factor += 2) {
    if (factor * factor > left) factor = left;
    for (; left % factor == 0; left /= factor) radices.push_back(factor);
  }
  return radices;
}

double fourier_error_bound(int width, int height) {
  double bound = 0x1p-24;
  for (const int side : {width, height})
    for (const std::uint32_t r : fourier_radices(std::uint32_t(side)))
      bound += std::sqrt(double(r)) * (r + 6) * 0x1p-24;
  return bound;
}

FourierTransform::FourierTransform(Context& context, int width, int height, bool inverse)
    : size_(checked_side("width", width), checked_side("height", height)),
      inverse_(inverse),
      prime_(context, shaders::sampling_spectrum_prime_comp),
      roots_x_(context, roots_of_unity(size_.x, inverse)),
      roots_y_(context, roots_of_unity(size_.y, inverse)),
      other_(context, std::size_t(size_.x) * size_.y) {
  plan(true, size_.x);
  plan(false, size_.y);
  for (const Pass& pass : passes_)
    if (pass.radix <= 5)
      butterflies_.try_emplace(
          pass.radix, context, shaders::sampling_spectrum_comp,
          std::vector<Specialization>{{0, pass.radix}, {1, inverse ? 1u : 0u}});
}

void FourierTransform::plan(bool along_x, std::uint32_t count) {
  std::uint32_t done = 1;
  for (const std::uint32_t radix : fourier_radices(count)) {
    passes_.push_back({along_x, radix, done});
    done *= radix;
  }
}

void FourierTransform::record(Commands& commands, const Buffer<vec2>& data) {
  if (data.count() != other_.count())
    throw std::invalid_argument("gpu::FourierTransform: " + std::to_string(data.count()) +
                                " values, must be " + std::to_string(other_.count()));
  BufferRef<vec2> from = data;
  BufferRef<vec2> to = other_;
  for (const Pass& pass : passes_) {
    const bool last = &pass == &passes_.back();
    const std::uint32_t count = pass.along_x ? size_.x : size_.y;
    const std::uint32_t lines = pass.along_x ? size_.y : size_.x;
    const SpectrumArgs args{.from = from,
                            .to = to,
                            .roots = pass.along_x ? roots_x_ : roots_y_,
                            .count = count,
                            .lines = lines,
                            .element_stride = pass.along_x ? 1 : size_.x,
                            .line_stride = pass.along_x ? size_.x : 1,
                            .radix = pass.radix,
                            .done = pass.done,
                            .scale = inverse_ && last ? float(1.0 / double(data.count())) : 1.0f,
                            .lines_first = pass.along_x ? 0u : 1u};
    const bool small = pass.radix <= 5;
    const std::uint32_t elements = small ? count / pass.radix : count;
    commands.dispatch(small ? butterflies_.at(pass.radix) : prime_,
                      pass.along_x ? Threads{elements, lines} : Threads{lines, elements}, args);
    std::swap(from, to);
  }
  if (passes_.size() % 2 == 1) commands.copy(other_, data, 0, 0, data.count());
}

Grid<vec2> fourier_transform(Context& context, const Grid<vec2>& values, bool inverse) {
  FourierTransform transform(context, values.width(), values.height(), inverse);
  const Buffer<vec2> data(context, values.values());
  context.run([&](Commands& commands) { transform.record(commands, data); });
  Grid<vec2> result(values.width(), values.height());
  result.values() = data.read();
  return result;
}

}  // namespace parity::gpu
