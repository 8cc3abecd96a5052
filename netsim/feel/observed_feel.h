#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"

namespace tandem::netsim {

/// Measures how a whole run felt, from the motion of its own hands. Call `add` every tick; it is not real-time safe.
/// Each number is that of the worst seat. It is NaN where the run has no such motion: no press, no motion, no authority
/// transfer.
/// - stiffness_felt_n_m: slope of the felt force over the depth of a hand that leads alone, from 0.2 N to 0.9 of its
/// motor's force.
/// - drag_n: RMS force on a hand that leads alone and moves faster than 20 mm/s while the tool has no contact.
/// - gain_max: largest ratio of the tool's to the hand's amplitude at 0.5 to 10 Hz, where the hand has at least 0.2 mm
/// RMS.
/// - overshoot: largest distance of the tool from the box of the hand's last second, as a share of that box. Only boxes
/// of 10 mm or more count.
/// - limit_cycle_n: force above 1 Hz, RMS, in any 2 s in which an engaged hand stays within 2 mm.
/// - handover_bump_n, handover_step_n_ms: largest change of force in an authority transfer, in all and per millisecond.
/// The interval begins when authority begins to change and lasts until 0.5 s after its last change.
/// - engaged_share, held_share, saturated_share, trips_per_min, delivered_error_n: of the session from 1 s on.
///
/// The first 240 000 rows of 10 ms, of all seats together, are kept. Later rows still count for the last two groups.
class ObservedFeel {
 public:
  explicit ObservedFeel(const SceneSpec& scene);

  void add(const server::TickRecord& record);
  /// Returns the numbers by key, in order. @param trips  gate trips of every seat in the run
  [[nodiscard]] std::vector<std::pair<std::string, double>> values(std::span<const std::uint32_t> trips) const;

  /// Returns the keys, in order.
  [[nodiscard]] static std::span<const std::string_view> keys();

 private:
  struct Seat {
    std::size_t tool = 0;
    double force_max = 0;
    std::vector<hal::Vec3> x, tool_x, f, f_env;  ///< every 10 ms
    std::vector<char> engaged, alone;            ///< alone: the hand has all authority over its tool
    std::uint64_t engaged_ticks = 0, saturated_ticks = 0;
    double error_square = 0;
    double alpha = -1;
    hal::Vec3 f_before = hal::Vec3::Zero(), f_hand_over = hal::Vec3::Zero();
    std::uint32_t hand_over_until = 0;
    bool handed_over = false;
    double bump = 0, step = 0;
  };
  void observe_transfer(Seat& seat, const server::SeatRecord& record, const hal::Vec3& f, std::uint32_t tick);
  [[nodiscard]] double stiffness(const Seat& seat) const;
  [[nodiscard]] double drag(const Seat& seat) const;
  [[nodiscard]] double gain(const Seat& seat) const;
  [[nodiscard]] double overshoot(const Seat& seat) const;
  [[nodiscard]] double limit_cycle(const Seat& seat) const;

  double tick_hz_;
  std::uint32_t every_;   ///< ticks between rows
  std::size_t rows_max_;  ///< rows kept per seat
  std::vector<Seat> seats_;
  std::vector<std::uint64_t> held_;  ///< by tool
  std::uint64_t ticks_ = 0;
};

}  // namespace tandem::netsim
