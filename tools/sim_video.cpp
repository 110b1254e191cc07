#include "tools/sim_video.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "geometry/output_error.h"

extern char** environ;

namespace parity::tools {
namespace {

/// Exit status of a program found on the PATH; 127: it is not there.
int run_program(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

void make_video(const std::filesystem::path& folder, double frames_per_second, bool quiet) {
  const std::string target = (folder / "video.mp4").string();
  const std::string unfinished = (folder / "video.part.mp4").string();
  // Sides of H.264 with its usual colour resolution are even.
  const int status =
      run_program({"ffmpeg", "-y", "-loglevel", "error", "-nostdin", "-framerate",
                   std::to_string(frames_per_second), "-i", (folder / "frame_%04d.png").string(),
                   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", unfinished});
  if (status == 127) {
    if (!quiet)
      std::fprintf(stderr, "parity: no ffmpeg here: the frames are there, the video is not\n");
    return;
  }
  std::error_code error;
  if (status != 0) {
    std::filesystem::remove(unfinished, error);
    throw OutputError(target, "ffmpeg ended with status " + std::to_string(status));
  }
  std::filesystem::rename(unfinished, target, error);
  if (error) throw OutputError(target, error.message());
}

}  // namespace parity::tools
