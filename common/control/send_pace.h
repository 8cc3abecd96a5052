#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/port_sample.h"

namespace tandem::control {

/// Decides when one end of a channel sends its sample: at most every `interval` ticks, at least every `heartbeat`
/// ticks, and in between only if the receiver would notice. The receiver predicts the samples that are not sent
/// (HeldSample); this class computes the same prediction. A sample is sent if it leaves the dead-band around the
/// prediction, x' and v':
///
///     |v - v'| > weber max(|v|, velocity_floor)
///     |x - x'| > weber max(|F|, force_floor) / stiffness       the error of the force of the receiver's spring
///     |f - f'| > weber max(|f|, force_floor)                   if the receiver uses f
///     e_in - e_in' > energy, on any axis                       credit that the receiver may spend
///
/// Norms are over the axes. Energies never decrease, so a held one is at most the true one: the receiver's ledger
/// spends no more than with every sample. Its bound therefore holds unchanged. Source: Hinterseer, Hirche, Chaudhuri,
/// Steinbach, Buss 2008: "Perception-based data reduction and transmission of haptic data in telepresence and
/// teleaction systems", IEEE Trans. Signal Processing 56(2). The floors are additions: near rest, a share of the
/// present value is below the noise of encoders.
class SendPace {
 public:
  /// Values are in the units of the channel's port.
  struct Params {
    std::size_t dof = 3;               ///< number of axes in use, 1 to kAxesMax
    double dt = 0.001;                 ///< duration of a tick [s]
    std::uint32_t interval = 1;        ///< fewest ticks between two datagrams, at least 1
    std::uint32_t heartbeat = 16;      ///< most ticks between two datagrams, at least `interval`
    std::uint32_t order = 1;           ///< of the prediction, 0 or 1, see HeldSample
    bool dead_band = true;             ///< false: every sample is sent that `interval` allows
    double weber = 0.1;                ///< share that is not noticed, (0, 1)
    double velocity_floor = 0.1;       ///< [m/s]
    double force_floor = 0.6;          ///< [N]
    double stiffness = 400;            ///< largest stiffness of the receiver's spring [N/m]
    std::uint64_t energy = 5'000'000;  ///< [nJ]
    bool force_acts = true;            ///< a law of the receiver uses PortSample::f
    bool force_is_place = false;       ///< PortSample::f is a position (server, law `replica`); not with `force_acts`
  };

  /// @param params  see Params
  /// @param tools   samples per datagram, at least 1
  SendPace(const Params& params, std::size_t tools);

  /// Whether `interval` allows a datagram at this tick; ticks may be missing.
  [[nodiscard]] bool allowed(std::uint32_t tick) const noexcept { return !any_ || tick - last_ >= params_.interval; }
  /// Whether a datagram must be sent whatever it contains: the first one, and when the heartbeat is due.
  [[nodiscard]] bool overdue(std::uint32_t tick) const noexcept {
    return !any_ || !params_.dead_band || tick - last_ >= params_.heartbeat;
  }
  /// Whether a sample is outside the dead-band. A value that is not finite is outside.
  /// @param tick   of this sample, at or after that of the last datagram
  /// @param tool   index of the sample in the datagram
  /// @param force  norm of the force at this seat [N]; decides the tolerance of the position
  /// @param acts   false: position and velocity act on nothing at the receiver and are ignored
  [[nodiscard]] bool noticeable(std::uint32_t tick, std::size_t tool, const PortSample& sample, double force,
                                bool acts = true) const noexcept TANDEM_REALTIME;
  /// Records a sample of the datagram that is sent at this tick.
  void record(std::size_t tool, const PortSample& sample) noexcept TANDEM_REALTIME { sent_[tool] = sample; }
  /// Records that a datagram was sent at this tick.
  void sent(std::uint32_t tick) noexcept {
    last_ = tick;
    any_ = true;
  }
  /// The next datagram is the first of a new connection.
  void restart() noexcept { any_ = false; }

 private:
  Params params_;
  std::vector<PortSample> sent_;  ///< of the last datagram
  std::uint32_t last_ = 0;        ///< its tick
  bool any_ = false;
};

/// Predicts the samples that the other end did not send (SendPace): how long the newest one is held, at most `limit`.
/// A sample that is held counts as new, so its age for the law is its age less this time. Once `limit` has passed, a
/// datagram is late or lost, and the age grows as without a dead-band. Prediction after t: x' = x (order 0) or
/// x' = x + v t (order 1). An order 2 by the acceleration of STATE was measured: it saved no more and followed no
/// better, because the lasting acceleration of a hand is known 0.1 s late.
class HeldSample {
 public:
  /// @param limit  longest time between two datagrams of the sender [s]; 0: the sender holds back nothing
  /// @param order  of the prediction, 0 or 1
  explicit HeldSample(double limit = 0, std::uint32_t order = 0) noexcept : limit_(limit), order_(order) {}

  /// Whether the sender may hold back samples.
  [[nodiscard]] bool on() const noexcept { return limit_ > 0; }
  /// Longest time between two datagrams of the sender [s].
  [[nodiscard]] double limit() const noexcept { return limit_; }
  /// A new sample arrived.
  void restart() noexcept { held_ = 0; }
  /// Returns the time by which the newest sample is to be advanced now [s], at least 0.
  /// @param silence  time since it arrived [s]
  [[nodiscard]] double advance(double silence) noexcept TANDEM_REALTIME {
    const double now = silence < limit_ ? silence : limit_;  // the silence is 24 h before the first datagram
    const double step = now > held_ ? now - held_ : 0;
    held_ += step;
    return step;
  }
  /// Time for which the newest sample is held [s].
  [[nodiscard]] double held() const noexcept { return held_; }
  /// Advances a sample by `step` [s]. @param axes  in use
  void predict(PortSample& sample, std::size_t axes, double step) const noexcept TANDEM_REALTIME {
    predict(sample, axes, step, order_);
  }
  /// The same for a prediction of this order. The result stays in the range of positions that a datagram may have: both
  /// ends pass it on to others.
  static void predict(PortSample& sample, std::size_t axes, double step, std::uint32_t order) noexcept TANDEM_REALTIME {
    if (order == 0) return;
    for (std::size_t a = 0; a < axes; ++a) sample.x[a] = std::clamp(sample.x[a] + sample.v[a] * step, -kReach, kReach);
  }
  [[nodiscard]] std::uint32_t order() const noexcept { return order_; }

  static constexpr double kReach = 10;  ///< largest absolute position on the wire [m]

 private:
  double limit_;
  std::uint32_t order_;
  double held_ = 0;  ///< [s]
};

}  // namespace tandem::control
