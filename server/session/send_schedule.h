#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "proto/spec/scene_spec.h"
#include "server/policy/load_shedder.h"
#include "server/session/close_out.h"
#include "server/session/seat_endpoint.h"

namespace tandem::server {

/// Decides at which ticks a datagram to each seat is due, and hands out those that are due.
///
/// Seats that control a tool get FORCE at every tick. Seats that receive no force get at most 60 datagrams per second.
/// At high shed levels observers and evaluators whose seat is not required get fewer (ShedLevel).
class SendSchedule {
 public:
  /// @param seats  of the session, in the order of the scene; must outlive this
  SendSchedule(const SceneSpec& scene, std::span<SeatEndpoint> seats) noexcept;

  /// Ticks between two FORCE datagrams to this seat at a shed level; at least 1.
  [[nodiscard]] std::uint32_t interval(std::size_t seat, ShedLevel level) const noexcept;
  /// Marks the datagrams of this tick. A datagram that was due and not sent is dropped: the new one replaces it.
  /// @param tick  number of the server's tick; ticks may be missing
  void begin_tick(Time now, std::uint32_t tick, ShedLevel level, const CloseOuts& closing) noexcept TANDEM_REALTIME;
  /// Writes the next datagram into `buffer`: a path challenge, CLOSE or FORCE. @return nullopt if none is due
  [[nodiscard]] std::optional<Transmit> poll(Time now, std::uint32_t tick, const CloseOuts& closing,
                                             std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  /// `poll` has nothing more to send in this tick.
  [[nodiscard]] bool done() const noexcept { return next_ >= seats_.size(); }
  /// Lets `poll` begin with the first seat again.
  void rewind() noexcept { next_ = 0; }

 private:
  /// The seat controls a tool that the session cannot do without.
  [[nodiscard]] bool controls(std::size_t seat) const noexcept;
  /// Whether a new interval of the seat begins; true once per interval, even after missed ticks.
  [[nodiscard]] bool turn_begins(std::size_t seat, std::uint32_t tick, ShedLevel level) noexcept TANDEM_REALTIME;

  const SceneSpec* scene_;
  std::span<SeatEndpoint> seats_;
  std::uint32_t observer_interval_;  ///< ticks between two FORCEs to a seat that receives no force
  /// Upper bound for evaluators: six intervals fit into the gates' silence limit.
  std::uint32_t evaluator_interval_max_;
  std::array<bool, kSeatsMax> every_tick_{};  ///< the interval of this seat is 1 at every shed level
  std::array<bool, kSeatsMax> due_{};
  std::array<std::uint32_t, kSeatsMax> last_turn_{};  ///< number of the last interval in which a FORCE was due
  std::size_t next_ = 0;                              ///< next seat for `poll`
};

}  // namespace tandem::server
