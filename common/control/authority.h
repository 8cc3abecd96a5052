#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/axes.h"

namespace tandem::control {

/// Tank that pays for the energy injected by changes of authority. The weighted storage is V = sum alpha_i V_i. A
/// change of alpha adds sum alpha'_i V_i to it, for any state of the flow sources.
class AuthorityTank {
 public:
  /// @param initial  initial level [J]; the capacity is twice that
  explicit AuthorityTank(double initial = 0.05) noexcept : level_(initial), capacity_(2 * initial) {}
  /// Adds energy [J] up to the capacity.
  void fill(double joule) noexcept {
    if (joule > 0) level_ = level_ + joule < capacity_ ? level_ + joule : capacity_;
  }
  /// Returns the largest payable share of a change that costs `joule`, [0, 1]. A negative cost is always payable and
  /// fills the tank.
  [[nodiscard]] double pay(double joule) noexcept;
  /// Present level [J].
  [[nodiscard]] double level() const noexcept { return level_; }

 private:
  double level_, capacity_;
};

/// One number per master.
using MasterArray = std::array<double, kMastersMax>;

/// Authority of all masters over one tool. At every tick sum alpha = 1, or all are 0 while no authorised seat is
/// present (HELD: the tool is braked).
class ToolAuthority {
 public:
  /// @param masters  number of masters, at most kMastersMax
  /// @param slew     largest |d alpha / dt| [1/s]; infinity: changes take effect at once
  /// @param tank     initial level of the authority tank [J]
  ToolAuthority(std::size_t masters, double slew, double tank) noexcept;

  /// Sets the authority that the instructor requests. It is ignored unless all values are finite, >= 0 and sum to 1
  /// (within 1e-6; then normalised exactly).
  /// @return whether it was accepted.
  bool request(const MasterArray& wanted) noexcept;
  /// Returns what `request` would store; nullopt if `request` would ignore it.
  [[nodiscard]] std::optional<MasterArray> normalised(const MasterArray& wanted) const noexcept;

  /// Input of one tick.
  struct Input {
    double dt = 0.001;  ///< duration of a tick [s]
    std::array<bool, kMastersMax>
        present{};          ///< engaged, with recent datagrams; the authority of absent masters ramps to those present
    MasterArray stored{};   ///< V_i: energy in each seat's spring at this tool [J]
    double dissipated = 0;  ///< heat of the tool that is not spent elsewhere [J]
    /// Force of each seat's spring at this tool as the most sensitive hand would feel all of it [N], per axis.
    std::array<AxisArray, kMastersMax> pull{};
  };
  /// Moves all authorities towards the requested ones, renormalised over the masters present; called once per tick.
  /// The forces at the tool then change by at most 180 N/s for any hand, unless that takes longer than 0.4 s or the
  /// scene demands a slew above 10/s.
  void step(const Input& in) noexcept TANDEM_REALTIME;

  /// Whether `step` would move no authority with these masters present: then only `fill` has an effect.
  [[nodiscard]] bool settled(const std::array<bool, kMastersMax>& present) const noexcept {
    return settled_ && present == present_;
  }
  /// Adds heat of the tool to the tank, as `step` does. @param dissipated  [J]
  void fill(double dissipated) noexcept TANDEM_REALTIME { tank_.fill(dissipated); }

  /// Authority of one master [0, 1].
  [[nodiscard]] double alpha(std::size_t master) const noexcept { return now_[master]; }
  /// Returns the authority of each master, of sum 1 or 0.
  [[nodiscard]] const MasterArray& weights() const noexcept { return now_; }
  /// Authorities requested last, of sum 1.
  [[nodiscard]] const MasterArray& requested() const noexcept { return wanted_; }
  /// True while the tool is braked: all authorities are 0.
  [[nodiscard]] bool held() const noexcept { return held_; }
  [[nodiscard]] double injected() const noexcept { return injected_; }  ///< by changes of alpha, cumulative [J]
  /// Level of the tank [J].
  [[nodiscard]] double tank() const noexcept { return tank_.level(); }

 private:
  /// Returns the largest share of the way to `goal` that no hand feels as a step.
  [[nodiscard]] double unfelt_share(const Input& in, const MasterArray& goal, double farthest) const noexcept;

  std::size_t masters_;
  double slew_;
  AuthorityTank tank_;
  MasterArray wanted_{}, now_{};
  bool held_ = true;
  bool settled_ = false;                     ///< the last step found all authorities at their goals
  std::array<bool, kMastersMax> present_{};  ///< masters present in the last step
  double injected_ = 0;
};

}  // namespace tandem::control
