#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

#include "common/io/fd.h"

namespace tandem::io {

/// Event that any thread signals and one thread polls. Signals before a `clear` count as one. `signal` and `clear` are
/// one system call each and never wait, so a real-time thread may use them.
class EventFd {
 public:
  EventFd() noexcept : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

  /// False if the system gave no descriptor.
  [[nodiscard]] bool open() const noexcept { return fd_.open(); }
  /// Descriptor that is readable while the event is signalled; for poll and epoll only.
  [[nodiscard]] int get() const noexcept { return fd_.get(); }

  void signal() const noexcept {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(fd_.get(), &one, sizeof one);
  }
  void clear() const noexcept {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto read = ::read(fd_.get(), &count, sizeof count);
  }

 private:
  Fd fd_;
};

}  // namespace tandem::io
