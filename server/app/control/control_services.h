#pragma once

#include <asio/io_context.hpp>
#include <asio/ssl/context.hpp>
#include <chrono>
#include <cstdint>
#include <functional>

#include "common/auth/attempt_limiter.h"
#include "common/auth/connection_slots.h"
#include "common/auth/io/server_keystore.h"
#include "common/auth/limiter.h"
#include "common/io/clock.h"
#include "server/app/control/control_event.h"
#include "server/app/control/join_handler.h"

namespace tandem::server {

struct ControlLimits {
  std::chrono::milliseconds deadline{5000};  ///< from accept to the first accepted request
  /// Afterwards: for a whole frame, and for the execution of a command
  std::chrono::milliseconds frame_deadline{5000};
  std::chrono::milliseconds answer_deadline{2000};  ///< for a reply to be read; then the connection is closed
  int unread_max = 256 * 1024;                      ///< [bytes] of unread replies that the kernel buffers
  std::size_t input_before_auth = 8192;             ///< [bytes], TLS included
  /// TLS handshakes, and connections whose key is not enrolled. Four times as many may wait for a handshake.
  std::size_t pending = 256;
  std::size_t connections = 2048;  ///< with enrolled keys
  /// From accept to the first byte; the second value applies while half of the waiting slots are in use
  std::chrono::milliseconds first_byte{5000}, first_byte_pressed{1000};
  std::chrono::milliseconds unjoined_idle{10000};              ///< for connections that have not joined
  std::size_t unjoined_per_key = 4, unjoined_per_source = 16;  ///< connections that have not joined
  bool loopback_exempt = true;                                 ///< wrong codes from loopback addresses are not limited
  auth::AcceptLimits accept;
};

/// Number of connections without a proved key per `ControlLimits::pending`. They wait for a first byte, then for a
/// handshake.
inline constexpr std::size_t kMostPerPending = 4;

/// Clocks of the control plane; tests replace them.
struct ControlClocks {
  std::function<std::int64_t()> wall = auth::wall_seconds;  ///< [s] since 1970, UTC
  std::function<Time()> monotonic = io::monotonic_now;
};

/// Parts of a control plane that all its connections share. Used on the thread of `context`.
struct ControlServices {
  asio::io_context& context;
  auth::ServerKeystore& trust;
  JoinHandler& join_handler;
  ControlLimits limits;
  ControlClocks clocks;
  ControlEvents events;
  asio::ssl::context tls;
  auth::AttemptLimiter attempts;
  auth::ConnectionSlots slots;  ///< of connections with enrolled keys

  [[nodiscard]] Time now() const { return clocks.monotonic(); }
};

}  // namespace tandem::server
