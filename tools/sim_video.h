#pragma once

#include <filesystem>

namespace parity::tools {

/// video.mp4 of the folder's frame_####.png, by ffmpeg; a note on stderr where there is none.
///
/// @throws OutputError  ffmpeg failed.
void make_video(const std::filesystem::path& folder, double frames_per_second, bool quiet);

}  // namespace parity::tools
