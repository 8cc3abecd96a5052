#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"
#include "server/report/violations.h"

namespace tandem::server {

/// One direction of a link.
struct DirectionReport {
  double loss_percent = 0,  ///< lost datagrams [%]
      longest_gap_ms = 0,   ///< longest time without a datagram [ms]
      age_p99_ms = 0;       ///< 99th percentile of the age of the newest one [ms]
};
/// Link of one seat, as both ends measured it.
struct LinkReport {
  double rtt_p50_ms = 0,  ///< median round-trip time [ms]
      rtt_p99_ms = 0;     ///< its 99th percentile [ms]
  DirectionReport up,     ///< client to server
      down;               ///< server to client
};
/// Tracking and force errors of one seat and its slave. NaN if a value does not exist (no contact phase, no leader).
struct SeatMetrics {
  double judged_s = 0;                  ///< session time in which tracking and joint errors were evaluated [s]
  double tracking_rms_m = 0,            ///< distance between hand and slave, RMS [m]
      tracking_rms_lag_removed_m = 0,   ///< the same without the network's lag [m]
      transport_lag_rms_m = 0;          ///< part that is due to the lag [m]
  std::vector<double> joint_rms_rad;    ///< difference between the joints of both devices, RMS [rad]
  double force_error_rms_n = 0,         ///< error of the delivered contact force, RMS [N]
      force_error_commanded_rms_n = 0,  ///< error of the commanded one [N]
      force_error_percent = 0;          ///< share of the force [%]
  double effort_peak_n = 0,             ///< largest force of the motor [N]
      speed_peak_m_s = 0;               ///< largest speed of the hand [m/s]; NaN: no two samples are near enough
  /// Distance from the leading hand at the same session tick; NaN if no other seat led.
  double leader_offset_rms_m = 0;
};
/// Results of one seat.
struct SeatReport {
  std::string name;                   ///< name in the scene
  SeatKind kind = SeatKind::kMaster;  ///< hand or slave
  Role role = Role::kTrainee;         ///< role of its participant
  double alpha_mean = 0;              ///< mean authority [0, 1]
  SeatMetrics metrics;                ///< errors over the whole session
  SeatRecord last;                    ///< cumulative energies
  double mfs_j = 0;                   ///< energy of the modulated flow sources [J]
  LinkReport link;                    ///< its link
  std::uint32_t gate_trips = 0;       ///< losses of the link that released the hand
  std::string gate;                   ///< state at the end, for display
  bool taken = true;                  ///< a client took the seat
};
/// Results of one tool.
struct ToolReport {
  std::string name;                ///< name in the scene
  double contact_force_rms_n = 0,  ///< contact force of the slave, RMS [N]
      penetration_max_m = 0;       ///< its deepest penetration [m]
  double held_s = 0;               ///< time without an authorised seat: the tool was braked [s]; without `unleased_s`
};
/// Results of one phase of the scene.
struct PhaseReport {
  std::string name;                ///< name in the scene
  double from_s = 0,               ///< begin on the session clock [s]
      to_s = 0;                    ///< end on the session clock [s]
  std::vector<SeatMetrics> seats;  ///< metrics of each seat
};
/// Results of one session.
struct RunReport {
  std::string scenario;    ///< name of the scene
  std::uint64_t seed = 0;  ///< seed of the run
  double duration_s = 0;   ///< of the session clock
  double stopped_s = 0;    ///< time in which the session was stopped and its clock did not advance; not in `duration_s`
  double unleased_s = 0;   ///< time in which the directory of the service did not answer, so no hand was engaged
  double judged_s = 0;     ///< session time in which the metrics of at least one MASTER seat were evaluated
  double sparse_s =
      0;  ///< session time whose samples are more than ReportBuilder::kSpeedSpan apart; 0: a tenth at most
  double sparse_gap_s = 0;            ///< mean interval between these samples [s]
  std::uint64_t shed_rows = 0;        ///< ticks of a wanted file without a row, because the server shed load
  bool moved = false;                 ///< a hand moved by more than ReportBuilder::kMoved while its seat was engaged
  std::vector<Violation> violations;  ///< violated invariants
  bool passed = true;                 ///< no violation but expected ones
  /// SHA-256 of the trace
  std::string trace_hash;
  double cpu_s = 0;                 ///< processor time of the run [s]; 0: not measured
  std::vector<SeatReport> seats;    ///< one per seat, in the scene's order
  std::vector<ToolReport> tools;    ///< one per tool
  std::vector<PhaseReport> phases;  ///< one per phase
  /// Metrics of haptic quality by key (netsim/feel/observed_feel.h). NaN if the run does not produce a value; empty:
  /// not evaluated.
  std::vector<std::pair<std::string, double>> feel;
  std::optional<PhaseReport> outside;  ///< metrics outside the scene's phases; absent: the scene has none

  /// Whether the metrics have content: a hand moved, and session time was evaluated.
  [[nodiscard]] bool judged() const noexcept { return moved && judged_s > 0; }
  /// `pass`, `fail` (an invariant is violated), or `not_judged` (none is, but the metrics have no content).
  [[nodiscard]] const char* verdict() const noexcept { return !passed ? "fail" : judged() ? "pass" : "not_judged"; }
  /// The same for display: `pass`, `FAIL`, `not judged`.
  [[nodiscard]] const char* verdict_text() const noexcept {
    return !passed ? "FAIL" : judged() ? "pass" : "not judged";
  }
};

/// Collects the ticks of a run and evaluates them afterwards. Each sample is stored at the session tick at which it was
/// taken. A record made at the server of a live session therefore compares simultaneous samples. Not real-time: called
/// by a thread without real-time duties.
class ReportBuilder {
 public:
  static constexpr std::size_t kSlotsMax =
      1'200'000;  ///< samples kept per seat: 20 min at 1 kHz; of longer runs every 2nd, 4th, ...
  static constexpr double kMoved = 0.002;  ///< smallest extent of a hand's path along an axis that counts as motion [m]
  /// [s] Interval of speed differences: longer than encoder steps, shorter than motion.
  static constexpr double kSpeedSpan = 0.005;
  /// [s] The longest, where samples are sparse: the mean speed of a longer time is not that of the hand.
  static constexpr double kSpeedSpanMax = 0.1;
  /// @param scene      must outlive the builder
  /// @param slots_max  as kSlotsMax, for tests
  explicit ReportBuilder(const SceneSpec& scene, std::size_t slots_max = kSlotsMax);
  /// Adds the record of one tick, in order of time.
  void add(const TickRecord& record);
  /// @param links  one per seat
  [[nodiscard]] RunReport build(const std::vector<LinkReport>& links) const;

 private:
  using Point3 = std::array<float, 3>;
  struct Sample {
    Point3 x{}, f{}, f_cmd{}, q{};
    bool known = false;       ///< a sample of this tick exists
    bool usable = false;      ///< engaged for more than a second
    std::uint8_t leader = 0;  ///< number of the seat that led this one, from 1; 0: none
  };
  using Track = std::vector<Sample>;  ///< samples of one seat or slave, by slot: every `stride_`th session tick
  struct Window {
    double from = 0, to = 0;
  };
  /// A seat and the slave that it follows, for comparison.
  struct SeatAndSlave {
    const Track* seat = nullptr;
    const Track* slave = nullptr;
    double one_way_s = 0;
    bool has_joints = true;           ///< the slave is a device; a virtual tool has no joints
    std::span<const Track> all = {};  ///< tracks of all seats
    float answer = 1;  ///< +1: the seat's motor renders the environment; -1: the seat is the slave that presses
  };
  /// Part of the session to evaluate.
  struct ReportInterval {
    std::vector<Window> windows;  ///< [s]
    bool outside = false;         ///< evaluate outside the windows instead
    std::vector<Window> contact;  ///< windows for force errors
    bool all_peaks = false;       ///< peaks cover the whole session
  };
  // report_metrics.cpp
  [[nodiscard]] SeatMetrics compute_metrics(const SeatAndSlave& pair, const ReportInterval& part) const;
  [[nodiscard]] double leader_offset_rms(const SeatAndSlave& pair, const std::vector<char>& use) const;
  void compute_force_errors(const SeatAndSlave& pair, const ReportInterval& part, SeatMetrics& m) const;
  void find_peaks(const SeatAndSlave& pair, const ReportInterval& part, SeatMetrics& m) const;
  [[nodiscard]] std::vector<char> slots_within(const std::vector<Window>& windows, bool outside,
                                               std::size_t slots) const;
  /// @param of  windows; `outside` selects the time outside them
  [[nodiscard]] std::vector<char> usable_slots(const SeatAndSlave& pair, const std::vector<Window>& of,
                                               bool outside) const;
  /// Samples of more than a tenth of the session are too far apart for kSpeedSpan.
  [[nodiscard]] bool sparse() const noexcept { return sparse_ticks_ * 10 > ticks_; }
  [[nodiscard]] double rate() const noexcept {
    return scene_->tick_hz / static_cast<double>(stride_);
  }  ///< slots per second
  // report.cpp
  [[nodiscard]] static Track fill_gaps(const Track& track);
  [[nodiscard]] static bool has_moved(const Track& track);
  void store_sample(Track& track, std::uint32_t tick, const Sample& sample);
  void decimate();
  void track_stops(const TickRecord& record);

  const SceneSpec* scene_;
  std::size_t slots_max_, stride_ = 1;
  std::vector<Track> seats_, tools_;
  std::vector<double> alpha_sum_, contact_square_, penetration_;
  std::vector<std::uint64_t> contact_count_, held_ticks_;
  std::vector<std::uint32_t> engaged_since_, held_since_;
  std::vector<SeatRecord> last_;
  std::vector<double> mfs_;
  std::uint64_t sparse_ticks_ = 0, sparse_records_ = 0;  ///< of records more than kSpeedSpan apart
  std::uint64_t ticks_ = 0, dropped_ticks_ = 0, stopped_ticks_ = 0, unleased_ticks_ = 0,
                stopped_total_ = 0;  ///< stopped_ticks_: of the previous record; stopped_total_: sum
  std::uint32_t newest_ = 0;         ///< tick of the previous record
  std::vector<std::size_t> slips_;   ///< ticks at which session time did not advance
};

/// The report as JSON text; server/README.md documents the keys. NaN becomes null.
[[nodiscard]] std::string to_json(const RunReport& report, int indent = 2);

}  // namespace tandem::server
