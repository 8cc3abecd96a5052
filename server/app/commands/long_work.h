#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/signals.h"

namespace tandem::server {

/// Progress of a command that takes long: a line on the terminal, if standard error is one, and the end by Ctrl-C.
class LongWork {
 public:
  /// @param what  what the command does, such as "export"
  explicit LongWork(std::string what) : what_(std::move(what)), on_terminal_(::isatty(STDERR_FILENO) == 1) {}
  ~LongWork() { clear(); }
  LongWork(const LongWork&) = delete;
  LongWork& operator=(const LongWork&) = delete;

  /// @param share  finished share [0, 1]  @return false: the user wants the command to end
  [[nodiscard]] bool advance(double share) {
    const Time now = io::monotonic_now();
    if (on_terminal_ && now - shown_ >= kInterval) {
      shown_ = now;
      std::fprintf(stderr, "\r%s %3.0f %%", what_.c_str(), 100 * share);
      std::fflush(stderr);
      written_ = true;
    }
    return io::pending_signal().empty();
  }
  /// Removes the line, so that other text can be printed.
  void clear() {
    if (written_) std::fputs("\r\x1b[K", stderr);
    written_ = false;
  }

 private:
  static constexpr Duration kInterval = std::chrono::milliseconds(200);

  io::Fd signals_ = io::make_signalfd();  ///< from now on signals wait to be read
  std::string what_;
  bool on_terminal_, written_ = false;
  Time shown_{};
};

}  // namespace tandem::server
