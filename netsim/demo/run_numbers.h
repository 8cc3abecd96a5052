#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/plot/svg_plot.h"

/// The six runs of the demo and the numbers of each run. Data only.
namespace tandem::netsim::demo {

enum class Task : std::uint8_t { kFreeMotion, kContact };
/// Columns of the table: paper's gains, Tandem's defaults, defaults on the bad network.
enum class Setting : std::uint8_t { kSeed, kDefaults, kBadNetwork };
inline constexpr std::size_t kSettings = 3, kRuns = 6;

struct RunPlan {
  std::string_view name;   ///< for --runs and for file names
  std::string_view scene;  ///< name of a shipped scene
  Task task = Task::kFreeMotion;
  Setting setting = Setting::kSeed;
  double duration_s = 0;  ///< session time [s]
  [[nodiscard]] constexpr bool joint_port() const noexcept { return setting == Setting::kSeed; }
};
/// Returns all plans, in the order in which they run.
[[nodiscard]] const std::array<RunPlan, kRuns>& run_plans() noexcept;
[[nodiscard]] const RunPlan& run_plan(Task task, Setting setting) noexcept;
/// Returns a title, for example "Free motion, the paper's gains".
[[nodiscard]] std::string title_of(const RunPlan& plan);

/// Network of Setting::kBadNetwork, in each direction.
inline constexpr double kBadDelayMs = 20, kBadJitterMs = 5, kBadLossPercent = 5;
inline constexpr std::uint64_t kSeedNumber = 1;
/// Returns "20 ms + 0–5 ms jitter, 5 % loss each way" or "none added".
[[nodiscard]] std::string network_text(Setting setting);

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Numbers of one seat over one interval, from the JSON report (server/README.md: report keys).
struct SeatNumbers {
  double tracking_m = kUnknown, lag_removed_m = kUnknown, transport_lag_m = kUnknown;
  std::array<double, 3> joint_rad{kUnknown, kUnknown, kUnknown};
  double force_error_n = kUnknown, force_error_commanded_n = kUnknown;
};
struct LinkNumbers {
  double rtt_p50_ms = kUnknown, rtt_p99_ms = kUnknown, loss_up_percent = kUnknown, loss_down_percent = kUnknown;
  double gap_up_ms = kUnknown, gap_down_ms = kUnknown;
};
struct PhaseNumbers {
  std::string name;
  double from_s = 0;
  SeatNumbers trainer, trainee;
};
struct ViolationNumbers {
  std::string invariant, seat;
  double at_s = 0;
  bool expected = false;
};
struct ReportNumbers {
  bool passed = false;
  double duration_s = kUnknown, cpu_s = kUnknown;
  std::string trace_hash;
  std::vector<ViolationNumbers> violations;
  SeatNumbers trainer, trainee;  ///< whole run
  LinkNumbers trainer_link, trainee_link;
  double effort_peak_n = kUnknown, speed_peak_m_s = kUnknown;  ///< largest of both hands
  double gate_trips = kUnknown;                                ///< sum of both hands
  double late_ticks = kUnknown;                                ///< of server and clients; unknown in virtual time
  double contact_force_n = kUnknown;
  std::vector<PhaseNumbers> phases;
  [[nodiscard]] const PhaseNumbers* phase(std::string_view name) const noexcept;
};

/// Numbers that only the trace contains (measure.h).
struct TraceNumbers {
  double stiffness_n_m = kUnknown;                                            ///< rendered, near the working pose
  double stiffness_held_n_m = kUnknown;                                       ///< force / depth while the leader holds
  double force_x_leader_n = kUnknown, force_x_leader_percent = kUnknown;      ///< along x, contact phase
  double force_x_follower_n = kUnknown, force_x_follower_percent = kUnknown;  ///< along x, alignment phase
  double aligned_x_m = kUnknown;   ///< RMS of follower - leader along x, alignment phase
  double force_step_n = kUnknown;  ///< largest change of a commanded force in 1 ms while alpha moves
};

/// Stiffness of the springs between a hand and the slave at zero delay [N/m]; infinite: no such spring. A scene of law
/// `replica` has only the device's spring.
struct Springs {
  double device = kUnknown, channel = kUnknown, slave = kUnknown;
  [[nodiscard]] double series() const noexcept { return 1 / (1 / device + 1 / channel + 1 / slave); }
};

/// Reduced curves of one run for the overlay of the settings (overlay.h).
using OverlaySeries = std::vector<std::vector<plot::Point2>>;

/// Delays and losses of the trainer's datagrams; [0] to the server, [1] from it. Empty: not recorded.
struct NetworkSeries {
  std::array<std::vector<plot::Point2>, 2> delay;  ///< session time [s], delay [ms]
  std::array<std::vector<plot::Band>, 2> lost;     ///< intervals of session time [s]
};

/// Tips and forces of one run for its animation (animation.h).
struct MotionFrames {
  static constexpr double kRate = 50;  ///< frames per second of session time [1/s]
  /// One value per frame, in this order: tip of trainer, trainee, slave (x, y, z each, [0.1 mm]), force on the
  /// trainer's and on the trainee's hand (norm, [10 mN]), authority of the trainer [0.01].
  static constexpr std::size_t kValues = 12;
  std::vector<std::array<int, kValues>> frames;
};

/// A finished run.
struct RunResult {
  const RunPlan* plan = nullptr;
  ReportNumbers report;
  TraceNumbers trace;
  Springs springs;
  std::vector<std::string> commands;  ///< commands that repeat the run
  std::string figures_html;           ///< drawn from its trace
  OverlaySeries overlay;
  NetworkSeries network;
  MotionFrames motion;
};

}  // namespace tandem::netsim::demo
