#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/loss_spec.h"

namespace tandem::netsim {

/// One mistake in a spec.
struct SpecProblem {
  std::string key;      ///< member, such as `body.cap`
  std::string message;  ///< what is wrong and what is allowed
};

/// Collects mistakes; every check names the member, its value and what is allowed. For the check functions of specs.
class Findings {
 public:
  /// 1.5 ms as "1.5 ms": what a person wrote in the profile or on the command line.
  [[nodiscard]] static std::string text(Duration d) {
    std::ostringstream out;
    out << static_cast<double>(d.count()) / 1e6 << " ms";
    return out.str();
  }
  [[nodiscard]] static std::string text(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }

  template <typename T>
  void range(std::string_view key, T value, T lo, T hi) {
    if (!(value >= lo && value <= hi)) {  // also NaN
      add(key, text(value) + " is not in [" + text(lo) + ", " + text(hi) + "]");
    }
  }
  template <typename T>
  void above(std::string_view key, T value, T lo, T hi) {
    if (!(value > lo && value <= hi)) add(key, text(value) + " is not in (" + text(lo) + ", " + text(hi) + "]");
  }
  void add(std::string_view key, std::string message) { all_.push_back({std::string(key), std::move(message)}); }
  [[nodiscard]] std::vector<SpecProblem> take() { return std::move(all_); }

 private:
  std::vector<SpecProblem> all_;
};

/// @param has_rate, has_stall  whether the path has what congestion loss depends on
void check_loss(const LossSpec& loss, bool has_rate, bool has_stall, Findings& found);

}  // namespace tandem::netsim
