#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/control/esc_hub.h"
#include "common/control/send_pace.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_codec.h"
#include "server/policy/roles.h"
#include "server/session/connection.h"
#include "server/session/force_pace.h"
#include "server/session/misbehaviour_monitor.h"
#include "server/session/seat_catalogue.h"

namespace tandem::server {

/// The server's end of one seat: its connection, its newest STATE, its misbehaviour monitor and the near ends of its
/// springs.
class SeatEndpoint {
 public:
  SeatEndpoint(const SceneSpec& scene, std::size_t seat, const AxisArray& scale);

  /// Sets the digest to which everything sent to this seat is added; null: none. It must outlive this.
  void record_outputs(OutputDigest* outputs) noexcept {
    outputs_ = outputs;
    if (connection_) connection_->record_outputs(outputs);
  }
  /// Attaches a client to the seat. Energies, statistics and link timing start from zero.
  /// @param entry  out: the previous contents of the seat, so that the caller's thread frees the memory
  void attach(Time now, SeatConnection& entry) noexcept;
  /// Age of the newest sample when this end last moved [s]; a sample that the client holds back counts as new.
  [[nodiscard]] double age() const noexcept { return age_; }
  /// Longest time for which the client may hold back a datagram; 0 without `send` in the scene.
  [[nodiscard]] Duration held_back() const noexcept { return from_seconds(held_.limit()); }
  /// Time since the client was last heard; time since admission if it never was. @pre taken()
  [[nodiscard]] Duration silence(Time now) const noexcept { return connection_->silence(now); }
  void release() noexcept { taken_ = false; }
  [[nodiscard]] bool taken() const noexcept { return taken_; }

  /// Opens a datagram, checks that the role may send its type, and decodes it. A newer STATE takes effect here; the
  /// result is for the session.
  struct Received {
    const wire::AuthorityMessage* authority = nullptr;  ///< valid until the next datagram
    bool close = false;
    bool accepted_state = false;  ///< a newer STATE took effect
    bool forbidden = false;       ///< the role may not send this type
    /// Authenticated content, also of a datagram that was dropped then; valid until the next datagram. Its data() is
    /// null if the datagram did not authenticate.
    std::span<const std::byte> plaintext;
  };
  /// @param header  of the datagram `bytes`
  Received on_datagram(Time now, const PeerAddress& from, const transport::Header& header,
                       std::span<const std::byte> bytes, PathTokens& tokens) noexcept TANDEM_REALTIME;

  /// Heard within the hold limit: 100 ms, or the silence limit of the gate if that is longer (masters, law `replica`).
  [[nodiscard]] bool alive(Time now) const noexcept;
  /// False for observers: their seats receive no force.
  [[nodiscard]] bool receives_force() const noexcept { return receives_force_; }
  /// One direction of the link is lost: the client reports that it receives nothing, or its echoes stay the same. @pre
  /// taken()
  [[nodiscard]] bool one_way() const noexcept;
  [[nodiscard]] bool ready(Time now) const noexcept { return ready(condition(now)); }
  [[nodiscard]] bool ever_heard() const noexcept { return generation_ > 0; }
  /// Faults of the seat's link or client.
  struct Condition {
    bool alive = false;
    bool lost = true;  ///< not alive, or one direction of the link is lost
    bool quarantined = false;
  };
  [[nodiscard]] Condition condition(Time now) const noexcept {
    const bool heard = alive(now);
    return {heard, !heard || one_way(), misbehaviour_.quarantined(now)};
  }
  /// Alive, its device delivers samples, no latch or local stop is on, and it is not quarantined.
  /// @param now  result of `condition`
  [[nodiscard]] bool ready(const Condition& now) const noexcept {
    return now.alive && (rx_->ready || rx_->engaged) && !rx_->stop && !now.quarantined;
  }
  [[nodiscard]] bool present(Time now) const noexcept { return present(condition(now)); }
  /// The seat's spring may act on tools. @param now  result of `condition`
  [[nodiscard]] bool present(const Condition& now) const noexcept {
    return !now.lost && rx_->engaged && !rx_->stop && !now.quarantined;
  }

  /// Moves the references of all ends. @param near one per end
  void move(Time now, double dt, std::span<const control::NearEnd> near) noexcept TANDEM_REALTIME;
  /// Holds the references while the seat is lost and its authority moves to other seats, so that no force at the tool
  /// jumps. If other seats move the tool farther than this seat's motor could pull, the reference is clamped to the
  /// tool.
  /// @param near  as for `move`
  void hold(std::span<const control::NearEnd> near) noexcept TANDEM_REALTIME;

  /// This seat's end of the spring to a tool. Master seats under law `replica` have one end per tool, all other seats
  /// have one.
  [[nodiscard]] control::ChannelEnd& end(std::size_t tool = 0) noexcept { return *ends_[tool & end_mask_]; }
  [[nodiscard]] const control::ChannelEnd& end(std::size_t tool = 0) const noexcept { return *ends_[tool & end_mask_]; }
  [[nodiscard]] std::size_t ends() const noexcept { return ends_.size(); }
  /// Tools whose couplings are part of this seat's STATE and FORCE, in order; at least one.
  [[nodiscard]] std::span<const std::size_t> coupled_tools() const noexcept { return coupled_tools_; }
  /// Newest sample of the coupling to this tool; of the first coupling if the seat has none to this tool.
  [[nodiscard]] const PortSample& last_sample(std::size_t tool) const noexcept {
    return coupling_index_[tool] == 0 ? rx_->port : further_rx_[coupling_index_[tool] - 1];
  }
  /// Part of the next FORCE for coupling k.
  [[nodiscard]] wire::ToolForce& coupling_force(std::size_t k) noexcept { return k == 0 ? tx : further_tx_[k - 1]; }
  [[nodiscard]] transport::SecureChannel* link() noexcept { return taken_ ? &connection_->link() : nullptr; }
  [[nodiscard]] const transport::SecureChannel* link() const noexcept {
    return taken_ ? &connection_->link() : nullptr;
  }
  /// Newest STATE. Its `telemetry` is valid only with `with_telemetry`: read `telemetry` instead.
  [[nodiscard]] const wire::StateMessage& last_state() const noexcept { return *rx_; }
  /// Newest telemetry, of the newest STATE or of an earlier one.
  [[nodiscard]] const wire::Telemetry& telemetry() const noexcept { return telemetry_; }
  /// Whether this client has sent any: until then `telemetry` is all zeros.
  [[nodiscard]] bool sent_telemetry() const noexcept { return sent_telemetry_; }
  [[nodiscard]] MisbehaviourMonitor& misbehaviour() noexcept { return misbehaviour_; }
  [[nodiscard]] const MisbehaviourMonitor& misbehaviour() const noexcept { return misbehaviour_; }
  [[nodiscard]] bool poll_flood() noexcept { return taken_ && connection_->poll_flood(); }
  /// Hash of the client's resume secret; zero: none.
  [[nodiscard]] const std::array<std::byte, 32>& resume() const noexcept { return resume_; }
  /// Force scale that the client's ticket allows, 0 to 1.
  [[nodiscard]] double force_scale() const noexcept { return force_scale_; }
  /// Restores the owner of the seat, after a server restart.
  void set_resume(const std::array<std::byte, 32>& resume, double force_scale = 1) noexcept {
    resume_ = resume;
    force_scale_ = force_scale;
  }
  [[nodiscard]] AccessRole role() const noexcept { return role_; }
  /// Number of STATEs that took effect.
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }
  [[nodiscard]] bool energy_fell() const noexcept { return energy_fell_; }
  [[nodiscard]] std::uint32_t outages() const noexcept { return outages_; }

  wire::ForceMessage tx{};  ///< the next FORCE, filled by the session

  /// The client can receive: its address is validated and at least one STATE took effect.
  [[nodiscard]] bool reachable() const noexcept { return taken_ && connection_->proven_address() && generation_ > 0; }
  /// A FORCE that is due may be sent: the client was heard recently, or a keep-alive is due. @pre reachable()
  [[nodiscard]] bool may_send(Time now) noexcept { return connection_->may_send(now); }
  /// Whether `tx` differs from what the client predicts, or must be sent anyway. Always true without `send` in the
  /// scene.
  [[nodiscard]] bool force_due(Time now, std::uint32_t tick) noexcept TANDEM_REALTIME {
    return !pace_ || pace_->due(tick, tx, further_tx_, rx_->engaged && alive(now), rx_->port);
  }
  /// The client has been silent for so long that nothing is sent to it any more. @pre reachable()
  [[nodiscard]] bool expired(Time now) const noexcept { return connection_->expired(now); }
  /// Seals `tx`, CLOSE, or a challenge that is due; size 0 if nothing is due.
  [[nodiscard]] Transmit transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  [[nodiscard]] Transmit transmit_close(Time now, std::uint32_t tick, wire::CloseReason why,
                                        std::span<std::byte> buffer) noexcept;
  [[nodiscard]] std::optional<Transmit> transmit_challenge(Time now, std::uint32_t tick,
                                                           std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    return taken_ && connection_->may_have_challenge() ? connection_->poll_challenge(now, tick, codec_, buffer)
                                                       : std::nullopt;
  }

 private:
  void move(std::size_t end, const control::NearEnd& near) noexcept TANDEM_REALTIME;
  /// Advances the received samples to what the client expects this end to predict.
  void predict(Time now) noexcept TANDEM_REALTIME;
  /// Whether a position moved by more than 1 m or 5 rad between two samples. Also records if a received energy fell.
  [[nodiscard]] bool jumps(const PortSample& next, const PortSample& last) noexcept;

  const SceneSpec* scene_;
  Duration tick_;
  AccessRole role_;
  bool receives_force_;
  Duration hold_time_min_, hold_time_max_;  ///< bounds of the hold limit, which depends on the gaps of the link
  Duration one_way_after_;                  ///< silence reported by the client from which the link counts as one-way
  MisbehaviourMonitor misbehaviour_;
  std::array<std::byte, 32> resume_{};
  double force_scale_ = 1;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends_;
  std::size_t end_mask_;  ///< maps a tool's index to its end: 0 where one end serves all tools
  std::vector<std::size_t> coupled_tools_;
  /// Index in `coupled_tools_`; 0 also for tools without a coupling.
  std::array<std::uint8_t, kToolsMax> coupling_index_{};
  std::optional<Connection> connection_;  ///< kept after its client has left, until another client joins
  OutputDigest* outputs_ = nullptr;
  bool taken_ = false;
  wire::Codec codec_;
  control::EndInput input_;  ///< of the last `move`: kept, because most of its array entries are beyond the axes in use
  wire::AuthorityMessage authority_request_;
  /// The newest STATE, and the buffer for the next one: swapped, never copied.
  std::unique_ptr<wire::StateMessage> rx_ = std::make_unique<wire::StateMessage>(),
                                      next_ = std::make_unique<wire::StateMessage>();
  wire::Telemetry telemetry_{};
  bool sent_telemetry_ = false;
  std::vector<PortSample> further_rx_, further_next_;
  std::vector<wire::ToolForce> further_tx_;
  std::optional<ForcePace> pace_;  ///< empty: a FORCE at every tick that the schedule allows
  control::HeldSample held_;
  std::uint64_t generation_ = 0;
  double age_ = 0;
  std::array<bool, kToolsMax> was_engaged_{};  ///< per end
  bool was_present_ = false, energy_fell_ = false;
  std::uint32_t outages_ = 0;
};

}  // namespace tandem::server
