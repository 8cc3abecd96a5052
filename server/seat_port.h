#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/control/channel.h"
#include "proto/scene_spec.h"
#include "proto/wire_codec.h"
#include "server/conduct.h"
#include "server/connection.h"
#include "server/reception.h"
#include "server/roles.h"

namespace tandem::server {

/// The server's end of one seat: its link, what it last said, and its end of the spring.
class SeatPort {
 public:
  SeatPort(const SceneSpec& scene, std::size_t seat, const AxisArray& scale);

  /// A client took the seat. Energies, statistics and freshness start anew.
  /// @param entry  holds what was there before afterwards: memory is given back on the caller's thread
  void take(Time now, Entry& entry) noexcept;
  /// Of its newest sample, when this end last moved [s].
  [[nodiscard]] double age() const noexcept { return age_; }
  /// Since it was last heard; since it was taken when its client never spoke. @pre taken()
  [[nodiscard]] Duration silence(Time now) const noexcept { return connection_->silence(now); }
  void release() noexcept { taken_ = false; }
  [[nodiscard]] bool taken() const noexcept { return taken_; }

  /// Opens, asks whether the role may send such a thing, decodes; STATE acts here. @return the rest, for the session.
  struct Heard {
    const wire::AuthorityMessage* authority = nullptr;  ///< until the next datagram
    bool close = false;
    bool acted = false;      ///< a newer STATE
    bool forbidden = false;  ///< its role may not send this
  };
  Heard on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes, PathTokens& tokens) noexcept TANDEM_REALTIME;

  /// Heard from within the hold limit.
  [[nodiscard]] bool alive(Time now) const noexcept;
  /// A hand that may be given force: not an observer's.
  [[nodiscard]] bool feels() const noexcept { return feels_; }
  /// Its last word says that it hears nothing of us, or it echoes nothing newer: one direction is lost. @pre taken()
  [[nodiscard]] bool deaf() const noexcept;
  /// Alive, its device streams, nothing latched, nobody stopped it.
  [[nodiscard]] bool ready(Time now) const noexcept {
    return alive(now) && (rx_->ready || rx_->engaged) && !rx_->stop && !conduct_.isolated(now);
  }
  [[nodiscard]] bool alive_once() const noexcept { return generation_ > 0; }
  /// Its spring may act on tools.
  [[nodiscard]] bool present(Time now) const noexcept { return alive(now) && rx_->engaged && !rx_->stop && !conduct_.isolated(now) && !deaf(); }

  /// What the near end of a spring hangs on.
  struct Near {
    bool engaged = false;    ///< else it rests, without elongation
    AxisArray x{};           ///< the tool's position, a weighted one where one end serves several tools
    AxisArray offset{};      ///< hand minus tool, taken off what was received
    AxisArray dissipated{};  ///< heat at the tools this seat may spend [J]
    double weight = 0;       ///< how many such springs a move loads
    double pass_on = 1;      ///< share of the heat the client may have when it is not needed here
  };
  /// Moves the references of all ends. @param near  of each
  void move(Time now, double dt, std::span<const Near> near) noexcept TANDEM_REALTIME;
  /// The seat is lost and its weight moves to other seats: its end keeps its reference, so that nothing at the tool jumps. The
  /// reference gives way to a tool that others take farther than this seat's motor could pull.
  /// @param near  as for `move`
  void hold(std::span<const Near> near) noexcept TANDEM_REALTIME;

  /// This seat's end of the spring to a tool: hands of law `replica` have one for each tool, all others one.
  [[nodiscard]] control::ChannelEnd& end(std::size_t tool = 0) noexcept { return *ends_[tool & end_mask_]; }
  [[nodiscard]] const control::ChannelEnd& end(std::size_t tool = 0) const noexcept { return *ends_[tool & end_mask_]; }
  [[nodiscard]] std::size_t ends() const noexcept { return ends_.size(); }
  /// The tools whose ties have a place in this seat's STATE and FORCE, in order; at least one.
  [[nodiscard]] std::span<const std::size_t> tied_tools() const noexcept { return tied_tools_; }
  /// What the hand said last of its tie to this tool; of its first one, where it has none to it.
  [[nodiscard]] const PortSample& heard_of(std::size_t tool) const noexcept {
    return tie_of_[tool] == 0 ? rx_->port : further_rx_[tie_of_[tool] - 1];
  }
  /// What the hand is told next of its tie k.
  [[nodiscard]] wire::TieForce& told(std::size_t k) noexcept { return k == 0 ? tx : further_tx_[k - 1]; }
  [[nodiscard]] link::Link* link() noexcept { return taken_ ? &connection_->link() : nullptr; }
  [[nodiscard]] const link::Link* link() const noexcept { return taken_ ? &connection_->link() : nullptr; }
  [[nodiscard]] const wire::StateMessage& heard() const noexcept { return *rx_; }
  [[nodiscard]] Conduct& conduct() noexcept { return conduct_; }
  [[nodiscard]] const Conduct& conduct() const noexcept { return conduct_; }
  [[nodiscard]] bool poll_flood() noexcept { return taken_ && connection_->poll_flood(); }
  [[nodiscard]] const std::array<std::byte, 32>& resume() const noexcept { return resume_; }  ///< hash of its secret
  [[nodiscard]] double force_scale() const noexcept { return force_scale_; }                  ///< what its ticket allowed
  /// Who sat here before the server died.
  void remember(const std::array<std::byte, 32>& resume, double force_scale = 1) noexcept {
    resume_ = resume;
    force_scale_ = force_scale;
  }
  [[nodiscard]] AccessRole role() const noexcept { return role_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }  ///< counts STATEs that acted
  [[nodiscard]] bool energy_fell() const noexcept { return energy_fell_; }
  [[nodiscard]] std::uint32_t outages() const noexcept { return outages_; }

  wire::ForceMessage tx{};  ///< the next FORCE, filled by the session

  /// Somebody is there to be told: he spoke, and his address is proven.
  [[nodiscard]] bool reachable() const noexcept { return taken_ && connection_->at() && generation_ > 0; }
  /// A FORCE that is due may go out: the peer spoke lately, or it is time for a keep-alive. @pre reachable()
  [[nodiscard]] bool may_be_told(Time now) noexcept { return connection_->may_be_told(now); }
  /// Silent for so long that nothing goes there any more. @pre reachable()
  [[nodiscard]] bool forgotten(Time now) const noexcept { return connection_->forgotten(now); }
  /// Seals `tx`, CLOSE, or a challenge that is due; size 0 if nothing is.
  [[nodiscard]] Transmit transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  [[nodiscard]] Transmit transmit_close(Time now, std::uint32_t tick, wire::CloseReason why, std::span<std::byte> buffer) noexcept;
  [[nodiscard]] std::optional<Transmit> transmit_challenge(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept
      TANDEM_REALTIME {
    return taken_ && connection_->challenges() ? connection_->poll_challenge(now, tick, codec_, buffer) : std::nullopt;
  }

 private:
  void move(std::size_t end, const Near& near) noexcept TANDEM_REALTIME;
  /// Farther from the sample before than any hand comes in the time between. Also notes energy that is taken back.
  [[nodiscard]] bool jumps(const PortSample& next, const PortSample& last) noexcept;

  const SceneSpec* scene_;
  Duration tick_;
  AccessRole role_;
  bool feels_;
  Duration hold_least_, hold_most_;  ///< of a silence, by the gaps of its link
  Duration deaf_after_;  ///< its own word that it hears nothing
  Conduct conduct_;
  std::array<std::byte, 32> resume_{};
  double force_scale_ = 1;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends_;
  std::size_t end_mask_;  ///< of a tool's number, which says which end: 0 where there is one for all
  std::vector<std::size_t> tied_tools_;
  std::array<std::uint8_t, kToolsMax> tie_of_{};  ///< place in `tied_tools_`; 0 also of tools without a tie
  std::optional<Connection> connection_;  ///< kept when its client has left, until another comes
  bool taken_ = false;
  wire::Codec codec_;
  control::EndInput input_;  ///< of the last `move`: kept, as most of its arrays are beyond the axes in use
  wire::AuthorityMessage wish_;
  /// What acts, and room for what comes next: exchanged, never copied.
  std::unique_ptr<wire::StateMessage> rx_ = std::make_unique<wire::StateMessage>(), next_ = std::make_unique<wire::StateMessage>();
  std::vector<PortSample> further_rx_, further_next_;
  std::vector<wire::TieForce> further_tx_;
  std::uint64_t generation_ = 0;
  double age_ = 0;
  std::array<bool, kToolsMax> was_engaged_{};  ///< per end
  bool was_present_ = false, energy_fell_ = false;
  std::uint32_t outages_ = 0;
};

}  // namespace tandem::server
