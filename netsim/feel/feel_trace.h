#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hal/core/device.h"
#include "netsim/feel/meters.h"

namespace tandem::netsim {

/// Recording of a probe: one row per tick of the running session, in columns of equal length. Positions [m], forces
/// [N], frame W.
struct FeelTrace {
  struct Hand {
    std::vector<hal::Vec3> x;      ///< tip of the device
    std::vector<hal::Vec3> f;      ///< delivered by the motor to the hand
    std::vector<hal::Vec3> f_cmd;  ///< commanded before the force gate
    std::vector<char> engaged;
    std::vector<double> alpha;  ///< authority over the tool [0, 1]
    /// Work of the motor on the hand in the tick: delivered force times the motion of the tip [J]. The first row has
    /// that of its own tick only.
    std::vector<double> work;
    double force_max = 0;              ///< largest force that motor and gate allow this seat [N]
    std::vector<std::uint32_t> trips;  ///< trips of the force gate since the start
    std::vector<double> loop;  ///< time since the STATE was sent that the newest FORCE answers, at the hand's tick [s]
    /// Datagrams since the start: of the client, and of the server to it. Empty for scenes without `send`.
    std::vector<std::uint64_t> sent_up, sent_down;
  };
  double tick_hz = 1000;
  double one_way_s = 0;   ///< half of the leader's median round trip, without the server's tick [s]
  std::vector<double> t;  ///< session time [s]
  std::vector<Hand> hands;
  std::vector<hal::Vec3> tool;      ///< tip of the tool
  std::vector<hal::Vec3> f_env;     ///< force of the environment on the tool
  std::vector<char> held;           ///< whether the tool is braked (HELD)
  std::string trouble;              ///< why there is no result; empty: the session ran
  std::vector<std::string> broken;  ///< invariants that the law promises and the run broke, without repetition

  [[nodiscard]] std::size_t rows() const noexcept { return t.size(); }

  /// Returns the rows [first, second) with session times in [from, to).
  [[nodiscard]] std::pair<std::size_t, std::size_t> window(double from, double to) const noexcept;
  /// Returns the rows of a column with session times in [from, to).
  /// @param column  `t`, or a column of the trace
  template <typename Value>
  [[nodiscard]] std::span<const Value> part(const std::vector<Value>& column, double from, double to) const noexcept {
    const auto [first, end] = window(from, to);
    return std::span{column}.subspan(first, end - first);
  }
};

}  // namespace tandem::netsim
