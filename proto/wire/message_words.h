#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proto/wire/body_layout.h"
#include "proto/wire/wire_messages.h"

/// Private to proto/wire/wire_codec.cpp: the words of STATE and FORCE that combine several small values. wire.proto
/// defines their bits.
namespace tandem::wire {

/// Bit positions of the parts of STATE's flags (wire.proto).
inline constexpr std::uint32_t kGateAt = 4, kTelemetryFollows = 1U << 7, kStateFlagsMax = 0xff;
static_assert(static_cast<std::uint32_t>(GateState::kFault) < 1U << 3);
inline std::uint32_t state_flags(const StateMessage& m) noexcept {
  return (m.ready ? 1U : 0U) | (m.engaged ? 2U : 0U) | (m.stop ? 4U : 0U) | (m.stop_all ? 8U : 0U) |
         static_cast<std::uint32_t>(m.gate) << kGateAt | (m.with_telemetry ? kTelemetryFollows : 0U);
}
/// @return whether the gate's state exists. `with_telemetry` is left as it is.
inline bool read_state_flags(std::uint32_t flags, StateMessage& out) noexcept {
  const std::uint32_t gate = flags >> kGateAt & 7U;
  out.ready = (flags & 1U) != 0;
  out.engaged = (flags & 2U) != 0;
  out.stop = (flags & 4U) != 0;
  out.stop_all = (flags & 8U) != 0;
  out.gate = static_cast<GateState>(gate);
  return gate <= static_cast<std::uint32_t>(GateState::kFault) && (flags & ~kStateFlagsMax) == 0 &&
         ((flags & kTelemetryFollows) != 0) == out.with_telemetry;
}

/// Layout of FORCE's session word (wire.proto).
inline constexpr std::uint32_t kMissingAt = 8, kTelemetryEveryTick = 1U << 16, kSessionWordMax = (1U << 17) - 1;
static_assert(kSeatsMax < 1U << 8);
inline std::uint32_t session_word(const ForceMessage& m) noexcept {
  return static_cast<std::uint32_t>(m.session) | m.missing << kMissingAt |
         (m.telemetry_every_tick ? kTelemetryEveryTick : 0U);
}
/// @return whether all parts are in range
inline bool read_session_word(std::uint32_t word, ForceMessage& out) noexcept {
  const std::uint32_t state = word & 0xffU;
  out.session = static_cast<SessionState>(state);
  out.missing = word >> kMissingAt & 0xffU;
  out.telemetry_every_tick = (word & kTelemetryEveryTick) != 0;
  return state <= static_cast<std::uint32_t>(SessionState::kOverloaded) && out.missing <= kSeatsMax &&
         word <= kSessionWordMax;
}

/// Bit positions of the parts of FORCE's flags (wire.proto).
inline constexpr std::uint32_t kTicksAt = 3, kByAt = 9, kToAt = 14, kPercentAt = 19, kToolAt = 26, kFlagsEnd = 29,
                               kSurfaces = 1U << 29, kGhost = 1U << 30, kTouching = 1U << 31;
inline constexpr std::uint32_t kForceFlagsMax = kTouching | kGhost | kSurfaces | ((1U << kFlagsEnd) - 1);
static_assert(kTransferNoticeTicks < 1U << 6 && kSeatsMax < TransferParties::kOperator && kMastersMax < 1U << 5 &&
              kToolsMax <= 1U << 3);

inline std::uint32_t force_flags(const ForceMessage& m) noexcept {
  const TransferParties& p = m.transfer_parties;
  return (m.engage ? 1U : 0U) | static_cast<std::uint32_t>(m.transfer) << 1 | m.transfer_ticks << kTicksAt |
         p.by << kByAt | p.to << kToAt | p.percent << kPercentAt | p.tool << kToolAt | (m.touching ? kTouching : 0U);
}
/// @return whether the flags are in range and unused bits are 0
inline bool read_force_flags(std::uint32_t flags, ForceMessage& out) noexcept {
  TransferParties& p = out.transfer_parties;
  out.touching = (flags & kTouching) != 0;
  flags &= ~(kTouching | kSurfaces | kGhost);
  if (flags >> kFlagsEnd != 0) return false;
  out.engage = (flags & 1U) != 0;
  out.transfer = static_cast<TransferNotice>(flags >> 1 & 3U);
  out.transfer_ticks = flags >> kTicksAt & 63U;
  p = {flags >> kByAt & 31U, flags >> kToAt & 31U, flags >> kPercentAt & 127U, flags >> kToolAt & 7U};
  const bool announced = out.transfer == TransferNotice::kGaining || out.transfer == TransferNotice::kLosing;
  const bool in_range = out.transfer_ticks <= kTransferNoticeTicks &&
                        (p.by <= kSeatsMax || p.by == TransferParties::kOperator) && p.to <= kMastersMax &&
                        p.percent <= 100 && p.tool < kToolsMax;
  return in_range && (announced || flags >> kTicksAt == 0);
}

/// The flags word of an encoded FORCE, read at its fixed offset. @pre in has the size of the smallest FORCE
inline std::uint32_t flags_of_force(std::span<const std::byte> in, std::size_t axes, bool exact) noexcept {
  const std::size_t at =
      kPreambleSize + (exact ? 0 : 3 * detail::packed(axes, 4)) + detail::packed(axes, 8) + detail::scalar(1, 1, 4) + 1;
  std::uint32_t flags = 0;
  std::memcpy(&flags, in.data() + at, sizeof flags);
  return flags;
}

/// Layout of FORCE's surfaces word (wire.proto).
inline constexpr std::uint32_t kCount = 7, kPull = 0xffff, kPullAt = 8, kSurfacesMax = kPull << kPullAt | kCount;
inline std::uint32_t surfaces_word(const ToolForce& m) noexcept {
  if (m.contacts.size == 0 && m.slave_pull == 0) [[likely]]
    return 0;
  const double pull = std::isfinite(m.slave_pull) ? std::clamp(m.slave_pull, 0.0, 1.0) : 0;
  return m.contacts.size | static_cast<std::uint32_t>(pull * kPull + 0.5) << kPullAt;
}

}  // namespace tandem::wire
