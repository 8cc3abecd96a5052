#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/base/axes.h"

namespace tandem::control {

/// Converts a credit from joule to nanojoule, rounded down so that an account never gains. NaN and infinity give 0.
[[nodiscard]] inline std::uint64_t credit_nj(double joule) noexcept {
  if (!(joule > 0)) return 0;  // also NaN
  if (joule >= 1e9) [[unlikely]]
    return std::isinf(joule) ? 0 : 1'000'000'000'000'000'000ULL;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(joule * 1e9));  // one instruction through the signed type
}
/// Converts a debit from joule to nanojoule, rounded up. A debit that is not a number exceeds every budget.
[[nodiscard]] inline std::uint64_t debit_nj(double joule) noexcept {
  if (joule <= 0) return 0;
  if (!(joule < 1e9)) return std::numeric_limits<std::uint64_t>::max();
  const double exact = joule * 1e9;
  const auto whole = static_cast<std::int64_t>(exact);
  return static_cast<std::uint64_t>(whole) + (static_cast<double>(whole) < exact ? 1 : 0);
}
/// Returns a + b, or the largest value on overflow.
[[nodiscard]] inline std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) noexcept {
  const std::uint64_t sum = a + b;
  return sum < a ? std::numeric_limits<std::uint64_t>::max() : sum;
}

/// Energy account of one axis at one end of a channel [nJ]. It follows passive set-position modulation [Lee & Huang,
/// T-RO 26(2) 2010] and the two-port observer [Ryu, Artigas, Preusche, Mechatronics 20(7) 2010]:
///
///     out <= initial + received + eta * dissipated        at every instant,
///
/// where `received` is the newest cumulative `in` of the other end. All transmitted sums are monotone. Loss,
/// duplication, reordering and delay therefore only make `received` older and the bound smaller.
class EnergyLedger {
 public:
  EnergyLedger() = default;
  /// @param initial  E_0 [J] >= 0.  @param eta  share of the dissipation that may be spent, [0, 1].
  EnergyLedger(double initial, double eta) noexcept : own_(credit_nj(initial)), eta_(eta) {}

  /// Adds energy that the channel absorbed at this end [J]; the other end may spend it.
  void absorb(double joule) noexcept { in_ = saturating_add(in_, credit_nj(joule)); }
  /// Stores the other end's cumulative `in` [nJ]; older values change nothing.
  void receive(std::uint64_t cumulative) noexcept { received_ = std::max(received_, cumulative); }
  /// Adds energy that this end turned into heat [J]. It is spent once, at this end, and never also sent as `in`.
  /// @return the credited energy [nJ].
  std::uint64_t dissipate(double joule) noexcept {
    const std::uint64_t credited = credit_nj(eta_ * joule);
    own_ = saturating_add(own_, credited);
    return credited;
  }
  /// Returns to the account the cost of an earlier move of this end [J]; this end may spend it again.
  void refund(double joule) noexcept { own_ = saturating_add(own_, credit_nj(joule)); }
  /// Forfeits unspent energy above `limit` [J]. A seat can then not accumulate energy at authority 0 and spend it later
  /// at once. Of the forfeited energy at most `most` [nJ] is passed to the other end, which counts it as received.
  /// @return the energy passed on [nJ].
  std::uint64_t forfeit_above(double limit, std::uint64_t most) noexcept {
    const std::uint64_t kept = credit_nj(limit), margin = margin_nj();
    if (margin <= kept) return 0;
    const std::uint64_t surplus = margin - kept, passed_on = std::min(surplus, most);
    used_ += surplus;
    in_ = saturating_add(in_, passed_on);
    return passed_on;
  }
  /// Pays `joule` if the margin allows. @return whether it was paid.
  [[nodiscard]] bool spend(double joule) noexcept {
    const std::uint64_t cost = debit_nj(joule);
    if (cost > margin_nj() || cost == std::numeric_limits<std::uint64_t>::max()) return false;
    out_ += cost;
    used_ += cost;
    return true;
  }
  /// Books `joule` regardless of the margin, so that monitors see the breach of laws without passivity.
  void spend_unchecked(double joule) noexcept {
    const std::uint64_t cost = debit_nj(joule);
    out_ = saturating_add(out_, cost);
    used_ = saturating_add(used_, cost);
  }
  /// Cumulative energy absorbed at this end; sent to the other end [nJ].
  [[nodiscard]] std::uint64_t in_nj() const noexcept { return in_; }
  /// Cumulative energy paid at this end [nJ].
  [[nodiscard]] std::uint64_t out_nj() const noexcept { return out_; }
  /// Upper bound of `out_nj`: initial + received + eta * dissipated [nJ].
  [[nodiscard]] std::uint64_t bound_nj() const noexcept { return saturating_add(own_, received_); }
  /// Energy that can be spent now: the bound less what was paid and forfeited, at least 0 [nJ].
  [[nodiscard]] std::uint64_t margin_nj() const noexcept {
    const std::uint64_t bound = bound_nj();
    return bound > used_ ? bound - used_ : 0;
  }
  /// Newest cumulative `in` of the other end [nJ].
  [[nodiscard]] std::uint64_t received_nj() const noexcept { return received_; }
  /// Cumulative energy forfeited [nJ].
  [[nodiscard]] std::uint64_t forfeited_nj() const noexcept { return used_ - out_; }
  /// The margin [J].
  [[nodiscard]] double margin() const noexcept { return static_cast<double>(margin_nj()) * 1e-9; }
  /// Returns whether the invariant holds, for monitors; false only if the account is broken.
  [[nodiscard]] bool holds() const noexcept { return out_ <= bound_nj(); }

 private:
  // Sums, because the margin is computed several times per tick.
  std::uint64_t own_ = 0;   ///< initial + eta * dissipated
  std::uint64_t used_ = 0;  ///< out + forfeited
  std::uint64_t in_ = 0, out_ = 0, received_ = 0;
  double eta_ = 0;
};

}  // namespace tandem::control
