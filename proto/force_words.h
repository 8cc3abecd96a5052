#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proto/wire.h"
#include "proto/wire_codec.h"

/// Private to proto/wire_codec.cpp: the words of FORCE that hold several small things each (wire.proto has their bits).
namespace tandem::wire {

/// Places of the parts of FORCE's flags (wire.proto).
inline constexpr std::uint32_t kTicksAt = 3, kByAt = 9, kToAt = 14, kPercentAt = 19, kToolAt = 26, kFlagsEnd = 29, kSurfaces = 1U << 29, kGhost = 1U << 30, kTouching = 1U << 31;
inline constexpr std::uint32_t kForceFlagsMax = kTouching | kGhost | kSurfaces | ((1U << kFlagsEnd) - 1);
static_assert(kHandoverNotice < 1U << 6 && kSeatsMax < HandoverParties::kOperator && kMastersMax < 1U << 5 && kToolsMax <= 1U << 3);

inline std::uint32_t force_flags(const ForceMessage& m) noexcept {
  const HandoverParties& p = m.handover_parties;
  return (m.engage ? 1U : 0U) | static_cast<std::uint32_t>(m.handover) << 1 | m.handover_ticks << kTicksAt | p.by << kByAt | p.to << kToAt |
         p.percent << kPercentAt | p.tool << kToolAt | (m.touching ? kTouching : 0U);
}
/// @return whether the flags are in range and say nothing beside what they mean
inline bool read_force_flags(std::uint32_t flags, ForceMessage& out) noexcept {
  HandoverParties& p = out.handover_parties;
  out.touching = (flags & kTouching) != 0;
  flags &= ~(kTouching | kSurfaces | kGhost);
  if (flags >> kFlagsEnd != 0) return false;
  out.engage = (flags & 1U) != 0;
  out.handover = static_cast<Handover>(flags >> 1 & 3U);
  out.handover_ticks = flags >> kTicksAt & 63U;
  p = {flags >> kByAt & 31U, flags >> kToAt & 31U, flags >> kPercentAt & 127U, flags >> kToolAt & 7U};
  const bool announced = out.handover == Handover::kComes || out.handover == Handover::kGoes;
  const bool in_range = out.handover_ticks <= kHandoverNotice && (p.by <= kSeatsMax || p.by == HandoverParties::kOperator) && p.to <= kMastersMax &&
                        p.percent <= 100 && p.tool < kToolsMax;
  return in_range && (announced || flags >> kTicksAt == 0);
}

/// FORCE's flags, where they stand. @pre in has the size of the smallest FORCE
inline std::uint32_t flags_of_force(std::span<const std::byte> in, std::size_t axes) noexcept {
  const std::size_t at = kPreambleSize + 4 * detail::packed(axes, 8) + detail::scalar(1, 1, 4) + 1;
  std::uint32_t flags = 0;
  std::memcpy(&flags, in.data() + at, sizeof flags);
  return flags;
}

/// FORCE's word about surfaces (wire.proto).
inline constexpr std::uint32_t kCount = 7, kPull = 0xffff, kPullAt = 8, kSurfacesMax = kPull << kPullAt | kCount;
inline std::uint32_t surfaces_word(const TieForce& m) noexcept {
  if (m.contacts.size == 0 && m.slave_pull == 0) [[likely]] return 0;
  const double pull = std::isfinite(m.slave_pull) ? std::clamp(m.slave_pull, 0.0, 1.0) : 0;
  return m.contacts.size | static_cast<std::uint32_t>(pull * kPull + 0.5) << kPullAt;
}

}  // namespace tandem::wire
