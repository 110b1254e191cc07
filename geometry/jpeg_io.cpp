#include <csetjmp>
#include <cstdio>
#include <cstring>

// libjpeg's headers need <cstdio> before them.
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity::detail {
namespace {

constexpr int max_scans = 200;  // a progressive file of a few bytes a scan would take for ever

/// libjpeg reports an error by a long jump, so what happens between setjmp and the jump owns
/// nothing: all state is here.
struct JpegReader {
  jpeg_decompress_struct codec = {};
  jpeg_error_mgr errors = {};
  jpeg_progress_mgr progress = {};
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX] = {};

  JpegReader();
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&codec); }
};

JpegReader& reader_of(j_common_ptr codec) { return *static_cast<JpegReader*>(codec->client_data); }

[[noreturn]] void on_error(j_common_ptr codec) {
  JpegReader& reader = reader_of(codec);
  codec->err->format_message(codec, reader.message);
  std::longjmp(reader.jump, 1);
}

// Level -1 is a warning. Data that end too early are an error here; others are tolerated.
void on_message(j_common_ptr codec, int level) {
  const int code = codec->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) on_error(codec);
}

void on_progress(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= max_scans) return;
  JpegReader& reader = reader_of(codec);
  std::snprintf(reader.message, sizeof reader.message, "more than %d scans", max_scans);
  std::longjmp(reader.jump, 1);
}

JpegReader::JpegReader() {
  codec.err = jpeg_std_error(&errors);
  errors.error_exit = on_error;
  errors.emit_message = on_message;
  codec.client_data = this;
}

bool read_header(JpegReader& reader, Bytes bytes) {
  if (setjmp(reader.jump)) return false;
  jpeg_create_decompress(&reader.codec);
  reader.progress.progress_monitor = on_progress;
  reader.codec.progress = &reader.progress;
  jpeg_mem_src(&reader.codec, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&reader.codec, TRUE);
  return true;
}

bool read_rows(JpegReader& reader, Grid<u8vec4>& texels) {
  if (setjmp(reader.jump)) return false;
  reader.codec.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&reader.codec);
  while (reader.codec.output_scanline < reader.codec.output_height) {
    JSAMPROW row = reinterpret_cast<JSAMPROW>(&texels(0, int(reader.codec.output_scanline)));
    jpeg_read_scanlines(&reader.codec, &row, 1);
  }
  jpeg_finish_decompress(&reader.codec);
  return true;
}

}  // namespace

bool is_jpeg(Bytes bytes) { return starts_with(bytes, "\xff\xd8\xff"); }

Grid<u8vec4> decode_jpeg(Bytes bytes, const std::string& name) {
  JpegReader reader;
  if (!read_header(reader, bytes))
    throw InputError(name, std::string("bad JPEG: ") + reader.message);
  if (reader.codec.num_components == 4)
    throw InputError(name, "JPEG with four components (CMYK), expected grey or colour");
  check_claimed_size(name, reader.codec.image_width, reader.codec.image_height, bytes.size());
  Grid<u8vec4> texels{int(reader.codec.image_width), int(reader.codec.image_height)};
  if (!read_rows(reader, texels))
    throw InputError(name, std::string("bad JPEG: ") + reader.message);
  return texels;
}

}  // namespace parity::detail
