#pragma once

#include <string>
#include <string_view>

#include "common/io/fd.h"

namespace tandem::netsim {

/// Collects SIGINT (Ctrl-C), SIGTERM and SIGHUP for a command. Every command then reports what is done so far, prints
/// one common message and exits with io::kExitTrouble. An interrupted run is not a pass, because part of it was not
/// judged. The exception is a proxy without a time limit, which a signal ends normally.
class SignalWatcher {
 public:
  /// Blocks the signals and queues them. Construct it before any thread starts.
  SignalWatcher();

  /// Returns a descriptor that is readable after a signal; the caller must not read from it.
  [[nodiscard]] int fd() const noexcept { return signals_.get(); }
  /// Returns whether a signal arrived; costs a system call.
  [[nodiscard]] bool signalled() const noexcept;

  /// Prints the interruption to standard error. @param done  finished part, for example "3.2 of 12 s"
  static void report(std::string_view command, const std::string& done);

 private:
  io::Fd signals_;
};

}  // namespace tandem::netsim
