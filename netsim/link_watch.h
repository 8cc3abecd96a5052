#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/link_quality.h"
#include "netsim/path_spec.h"
#include "netsim/quality_summary.h"

namespace tandem::netsim {

/// Watches both directions of one link, and round trips. Network and ProxyCore feed it through an optional pointer;
/// without one they pay a comparison per datagram. 1.3 MB, taken by the constructor; nothing later.
///
/// A round trip is what an echo would measure that answers at once: a datagram down took so long, and the newest one up
/// that had come when it was sent so long.
class LinkWatch {
 public:
  /// @param from  what was sent before is not judged: people begin when the session does
  explicit LinkWatch(Time from = Time{});

  /// A datagram went in; numbers of one direction ascend.
  void sent(Direction direction, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// One that went in will not come out.
  void lost(Direction direction, Time sent, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// One came out, or a copy of one.
  void arrived(Direction direction, Time sent, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;

  /// All so far. Copies what it has seen, so not for the packet path; same thread.
  [[nodiscard]] LinkSummary summary() const;

 private:
  void judge(std::int64_t step) noexcept;

  /// Datagrams down under way for which the delay of the newest one up is kept.
  static constexpr std::size_t kUnderWayMax = 8'192;
  struct Answer {
    std::uint64_t index = 0;
    Duration up{};  ///< negative: nothing had come
  };

  std::array<LinkQuality, kDirections> ways_;
  bool up_heard_ = false;
  Time up_newest_;       ///< when the newest datagram up was sent that has come
  Duration up_delay_{};  ///< how long it took
  std::vector<Answer> answers_;  ///< by index modulo kUnderWayMax
  StepClock clock_;
  SlidingDelays round_trips_;
  WindowSummaries windows_{};
};

}  // namespace tandem::netsim
