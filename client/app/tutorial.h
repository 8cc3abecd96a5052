#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/app/client_status.h"

namespace tandem::client {

/// Tutorial of 20 s for a user's first session: explains the seat, the keys to press and their effects. Sans-I/O: time,
/// keys and status are arguments.
class Tutorial {
 public:
  static constexpr double kLength = 20;  ///< [s] since the session runs

  /// @param by_keys   true: the user moves the device with keys; false: its motion is simulated too
  /// @param partners  names of the simulated seats
  Tutorial(const SeatSetup& setup, bool by_keys, std::vector<std::string> partners);

  /// Handles one key. @param key  name as in io::KeyReader
  void on_key(const std::string& key);
  /// Returns the lines that are due. @param now_s  time on any monotonic clock [s]
  [[nodiscard]] std::vector<std::string> messages(double now_s, const ClientStatus& status);
  /// True after the last step.
  [[nodiscard]] bool finished() const noexcept { return next_ >= steps_.size(); }

 private:
  struct Step {
    double at = 0;  ///< time since the session runs [s]
    std::string text;
    std::vector<std::string> keys;  ///< keys that the text requests
    std::string happened;           ///< effect, shown once, 1.5 s after one of the keys was pressed
    std::string early;              ///< effect, shown instead of the text if one of the keys was pressed before
    bool pressed = false, reported = false;
    std::optional<double> pressed_at{};
  };
  void add_keys_of_hand();
  void add_keys_of_authority();
  /// Whether key r of this seat ends a stop or pause of all hands. @param paused  by this seat, not stopped
  [[nodiscard]] bool may_resume(bool paused) const noexcept {
    return (setup_->seat.role == Role::kInstructor && setup_->seat.kind == SeatKind::kMaster) ||
           (paused && setup_->may_end_pauses);
  }

  const SeatSetup* setup_;
  std::string partner_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::optional<double> began_;
};

}  // namespace tandem::client
