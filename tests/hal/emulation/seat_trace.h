#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "hal/core/device.h"

/// Trace that `tandem-client join --trace` wrote for a seat with three joints, and comparison of the motions of two
/// seats.
namespace tandem::test {

struct SeatTrace {
  struct Row {
    double t = 0;  ///< session time [s], negative before the session start
    hal::Vec3 q, x, wanted, passed,
        given;     ///< joints [rad], tip [m]; force commanded, passed by the gate, delivered [N]
    int gate = 0;  ///< wire::GateState
  };
  std::vector<Row> rows;

  /// Parses a trace. Returns an empty one unless every line has the columns of a trace of three joints.
  static SeatTrace parse(const std::string& csv) {
    constexpr const char* kHeader =
        "t_s[s],q0[rad],q1[rad],q2[rad],x[m],y[m],z[m],f_cmd_x[N],f_cmd_y[N],f_cmd_z[N],f_gate_x[N],f_gate_y[N],f_gate_"
        "z[N],"
        "f_out_x[N],f_out_y[N],f_out_z[N],gate[1],alpha[1],silence[s]";
    SeatTrace trace;
    std::istringstream in(csv);
    std::string line;
    if (!std::getline(in, line) || line != kHeader) return {};
    while (std::getline(in, line)) {
      std::array<double, 18> v{};
      char* at = line.data();
      for (double& one : v) {
        char* end = nullptr;
        one = std::strtod(at, &end);
        if (end == at) return {};
        at = *end == ',' ? end + 1 : end;
      }
      const auto three = [&](std::size_t i) { return hal::Vec3(v[i], v[i + 1], v[i + 2]); };
      trace.rows.push_back({v[0], three(1), three(4), three(7), three(10), three(13), static_cast<int>(v[16])});
    }
    return trace;
  }
};

/// Readings of three seats at equal session times, while all gates had been ACTIVE for at least `settle`.
struct Together {
  std::vector<hal::Vec3> lead, follow, tool;
  double seconds = 0;  ///< duration of the session while the leader was seated

  static Together of(const SeatTrace& lead, const SeatTrace& follow, const SeatTrace& tool, double settle) {
    constexpr int kActive = 3;
    constexpr double kApart = 0.005;  // readings further apart in time are not compared [s]
    Together out;
    double disturbed = 0;
    const auto at = [](const SeatTrace& trace, double t, std::size_t& i) -> const SeatTrace::Row& {
      while (i + 1 < trace.rows.size() && std::abs(trace.rows[i + 1].t - t) <= std::abs(trace.rows[i].t - t)) ++i;
      return trace.rows[i];
    };
    // Before the session start times count down; these rows are not compared.
    const auto begin = [](const SeatTrace& trace) {
      std::size_t i = trace.rows.size();
      while (i > 0 && trace.rows[i - 1].t > 0) --i;
      return i;
    };
    std::size_t f = begin(follow), s = begin(tool);
    if (f == follow.rows.size() || s == tool.rows.size()) return out;
    for (const SeatTrace::Row& row : lead.rows) {
      if (row.t <= 0) continue;
      out.seconds = row.t;
      const auto& other = at(follow, row.t, f);
      const auto& third = at(tool, row.t, s);
      const bool active = row.gate == kActive && other.gate == kActive && third.gate == kActive;
      if (!active) disturbed = row.t;
      if (!active || row.t - disturbed < settle || std::abs(other.t - row.t) > kApart ||
          std::abs(third.t - row.t) > kApart)
        continue;
      out.lead.push_back(row.x);
      out.follow.push_back(other.x);
      out.tool.push_back(third.x);
    }
    return out;
  }
};

inline hal::Vec3 mean(const std::vector<hal::Vec3>& all) {
  hal::Vec3 sum = hal::Vec3::Zero();
  for (const hal::Vec3& x : all) sum += x;
  return sum / static_cast<double>(std::max<std::size_t>(1, all.size()));
}

/// Returns the deviation of `path` from the motion of `lead`, independent of the starting points.
/// It is the RMS of the difference divided by the RMS of the motion; 1 for a path at rest.
inline double unlike(const std::vector<hal::Vec3>& path, const std::vector<hal::Vec3>& lead) {
  const hal::Vec3 of_path = mean(path), of_lead = mean(lead);
  double difference = 0, motion = 0;
  for (std::size_t i = 0; i < lead.size(); ++i) {
    difference += ((path[i] - of_path) - (lead[i] - of_lead)).squaredNorm();
    motion += (lead[i] - of_lead).squaredNorm();
  }
  return std::sqrt(difference / motion);
}

}  // namespace tandem::test
