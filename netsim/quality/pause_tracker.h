#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::netsim {

/// Pauses of a sender: times at which it resumed after a silence longer than kPause. It remembers the newest 64.
/// Real-time safe.
class PauseTracker {
 public:
  static constexpr Duration kPause = std::chrono::milliseconds(100);

  /// End of a pause.
  struct Resume {
    Time at, last_before;  ///< first datagram after the pause, last one before it
  };
  /// Records that the sender resumed.
  void add(const Resume& resume) noexcept TANDEM_REALTIME { resumes_[count_++ % kKept] = resume; }
  /// Returns the oldest or newest remembered resume with after < at <= until; nullptr if there is none.
  [[nodiscard]] const Resume* first_in(Time after, Time until) const noexcept TANDEM_REALTIME {
    return find(after, until, false);
  }
  [[nodiscard]] const Resume* last_in(Time after, Time until) const noexcept TANDEM_REALTIME {
    return find(after, until, true);
  }

 private:
  [[nodiscard]] const Resume* find(Time after, Time until, bool newest) const noexcept;

  static constexpr std::size_t kKept = 64;
  std::array<Resume, kKept> resumes_{};
  std::uint64_t count_ = 0;
};

}  // namespace tandem::netsim
