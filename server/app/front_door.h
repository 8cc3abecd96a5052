#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/io/udp_socket.h"
#include "common/trust/audit_throttle.h"
#include "common/trust/io/client_trust.h"
#include "common/trust/io/server_trust.h"
#include "server/app/control_plane.h"
#include "server/app/house.h"
#include "server/app/metrics_server.h"

namespace tandem::server {

/// Where people come in: the keys in force, the control connections on a thread of their own, the sessions they may join. On loopback
/// without a state folder the keys are made on the spot, and clients of the same user on the same machine find what they need in the
/// runtime folder; everything else is the same.
class FrontDoor {
 public:
  struct Plan {
    io::SocketAddress listen;  ///< port 0: one that is free for UDP and TCP
    std::string state;         ///< as typed; empty: the usual place, or on loopback keys made on the spot
    std::function<void(const ControlNews&)> tell;  ///< on the door's thread
    std::function<void(const std::string&)> say{};  ///< the same: what people ordered, for those who watch the server
    ControlLimits limits{};
    LoadLimits load{};                             ///< of a shard, above which nobody new gets a seat
    io::Steering steering{};                       ///< of datagrams to shards
    std::optional<io::SocketAddress> metrics{};    ///< where /metrics, /healthz and /readyz are answered; nothing: nowhere
    std::vector<std::string> metrics_hosts{};      ///< names under which they may be asked for, beside the address
    trust::AuditLimits audit{};
  };
  /// What is wrong with the keys and books for an address, before anything starts; empty: nothing.
  [[nodiscard]] static std::string problem_with_keys(const io::SocketAddress& listen, const std::string& state);
  /// Everything that is wrong with them, for `--check`; and with the address: whether this computer has it. Nothing is opened or changed.
  [[nodiscard]] static std::vector<std::string> problems_with_keys(const io::SocketAddress& listen, const std::string& state);
  [[nodiscard]] static std::string problem_with_address(const io::SocketAddress& listen);
  /// @return the door, listening but not yet answering, or what is wrong and what to do about it
  [[nodiscard]] static std::expected<std::unique_ptr<FrontDoor>, std::string> open(const Plan& plan);
  ~FrontDoor();

  /// For the shards: the datagrams' sockets, all on the port of the control connections. Once.
  [[nodiscard]] std::vector<io::UdpSocket> take_sockets() { return std::move(sockets_); }
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  /// Where sessions may lay down what a restart needs: the state folder, or on loopback with keys made on the spot the folder where clients
  /// find them.
  [[nodiscard]] std::string folder() const;
  /// Whether keys were made on the spot.
  [[nodiscard]] bool throw_away() const noexcept { return !trust_.on_disk(); }

  /// Before `start`.
  void add(House::Opening opening);
  void watch(Shard& shard) { house_.watch(shard); }
  /// Answers from now on. @return what is wrong
  [[nodiscard]] std::string start();

  // ---- While it answers, from another thread than its own; these wait until it is done. ----
  /// A session that is over goes; nobody looks at it afterwards.
  void close(const trust::Id16& id);
  /// A session in the place of one that went, in a slot of its shard that is free.
  void open_late(House::Opening opening);
  /// Ends a session gently.
  void end(const trust::Id16& id);
  /// Whoever wants in from now on is told that this server is about to end.
  void drain();
  /// Whether an operator ordered that no new session opens, and when all hands are to be let go. Without waiting.
  [[nodiscard]] std::optional<Time> drain_due() const noexcept { return house_.drain_due(); }
  /// The address in force.
  [[nodiscard]] std::optional<io::SocketAddress> metrics_address() const { return metrics_ ? std::optional(metrics_->address()) : std::nullopt; }

  /// Writes down what happened in a session, on the door's thread; from any.
  void audit(std::string_view event, std::string session, std::string detail);
  /// No newcomers, all control connections closed. Before the shards and sessions go.
  void stop();

 private:
  FrontDoor(trust::ServerTrust trust, const Plan& plan);
  // The audit log (front_door_audit.cpp).
  /// Writes down who came in, and who was not let in and why. @return false: there are too many such lines of its source
  [[nodiscard]] bool note(const ControlNews& news);
  /// Writes what the audit log owes, and says when it fails and when it works again.
  void look_after_audit();
  void end_audit();
  /// What the commands beside this server may know of the sessions, written down when it changed.
  [[nodiscard]] std::string write_down();
  void write_down_now_and_then();
  /// Whoever was revoked loses seat, visit and connection.
  void look_for_revoked_now_and_then();
  void on_thread(const std::function<void()>& what);

  trust::ServerTrust trust_;
  std::function<void(const ControlNews&)> tell_;
  std::function<void(const std::string&)> say_;
  trust::AuditThrottle throttle_;
  std::uint64_t lost_told_ = 0;  ///< lines of the audit log whose loss was told
  bool audit_fails_ = false;     ///< and that was told
  ControlThread thread_;
  House house_;
  ControlPlane plane_;
  std::optional<MetricsServer> metrics_;
  asio::steady_timer refresh_, revoked_;
  std::vector<io::UdpSocket> sockets_;
  io::SocketAddress address_;
  std::optional<trust::LocalRuntime> local_;
  ServingSpec serving_;
  bool serving_fails_ = false;  ///< and that was told
  bool started_ = false;
};

}  // namespace tandem::server
