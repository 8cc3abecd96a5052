#include "common/trust/limiter.h"

namespace tandem::trust {

Source Source::of_v6(const std::array<std::uint8_t, 16>& a) noexcept {
  const auto number = [&a](std::size_t from, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = from; i < from + count; ++i) value = value << 8 | a[i];
    return value;
  };
  if (number(0, 8) == 0 && number(8, 4) == 0xffff) return v4(static_cast<std::uint32_t>(number(12, 4)));
  const bool loopback = number(0, 8) == 0 && number(8, 8) == 1;
  // ::1 shares its 64 bits with nobody but itself as far as limits go.
  return {number(0, 8), true, loopback};
}

void FailureLimiter::failed(const Source& source, Time now) {
  if (source.loopback) return;
  Record& record = sources_.at(source, now, {});
  record.at[record.count % kFailures] = now;
  ++record.count;
  if (record.count < kFailures) return;
  // The oldest of the last ten is in the place that the next one will take.
  if (now - record.at[record.count % kFailures] > kWithin) return;
  record.blocked_until = now + kBlocked;
  record.count = 0;
}

Duration FailureLimiter::blocked_for(const Source& source, Time now) const {
  const Record* const record = sources_.find(source);
  if (record == nullptr || record->blocked_until == Time{}) return Duration::zero();
  return record->blocked_until - now;
}

}  // namespace tandem::trust
