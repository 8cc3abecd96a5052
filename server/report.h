#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "proto/scene_spec.h"
#include "server/tick_record.h"
#include "server/violations.h"

namespace tandem::server {

struct DirectionReport {
  double loss_percent = 0, longest_gap_ms = 0, age_p99_ms = 0;
};
struct LinkReport {
  double rtt_p50_ms = 0, rtt_p99_ms = 0;
  DirectionReport up, down;
};
/// How well one seat and its slave went together. NaN where a number does not exist (no contact phase, nobody leads).
struct SeatMetrics {
  double judged_s = 0;  ///< session time that tracking and joint errors are made of [s]
  double tracking_rms_m = 0, tracking_rms_lag_removed_m = 0, transport_lag_rms_m = 0;
  std::vector<double> joint_rms_rad;
  double force_error_rms_n = 0, force_error_commanded_rms_n = 0, force_error_percent = 0;
  double effort_peak_n = 0, speed_peak_m_s = 0;
  double leader_offset_rms_m = 0;  ///< from the hand that led this one, at the same session tick; NaN where none did
};
struct SeatReport {
  std::string name;
  SeatKind kind = SeatKind::kMaster;
  Role role = Role::kTrainee;
  double alpha_mean = 0;
  SeatMetrics metrics;
  SeatRecord last;      ///< cumulative energies
  double mfs_j = 0;
  LinkReport link;
  std::uint32_t gate_trips = 0;
  std::string gate;     ///< state at the end, for people
  bool taken = true;    ///< somebody sat there
};
struct ToolReport {
  std::string name;
  double contact_force_rms_n = 0, penetration_max_m = 0;
  double held_s = 0;    ///< nobody entitled was there: the tool stood braked [s]
};
struct PhaseReport {
  std::string name;
  double from_s = 0, to_s = 0;
  std::vector<SeatMetrics> seats;
};
struct RunReport {
  std::string scenario;
  std::uint64_t seed = 0;
  double duration_s = 0;  ///< of the session clock
  double stopped_s = 0;   ///< for which people had stopped the session and its clock stood still; not in `duration_s`
  double judged_s = 0;    ///< session time that the metrics of at least one MASTER seat are made of
  bool moved = false;     ///< a hand moved by more than ReportBuilder::kMoved while its seat was engaged
  std::vector<Violation> violations;
  bool passed = true;
  std::string trace_hash;
  double cpu_s = 0;
  std::vector<SeatReport> seats;
  std::vector<ToolReport> tools;
  std::vector<PhaseReport> phases;
  /// How the run felt, by key: netsim/feel/observed_feel.h. NaN where it shows no such number; empty: not judged.
  std::vector<std::pair<std::string, double>> feel;
  std::optional<PhaseReport> outside;  ///< what lies outside the scene's phases; nothing: the scene has none

  /// There is something that the metrics tell: somebody moved and it was judged.
  [[nodiscard]] bool judged() const noexcept { return moved && judged_s > 0; }
  /// `pass`, `fail` (an invariant is broken), `not_judged` (none is, and there is nothing else to tell).
  [[nodiscard]] const char* verdict() const noexcept { return !passed ? "fail" : judged() ? "pass" : "not_judged"; }
  /// The same for people: `pass`, `FAIL`, `not judged`.
  [[nodiscard]] const char* verdict_words() const noexcept { return !passed ? "FAIL" : judged() ? "pass" : "not judged"; }
};

/// Collects ticks of a run and judges them afterwards. Each sample is put at the session tick at which it was taken, so that a
/// record made at the server of a live session compares what happened at the same time. Not real-time: fed by an ordinary thread.
class ReportBuilder {
 public:
  static constexpr std::size_t kSlotsMax = 1'200'000;  ///< samples kept of a seat: 20 min at 1 kHz; of longer runs every 2nd, 4th, ...
  static constexpr double kMoved = 0.002;              ///< extent of a hand's path along an axis that is a motion [m]
  /// @param slots_max  as kSlotsMax, for tests
  explicit ReportBuilder(const SceneSpec& scene, std::size_t slots_max = kSlotsMax);
  void add(const TickRecord& record);
  /// @param links  one per seat.
  [[nodiscard]] RunReport build(const std::vector<LinkReport>& links) const;

 private:
  using Point3 = std::array<float, 3>;
  struct Sample {
    Point3 x{}, f{}, f_cmd{}, q{};
    bool known = false;   ///< a sample of this very tick came
    bool usable = false;  ///< engaged for more than a second
    std::uint8_t leader = 0;  ///< number of the seat whose hand led this one, from 1; 0: none
  };
  using Track = std::vector<Sample>;  ///< of one seat or slave, by slot: every `stride_`th session tick
  struct Window {
    double from = 0, to = 0;
  };
  /// What `judge` compares: a seat with the slave it follows.
  struct Pair {
    const Track* seat = nullptr;
    const Track* slave = nullptr;
    double one_way_s = 0;
    bool has_joints = true;  ///< the slave is a device; a virtual tool has no joints to compare
    std::span<const Track> all = {};  ///< of every seat
    float answer = 1;  ///< +1: the seat's motor stands for the environment; -1: it is the slave's own, which presses against it
  };
  /// Which part of the session is judged.
  struct Part {
    std::vector<Window> windows;  ///< [s]
    bool outside = false;         ///< what lies outside the windows instead
    std::vector<Window> contact;  ///< where force errors are judged
    bool all_peaks = false;       ///< peaks are those of the whole session
  };
  // report_judge.cpp
  [[nodiscard]] SeatMetrics judge(const Pair& pair, const Part& part) const;
  [[nodiscard]] double beside_leader(const Pair& pair, const std::vector<char>& use) const;
  void judge_forces(const Pair& pair, const Part& part, SeatMetrics& m) const;
  void find_peaks(const Pair& pair, const Part& part, SeatMetrics& m) const;
  [[nodiscard]] std::vector<char> within(const std::vector<Window>& windows, bool outside, std::size_t slots) const;
  /// @param of  the windows: within them, or outside
  [[nodiscard]] std::vector<char> counted(const Pair& pair, const std::vector<Window>& of, bool outside) const;
  [[nodiscard]] double rate() const noexcept { return scene_->tick_hz / static_cast<double>(stride_); }  ///< slots per second
  // report.cpp
  [[nodiscard]] static Track without_gaps(const Track& track);
  [[nodiscard]] static bool has_moved(const Track& track);
  void place(Track& track, std::uint32_t tick, const Sample& sample);
  void thin_out();
  void notice_stops(const TickRecord& record);

  const SceneSpec* scene_;
  std::size_t slots_max_, stride_ = 1;
  std::vector<Track> seats_, tools_;
  std::vector<double> alpha_sum_, contact_square_, penetration_;
  std::vector<std::uint64_t> contact_count_, held_ticks_;
  std::vector<std::uint32_t> engaged_since_, held_since_;
  std::vector<SeatRecord> last_;
  std::vector<double> mfs_;
  std::uint64_t ticks_ = 0, slipped_ = 0, stood_ = 0, stopped_ = 0;  ///< stood_: of the record before; stopped_: in all
  std::uint32_t newest_ = 0;  ///< tick of the record before
  std::vector<std::size_t> slips_;  ///< ticks at which session time stood still
};

/// The report as JSON text; keys as README documents them. NaN becomes null.
[[nodiscard]] std::string to_json(const RunReport& report, int indent = 2);

}  // namespace tandem::server
