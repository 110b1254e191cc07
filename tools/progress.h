#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace parity::tools {

/// How far long work has come, on stderr: a bar that redraws itself on a terminal, else one line
/// for each 10 %. Nothing is shown for work that ends within half a second, nor if `quiet`. No
/// colours; TERM=dumb and NO_COLOR get lines instead of the bar.
class Progress {
 public:
  /// @param what   "rendering", shown before the bar
  /// @param total  steps of the whole work; 0 counts as done
  Progress(std::string what, std::size_t total, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// So much more is done.
  void advance(std::size_t steps = 1);
  /// So much is done in all.
  void set(std::size_t done);
  /// Wipes the bar, so that a message can be printed; the next step draws it again.
  void clear();

 private:
  void show();

  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  int shown_tenth_ = 0;
  double start_;
  double last_draw_ = 0;
};

/// "rendering [#####.....] 50 % 3 s left": fits into `columns` characters.
///
/// @param seconds  since the start; the rest is estimated from it.
std::string progress_bar(const std::string& what, std::size_t done, std::size_t total,
                         double seconds, std::size_t columns);

/// Whether a stream is a terminal that can redraw a line: not TERM=dumb, not NO_COLOR.
bool can_redraw(std::FILE* stream);

}  // namespace parity::tools
