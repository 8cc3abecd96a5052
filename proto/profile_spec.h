#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// A network profile after validation: every number finite and in range, rules between numbers kept. Units are those of
/// the keys in proto/profile.proto; what the models mean stands there. Made by proto/profile_text.h only.
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
};
struct ProfileBody {
  enum class Kind : std::uint8_t { kNone, kUniform, kLogNormal, kLogLogistic } kind = Kind::kNone;
  double low_ms = 0, high_ms = 0;               ///< uniform
  double median_ms = 0, shape = 0, cap_ms = 0;  ///< the others
  double tau_ms = 0;
};
struct ProfileStall {
  double rate_per_s = 0, length_min_ms = 0, alpha = 0, cap_ms = 0;
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
};

struct ProfileOutage {
  double start_s = 0, length_ms = 0, period_s = 0;  ///< period 0: once
  bool hold = false;
  bool up = true, down = true;
  std::uint64_t hold_bytes = 0;  ///< 0: no limit
};

struct ProfileQuantiles {
  bool up = true, down = true;
  std::array<double, 4> delay_ms{};  ///< p5, p50, p95, p99
};

struct ProfileSpec {
  std::string name;  ///< file name without folder and ending
  std::uint32_t version = 0;
  std::string summary;
  std::vector<std::string> sources;
  ProfilePath up, down;
  std::vector<ProfileOutage> outages;
  std::vector<ProfileQuantiles> checks;
};

}  // namespace tandem
