#pragma once

#include <array>

#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Checks one end of a channel for starvation: a reference stays in place although received data, hand and motor would
/// let it move. Only an empty account may cause that. The check uses positions, not the refusals that the ledger
/// reports.
///
/// An account that really is empty is excused until hand and tool have come together in the recovery phase. Its account
/// must then hold at least half its initial energy. An outage, or a tool that fell without a participant, parted them
/// and emptied the accounts; that was no ordinary motion. The energy that brings them together comes from the hand, and
/// a hand may supply none. Examples are a resting hand, and a hand that strokes within the stretch of its spring and
/// takes back its energy. A channel that lifted the tool nevertheless would deliver energy that it never received.
class StarvationChecker {
 public:
  struct Sample {
    const control::ChannelEnd& end;
    const AxisArray& scale;  ///< tip gain to port gain, per axis
    const PortSample& received;
    const AxisArray &x, &coupled;  ///< position of the body coupled to this end: after the tick, and before its motion
    const AxisArray& ref_before;   ///< reference after the previous tick
    const AxisArray& offset;       ///< hand minus tool that the session has yet to close
  };
  void check(const ObservedSeat& seat, const Sample& sample);
  /// This tick is not judged.
  void skip() noexcept { ticks_ = {}; }

 private:
  std::array<unsigned, kAxesMax> ticks_{};  ///< consecutive ticks in which the reference stayed, per axis
  /// The reference reached its target with energy to spare, after hand and tool were last apart; per axis.
  std::array<bool, kAxesMax> recovered_{};
};

}  // namespace tandem::netsim
