#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/loss_spec.h"
#include "netsim/models/poisson_intervals.h"

/// Loss models other than BadPeriods. Each is evaluated exactly once per datagram, in order. Draws are keyed by the
/// datagram's index, so that no model depends on another's decision.
namespace tandem::netsim {

/// Gilbert-Elliott model per datagram, see GilbertElliottSpec.
class GilbertElliott {
 public:
  /// The first datagram draws its state from the stationary distribution.
  GilbertElliott(const GilbertElliottSpec& spec, RandomKey key, std::uint64_t salt = 0) noexcept;
  [[nodiscard]] bool lost(std::uint64_t index) noexcept;
  /// Draws the initial state of the flow with this salt.
  void begin(std::uint64_t salt) noexcept { bad_ = first_key_.uniform(salt) < spec_.p / (spec_.p + spec_.r); }
  [[nodiscard]] bool bad() const noexcept { return bad_; }  ///< state that decided the last datagram

 private:
  GilbertElliottSpec spec_;
  RandomKey state_key_, loss_key_, first_key_;
  bool bad_ = false;
};

/// Four-state model per datagram, see FourStateSpec.
class FourState {
 public:
  FourState(const FourStateSpec& spec, RandomKey key) noexcept : spec_(spec), key_(key) {}
  [[nodiscard]] bool lost(std::uint64_t index) noexcept;
  [[nodiscard]] int state() const noexcept { return state_; }  ///< state that decided the last datagram, 1 to 4

 private:
  /// Returns the state after `state_` for a draw in [0, 1).
  [[nodiscard]] int next(double u) const noexcept;

  FourStateSpec spec_;
  RandomKey key_;
  int state_ = 1;
};

/// Loss bursts that begin as a Poisson process, see LossBurstsSpec.
class LossBursts {
 public:
  LossBursts(const LossBurstsSpec& spec, RandomKey key) noexcept;
  [[nodiscard]] bool lost(Time now) noexcept;

 private:
  bool datagrams_;
  std::int64_t cap_;
  /// With unit kDatagrams, interval lengths count datagrams (minus the first) as nanoseconds; they are never used as
  /// times.
  PoissonIntervals bursts_;
  Time last_{Duration{-1}};
  std::int64_t remaining_ = 0;
};

/// Loss with exact counts or positions, see LossPatternSpec.
class LossPattern {
 public:
  LossPattern(const LossPatternSpec& spec, RandomKey key, std::uint64_t salt = 0)
      : spec_(spec), key_(key), salt_(salt) {}
  [[nodiscard]] bool lost(Time now, std::uint64_t index) noexcept;
  void set_salt(std::uint64_t salt) noexcept { salt_ = salt; }

 private:
  LossPatternSpec spec_;
  RandomKey key_;
  std::uint64_t salt_;
  std::uint32_t lost_in_window_ = 0;
  std::size_t next_index_ = 0, next_time_ = 0;
};

/// Player of a recorded loss, see LossTrace.
class LossTracePlayer {
 public:
  explicit LossTracePlayer(std::shared_ptr<const LossTrace> trace) noexcept : trace_(std::move(trace)) {}
  [[nodiscard]] bool lost(Time now, std::uint64_t index) const noexcept;

 private:
  std::shared_ptr<const LossTrace> trace_;
};

}  // namespace tandem::netsim
