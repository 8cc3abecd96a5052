#include "netsim/system/starvation_checker.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim {
namespace {

constexpr double kStarvedMax = 0.3;              // [s]
constexpr double kAside = 0.002, kLeash = 0.98;  // [m] from a target that counts as reached; share of the motor's force
constexpr std::uint64_t kEmptyNj = 10'000;       // [nJ], less than the cost of any step of a reference
constexpr double kTogether = 1e-5;               // [m], at which hand and tool count as together
constexpr double kRecovered = 0.5;               // share of the initial energy at which an account counts as refilled

}  // namespace

void StarvationChecker::check(const ObservedSeat& seat, const Sample& sample) {
  const PortSample& rx = sample.received;
  const control::EndState& state = sample.end.state();
  const ChannelSpec& channel = seat.scene.channel;
  for (std::size_t a = 0; a < seat.scene.dof; ++a) {
    const double root = std::sqrt(sample.scale[a]), ref = state.ref[a];
    // The target lies between the received position, extrapolated by its age, and the position at which the received
    // force would hold.
    const double forced = sample.x[a] + rx.f[a] / state.k[a];
    const double missing = std::max({std::min(rx.x[a], forced) - ref, ref - std::max(rx.x[a], forced), 0.0});
    const double aside = kAside / root + channel.lead_max * std::abs(rx.v[a]);
    const bool there = missing <= aside;
    const bool met = std::abs(rx.x[a] - ref) <= aside;
    // With a weak motor the motion of one tick matters: `pulled` covers the coupled position before and after it.
    const double pulled = std::max(std::abs(ref - sample.x[a]), std::abs(ref - sample.coupled[a]));
    const bool clamped = pulled > kLeash * seat.force_share() * seat.scene.gate.force_max * root / state.k[a];
    const bool moves = std::abs(ref - sample.ref_before[a]) > 0.5 * channel.v_app / root * seat.tick();
    const control::EnergyLedger& ledger = sample.end.ledger(a);
    const std::uint64_t used = ledger.out_nj() + ledger.forfeited_nj();  // by the ledger's sums, not by its verdict
    const bool empty = ledger.bound_nj() <= used + kEmptyNj;
    const bool refilled =
        static_cast<double>(ledger.bound_nj()) >= static_cast<double>(used) + 1e9 * kRecovered * channel.e0;
    const bool together = std::abs(sample.offset[a]) <= kTogether / root;
    recovered_[a] = together && (recovered_[a] || (met && refilled));
    ticks_[a] = there || clamped || moves ? 0 : ticks_[a] + 1;
    if ((recovered_[a] || !empty) && ticks_[a] * seat.tick() > kStarvedMax) seat.violated("starved");
  }
}

}  // namespace tandem::netsim
