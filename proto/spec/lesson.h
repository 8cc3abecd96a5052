#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "proto/spec/access_role.h"
#include "proto/spec/scene_spec.h"

/// A recorded session in memory, as scores, reports, exports and comparisons read it. SI units, frame of the scene.
/// Element k of each column belongs to row k of Lesson::tick. Values that are not known are NaN, never 0.
namespace tandem {

using LessonTriple = std::array<double, 3>;
using LessonSeatSet = std::bitset<kSeatsMax>;  ///< of a scene, by index

/// Columns of one seat. MASTER seats: tip and forces of the hand, as the tool sees them.
struct LessonSeat {
  std::string person;                      ///< name of the participant, or empty
  bool workstation = false;                ///< `person` is the name of a workstation, which several persons may share
  std::vector<std::uint8_t> fresh;         ///< 1: a sample that no earlier row has; 0: the last sample again
  std::vector<std::uint32_t> sample_tick;  ///< session tick of the sample
  std::vector<AxisArray> q;                ///< joints of the device [rad] or [m]
  std::vector<LessonTriple> x, v;          ///< measured_cp [m], measured_cv [m/s]
  /// Orientation of the hand as a unit quaternion, scalar first or last. Only tables of motion have it: ports of
  /// sessions have positions.
  std::vector<std::array<double, 4>> orientation;
  std::vector<LessonTriple> f,
      f_cmd;                  ///< measured_cf: force delivered to the hand; servo_cf: commanded before the gate [N]
  std::vector<double> alpha;  ///< authority over the first tool that the seat follows [0, 1]
  std::vector<std::uint8_t> engaged;     ///< 1: the sample acts on tools
  std::vector<std::uint8_t> gate;        ///< wire::GateState
  std::vector<std::uint32_t> leader;     ///< number of the master that leads the seat, from 1; 0: none
  std::vector<LessonTriple> ghost;       ///< predicted tip of that master [m]
  std::vector<EnergyArray> e_in, e_out;  ///< energy at the client's end [nJ]
  std::vector<double> dissipated_j, refused_j, margin_min_j,
      delivered_j;  ///< [J], cumulative; the margin is the least so far
};

/// Whether a participant had the seat: a recording has zeros for a seat without samples. True if the lesson does not
/// say which samples are new.
[[nodiscard]] inline bool has_samples(const LessonSeat& seat) {
  return seat.fresh.empty() || std::ranges::any_of(seat.fresh, [](std::uint8_t fresh) { return fresh != 0; });
}

/// Columns of one tool.
struct LessonTool {
  std::vector<AxisArray> q;                ///< joints of the slave device [rad] or [m]
  std::vector<LessonTriple> x, x_tool;     ///< tip of the slave, and virtual mass [m]
  std::vector<LessonTriple> f_cmd, f_env;  ///< force commanded to the slave, and of the environment on it [N]
  std::vector<double> penetration;         ///< depth in the environment [m]
  std::vector<std::uint8_t> held;          ///< 1: no seat has authority; the tool is braked
  std::vector<std::array<double, kMastersMax>> alpha;  ///< authority of each master in force [0, 1]
  std::vector<double> mfs_j, e_p_j;  ///< energy granted by the flow sources, E_p of [Licona et al. 2019] eq. 3 [J]
  std::vector<LessonTriple> e_p_axis_j;
  std::vector<std::uint32_t> sample_tick;
};

/// Link and device of a seat at one time, about 60 per second and seat.
struct LessonLink {
  std::uint32_t tick = 0;
  std::uint32_t seat = 0;  ///< index
  double rtt_p50_ms = std::numeric_limits<double>::quiet_NaN();
  double loss_up_percent = std::numeric_limits<double>::quiet_NaN(),
         loss_down_percent = std::numeric_limits<double>::quiet_NaN();
  double gap_up_ms = std::numeric_limits<double>::quiet_NaN(), gap_down_ms = std::numeric_limits<double>::quiet_NaN();
  double age_p99_ms = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t gate_trips = 0, late_ticks = 0;
};

/// An audited event of the session: join, leave, stop, change of authority, hand-over, trip.
struct LessonEvent {
  std::uint32_t tick = 0;
  std::int64_t time_ns = 0;  ///< as Lesson::time_ns
  std::string what;          ///< word of the audit log
  std::string seat;          ///< name of the seat, or empty
  std::string text;          ///< line for people
  std::string person{};      ///< that gave the order at a console; empty: no order, or not known
};

/// A mark on the timeline.
struct LessonMark {
  double t_s = 0;  ///< session time [s]
  std::string by;  ///< person, or role and workstation
  std::string text;
};

/// A rating sheet of one evaluator about one seat.
struct LessonSheet {
  std::string sheet;  ///< OSATS, GEARS, GOALS or CHECKLIST
  std::string of;     ///< seat
  std::string by;     ///< evaluator
  std::map<std::string, int> scores;
  bool closed = false;
};

/// Account of one channel of the file: recorded + dropped + never_received = ticks of the session.
struct LessonCount {
  std::uint64_t recorded = 0, dropped = 0, never_received = 0;
};

/// Digest of the values of tools in the rows of a chunk, before they were rounded.
struct LessonDigest {
  std::uint32_t tick = 0;  ///< last row of the chunk
  std::uint64_t tools = 0;
};

struct Lesson {
  std::string session;     ///< name of the session
  std::string scene_text;  ///< effective scene in text format, from which `scene` was read
  SceneSpec scene;
  std::map<std::string, std::string> metadata;  ///< version, commit, build, seed, law, hash of the scene, clock
  std::int64_t start_unix_ns = 0;               ///< wall clock at time_ns = 0; 0: unknown
  std::vector<std::uint32_t> tick;              ///< session tick, strictly increasing; missing ticks are gaps
  std::vector<std::int64_t> time_ns;            ///< server's monotonic clock since the first tick [ns]
  std::vector<std::uint8_t> running;            ///< 1: the session clock advanced
  std::vector<std::uint64_t> stopped_ticks, dropped_ticks;
  std::vector<LessonSeat> seats;  ///< as scene.seats
  std::vector<LessonTool> tools;  ///< as scene.tools
  std::vector<LessonLink> links;
  std::vector<LessonEvent> events;
  std::vector<LessonMark> marks;
  std::vector<LessonSheet> sheets;
  std::map<std::string, LessonCount> counts;  ///< by channel topic
  std::vector<LessonDigest> digests;          ///< in the order of ticks
  bool complete = true;                       ///< false: the file has no end, or was repaired

  /// Number of rows.
  [[nodiscard]] std::size_t rows() const noexcept { return tick.size(); }
};

}  // namespace tandem
