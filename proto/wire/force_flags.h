#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proto/wire/wire_codec.h"
#include "proto/wire/wire_messages.h"

/// Private to proto/wire/wire_codec.cpp: the words of FORCE that combine several small values. wire.proto defines their
/// bits.
namespace tandem::wire {

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
inline std::uint32_t flags_of_force(std::span<const std::byte> in, std::size_t axes) noexcept {
  const std::size_t at = kPreambleSize + 4 * detail::packed(axes, 8) + detail::scalar(1, 1, 4) + 1;
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
