#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity::detail {
namespace {

/// The bytes of a file as OpenEXR wants to read them.
class InputBytes : public Imf::IStream {
 public:
  InputBytes(Bytes bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || offset_ > bytes_.size() || std::size_t(count) > bytes_.size() - offset_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(to, bytes_.data() + offset_, std::size_t(count));
    offset_ += std::size_t(count);
    return offset_ < bytes_.size();
  }
  std::uint64_t tellg() override { return offset_; }
  void seekg(std::uint64_t offset) override { offset_ = std::size_t(offset); }

 private:
  Bytes bytes_;
  std::size_t offset_ = 0;
};

/// Collects what OpenEXR writes.
class OutputBytes : public Imf::OStream {
 public:
  OutputBytes() : Imf::OStream("memory") {}

  void write(const char from[], int count) override {
    const std::size_t end = offset_ + std::size_t(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + offset_, from, std::size_t(count));
    offset_ = end;
  }
  std::uint64_t tellp() override { return offset_; }
  void seekp(std::uint64_t offset) override { offset_ = std::size_t(offset); }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t offset_ = 0;
};

/// A box of texels, both ends included; OpenEXR has checked that it is neither empty nor huge.
struct Window {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

Window window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

/// The names of the channels that are red, green, blue and alpha; empty: none.
struct ColorChannels {
  std::string names[4];
};

bool has(const Imf::ChannelList& channels, const std::string& name) {
  return channels.findChannel(name) != nullptr;
}

ColorChannels with_prefix(const Imf::ChannelList& channels, const std::string& prefix) {
  const std::string alpha = has(channels, prefix + "A") ? prefix + "A" : "";
  return {{prefix + "R", prefix + "G", prefix + "B", alpha}};
}

ColorChannels choose_channels(const Imf::ChannelList& channels, const std::string& name) {
  const auto has_rgb = [&](const std::string& prefix) {
    return has(channels, prefix + "R") && has(channels, prefix + "G") &&
           has(channels, prefix + "B");
  };
  if (has_rgb("")) return with_prefix(channels, "");
  std::set<std::string> layers;
  channels.layers(layers);
  for (const std::string& layer : layers)
    if (has_rgb(layer + ".")) return with_prefix(channels, layer + ".");
  if (has(channels, "Y")) return {{"Y", "Y", "Y", has(channels, "A") ? "A" : ""}};
  std::string list;
  for (auto i = channels.begin(); i != channels.end() && list.size() < 200; ++i)
    list += std::string(list.empty() ? "" : ", ") + i.name();
  throw InputError(name, "EXR has the channels " + list + ", expected R, G, B or Y");
}

/// Places the data window in the display window.
Grid<vec4> place(const Grid<vec4>& data, const Window& from, const Window& to) {
  Grid<vec4> picture{to.width, to.height, vec4(0.0f)};
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x) {
      const long long px = (long long)(from.x) + x - to.x, py = (long long)(from.y) + y - to.y;
      if (px >= 0 && px < to.width && py >= 0 && py < to.height)
        picture(int(px), int(py)) = data(x, y);
    }
  return picture;
}

Imf::Slice float_slice(float* first, const Window& window, double fill) {
  const auto row_bytes = sizeof(vec4) * std::size_t(window.width);
  return Imf::Slice::Make(Imf::FLOAT, first, Imath::V2i(window.x, window.y), window.width,
                          window.height, sizeof(vec4), row_bytes, 1, 1, fill);
}

Grid<vec4> read_part(Imf::InputPart& part, const Window& window, const std::string& name) {
  const ColorChannels channels = choose_channels(part.header().channels(), name);
  const bool is_grey = channels.names[0] == channels.names[1];
  Grid<vec4> data{window.width, window.height, vec4(0.0f, 0.0f, 0.0f, 1.0f)};
  Imf::FrameBuffer target;
  for (int c = 0; c < 4; ++c) {
    const bool is_repeated = is_grey && (c == 1 || c == 2);
    if (channels.names[c].empty() || is_repeated) continue;
    target.insert(channels.names[c], float_slice(&data(0, 0)[c], window, c == 3 ? 1.0 : 0.0));
  }
  part.setFrameBuffer(target);
  part.readPixels(window.y, window.y + window.height - 1);
  if (is_grey)
    for (vec4& texel : data) texel.y = texel.z = texel.x;
  return data;
}

/// Luminance with chroma at half resolution, which OpenEXR turns into RGB.
Grid<vec4> read_luminance_chroma(Bytes bytes, const Window& window, const std::string& name) {
  InputBytes stream{bytes, name};
  Imf::RgbaInputFile file{stream, 0};
  Grid<vec4> data{window.width, window.height};
  std::vector<Imf::Rgba> line(std::size_t(window.width));
  for (int y = 0; y < window.height; ++y) {
    file.setFrameBuffer(
        Imf::ComputeBasePointer(line.data(), file.dataWindow()) - std::ptrdiff_t(y) * window.width,
        1, std::size_t(window.width));
    file.readPixels(window.y + y);
    for (int x = 0; x < window.width; ++x) {
      const Imf::Rgba& texel = line[std::size_t(x)];
      data(x, y) = {float(texel.r), float(texel.g), float(texel.b), float(texel.a)};
    }
  }
  return data;
}

Grid<vec4> read_exr(Bytes bytes, const std::string& name) {
  InputBytes stream{bytes, name};
  Imf::MultiPartInputFile file{stream, 0, false};
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw InputError(name, "EXR holds deep data, expected a flat picture");
  const Window data = window_of(header.dataWindow());
  const Window display = window_of(header.displayWindow());
  check_claimed_size(name, data.width, data.height, bytes.size());
  check_claimed_size(name, display.width, display.height, bytes.size());
  if (has(header.channels(), "RY") && has(header.channels(), "BY"))
    return place(read_luminance_chroma(bytes, data, name), data, display);
  Imf::InputPart part{file, 0};
  return place(read_part(part, data, name), data, display);
}

void limit_claims() {
  static const bool done = [] {
    Imf::Header::setMaxImageSize(max_image_side, max_image_side);
    Imf::Header::setMaxTileSize(max_image_side, max_image_side);
    return true;
  }();
  static_cast<void>(done);
}

float finite_in_half(float value) {
  return std::isfinite(value) ? std::clamp(value, -float(HALF_MAX), float(HALF_MAX)) : value;
}

}  // namespace

bool is_exr(Bytes bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); }

Grid<vec4> decode_exr(Bytes bytes, const std::string& name) {
  limit_claims();
  try {
    return read_exr(bytes, name);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(name, std::string("bad EXR: ") + error.what());
  }
}

std::vector<std::byte> encode_exr(const Grid<vec4>& linear, const ImageMetadata& metadata) {
  const int width = linear.width(), height = linear.height();
  Imf::Header header{width, height};
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : metadata.attributes)
    header.insert(key, Imf::StringAttribute(text));

  Grid<Imf::Rgba> colors{width, height};
  std::transform(linear.begin(), linear.end(), colors.begin(), [](const vec4& c) {
    return Imf::Rgba(finite_in_half(c.x), finite_in_half(c.y), finite_in_half(c.z),
                     finite_in_half(c.w));
  });
  Imf::FrameBuffer source;
  const auto add = [&](const std::string& name, Imf::PixelType type, const void* first,
                       std::size_t stride) {
    header.channels().insert(name, Imf::Channel(type));
    source.insert(name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(first)), stride,
                                   stride * std::size_t(width)));
  };
  add("R", Imf::HALF, &colors.data()->r, sizeof(Imf::Rgba));
  add("G", Imf::HALF, &colors.data()->g, sizeof(Imf::Rgba));
  add("B", Imf::HALF, &colors.data()->b, sizeof(Imf::Rgba));
  add("A", Imf::HALF, &colors.data()->a, sizeof(Imf::Rgba));
  for (const ImageChannel& channel : metadata.channels)
    add(channel.name, Imf::FLOAT, channel.values.data(), sizeof(float));

  OutputBytes stream;
  {
    Imf::OutputFile file{stream, header, 0};
    file.setFrameBuffer(source);
    file.writePixels(height);
  }
  return stream.take();
}

}  // namespace parity::detail
