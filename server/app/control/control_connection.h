#pragma once

#include <asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/auth/io/control_stream.h"
#include "common/auth/origin.h"
#include "common/auth/pending_slots.h"
#include "server/app/control/command_rates.h"
#include "server/app/control/control_services.h"

namespace tandem::server {

class ControlConnection;

/// Change that a connection reports to its owner.
enum class ConnectionChange : std::uint8_t { kKeyProved, kJoined, kEnded };
using OnConnectionChange = std::function<void(const ControlConnection&, ConnectionChange)>;

/// One control connection: TLS handshake, then one frame at a time. Each frame is answered before the next one is
/// read. Until the first accepted request it has a deadline and a limit of input bytes. The workstation is looked up
/// for every frame, so a revoked workstation is rejected at its next frame.
class ControlConnection : public std::enable_shared_from_this<ControlConnection> {
 public:
  /// @param services  must outlive this
  /// @param address   of the peer, for logs
  ControlConnection(ControlServices& services, auth::PendingSlots::Id id, asio::ip::tcp::socket socket,
                    const auth::Origin& origin, std::string address, OnConnectionChange on_change);
  /// @param deadline  for the first accepted request
  void start(std::chrono::milliseconds deadline);
  void stop();
  /// Ends the connection without a reply and records `why`.
  void close(ControlEvent why);
  [[nodiscard]] auth::PendingSlots::Id id() const noexcept { return id_; }
  [[nodiscard]] const auth::Origin& origin() const noexcept { return origin_; }
  [[nodiscard]] const auth::KeyFingerprint& fingerprint() const noexcept { return pin_; }
  /// The Welcome that was sent; null before a join.
  [[nodiscard]] const rpc::Welcome* welcome() const noexcept { return welcome_ ? &*welcome_ : nullptr; }
  /// Ends the connection with an error reply if its workstation was revoked.
  void disconnect_if_revoked();

 private:
  void read_next();
  void on_frame(SecretBuffer bytes);
  /// Takes a frame of an unknown workstation again a moment later: another server of the service may have enrolled it
  /// just now. @return false: the connection has waited long enough, or no enrolment can arrive
  bool await_enrolment(SecretBuffer& bytes);
  void on_enrol(const rpc::Enroll& enrol);
  void on_hello(rpc::Hello hello);
  void on_command(rpc::Body command);
  /// Has a request decided. One for a session that a server is about to serve waits for it, at most until `until`.
  void admit(const std::shared_ptr<JoinRequest>& request, Time until);
  void look_again(const std::shared_ptr<JoinRequest>& request, Time until);
  void on_join_reply(const std::shared_ptr<JoinRequest>& request, JoinReply admission, Time until);
  /// Sends a reply, then reads the next frame, or ends the connection if `last`.
  void answer(rpc::Body body, bool last = false);
  void refuse(rpc::ErrorCode reason, std::string text, bool last, std::uint32_t retry_after_s = 0);
  /// Ends the connection after `time`, whether it waits for its client or for a reply of the server.
  void set_deadline(std::chrono::milliseconds time);
  /// The client's key is enrolled.
  void on_key_proved();
  /// The first request was accepted: deadline and input limit end.
  void accepted();
  void on_stream_fault(const auth::StreamError& fault);
  void finish();
  /// If too many wrong codes came from this source or key, sends an error reply. @return true if it did
  bool reply_if_blocked(Duration left);
  [[nodiscard]] std::optional<auth::KeyFingerprint> enrolled_key() const {
    return workstation_ ? std::optional(pin_) : std::nullopt;
  }

  /// Records an event of this connection.
  void record(ControlEvent event, std::string detail = {}) const;

  ControlServices& services_;
  auth::PendingSlots::Id id_;
  std::shared_ptr<auth::ControlStream> stream_;
  auth::Origin origin_;
  auth::Source source_;
  std::string address_;
  OnConnectionChange on_change_;
  auth::KeyFingerprint pin_;
  std::optional<WorkstationRow> workstation_;
  std::optional<rpc::Welcome> welcome_;
  std::optional<rpc::Elsewhere> sent_to_;
  CommandRates rates_;
  asio::steady_timer look_again_;        ///< at a request that waits for its session, or for an enrolment
  std::optional<Time> enrolment_until_;  ///< end of the wait for an enrolment; nullopt: not begun
  TokenBucket forbidden_events_{1, 1};   ///< audit events of forbidden commands
  std::uint32_t request_ = 0;
  bool acted_ = false, refused_ = false;  ///< a command was executed; a command was rejected
  bool pending_ = true, proved_ = false, finished_ = false, writing_ = false;
};

}  // namespace tandem::server
