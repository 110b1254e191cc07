#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

/// Pictures in files. A side has at most 16384 texels; a file that claims more, or many more than
/// its bytes can hold, is refused before anything is allocated.
namespace parity {

constexpr std::size_t max_image_bytes = std::size_t(1) << 31;

/// A further channel of an EXR, with its layer: "albedo.R", "N.X", "Z".
struct ImageChannel {
  std::string name;
  Grid<float> values;
};

/// What an EXR carries beside its colours. The other formats have no place for it and leave it out.
struct ImageMetadata {
  std::vector<std::pair<std::string, std::string>> attributes;  ///< name, text
  std::vector<ImageChannel> channels;                           ///< written as 32-bit float
};

/// Stored RGBA of a PNG (any depth and colour type; 16 bits rounded to 8) or a JPEG, recognised by
/// its first bytes. Not decoded from sRGB; row 0 on top; alpha 255 where the file has none.
///
/// @param name  of the file, for the message.
/// @throws InputError  neither of the two, damaged, cut short, or too large.
Grid<u8vec4> decode_image(std::span<const std::byte> bytes, const std::string& name);

/// Are these the first bytes of a PNG or a JPEG, which hold what a screen shows, and not light?
bool is_display_referred(std::span<const std::byte> bytes);

/// A picture as linear RGBA, row 0 on top; alpha (linear itself) 1 where the file has none.
/// The format is recognised by the first bytes:
///   PNG   decoded from sRGB, 16 bits kept; gAMA and iCCP are ignored
///   JPEG  decoded from sRGB
///   HDR   Radiance RGBE, run-length coded or flat, EXPOSURE undone; XYZE is refused
///   EXR   the first part's R, G, B, A, else its first layer that has R, G, B, else Y for all
///   three;
///         the picture is the display window, 0 where there is no data; deep data are refused
///   PFM   colour or grey, either byte order; its scale is not applied
///
/// @throws InputError  not one of these, damaged, cut short, or too large.
///
/// Source: PNG (ISO/IEC 15948); Ward, "Real Pixels", Graphics Gems II; OpenEXR 3.1.
Grid<vec4> decode_linear_image(std::span<const std::byte> bytes, const std::string& name);

/// The same from a file of at most max_image_bytes.
///
/// @throws InputError  missing, a folder, too large, or as decode_linear_image.
Grid<vec4> load_image(const std::filesystem::path& path);

/// Display-referred 8-bit sRGB, rounded to nearest; clamped to [0, 1], NaN becomes 0. Alpha is
/// linear.
Grid<u8vec4> display_image(const Grid<vec4>& linear);

/// Writes a linear picture; the name's ending chooses the format:
///   .png  display_image of it
///   .exr  half R, G, B, A (finite values clamped to +-65504), ZIP, with the metadata
///   .hdr  RGBE, rounded to nearest, run-length coded; negative and NaN become 0, no alpha
///   .pfm  32-bit float RGB, no alpha
/// The file appears whole or not at all.
///
/// @throws std::invalid_argument  another ending, an empty picture, or one with a side above 16384;
///                                a channel of another size.
/// @throws OutputError  the file cannot be written.
void save_image(const std::filesystem::path& path, const Grid<vec4>& linear,
                const ImageMetadata& metadata);

/// Writes texels as they are (already display-referred) as an 8-bit RGBA PNG.
///
/// @throws std::invalid_argument  an empty picture, or one with a side above 16384.
/// @throws OutputError  the file cannot be written.
void save_png(const std::filesystem::path& path, const Grid<u8vec4>& texels);

}  // namespace parity
