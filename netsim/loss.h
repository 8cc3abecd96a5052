#pragma once

#include <cstdint>
#include <optional>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/loss_models.h"
#include "netsim/loss_spec.h"

namespace tandem::netsim {

/// Alternating good and bad periods of exponential length: a two-state Markov process in continuous time, advanced
/// lazily, the same whatever is asked of it and how often.
///
/// Identity: P(bad) = bad_mean / (good_mean + bad_mean);
/// P(bad at t + dt | good at t) = P(bad) (1 - exp(-dt (1/good_mean + 1/bad_mean))).
/// Time is cut into blocks of 1024 mean cycles, each starting from the stationary distribution, so that a jump of any
/// length costs a bounded number of draws. (At one cycle in 1024 the past is forgotten; rates are exact.)
class BadPeriods {
 public:
  BadPeriods(const BadPeriodsSpec& spec, RandomKey key) noexcept;

  /// @param t  never decreasing [Time{} or later]
  bool bad_at(Time t) noexcept;

  /// When the present period ends; valid after `bad_at`.
  [[nodiscard]] Time period_end() const noexcept { return end_; }

 private:
  static constexpr std::uint64_t kCycles = 1024;
  static constexpr std::uint64_t kDrawBits = 13;  ///< 8192 draws per block, four times what is needed on average

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

/// Decides which datagrams are lost. Every model is asked about every datagram, whatever the others say, so that
/// switching one on moves no decision of another.
class Loss {
 public:
  /// @param salt  put on top of the index where a number is drawn for it, see Path: flows of one link draw for
  ///              themselves and count for themselves, and meet the same bad times
  Loss(const LossSpec& spec, RandomKey key, std::uint64_t salt = 0);

  /// The salt of another flow, as if made with it. Takes no memory.
  void set_salt(std::uint64_t salt) noexcept;

  /// @param now    never decreasing
  /// @param index  of the datagram in its flow
  bool lost(Time now, std::uint64_t index) noexcept {
    const bool alone = probability_ > 0 && alone_key_.uniform(index | salt_) < probability_;
    return (models_ && lost_by_model(now, index)) || alone;
  }

  /// Lost because of the queue the datagram finds. @param wait before its first bit is sent
  [[nodiscard]] bool lost_in_queue(Duration wait, std::uint64_t index) const noexcept;
  /// Lost because it would leave during a stall.
  [[nodiscard]] bool lost_in_stall(std::uint64_t index) const noexcept {
    return congestion_ && stall_key_.uniform(index | salt_) < congestion_->in_stall;
  }
  [[nodiscard]] bool minds_queue() const noexcept { return congestion_ && congestion_->probability > 0; }

 private:
  bool lost_by_model(Time now, std::uint64_t index) noexcept;

  double probability_;
  std::uint64_t salt_;
  double loss_good_ = 0, loss_bad_ = 0;
  bool models_;  ///< any of those below
  RandomKey alone_key_, period_key_, queue_key_, stall_key_;
  std::optional<BadPeriods> periods_;
  std::optional<GilbertElliott> gilbert_elliott_;
  std::optional<FourState> four_state_;
  std::optional<LossBursts> bursts_;
  std::optional<LossPattern> pattern_;
  std::optional<LossPlayer> player_;
  std::optional<CongestionLossSpec> congestion_;
};

}  // namespace tandem::netsim
