#pragma once

#include <linux/filter.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tandem::io {

/// Selects which of several sockets of one port receives a datagram: by the value of its byte `byte`.
struct Steering {
  static constexpr std::size_t kSocketsMax = 64;
  std::size_t byte = 0;
  std::size_t sockets = 1;                    ///< 1 ... kSocketsMax
  std::array<std::uint8_t, 256> socket_of{};  ///< below `sockets`; datagrams that are too short go to socket 0
  bool grows = false;                         ///< further sockets may be bound later (`bind_udp_beside`)
};

/// The kernel's program of a Steering. It searches the value by halving, so a datagram takes at most 9 comparisons
/// whatever the assignment. The program is complete after construction: `attach` takes no heap.
class SteeringProgram {
 public:
  explicit SteeringProgram(const Steering& steering);

  /// Lets the kernel use this program for all sockets of a port (SO_ATTACH_REUSEPORT_CBPF), in place of an earlier one.
  /// Datagrams that arrive afterwards are distributed by it; none is lost or copied.
  /// @param fd  one of the sockets, bound with SO_REUSEPORT
  /// @return false if the kernel rejects it; the earlier program then remains
  bool attach(int fd) const noexcept;

  [[nodiscard]] const std::vector<sock_filter>& instructions() const noexcept { return program_; }

 private:
  std::vector<sock_filter> program_;
};

}  // namespace tandem::io
