#pragma once

#include <cstddef>

#include "common/base/axes.h"

namespace tandem::control {

/// A bounded pull of a hand that follows towards the hand that leads it. A relaxed hand that goes along with a spring stands beside the other
/// by what friction and its own damping hold; this law moves the end of the hand's spring by a shift s, so that the hand arrives:
///
///     e    = leader's hand - own hand, at most F_a / k_c long      F_a: the bound of the pull
///     z    = e through two poles at p
///     s'   = w p / 6 z - s / T                                     |s| <= F_a / k_c, |s'| <= 10 N/s / k_c
///     F    = k_c (x + s - q)
///
/// - Two poles at p = 1/2 sqrt(k_c / 0.5 kg), before the integration: above p the pull is turned by more than half a period, so that it calms what
///   swings on the spring (a hand and a handle of at most 0.5 kg swing at 2 p or faster), and below it the loop has a gain margin of 12.
/// - 1/T is 1/4 s: the pull fades as the hand arrives, and a hand that friction holds is left alone. At rest what is
///   left of e is the twentieth part of what it was without.
/// - w = 1 / (1 + (v / 40 mm/s)^2) of the leader's velocity v: a pull that is late by 1/p would make a fast motion worse.
/// - Nothing but its fading while no hand leads, while this hand has authority (wholly below 0.02 only), or at a surface unless wanted there.
///
/// Each step of s is the work of the spring's end: the owner pays it, then says so by `move`. An axis that could not pay stays.
class Assist {
 public:
  static constexpr std::size_t kAxes = 3;
  struct Params {
    std::size_t axes = 3;     ///< of a TIP port, 1 to 3
    double force = 0;         ///< F_a [N]; 0: off
    bool in_contact = false;  ///< pulls also while the tool touches a surface
    double k_c = 400;         ///< hand to copy [N/m]
    double dt = 0.001;        ///< tick [s]
  };
  struct Input {
    bool led = false;        ///< another hand leads, and `ahead` and `velocity` are known
    AxisArray ahead{};       ///< the leader's hand minus this hand [m], world axes
    AxisArray velocity{};    ///< of the leader's hand [m/s]
    double authority = 0;    ///< of this hand [0, 1]
    bool touching = false;   ///< the tool touches a surface
  };
  explicit Assist(const Params& params) noexcept;

  /// No pull, at once: for a seat that is not engaged.
  void rest() noexcept { *this = Assist(p_); }
  /// Once per tick. @return the step of the shift that is wanted [m]; no number that is not finite has a part in it
  const AxisArray& step(const Input& in) noexcept TANDEM_REALTIME;
  /// This step was paid for.
  void move(std::size_t axis, double step) noexcept { shift_[axis] += step; }

  [[nodiscard]] bool on() const noexcept { return p_.force > 0; }
  [[nodiscard]] double shift(std::size_t axis) const noexcept { return shift_[axis]; }  ///< s [m]
  [[nodiscard]] double force() const noexcept;                                          ///< norm of k_c s [N], at most F_a

  static constexpr double kRate = 10;        ///< largest change of the pull [N/s]
  static constexpr double kAuthority = 0.02; ///< from which on a hand is pulled no more
  static constexpr double kMassMax = 0.5;    ///< of a hand and its handle [kg]
  static constexpr double kFades = 4;        ///< T [s]
  static constexpr double kLetsGo = 0.2;     ///< the same where nothing is to pull [s]
  static constexpr double kSlow = 0.04;      ///< [m/s]

 private:
  Params p_;
  double reach_ = 0, pole_ = 0, most_ = 0;  ///< F_a / k_c [m]; share of a tick; largest step of s [m]
  AxisArray first_{}, second_{}, shift_{}, step_{};
};

}  // namespace tandem::control
