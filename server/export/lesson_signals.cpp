#include "server/export/lesson_signals.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "server/export/lesson_records.h"

namespace tandem::server {

namespace {

constexpr double kJoulePerNanojoule = 1e-9;
constexpr double kEnergyMax = 9.2e9;  // [J]; a column holds 2^63 nJ
constexpr std::uint64_t kFlagMax = 1;
constexpr std::uint64_t kGateStateMax = 6;  // message Seat of recordings, `gate`
constexpr const char* kTask = "task";
constexpr const char* kJoint = "joint";
constexpr const char* kNone = "none";

std::vector<std::string> numbered(const char* stem, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back(stem + std::to_string(k));
  return names;
}

/// Adds the signals of one group. Columns that may be changed also get functions that fill them.
class GroupSignals {
 public:
  GroupSignals(std::string group, std::vector<LessonSignal>& out) : group_(std::move(group)), out_(&out) {}

  template <class Values>
  void scalar(const char* name, const char* unit, const char* text, Values& values) {
    LessonSignal& signal = add(name, unit, kNone, text);
    signal.real = [&values](std::size_t row, std::span<double> to) { to[0] = values[row]; };
    if constexpr (!std::is_const_v<Values>) {
      signal.resize = [&values](std::size_t rows) { values.resize(rows); };
      signal.set_real = [&values](std::size_t row, std::span<const double> from) { values[row] = from[0]; };
    }
  }
  /// @param max  largest number that is allowed, if the type of the column allows more
  template <class Values>
  void whole(const char* name, const char* text, Values& values,
             std::uint64_t max = std::numeric_limits<std::uint64_t>::max(), const char* unit = "1") {
    using Value = typename Values::value_type;
    LessonSignal& signal = add(name, unit, kNone, text);
    signal.whole = [&values](std::size_t row, std::span<std::int64_t> to) {
      to[0] = static_cast<std::int64_t>(values[row]);
    };
    if constexpr (std::is_unsigned_v<Value>) {
      signal.whole_min = 0;
      max = std::min<std::uint64_t>(max, std::numeric_limits<Value>::max());
    }
    if (std::cmp_less(max, signal.whole_max)) signal.whole_max = static_cast<std::int64_t>(max);
    if constexpr (!std::is_const_v<Values>) {
      signal.resize = [&values](std::size_t rows) { values.resize(rows); };
      signal.set_whole = [&values](std::size_t row, std::span<const std::int64_t> from) {
        values[row] = static_cast<Value>(from[0]);
      };
    }
  }
  /// The first `columns.size()` numbers of each array.
  template <class Values>
  void array(const char* name, const char* unit, const char* frame, const char* text, std::vector<std::string> columns,
             Values& values) {
    LessonSignal& signal = add(name, unit, frame, text);
    signal.columns = std::move(columns);
    signal.real = [&values](std::size_t row, std::span<double> to) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = values[row][k];
    };
    if constexpr (!std::is_const_v<Values>) {
      signal.resize = [&values](std::size_t rows) { values.resize(rows); };
      signal.set_real = [&values](std::size_t row, std::span<const double> from) {
        for (std::size_t k = 0; k < from.size(); ++k) values[row][k] = from[k];
      };
    }
  }
  template <class Values>
  void triple(const char* name, const char* unit, const char* text, Values& values) {
    array(name, unit, kTask, text, {"x", "y", "z"}, values);
  }
  template <class Values>
  void energy(const char* name, const char* text, std::size_t axes, Values& values) {
    LessonSignal& signal = add(name, "J", kNone, text);
    signal.columns = numbered("axis", axes);
    signal.real_max = kEnergyMax;
    signal.real = [&values](std::size_t row, std::span<double> to) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = static_cast<double>(values[row][k]) * kJoulePerNanojoule;
    };
    if constexpr (!std::is_const_v<Values>) {
      signal.resize = [&values](std::size_t rows) { values.resize(rows); };
      signal.set_real = [&values](std::size_t row, std::span<const double> from) {
        for (std::size_t k = 0; k < from.size(); ++k) values[row][k] = std::llround(from[k] / kJoulePerNanojoule);
      };
    }
  }

  /// Numbers that follow from other columns.
  void derived(const char* name, const char* unit, const char* text,
               std::function<void(std::size_t row, std::span<double>)> real) {
    add(name, unit, kNone, text).real = std::move(real);
  }

 private:
  LessonSignal& add(const char* name, const char* unit, const char* frame, const char* text) {
    LessonSignal& signal = out_->emplace_back();
    signal.group = group_;
    signal.name = name;
    signal.unit = unit;
    signal.frame = frame;
    signal.description = text;
    return signal;
  }

  std::string group_;
  std::vector<LessonSignal>* out_;
};

template <class AnyLesson>
void add_session(AnyLesson& lesson, std::vector<LessonSignal>& out) {
  GroupSignals g("session", out);
  g.whole("tick", "tick of the session; ticks without a row are in the dataset gaps", lesson.tick);
  g.whole("time_ns", "monotonic clock of the server since the first tick", lesson.time_ns,
          std::numeric_limits<std::uint64_t>::max(), "ns");
  g.derived("time", "s", "session time: tick divided by the rate of the scene",
            [&lesson](std::size_t row, std::span<double> to) { to[0] = lesson.tick[row] / lesson.scene.tick_hz; });
  g.whole("running", "1: the session clock advanced", lesson.running, kFlagMax);
  g.whole("stopped_ticks", "ticks so far in which the session was stopped", lesson.stopped_ticks);
  g.whole("dropped_ticks", "dropped ticks so far", lesson.dropped_ticks);
}

template <class AnyLesson>
void add_seat(AnyLesson& lesson, std::size_t i, std::vector<LessonSignal>& out) {
  auto& s = lesson.seats[i];
  const bool linear = joints_of(lesson.scene) == 1;
  const std::size_t dof = lesson.scene.dof;
  GroupSignals g("seats/" + lesson.scene.seats[i].name, out);
  g.whole("fresh", "1: a new sample of the device; 0: the last sample again", s.fresh, kFlagMax);
  g.whole("sample_tick", "session tick of the sample", s.sample_tick);
  g.array("measured_jp", linear ? "m" : "rad", kJoint, "joints of the device", numbered("q", joints_of(lesson.scene)),
          s.q);
  g.triple("measured_cp", "m", "tip of the device, as the tool sees it", s.x);
  g.triple("measured_cv", "m/s", "velocity of the tip", s.v);
  g.triple("measured_cf", "N", "force delivered to the hand", s.f);
  g.triple("servo_cf", "N", "force commanded before the force gate", s.f_cmd);
  g.scalar("alpha", "1", "authority over the first tool that the seat follows", s.alpha);
  g.whole("engaged", "1: the sample acts on tools", s.engaged, kFlagMax);
  g.whole("gate", "state of the force gate", s.gate, kGateStateMax);
  g.whole("leader", "number of the master that leads the seat, from 1; 0: none", s.leader, lesson.scene.seats.size());
  g.triple("ghost", "m", "predicted tip of the leading master", s.ghost);
  g.energy("energy_in", "energy that the client put into the channel, cumulative", dof, s.e_in);
  g.energy("energy_out", "energy that the client took out of the channel, cumulative", dof, s.e_out);
  g.scalar("dissipated", "J", "energy dissipated at the client, cumulative", s.dissipated_j);
  g.scalar("refused", "J", "energy that the ledger refused, cumulative", s.refused_j);
  g.scalar("margin_min", "J", "least energy margin so far", s.margin_min_j);
  g.scalar("delivered", "J", "energy delivered to the hand, cumulative", s.delivered_j);
}

template <class AnyLesson>
void add_tool(AnyLesson& lesson, std::size_t j, std::vector<LessonSignal>& out) {
  auto& t = lesson.tools[j];
  const bool linear = joints_of(lesson.scene) == 1;
  GroupSignals g("tools/" + lesson.scene.tools[j].name, out);
  g.array("measured_jp", linear ? "m" : "rad", kJoint, "joints of the slave device",
          numbered("q", joints_of(lesson.scene)), t.q);
  g.triple("measured_cp", "m", "tip of the slave device", t.x);
  g.triple("setpoint_cp", "m", "virtual mass of the tool", t.x_tool);
  g.triple("servo_cf", "N", "force commanded to the slave device", t.f_cmd);
  g.triple("environment_cf", "N", "force of the environment on the slave device", t.f_env);
  g.scalar("penetration", "m", "depth in the environment", t.penetration);
  g.whole("held", "1: no seat has authority, the tool is braked", t.held, kFlagMax);
  std::vector<std::string> masters;
  for (std::size_t i = 0; i < lesson.scene.masters(); ++i) masters.push_back(lesson.scene.seats[i].name);
  g.array("alpha", "1", kNone, "authority of each master in force", std::move(masters), t.alpha);
  g.scalar("flow_source_energy", "J", "energy granted by the flow sources, cumulative", t.mfs_j);
  g.scalar("e_p", "J", "E_p of Licona et al. 2019, equation 3, all axes", t.e_p_j);
  g.array("e_p_axis", "J", kNone, "the same for each axis", {"x", "y", "z"}, t.e_p_axis_j);
  g.whole("sample_tick", "session tick of the sample of the slave device", t.sample_tick);
}

template <class AnyLesson>
std::vector<LessonSignal> all_signals(AnyLesson& lesson) {
  std::vector<LessonSignal> out;
  add_session(lesson, out);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) add_seat(lesson, i, out);
  for (std::size_t j = 0; j < lesson.tools.size(); ++j) add_tool(lesson, j, out);
  return out;
}

}  // namespace

std::vector<LessonSignal> signals_of(const Lesson& lesson) { return all_signals(lesson); }

std::vector<LessonSignal> signals_to_read(Lesson& lesson) { return all_signals(lesson); }

}  // namespace tandem::server
