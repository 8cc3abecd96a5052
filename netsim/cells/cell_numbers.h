#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

/// The numbers of a cell, for tables and pictures.
namespace tandem::netsim {

enum class CellNumber : std::uint8_t {
  kTracking,
  kFollower,
  kStiffness,
  kDrag,
  kForceError,
  kDrift,
  kMotorEnergy,
  kLeaderEnergy,
  kEngagedShare,
  kUnstable
};
inline constexpr std::size_t kCellNumberCount = 10;
/// SI units, by enumerator. A number that a task does not have is NaN.
using CellValues = std::array<double, kCellNumberCount>;

/// Description of a number.
struct CellNumberRow {
  CellNumber number;
  std::string_view key;         ///< in CSV
  std::string_view title;       ///< in reports
  std::string_view definition;  ///< one sentence for reports
  std::string_view si_unit;     ///< in CSV; `1`: dimensionless
  std::string_view unit;        ///< in reports
  double factor = 1;            ///< from SI to that unit
  int digits = 2;               ///< significant digits in reports
  bool least_is_worst = false;
  bool logarithmic = true;  ///< scale of its colours
};

inline constexpr std::array<CellNumberRow, kCellNumberCount> kCellNumbers{{
    {CellNumber::kTracking, "tracking", "Tracking",
     "RMS distance of the tool from the mean of the hands, weighted with their authority, while they move.", "m", "mm",
     1e3},
    {CellNumber::kFollower, "follower", "Followers",
     "RMS distance of the tool from the farthest of the other hands, while they move.", "m", "mm", 1e3},
    {CellNumber::kStiffness, "stiffness_felt", "Stiffness felt",
     "Force on the leader's hand over its depth while it presses and holds.", "N/m", "N/m", 1, 3, true},
    {CellNumber::kDrag, "drag", "Drag",
     "RMS of the motor's force on the leader's hand in free motion; friction of the device is not in it.", "N", "N"},
    {CellNumber::kForceError, "force_error", "Force error",
     "Force at the tool minus force on the leader's hand, means while it presses and holds.", "N", "N"},
    {CellNumber::kDrift, "drift", "Drift",
     "Distance between tool and weighted mean of the hands, mean of the last second, after 5 s without intended "
     "motion.",
     "m", "mm", 1e3},
    {CellNumber::kMotorEnergy, "motor_energy", "Energy from the motors",
     "Largest sum of what all motors together had given to the hands at any time: force delivered times motion of the "
     "tip. Led hands receive energy under every law.",
     "J", "mJ", 1e3},
    {CellNumber::kLeaderEnergy, "leader_energy", "Energy to the leader",
     "The same of the leader's motor alone: a hand that leads should receive nothing but what it stored before.", "J",
     "mJ", 1e3},
    {CellNumber::kEngagedShare, "engaged_share", "Engaged share", "Share of the time in which the leader was engaged.",
     "1", "%", 100, 3, true, false},
    {CellNumber::kUnstable, "unstable", "Unstable",
     "Share of the seeds in which a hand moved faster than 1.5 m/s, the tool was more than 250 mm from the hands, or a "
     "motor's force above 1 Hz exceeded 0.2 N RMS while no hand intended to move.",
     "1", "%", 100, 3, false, false},
}};

[[nodiscard]] constexpr const CellNumberRow& row_of(CellNumber number) noexcept {
  return kCellNumbers[static_cast<std::size_t>(number)];
}
/// Returns whether `a` is worse than `b`.
[[nodiscard]] constexpr bool worse(const CellNumberRow& row, double a, double b) noexcept {
  return row.least_is_worst ? a < b : a > b;
}
/// Returns a value in the unit of reports, such as `0.26`; an en dash if it is NaN.
/// @param value  SI
[[nodiscard]] std::string report_text(const CellNumberRow& row, double value);

}  // namespace tandem::netsim
