#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/loss_spec.h"
#include "netsim/poisson_intervals.h"

/// The loss models besides the periods in time. Each is asked about every datagram exactly once, in order, and draws by
/// the datagram's index, so that none depends on what another decided.
namespace tandem::netsim {

class GilbertElliott {
 public:
  /// The first datagram finds the stationary distribution.
  GilbertElliott(const GilbertElliottSpec& spec, RandomKey key, std::uint64_t salt = 0) noexcept;
  [[nodiscard]] bool lost(std::uint64_t index) noexcept;
  /// Draws the first state of the flow of this salt.
  void begin(std::uint64_t salt) noexcept { bad_ = first_key_.uniform(salt) < spec_.p / (spec_.p + spec_.r); }
  [[nodiscard]] bool bad() const noexcept { return bad_; }  ///< the state that decided last

 private:
  GilbertElliottSpec spec_;
  RandomKey state_key_, loss_key_, first_key_;
  bool bad_ = false;
};

class FourState {
 public:
  FourState(const FourStateSpec& spec, RandomKey key) noexcept : spec_(spec), key_(key) {}
  [[nodiscard]] bool lost(std::uint64_t index) noexcept;
  [[nodiscard]] int state() const noexcept { return state_; }  ///< that decided last, 1 to 4

 private:
  FourStateSpec spec_;
  RandomKey key_;
  int state_ = 1;
};

class LossBursts {
 public:
  LossBursts(const LossBurstsSpec& spec, RandomKey key) noexcept;
  [[nodiscard]] bool lost(Time now) noexcept;

 private:
  bool datagrams_;
  std::int64_t cap_;
  /// In datagrams the length of an interval counts them (less the first), one per nanosecond: it is never used as time.
  PoissonIntervals bursts_;
  Time last_{Duration{-1}};
  std::int64_t remaining_ = 0;
};

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

class LossPlayer {
 public:
  explicit LossPlayer(std::shared_ptr<const LossTrace> trace) noexcept : trace_(std::move(trace)) {}
  [[nodiscard]] bool lost(Time now, std::uint64_t index) const noexcept;

 private:
  std::shared_ptr<const LossTrace> trace_;
};

}  // namespace tandem::netsim
