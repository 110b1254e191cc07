#include <array>
#include <cstring>
#include <map>

#include "geometry/gltf_convert.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

constexpr std::uint64_t largest_image_file = std::uint64_t(1) << 30;
constexpr std::uint64_t base_decoded = std::uint64_t(512) << 20;
constexpr std::uint64_t decoded_per_byte = 128;

std::string place_of(int image) { return "images[" + std::to_string(image) + "]"; }

/// The stored bytes of an image, kept alive by `owned` where they are not in a buffer.
std::span<const std::byte> image_bytes(const Document& document, const Data& data,
                                       const Origin& origin, int image, Bytes& owned) {
  const Image& from = document.images[std::size_t(image)];
  if (!from.has_uri) return data.view(from.view);
  owned = read_uri(from.uri, origin, place_of(image) + ".uri", largest_image_file);
  return owned;
}

bool is_other_format(std::span<const std::byte> bytes) {
  const auto holds = [&](std::size_t offset, const char* text, std::size_t size) {
    return bytes.size() >= offset + size && std::memcmp(bytes.data() + offset, text, size) == 0;
  };
  return holds(1, "KTX 20", 6) || (holds(0, "RIFF", 4) && holds(8, "WEBP", 4));
}

class TextureConverter {
 public:
  TextureConverter(const Document& document, const Data& data, const Origin& origin, Scene& scene)
      : document_(document), data_(data), origin_(origin), scene_(scene) {
    texture_of_.assign(document.textures.size(), unseen);
    image_of_.assign(document.images.size(), unseen);
  }

  void convert(TextureUse& use) {
    if (use.texture < 0) return;
    const std::size_t index = std::size_t(use.texture);
    if (texture_of_[index] == unseen) texture_of_[index] = convert_texture(index);
    use.texture = texture_of_[index];
    if (use.texture < 0) use = {};
  }

 private:
  static constexpr int unseen = -2;

  int convert_texture(std::size_t index) {
    const Texture& from = document_.textures[index];
    const int image = from.image < 0 ? -1 : convert_image(from.image);
    if (image < 0) {
      scene_.notes.push_back("textures[" + std::to_string(index) +
                             "] is not stored as PNG or JPEG: left out");
      return -1;
    }
    parity::Texture texture{.image = image, .sampler = {}};
    if (from.sampler >= 0) texture.sampler = document_.samplers[std::size_t(from.sampler)];
    scene_.textures.push_back(texture);
    return int(scene_.textures.size()) - 1;
  }

  int convert_image(int index) {
    int& number = image_of_[std::size_t(index)];
    if (number != unseen) return number;
    Bytes owned;
    const std::span<const std::byte> bytes = image_bytes(document_, data_, origin_, index, owned);
    number = -1;
    if (is_other_format(bytes)) return number;
    scene_.images.push_back(decode_image(bytes, origin_.name + ": " + place_of(index)));
    number = int(scene_.images.size()) - 1;
    encoded_size_ += bytes.size();
    decoded_size_ += scene_.images.back().size() * sizeof(u8vec4);
    if (decoded_size_ > base_decoded + decoded_per_byte * encoded_size_)
      throw InputError(origin_.name, place_of(index) + ": the images expand to more memory than " +
                                         "files of their size may take");
    return number;
  }

  const Document& document_;
  const Data& data_;
  const Origin& origin_;
  Scene& scene_;
  std::vector<int> texture_of_;
  std::vector<int> image_of_;
  std::uint64_t encoded_size_ = 0;
  std::uint64_t decoded_size_ = 0;
};

}  // namespace

void convert_textures(const Document& document, const Data& data, const Origin& origin,
                      Scene& scene) {
  for (std::size_t i = 0; i < document.images.size(); ++i)
    if (document.images[i].has_uri)
      check_uri(document.images[i].uri, origin, place_of(int(i)) + ".uri");
  TextureConverter converter(document, data, origin, scene);
  for (Material& material : scene.materials)
    for (TextureUse* use : textures_of(material)) converter.convert(*use);
}

}  // namespace parity::gltf
