#include "tools/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string_view>

namespace parity::tools {
namespace {

constexpr double patience_seconds = 0.5;
constexpr double redraw_seconds = 0.1;

double now_seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

std::size_t terminal_columns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

std::string time_left(std::size_t done, std::size_t total, double seconds) {
  if (done == 0 || done >= total) return "";
  const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return " " + std::to_string(static_cast<long long>(left + 0.5)) + " s left";
}

int percent(std::size_t done, std::size_t total) {
  if (done >= total) return 100;
  return static_cast<int>(100.0 * static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace

std::string progress_bar(const std::string& what, std::size_t done, std::size_t total,
                         double seconds, std::size_t columns) {
  const int reached = percent(done, total);
  const std::string end = "] " + std::to_string(reached) + " %" + time_left(done, total, seconds);
  const std::string begin = what + " [";
  const std::size_t used = begin.size() + end.size() + 1;
  const std::size_t width = std::min<std::size_t>(40, columns > used ? columns - used : 0);
  const std::size_t full = width * static_cast<std::size_t>(reached) / 100;
  const std::string line = begin + std::string(full, '#') + std::string(width - full, '.') + end;
  return line.substr(0, columns > 0 ? columns - 1 : 0);
}

bool can_redraw(std::FILE* stream) {
  const char* term = std::getenv("TERM");
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = term == nullptr || std::string_view(term) == "dumb" ||
                     (no_color != nullptr && *no_color != '\0');
  return !plain && isatty(fileno(stream)) == 1;
}

Progress::Progress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)),
      total_(total),
      quiet_(quiet),
      terminal_(can_redraw(stderr)),
      start_(now_seconds()) {}

Progress::~Progress() { clear(); }

void Progress::advance(std::size_t steps) { set(done_ + steps); }

void Progress::set(std::size_t done) {
  done_ = std::min(done, total_);
  if (!quiet_ && now_seconds() - start_ >= patience_seconds) show();
}

void Progress::clear() {
  if (!drawn_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::show() {
  const double now = now_seconds();
  if (terminal_) {
    if (drawn_ && now - last_draw_ < redraw_seconds) return;
    const std::string bar = progress_bar(what_, done_, total_, now - start_, terminal_columns());
    std::fprintf(stderr, "\r\033[K%s", bar.c_str());
    std::fflush(stderr);
    drawn_ = true;
    last_draw_ = now;
    return;
  }
  const int tenth = percent(done_, total_) / 10;
  if (tenth <= shown_tenth_) return;
  shown_tenth_ = tenth;
  std::fprintf(stderr, "%s: %d %%\n", what_.c_str(), 10 * tenth);
}

}  // namespace parity::tools
