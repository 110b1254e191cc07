#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/image_io.h"
#include "geometry/input_error.h"

/// Whatever the bytes, a picture is refused by InputError or decoded.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    parity::decode_linear_image(std::as_bytes(std::span(data, size)), "fuzz");
  } catch (const parity::InputError&) {
  }
  return 0;
}
