#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "common/link/link.h"
#include "proto/seat_setup.h"
#include "proto/visit.h"
#include "proto/wire_codec.h"

namespace tandem::client {

/// What a link test found. Nothing that was not measured is 0: it is absent.
struct LinkFindings {
  double seconds = 0;       ///< lasted
  double tick_hz = 0;       ///< datagrams per second, each way
  std::size_t datagram_up = 0, datagram_down = 0;  ///< size with header and tag [bytes]

  struct Way {
    std::uint64_t sent = 0;       ///< known to have been sent
    std::uint64_t lost = 0;
    std::uint64_t reordered = 0;  ///< came, but after a newer one
    double longest_gap = 0;       ///< without anything new [s]
    [[nodiscard]] double loss_percent() const noexcept {
      return sent == 0 ? 0 : 100 * static_cast<double>(lost) / static_cast<double>(sent);
    }
  };
  std::optional<Way> up, down;    ///< absent: nothing came back
  std::uint64_t duplicates = 0;   ///< of what came down
  std::uint64_t refused = 0;      ///< came down, but is not authentic or not of this connection

  std::optional<double> rtt_min, rtt_p50, rtt_p99, rtt_max;  ///< the two machines' waiting for their ticks taken off [s]
  std::optional<double> jitter;    ///< 99th percentile of how much later than the fastest a FORCE came [s]
  std::uint32_t pauses = 0;        ///< silences longer than the gate's limit: in each a hand would have been let go
  double silent_at_end = 0;        ///< since the last news, when the test stopped [s]
  double silence_limit = 0, loop_age_max = 0;                ///< of the scene's gate [s]

  std::optional<double> clock_step;    ///< largest change between this machine's wall clock and its monotonic clock [s]
  std::optional<double> transit_step;  ///< largest lasting change of the fastest way down: another route, or the server's clock [s]

  std::uint64_t ticks = 0, late_ticks = 0, missed_ticks = 0;  ///< of this machine; late: by more than 1 ms
  double wake_p99 = 0, wake_max = 0;   ///< how late this machine began its ticks [s]
};

/// A visitor's end of a link (proto/visit.h): sends STATE at the scene's rate and counts what becomes of it. Sans-I/O; no heap after
/// construction but for one number per second.
class LinkTest {
 public:
  LinkTest(const SeatSetup& setup, const link::Link::Params& link);

  /// @param arrived  when the datagram reached this machine, own monotonic clock
  void on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept;
  /// Once per tick. @param late  how late it began  @param missed  ticks whose time passed altogether
  /// @param wall_offset  wall clock minus monotonic clock
  void on_tick(Time now, Duration late, std::uint32_t missed, Duration wall_offset) noexcept;
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;
  /// No more STATE: what is still under way may come and be counted. Gaps and pauses are those until now.
  void stop_sending(Time now) noexcept;
  /// The server is told, three times; then it sends no more.
  void leave() noexcept;

  [[nodiscard]] bool left() const noexcept { return leaving_ && close_due_ == 0; }
  /// The server ended the connection.
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  /// Since anything came; since the first tick when nothing did.
  [[nodiscard]] Duration silence(Time now) const noexcept;
  [[nodiscard]] LinkFindings findings(Time now) const;

 private:
  void take_transit(Time arrived, std::uint32_t server_tick) noexcept;

  SeatSetup setup_;
  Duration tick_length_;
  link::Link link_;
  wire::Codec codec_;
  wire::StateMessage state_{};
  std::optional<Time> began_;
  std::uint32_t tick_ = 0;
  std::size_t up_size_ = 0, down_size_ = 0;
  bool state_due_ = false, leaving_ = false, closed_ = false;
  std::optional<Time> stopped_;
  Duration gap_until_stop_{};
  unsigned close_due_ = 0;
  std::optional<wire::PathMessage> path_answer_;  ///< the server asks whether this end is where it heard it from
  std::uint64_t path_answers_ = 0;

  // What came down.
  std::optional<wire::VisitReport> report_;
  std::uint64_t echo_newest_ = 0;       ///< of the same FORCE as `report_`
  Duration echo_age_max_{}, rtt_min_ = Duration::max();
  std::optional<Time> news_;            ///< when the newest FORCE came
  std::uint32_t pauses_ = 0;

  // Transit: arrival here minus the server's tick, which has an unknown but constant part.
  Histogram transit_;                   ///< later than the fastest so far
  std::int64_t transit_floor_ = 0;
  std::vector<std::int64_t> second_floors_;  ///< fastest of each whole second
  std::int64_t second_floor_ = 0;
  std::optional<Time> second_began_;

  std::optional<Duration> wall_offset_;
  Duration wall_step_{};
  Histogram wakes_;
  std::uint64_t ticks_ = 0, late_ticks_ = 0, missed_ticks_ = 0;
};

}  // namespace tandem::client
