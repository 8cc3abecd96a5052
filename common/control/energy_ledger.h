#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/base/axes.h"

namespace tandem::control {

/// Joule to nanojoule, rounded so that an account never gains: credits down.
[[nodiscard]] inline std::uint64_t credit_nj(double joule) noexcept {
  if (!(joule > 0) || std::isinf(joule)) return 0;  // also NaN: what is no number is no credit
  if (joule >= 1e9) return 1'000'000'000'000'000'000ULL;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(joule * 1e9));  // by way of the signed type: one instruction
}
/// Debits up. A debit that is not a number is beyond every budget.
[[nodiscard]] inline std::uint64_t debit_nj(double joule) noexcept {
  if (joule <= 0) return 0;
  if (!(joule < 1e9)) return std::numeric_limits<std::uint64_t>::max();
  const double exact = joule * 1e9;
  const auto whole = static_cast<std::int64_t>(exact);
  return static_cast<std::uint64_t>(whole) + (static_cast<double>(whole) < exact ? 1 : 0);
}
[[nodiscard]] inline std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) noexcept {
  const std::uint64_t sum = a + b;
  return sum < a ? std::numeric_limits<std::uint64_t>::max() : sum;
}

/// The account of one axis at one end of a channel [nJ], in the spirit of passive set-position modulation
/// [Lee & Huang, T-RO 26(2) 2010] and of the two-port observer [Ryu, Artigas, Preusche, Mechatronics 20(7) 2010]:
///
///     out <= initial + received + eta * dissipated        at every instant,
///
/// where `received` is the newest cumulative `in` of the other end. All sums that travel are monotone, so loss, duplication,
/// reordering and any delay make `received` older and the bound smaller, never wrong.
class EnergyLedger {
 public:
  EnergyLedger() = default;
  /// @param initial  E_0 [J] >= 0.  @param eta  share of dissipation that may be spent, [0, 1].
  EnergyLedger(double initial, double eta) noexcept : initial_(credit_nj(initial)), eta_(eta) {}

  /// Energy the channel took in here; the other end may spend it [J].
  void absorb(double joule) noexcept { in_ = saturating_add(in_, credit_nj(joule)); }
  /// The other end's cumulative `in`; older values change nothing [nJ].
  void receive(std::uint64_t cumulative) noexcept { received_ = std::max(received_, cumulative); }
  /// Energy this end turned into heat [J]; spent once, here, and never also sent as `in`.
  /// @return what was credited [nJ].
  std::uint64_t dissipate(double joule) noexcept {
    const std::uint64_t credited = credit_nj(eta_ * joule);
    dissipated_ = saturating_add(dissipated_, credited);
    return credited;
  }
  /// A move of this end gave back what an earlier one had cost [J]; it may be spent here again.
  void take_back(double joule) noexcept { dissipated_ = saturating_add(dissipated_, credit_nj(joule)); }
  /// Gives up what is unspent above `limit` [J], so that nobody hoards while his authority is 0 and spends it later at once. Of that at
  /// most `most` [nJ] is handed on to the other end: here it counts as given up, there as received.
  /// @return what was handed on [nJ].
  std::uint64_t give_up_above(double limit, std::uint64_t most) noexcept {
    const std::uint64_t kept = credit_nj(limit), margin = margin_nj();
    if (margin <= kept) return 0;
    const std::uint64_t surplus = margin - kept, passed_on = std::min(surplus, most);
    forfeited_ += surplus;
    in_ = saturating_add(in_, passed_on);
    return passed_on;
  }
  /// Pays `joule` if the margin allows. @return whether it was paid.
  [[nodiscard]] bool spend(double joule) noexcept {
    const std::uint64_t cost = debit_nj(joule);
    if (cost > margin_nj() || cost == std::numeric_limits<std::uint64_t>::max()) return false;
    out_ += cost;
    return true;
  }
  /// Books `joule` whatever the margin is: for laws without passivity, so that their breach can be seen.
  void spend_unchecked(double joule) noexcept { out_ = saturating_add(out_, debit_nj(joule)); }
  [[nodiscard]] std::uint64_t in_nj() const noexcept { return in_; }
  [[nodiscard]] std::uint64_t out_nj() const noexcept { return out_; }
  [[nodiscard]] std::uint64_t bound_nj() const noexcept {
    return saturating_add(saturating_add(initial_, received_), dissipated_);
  }
  [[nodiscard]] std::uint64_t margin_nj() const noexcept {
    const std::uint64_t used = saturating_add(out_, forfeited_);
    const std::uint64_t bound = bound_nj();
    return bound > used ? bound - used : 0;
  }
  [[nodiscard]] std::uint64_t received_nj() const noexcept { return received_; }
  [[nodiscard]] std::uint64_t forfeited_nj() const noexcept { return forfeited_; }
  [[nodiscard]] double margin() const noexcept { return static_cast<double>(margin_nj()) * 1e-9; }
  /// The invariant itself, for monitors: true unless the account is broken.
  [[nodiscard]] bool holds() const noexcept { return out_ <= bound_nj(); }

 private:
  std::uint64_t initial_ = 0, in_ = 0, out_ = 0, received_ = 0, dissipated_ = 0, forfeited_ = 0;
  double eta_ = 0;
};

}  // namespace tandem::control
