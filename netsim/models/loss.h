#pragma once

#include <cstdint>
#include <optional>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/loss_models.h"
#include "netsim/models/loss_spec.h"

namespace tandem::netsim {

/// Alternating good and bad periods of exponential length: a two-state Markov process in continuous time. It is
/// evaluated lazily; the result does not depend on number or times of the queries.
///
/// Identity: P(bad) = bad_mean / (good_mean + bad_mean);
/// P(bad at t + dt | good at t) = P(bad) (1 - exp(-dt (1/good_mean + 1/bad_mean))).
/// Time is divided into blocks of 1024 mean cycles. Each block starts from the stationary distribution, so that a
/// jump of any length costs a bounded number of draws. The process therefore loses its memory once per 1024
/// cycles; rates are exact.
class BadPeriods {
 public:
  BadPeriods(const BadPeriodsSpec& spec, RandomKey key) noexcept;

  /// @param t  Time{} or later, non-decreasing over calls
  bool bad_at(Time t) noexcept;

  /// Returns the end of the current period. Call after `bad_at`.
  [[nodiscard]] Time period_end() const noexcept { return end_; }

 private:
  static constexpr std::uint64_t kCycles = 1024;
  static constexpr std::uint64_t kDrawBits = 13;  ///< 8192 draws per block, four times the average need

  void start_block(std::int64_t block) noexcept;
  void next_period() noexcept;

  RandomKey key_;
  Duration good_mean_, bad_mean_;
  double bad_share_;
  Duration block_length_;
  std::int64_t block_ = -1;
  std::uint64_t draw_ = 0;
  bool bad_ = false;
  Time end_{};
};

/// Combined loss decision. Every model is evaluated for every datagram, so that enabling one model changes no decision
/// of another.
class Loss {
 public:
  /// @param salt  combined with the index of each per-datagram draw, see Path. Flows of one link have
  /// independent draws and counts, and share the bad periods.
  Loss(const LossSpec& spec, RandomKey key, std::uint64_t salt = 0);

  /// Sets the salt of another flow, with the same effect as construction with it. Allocates nothing.
  void set_salt(std::uint64_t salt) noexcept;

  /// @param now    non-decreasing over calls
  /// @param index  index of the datagram in its flow
  bool lost(Time now, std::uint64_t index) noexcept {
    const bool alone = probability_ > 0 && independent_key_.uniform(index | salt_) < probability_;
    return (models_ && lost_by_model(now, index)) || alone;
  }

  /// Returns whether congestion loses the datagram.
  /// @param wait  time until its first bit would be sent
  [[nodiscard]] bool lost_in_queue(Duration wait, std::uint64_t index) const noexcept;
  /// Returns whether a datagram that would leave during a stall is lost.
  [[nodiscard]] bool lost_in_stall(std::uint64_t index) const noexcept {
    return congestion_ && stall_key_.uniform(index | salt_) < congestion_->in_stall;
  }
  [[nodiscard]] bool depends_on_queue() const noexcept { return congestion_ && congestion_->probability > 0; }

 private:
  bool lost_by_model(Time now, std::uint64_t index) noexcept;

  double probability_;
  std::uint64_t salt_;
  double loss_good_ = 0, loss_bad_ = 0;
  bool models_;  ///< whether any model below is active
  RandomKey independent_key_, period_key_, queue_key_, stall_key_;
  std::optional<BadPeriods> periods_;
  std::optional<GilbertElliott> gilbert_elliott_;
  std::optional<FourState> four_state_;
  std::optional<LossBursts> bursts_;
  std::optional<LossPattern> pattern_;
  std::optional<LossTracePlayer> player_;
  std::optional<CongestionLossSpec> congestion_;
};

}  // namespace tandem::netsim
