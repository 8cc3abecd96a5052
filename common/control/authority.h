#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/axes.h"

namespace tandem::control {

/// Pays for what changing authority injects. Weighted storage V = sum alpha_i V_i: a change of alpha adds sum alpha'_i V_i,
/// whatever the flow sources do (design notes, control 2, "weighted passivity").
class AuthorityTank {
 public:
  explicit AuthorityTank(double initial = 0.05) noexcept : level_(initial), capacity_(2 * initial) {}
  void fill(double joule) noexcept {
    if (joule > 0) level_ = level_ + joule < capacity_ ? level_ + joule : capacity_;
  }
  /// Largest share of a change costing `joule` that can be paid, [0, 1]; negative costs are free and fill the tank.
  [[nodiscard]] double pay(double joule) noexcept;
  [[nodiscard]] double level() const noexcept { return level_; }

 private:
  double level_, capacity_;
};

using Weights = std::array<double, kMastersMax>;

/// Authority of all masters over one tool: sum alpha = 1 at every tick, or all 0 while nobody entitled is present (HELD).
class AuthorityRow {
 public:
  /// @param slew  largest |d alpha / dt| [1/s]; infinity: at once.
  AuthorityRow(std::size_t masters, double slew, double tank) noexcept;

  /// What the instructor wants. Ignored unless finite, >= 0 and of sum 1 (to 1e-6; then normalised exactly).
  /// @return whether it was taken.
  bool request(const Weights& wanted) noexcept;
  /// What `request` would make of it; nullopt: it would be ignored.
  [[nodiscard]] std::optional<Weights> normalised(const Weights& wanted) const noexcept;

  struct Input {
    double dt = 0.001;
    std::array<bool, kMastersMax> present{};  ///< engaged and heard from: weight of the others ramps to those who are
    Weights stored{};                         ///< V_i: energy in each seat's spring at this tool [J]
    double dissipated = 0;                    ///< heat of the tool not spent elsewhere [J]
  };
  void step(const Input& in) noexcept TANDEM_REALTIME;

  [[nodiscard]] double alpha(std::size_t master) const noexcept { return now_[master]; }
  [[nodiscard]] const Weights& weights() const noexcept { return now_; }
  [[nodiscard]] const Weights& requested() const noexcept { return wanted_; }
  [[nodiscard]] bool held() const noexcept { return held_; }
  [[nodiscard]] double injected() const noexcept { return injected_; }  ///< by alpha changes, cumulative [J]
  [[nodiscard]] double tank() const noexcept { return tank_.level(); }

 private:
  std::size_t masters_;
  double slew_;
  AuthorityTank tank_;
  Weights wanted_{}, now_{};
  bool held_ = true;
  double injected_ = 0;
};

}  // namespace tandem::control
