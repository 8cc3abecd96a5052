#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/loss_spec.h"

namespace tandem::netsim {

/// One error in a spec.
struct SpecError {
  std::string key;      ///< name of the member, such as `body.cap`
  std::string message;  ///< the error and the allowed range
};

/// Collector of validation errors. Every check reports the member, its value and the allowed range.
class SpecErrors {
 public:
  /// Formats a duration in the unit of profiles and options: "1.5 ms".
  [[nodiscard]] static std::string text(Duration d);
  [[nodiscard]] static std::string text(double value);

  template <typename T>
  void range(std::string_view key, T value, T lo, T hi) {
    if (!(value >= lo && value <= hi)) {  // true also for NaN
      add(key, text(value) + " is not in [" + text(lo) + ", " + text(hi) + "]");
    }
  }
  template <typename T>
  void above(std::string_view key, T value, T lo, T hi) {
    if (!(value > lo && value <= hi)) add(key, text(value) + " is not in (" + text(lo) + ", " + text(hi) + "]");
  }
  void add(std::string_view key, std::string message) { errors_.push_back({std::string(key), std::move(message)}); }
  [[nodiscard]] std::vector<SpecError> take() { return std::move(errors_); }

 private:
  std::vector<SpecError> errors_;
};

/// Reports the errors of a spec that a constructor received.
/// @param subject  of the message
/// @throws std::invalid_argument with one line per error, if there is one
inline void throw_if_any(const std::string& subject, const std::vector<SpecError>& errors) {
  if (errors.empty()) return;
  std::string message = subject + ":";
  for (const SpecError& error : errors) message += "\n  " + error.key + ": " + error.message;
  throw std::invalid_argument(message);
}

/// Checks a loss spec.
/// @param has_rate, has_stall  whether the path has the rate and the stalls that congestion loss needs
void check_loss(const LossSpec& loss, bool has_rate, bool has_stall, SpecErrors& found);

}  // namespace tandem::netsim
