#include "common/control/authority.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {
/// Slew of authority after a loss [1/s], for any slew of the scene. The authority of a lost seat is 0 within 100 ms
/// after the server declares the loss, unless hands would feel that (`kFeltMax`). The server declares it 100 ms after
/// the last datagram, which meets the 220 ms of invariant 38 in ARCHITECTURE.md. A ramp from the first missing tick at
/// half the slew would remove authority at every gap of a wireless network.
constexpr double kLossSlew = 10.0;
/// Largest change of force that a change of authority causes [N/s]. Invariant 13 in ARCHITECTURE.md has 0.2 N/ms; the
/// springs and the tool move within the tick.
constexpr double kFeltMax = 180.0;
/// Slew of authority [1/s] that is allowed for any force: a lost seat must not keep its authority because springs are
/// strong.
constexpr double kSlowest = 2.5;
}  // namespace

double AuthorityTank::pay(double joule) noexcept {
  if (joule <= 0) {
    fill(-joule);
    return 1;
  }
  if (joule <= level_) {
    level_ -= joule;
    return 1;
  }
  const double share = level_ / joule;
  level_ = 0;
  return share;
}

ToolAuthority::ToolAuthority(std::size_t masters, double slew, double tank) noexcept
    : masters_(std::min(masters, kMastersMax)), slew_(slew), tank_(tank) {}

bool ToolAuthority::request(const MasterArray& wanted) noexcept {
  const auto weights = normalised(wanted);
  if (weights) {
    wanted_ = *weights;
    settled_ = false;
  }
  return weights.has_value();
}

std::optional<MasterArray> ToolAuthority::normalised(const MasterArray& wanted) const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < masters_; ++i) {
    if (!(wanted[i] >= 0) || !(wanted[i] <= 1)) return std::nullopt;
    sum += wanted[i];
  }
  if (!(std::abs(sum - 1) <= 1e-6)) return std::nullopt;
  MasterArray out{};
  for (std::size_t i = 0; i < masters_; ++i) out[i] = wanted[i] / sum;
  return out;
}

void ToolAuthority::step(const Input& in) noexcept {
  fill(in.dissipated);
  settled_ = false;
  present_ = in.present;
  // Renormalised over the masters present: a passive observer (authority 0) never inherits authority.
  MasterArray goal{};
  double sum = 0;
  bool somebody_lost = false;
  for (std::size_t i = 0; i < masters_; ++i) {
    goal[i] = in.present[i] ? wanted_[i] : 0;
    somebody_lost |= !in.present[i] && now_[i] > 0;
    sum += goal[i];
  }
  if (!(sum > 0)) {
    now_.fill(0);
    held_ = true;
    return;
  }
  for (std::size_t i = 0; i < masters_; ++i) goal[i] /= sum;
  if (held_) {  // springs are at rest after HELD, so setting all authorities at once injects nothing
    now_ = goal;
    held_ = false;
    return;
  }

  double farthest = 0;
  for (std::size_t i = 0; i < masters_; ++i) farthest = std::max(farthest, std::abs(goal[i] - now_[i]));
  settled_ = farthest == 0;
  if (settled_) return;
  const double slew = somebody_lost ? std::max(slew_, kLossSlew) : slew_;
  double share = std::min(1.0, slew * in.dt / farthest);
  if (slew <= kLossSlew) share = std::min(share, unfelt_share(in, goal, farthest));
  double cost = 0;
  for (std::size_t i = 0; i < masters_; ++i) cost += share * (goal[i] - now_[i]) * in.stored[i];
  if (!std::isfinite(cost)) return;
  // A scene without slew requires the step even if it is not paid. The authority of a lost seat must go, for any level
  // of the tank.
  if (std::isfinite(slew_) && !somebody_lost) {
    const double paid = tank_.pay(cost);
    share *= paid;
    cost *= paid;
  }
  if (!std::isfinite(share)) return;
  injected_ += cost;

  double total = 0;
  for (std::size_t i = 0; i < masters_; ++i) {
    now_[i] = share >= 1 ? goal[i] : now_[i] + share * (goal[i] - now_[i]);
    total += now_[i];
  }
  for (std::size_t i = 0; i < masters_; ++i) now_[i] /= total;
}

double ToolAuthority::unfelt_share(const Input& in, const MasterArray& goal, double farthest) const noexcept {
  double squared = 0;
  for (std::size_t a = 0; a < kAxesMax; ++a) {
    double change = 0;
    for (std::size_t i = 0; i < masters_; ++i) change += (goal[i] - now_[i]) * in.pull[i][a];
    squared += change * change;
  }
  const double felt = std::sqrt(squared), slowest = kSlowest * in.dt / farthest;
  return felt > 0 ? std::max(kFeltMax * in.dt / felt, slowest) : 1;  // a force that is no number: as fast as ever
}

}  // namespace tandem::control
