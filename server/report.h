#pragma once

#include <array>
#include <cstdint>
#include <string>
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
  double tracking_rms_m = 0, tracking_rms_lag_removed_m = 0, transport_lag_rms_m = 0;
  std::vector<double> joint_rms_rad;
  double force_error_rms_n = 0, force_error_commanded_rms_n = 0, force_error_percent = 0;
  double effort_peak_n = 0, speed_peak_m_s = 0;
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
  double duration_s = 0;
  double judged_s = 0;  ///< less than duration_s when the run outlived ReportBuilder::kTicksMax
  std::vector<Violation> violations;
  bool passed = true;
  std::string trace_hash;
  double cpu_s = 0;
  std::vector<SeatReport> seats;
  std::vector<ToolReport> tools;
  std::vector<PhaseReport> phases;
};

/// Collects ticks of a run and judges them afterwards. Each sample is put at the session tick at which it was taken, so that a
/// record made at the server of a live session compares what happened at the same time. Not real-time: fed by an ordinary thread.
class ReportBuilder {
 public:
  static constexpr std::size_t kTicksMax = 1'200'000;  ///< 20 min at 1 kHz; what comes later is not judged
  explicit ReportBuilder(const SceneSpec& scene);
  void add(const TickRecord& record);
  /// @param links  one per seat.
  [[nodiscard]] RunReport build(const std::vector<LinkReport>& links) const;

 private:
  using Point3 = std::array<float, 3>;
  struct Sample {
    Point3 x{}, f{}, f_cmd{}, q{};
    bool known = false;   ///< a sample of this very tick came
    bool usable = false;  ///< engaged for more than a second
  };
  using Track = std::vector<Sample>;  ///< of one seat or slave, by session tick
  struct Window {
    double from = 0, to = 0;
  };
  /// What `judge` compares: a seat with the slave it follows.
  struct Pair {
    const Track* seat = nullptr;
    const Track* slave = nullptr;
    double one_way_s = 0;
    float answer = 1;  ///< +1: the seat's motor stands for the environment; -1: it is the slave's own, which presses against it
  };
  /// @param peaks  where peaks are looked for: a phase, or the whole run.
  [[nodiscard]] SeatMetrics judge(const Pair& pair, const std::vector<Window>& windows, const std::vector<Window>& contact,
                                  const Window& peaks) const;
  [[nodiscard]] std::vector<char> counted(const Pair& pair, const std::vector<Window>& windows) const;
  [[nodiscard]] static Track without_gaps(const Track& track);
  static void place(Track& track, std::uint32_t tick, const Sample& sample);

  const SceneSpec* scene_;
  std::vector<Track> seats_, tools_;
  std::vector<double> alpha_sum_, contact_square_, penetration_;
  std::vector<std::uint64_t> contact_count_, held_ticks_;
  std::vector<std::uint32_t> engaged_since_, held_since_;
  std::vector<SeatRecord> last_;
  std::vector<double> mfs_;
  std::uint64_t ticks_ = 0, judged_ = 0, slipped_ = 0;
  std::uint32_t newest_ = 0;  ///< tick of the record before
  std::vector<std::size_t> slips_;  ///< ticks at which session time stood still
};

/// The report as JSON text; keys as README documents them. NaN becomes null.
[[nodiscard]] std::string to_json(const RunReport& report, int indent = 2);

}  // namespace tandem::server
