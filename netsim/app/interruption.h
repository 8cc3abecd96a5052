#pragma once

#include <string>
#include <string_view>

#include "common/io/fd.h"

namespace tandem::netsim {

/// Ctrl-C, SIGTERM and SIGHUP mean the same to every command: what was done so far is reported, `interrupted` is said in
/// one wording, and the exit code is kInterrupted, since what was not judged is no pass. The one exception: a proxy that
/// was given no end is meant to end so.
class Interruption {
 public:
  static constexpr int kInterrupted = 1;

  /// From now on signals wait here. Before threads start.
  Interruption();

  /// Readable when a signal came; whoever waits for it must not read.
  [[nodiscard]] int fd() const noexcept { return signals_.get(); }
  /// Whether a signal came; costs a system call.
  [[nodiscard]] bool came() const noexcept;

  /// Says it on standard error. @param done  what was, such as "3.2 of 12 s"
  static void say(std::string_view command, const std::string& done);

 private:
  io::Fd signals_;
};

}  // namespace tandem::netsim
