#include "netsim/system/sensor_faults.h"

#include <iterator>
#include <limits>

namespace tandem::netsim {
namespace {

/// Heat that the fault kHot reports, as a share of the motors' limit.
constexpr double kTooHot = 1.1;
/// Readings that no device has: positions, velocities. The squares of some are finite, those of others are not.
constexpr double kAbsurd[] = {1e5, -1e9, 1e160, -1e300};

}  // namespace

const hal::State& SensorFaults::read(Time now, const FaultSchedule& faults, const hal::State& state,
                                     std::size_t joints) noexcept {
  invalid_ = false;
  // NOLINTNEXTLINE(bugprone-return-const-ref-from-parameter): the header tells callers how long the result lives
  if (faults.empty()) return state;
  const bool frozen = faults.active(Fault::Kind::kFrozen, now);
  if (!frozen || !frozen_) reading_ = state;
  frozen_ = frozen;
  reading_.heat = faults.active(Fault::Kind::kHot, now) ? std::optional{kTooHot} : state.heat;
  const bool nan = faults.active(Fault::Kind::kNotANumber, now);
  if (!nan && !faults.active(Fault::Kind::kOutOfRange, now)) return reading_;
  const std::uint64_t drawn = key_.bits(static_cast<std::uint64_t>(now.time_since_epoch() / tick_));
  const std::size_t joint = drawn % joints;
  const double wrong = nan ? std::numeric_limits<double>::quiet_NaN() : kAbsurd[(drawn >> 8) % std::size(kAbsurd)];
  switch ((drawn >> 16) % 3) {
    case 0:
      reading_.q[joint] = wrong;
      break;
    case 1:
      reading_.dq[joint] = wrong;
      break;
    default:
      reading_.x[0] = wrong;
      break;
  }
  frozen_ = false;
  invalid_ = true;
  return reading_;
}

}  // namespace tandem::netsim
