#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/app/client_status.h"

namespace tandem::client {

/// Twenty seconds of words for a person who tries a session for the first time: what this seat holds, which keys to press, and what they
/// did. Pure: it is told the time, the keys and the status.
class Guidance {
 public:
  static constexpr double kLength = 20;  ///< [s] from the moment the session runs

  /// @param by_keys  the person moves the hand with keys; else it is simulated as well  @param partners  names of the simulated seats
  Guidance(const SeatSetup& setup, bool by_keys, std::vector<std::string> partners);

  /// A key as KeyReader names it.
  void pressed(const std::string& key);
  /// Lines that are due. @param now_s  any clock [s]
  [[nodiscard]] std::vector<std::string> say(double now_s, const ClientStatus& status);
  /// The guidance is over.
  [[nodiscard]] bool free() const noexcept { return next_ >= steps_.size(); }

 private:
  struct Step {
    double at = 0;                   ///< since the session runs [s]
    std::string text;
    std::vector<std::string> keys;   ///< that the text asks for
    std::string happened;            ///< said once, 1.5 s after one of them was pressed
    std::string early;               ///< what the keys do, said instead of the text where one of them came before
    bool pressed = false, told = false;
    std::optional<double> pressed_at{};
  };
  void add_keys_of_hand();
  void add_keys_of_authority();

  const SeatSetup* setup_;
  std::string partner_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::optional<double> began_;
};

}  // namespace tandem::client
