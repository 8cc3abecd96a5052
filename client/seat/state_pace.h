#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/control/send_pace.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Decides which ticks of a client have a STATE, for seats with `send` in their setup. Samples of an engaged seat obey
/// `control::SendPace`. A seat that is not engaged sends at every tick, and so does one that requests something. After
/// a change of any flag, kRepeats ticks have a STATE, so that a lost datagram delays it by one tick only.
class StatePace {
 public:
  static constexpr std::uint32_t kRepeats = 10;  ///< ticks

  /// @param params  of this seat (setup::send_pace)
  /// @param tools   number of tools, at least 1
  StatePace(const control::SendPace::Params& params, std::size_t tools) : pace_(params, tools) {}

  /// Whether this tick has a STATE; a true result counts as sent.
  /// @param tick     number of the tick; may skip numbers
  /// @param further  samples of the tools beyond the first
  [[nodiscard]] bool due(std::uint32_t tick, const wire::StateMessage& state,
                         std::span<const PortSample> further) noexcept TANDEM_REALTIME {
    const Flags flags{state.gate, state.ready, state.engaged, state.stop, state.stop_all, state.resume_stop};
    if (flags != flags_) changed_ = tick;
    flags_ = flags;
    const bool requests = state.stop || state.stop_all || state.resume_stop != 0;
    if (state.engaged && !requests && tick - changed_ >= kRepeats) {
      if (!pace_.allowed(tick)) return false;
      bool send = pace_.overdue(tick) || pace_.noticeable(tick, 0, state.port, 0);
      for (std::size_t k = 0; !send && k < further.size(); ++k) send = pace_.noticeable(tick, 1 + k, further[k], 0);
      if (!send) return false;
    }
    pace_.record(0, state.port);
    for (std::size_t k = 0; k < further.size(); ++k) pace_.record(1 + k, further[k]);
    pace_.sent(tick);
    return true;
  }
  /// The next tick has a STATE: a new connection knows none.
  void restart() noexcept { pace_.restart(); }

 private:
  /// Values that the server must know at once.
  struct Flags {
    wire::GateState gate = wire::GateState::kOff;
    bool ready = false, engaged = false, stop = false, stop_all = false;
    std::uint32_t resume_stop = 0;
    friend bool operator==(const Flags&, const Flags&) = default;
  };

  control::SendPace pace_;
  Flags flags_;
  std::uint32_t changed_ = 0;  ///< tick of the last change of the flags
};

}  // namespace tandem::client
