#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <span>

namespace tandem::auth {

/// Writes all bytes and continues after signals. @return whether all were written; false: errno holds the reason
[[nodiscard]] inline bool write_all(int fd, std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace tandem::auth
