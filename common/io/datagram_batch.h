#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "common/io/socket_address.h"

namespace tandem::io {

/// The local address to which a datagram was sent, so that the reply can come from it (sockets bound to "any").
struct LocalAddress {
  int family = AF_UNSPEC;  ///< AF_UNSPEC: the system chooses
  in_addr v4{};
  in6_addr v6{};
  unsigned interface_index = 0;
};

/// Receives many datagrams with one system call. All memory is allocated at construction.
class ReceiveBatch {
 public:
  static constexpr std::size_t kMax = 64;
  static constexpr std::size_t kSlotBytes = 1500;  ///< longer datagrams are cut and marked

  ReceiveBatch();

  static constexpr int kBufferBytes = 4 << 20;  ///< about 10 000 small datagrams
  /// Requests the data that `receive` uses: kernel time stamps, drop counts, and the local address if `local`.
  /// @param buffer_bytes  size of the kernel's receive buffer
  static void prepare(int fd, int family, bool local, int buffer_bytes = kBufferBytes) noexcept;

  /// @return number of received datagrams; 0: none waits; -1: see errno
  int receive(int fd) noexcept;

  [[nodiscard]] std::span<const std::byte> bytes(std::size_t i) const noexcept;
  [[nodiscard]] bool too_long(std::size_t i) const noexcept { return (headers_[i].msg_hdr.msg_flags & MSG_TRUNC) != 0; }
  [[nodiscard]] const sockaddr_storage& from(std::size_t i) const noexcept { return from_[i]; }

  struct Details {
    /// Time from arrival in the kernel to `read_at` [0, 1 s].
    Duration age{};
    /// The kernel's time of arrival, CLOCK_REALTIME; 0 if it gave none.
    Duration stamp{};
    std::uint32_t dropped = 0;  ///< by the kernel on this socket so far, if known
    LocalAddress local;
  };
  /// @param read_at  CLOCK_REALTIME after `receive`, the clock of the kernel's stamps
  [[nodiscard]] Details details(std::size_t i, Duration read_at) const noexcept;

 private:
  static constexpr std::size_t kControl = 192;
  struct alignas(cmsghdr) Control {
    std::array<std::byte, kControl> bytes;
  };

  std::unique_ptr<std::byte[]> data_;
  std::vector<Control> control_;
  std::array<mmsghdr, kMax> headers_{};
  std::array<iovec, kMax> pieces_{};
  std::array<sockaddr_storage, kMax> from_{};
  std::size_t used_ = kMax;  ///< headers in which the kernel may have written its own lengths
};

/// Sends many datagrams of one socket with one system call.
class SendBatch {
 public:
  static constexpr std::size_t kMax = 64;

  struct Result {
    std::uint32_t sent = 0;
    std::uint32_t refused = 0;  ///< no process listens at the destination (at present)
    std::uint32_t no_room = 0;  ///< the kernel's send buffer is full
    std::uint32_t other = 0;
  };

  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  /// Adds a datagram; `to` is null on connected sockets. Bytes and addresses must stay valid until `send`. At most
  /// kMax.
  void add(std::span<const std::byte> bytes, const SocketAddress* to, const LocalAddress* from) noexcept;
  /// Sends all added datagrams; those that cannot be sent are counted and dropped, as a network does.
  Result send(int fd) noexcept;

 private:
  struct alignas(cmsghdr) Control {
    std::array<std::byte, 64> bytes;
  };
  std::size_t count_ = 0;
  std::array<mmsghdr, kMax> headers_{};
  std::array<iovec, kMax> pieces_{};
  std::array<Control, kMax> control_{};
};

}  // namespace tandem::io
