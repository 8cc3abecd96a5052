#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// A network profile after validation: every number is finite and in range, and relations between numbers hold. Units
/// are those of the keys in proto/schema/profile.proto, which also explains the models. Only proto/text/profile_text.h
/// creates it.
namespace tandem {

struct ProfileBadPeriods {
  double good_mean_s = 0, bad_mean_ms = 0;
  double loss_good_percent = 0, loss_bad_percent = 0;
};
struct ProfileRate {
  std::uint64_t rate_bit_s = 0;
  std::uint32_t overhead_bytes = 28;
  std::uint64_t queue_bytes = 0;  ///< 0: no limit
  std::optional<double> queue_ms;
  double competing_peak_ms = 0, competing_period_ms = 0;
  std::uint32_t queue_datagrams = 0;  ///< 0: no limit
  bool codel = false;
  double codel_target_ms = 5, codel_interval_ms = 100;
  bool drop_head = false;                    ///< else the tail
  std::optional<std::string> capacity_file;  ///< replaces rate_bit_s; empty: the command line names the file
};
struct ProfileBody {
  enum class Kind : std::uint8_t {
    kNone,
    kUniform,
    kLogNormal,
    kLogLogistic,
    kTruncatedNormal,
    kExponential,
    kGamma,
    kHyperExponential,
    kPareto,
    kEmpirical
  } kind = Kind::kNone;
  double low_ms = 0, high_ms = 0;              ///< uniform; truncated normal: low
  double scale_ms = 0, shape = 0, cap_ms = 0;  ///< median, mean, scale or least value, depending on the kind
  double sd_ms = 0;
  double tau_ms = 0;
  struct Phase {
    double weight = 0, mean_ms = 0;
  };
  struct Point {
    double percent = 0, delay_ms = 0;
  };
  std::vector<Phase> phases = {};
  std::vector<Point> points = {};
};
struct ProfileRegime {
  double mean_ms = 0, floor_ms = 0;
  ProfileBody body;
};
struct ProfileBoundary {
  double period_s = 0, phase_s = 0;
  double stall_low_ms = 0, stall_high_ms = 0, floor_high_ms = 0;
  double loss_window_ms = 0, loss_percent = 0;
};
struct ProfileSlots {
  double period_ms = 0;
  std::uint32_t datagrams = 0;
  std::uint64_t bytes = 0;
};
struct ProfileStall {
  double rate_per_s = 0, length_min_ms = 0, alpha = 0, cap_ms = 0;
};
struct ProfileGilbertElliott {
  double p_percent = 0, r_percent = 0, h_percent = 0, k_percent = 100;
};
struct ProfileFourState {
  double p13_percent = 0, p31_percent = 0, p32_percent = 0, p23_percent = 0, p14_percent = 0;
};
struct ProfileLossBursts {
  double rate_per_s = 0;
  enum class Law : std::uint8_t { kFixed, kGeometric, kParetoII } law = Law::kFixed;
  bool datagrams = true;  ///< the unit of `length` and `cap`; else ms
  double length = 0, alpha = 1, cap = 0;
};
struct ProfileLossPattern {
  std::uint32_t lost = 0, of = 0, every = 0;
  std::vector<std::uint64_t> indices;
  std::vector<double> times_s;
};
struct ProfileCongestionLoss {
  double wait_low_ms = 0, wait_high_ms = 0, queue_percent = 0, stall_percent = 0;
};
struct ProfileLossTrace {
  std::vector<bool> lost;
  double interval_ms = 0;  ///< 0: one per datagram
};
struct ProfileReorder {
  double probability_percent = 0;
  std::uint32_t displacement = 3;
  double hold_limit_ms = 100;
};
struct ProfileDuplicate {
  double probability_percent = 0;
  double delay_max_ms = 1;
};

/// One direction.
struct ProfilePath {
  double loss_percent = 0;
  std::optional<ProfileBadPeriods> bad_periods;
  std::optional<ProfileRate> rate;
  double floor_ms = 0;
  ProfileBody body;
  std::optional<ProfileStall> stall;
  bool free_order = false;
  std::optional<ProfileReorder> reorder;
  std::optional<ProfileDuplicate> duplicate;
  std::optional<ProfileGilbertElliott> gilbert_elliott;
  std::optional<ProfileFourState> four_state;
  std::optional<ProfileLossBursts> loss_bursts;
  std::optional<ProfileLossPattern> loss_pattern;
  std::optional<ProfileCongestionLoss> congestion_loss;
  std::optional<ProfileLossTrace> loss_trace;
  std::vector<ProfileRegime> regimes;
  std::optional<ProfileBoundary> boundary;
  std::optional<ProfileSlots> slots;
  double corrupted_percent = 0;
  enum class Corruption : std::uint8_t { kChecksum, kBitFlips, kTruncate } corruption = Corruption::kChecksum;
  std::uint32_t corrupted_bits = 1;
  std::uint32_t mtu_bytes = 0;  ///< 0: no limit
  bool fragments = false;       ///< above the MTU; else dropped
};

struct ProfileOutage {
  double start_s = 0, length_ms = 0, period_s = 0;  ///< period 0: a single outage
  bool hold = false, hold_last = false;             ///< at most one; neither: drop
  bool up = true, down = true;
  std::uint64_t hold_bytes = 0;              ///< 0: no limit
  double mean_gap_s = 0, length_max_ms = 0;  ///< above 0: random times
  bool all_links = false;                    ///< the random times are the same for all clients
  double loss_at_start_ms = 0;
};

struct ProfileQuantiles {
  bool up = true, down = true;
  std::array<double, 4> delay_ms{};  ///< p5, p50, p95, p99
};

struct ProfileSpec {
  std::string name;  ///< file name without folder and extension
  std::uint32_t version = 0;
  std::string summary;
  std::vector<std::string> sources;
  ProfilePath up, down;
  std::vector<ProfileOutage> outages;
  std::vector<ProfileQuantiles> checks;
  bool shared = false;  ///< all clients share one link
};

}  // namespace tandem
