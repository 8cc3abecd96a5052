#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>

#include "common/io/udp_socket.h"
#include "common/trust/io/client_trust.h"
#include "common/trust/io/server_trust.h"
#include "server/app/control_plane.h"
#include "server/app/house.h"

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
  };
  /// What is wrong with the keys and books for an address, before anything starts; empty: nothing.
  [[nodiscard]] static std::string problem_with_keys(const io::SocketAddress& listen, const std::string& state);
  /// @return the door, listening but not yet answering, or what is wrong and what to do about it
  [[nodiscard]] static std::expected<std::unique_ptr<FrontDoor>, std::string> open(const Plan& plan);
  ~FrontDoor();

  /// For the shard: the datagrams' socket, on the port of the control connections. Once.
  [[nodiscard]] io::UdpSocket take_socket() { return std::move(*socket_); }
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  /// Whether keys were made on the spot.
  [[nodiscard]] bool throw_away() const noexcept { return !trust_.on_disk(); }

  /// Before `start`.
  void add(House::Opening opening);
  void watch(Shard& shard) { house_.watch(shard); }
  /// Answers from now on. @return what is wrong
  [[nodiscard]] std::string start();
  /// No newcomers, all control connections closed. Before the shards and sessions go.
  void stop();

 private:
  FrontDoor(trust::ServerTrust trust, const Plan& plan);
  /// Who came in, and who was not let in and why: in the audit log.
  void note(const ControlNews& news) const;

  trust::ServerTrust trust_;
  std::function<void(const ControlNews&)> tell_;
  ControlThread thread_;
  House house_;
  ControlPlane plane_;
  std::optional<io::UdpSocket> socket_;
  io::SocketAddress address_;
  std::optional<trust::LocalRuntime> local_;
  ServingSpec serving_;
  bool started_ = false;
};

}  // namespace tandem::server
