#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/models/path_spec.h"
#include "netsim/quality/link_quality.h"
#include "netsim/quality/link_summary.h"

namespace tandem::netsim {

/// Quality monitor of both directions of one link and of its round trips. Network and ProxyCore feed it through an
/// optional pointer; without a monitor they pay one comparison per datagram. The constructor allocates 1.3 MB; later
/// calls allocate nothing.
///
/// A round trip models an echo without processing time. It is the delay of a datagram down, plus the delay of the
/// newest datagram up that had arrived when that one was sent.
class LinkMonitor {
 public:
  /// @param from  datagrams sent before this time are ignored, for example those before the session starts
  explicit LinkMonitor(Time from = Time{});

  /// Reports a sent datagram; indices of one direction ascend.
  void sent(Direction direction, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// Reports that a sent datagram will not arrive.
  void lost(Direction direction, Time sent, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// Reports the arrival of a datagram or of a copy.
  void arrived(Direction direction, Time sent, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;

  /// Returns the summary of all events so far. Works on a copy of the state: not for the packet path. Same thread only.
  [[nodiscard]] LinkSummary summary() const;

 private:
  void judge(std::int64_t step) noexcept;

  /// Maximum number of datagrams down in flight for which the matching delay up is stored.
  static constexpr std::size_t kUnderWayMax = 8'192;
  struct Answer {
    std::uint64_t index = 0;
    Duration up{};  ///< negative: no datagram up had arrived
  };

  std::array<LinkQuality, kDirections> directions_;
  bool up_heard_ = false;
  Time up_newest_;               ///< time of sending of the newest datagram up that arrived
  Duration up_delay_{};          ///< delay of that datagram
  std::vector<Answer> answers_;  ///< indexed by datagram index modulo kUnderWayMax
  StepClock clock_;
  SlidingDelays round_trips_;
  WindowSummaries windows_{};
};

}  // namespace tandem::netsim
