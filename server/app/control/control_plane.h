#pragma once

#include <array>
#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/ssl/context.hpp>
#include <asio/steady_timer.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <expected>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "common/auth/attempt_limiter.h"
#include "common/auth/connection_slots.h"
#include "common/auth/io/server_keystore.h"
#include "common/auth/limiter.h"
#include "common/auth/pending_slots.h"
#include "common/auth/returning_addresses.h"
#include "common/io/clock.h"
#include "common/io/socket_address.h"
#include "server/app/control/join_handler.h"

namespace tandem::server {

class ControlConnection;

/// Event of the control plane. Each is counted; some are also reported.
enum class ControlEvent : std::uint8_t {
  kAccepted,
  kTooFast,
  kHandshakeFailed,
  kDeadline,
  kTooMuchInput,
  kBadFrame,
  kNotEnrolled,
  kBlocked,
  kEnrolled,
  kCodeRefused,
  kWelcomed,
  kRefused,
  kCommand,
  kCommandTooFast,
  kTrouble,
  kForbidden,
  kEvicted,  ///< closed before it proved an enrolled key, to admit another connection
  kIdle,     ///< closed because it had not joined and was idle for too long
  kTooMany,  ///< closed because it had not joined, and its key, its source or the server had too many
};
inline constexpr std::size_t kControlEvents = 19;
/// Name of the event, for logs and metrics.
[[nodiscard]] std::string_view to_text(ControlEvent event) noexcept;
/// Clause for messages; its subject is the peer.
[[nodiscard]] std::string_view control_event_text(ControlEvent event) noexcept;

/// Record for logs and audit. It never contains a secret.
struct ControlEventRecord {
  ControlEvent event = ControlEvent::kAccepted;
  std::string address, workstation, detail;
};

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

/// Accepts TLS connections, enrols workstations, passes join requests to a `JoinHandler` and dispatches commands. All
/// members run on the thread of `context`. Only file access of the keystore blocks it.
class ControlPlane {
 public:
  /// @param trust  after `begin_serving`; from now on used by the context's thread only
  /// @pre before destruction: `stop`, and the context has run out of work (ControlThread does both)
  ControlPlane(asio::io_context& context, auth::ServerKeystore& trust, JoinHandler& admissions,
               const ControlLimits& limits = {}, ControlClocks clocks = {},
               std::function<void(const ControlEventRecord&)> tell = {});
  ~ControlPlane();
  ControlPlane(const ControlPlane&) = delete;
  ControlPlane& operator=(const ControlPlane&) = delete;

  /// Listens on an address. It may be called several times, before the context runs.
  /// @return the address with the chosen port, or the error
  [[nodiscard]] std::expected<io::SocketAddress, std::string> listen(const io::SocketAddress& at);
  /// Stops accepting and closes every connection. Call it on the context's thread.
  void stop();

  /// Ends the connections of revoked workstations, without waiting for a frame of them. Call it on the context's
  /// thread.
  void disconnect_revoked();

  /// Number of events so far. Thread-safe.
  [[nodiscard]] std::uint64_t count(ControlEvent event) const noexcept {
    return counts_[static_cast<std::size_t>(event)].load(std::memory_order_relaxed);
  }

 private:
  friend class ControlConnection;
  using Id = auth::PendingSlots::Id;
  struct Acceptor {
    asio::ip::tcp::acceptor acceptor;
    asio::steady_timer pause;
    bool accepting = false;
  };

  /// A connection before its TLS handshake: only a socket.
  struct PendingConnection {
    asio::ip::tcp::socket socket;
    auth::Origin origin;
    auth::Source source;
    std::string address;
    Time arrived;
  };

  void accept_next(Acceptor& door);
  void pause_accepting(Acceptor& door, Duration time);
  void on_accepted(asio::ip::tcp::socket socket);
  void wait_for_first_byte(Id id);
  void on_first_byte(Id id);
  void begin_handshake(Id id);
  /// Closes expired connections, begins the handshakes that may begin, and schedules the next call.
  void service_pending();
  void close_unproven(Id id, ControlEvent why);
  /// Closes connections that have not joined and are idle or too many.
  void close_unjoined();
  /// Checks four times per second which connections still own a seat or a console.
  void schedule_sweep();
  void record_event(ControlEvent event, std::string address, std::string workstation = {}, std::string detail = {});
  // Called by connections.
  /// The connection proved an enrolled key: it no longer competes with unknown peers.
  void on_key_proved(const ControlConnection& connection);
  void on_joined(const ControlConnection& connection, const rpc::Welcome& welcome);
  void set_busy(const ControlConnection& connection, bool busy);
  void on_ended(const ControlConnection& connection);

  asio::io_context& context_;
  auth::ServerKeystore& trust_;
  JoinHandler& join_handler_;
  ControlLimits limits_;
  ControlClocks clocks_;
  std::function<void(const ControlEventRecord&)> on_event_;
  asio::ssl::context tls_;
  TokenBucket accept_rate_;  ///< limits the cost of accepting alone
  auth::AcceptLimiter accepts_;
  auth::AttemptLimiter attempts_;
  auth::PendingSlots pending_;
  auth::ConnectionSlots places_;
  auth::ReturningAddresses returning_;
  std::list<Acceptor> acceptors_;
  std::map<Id, std::shared_ptr<PendingConnection>> waiting_;
  std::map<Id, std::shared_ptr<ControlConnection>> connections_;
  asio::steady_timer pending_timer_, sweep_timer_;
  std::optional<Time> pending_due_;
  bool stopped_ = false, servicing_pending_ = false;
  std::array<std::atomic<std::uint64_t>, kControlEvents> counts_{};
};

/// Thread that runs the io_context of a control plane, with all signals blocked.
class ControlThread {
 public:
  [[nodiscard]] asio::io_context& context() noexcept { return context_; }
  void start();
  /// Runs `last` on the thread, then ends and joins it.
  void stop(std::function<void()> last);
  ~ControlThread();

 private:
  asio::io_context context_{1};
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work_;
  std::thread thread_;
};

}  // namespace tandem::server
