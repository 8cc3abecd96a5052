#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "client/diagnostics/tick_statistics.h"
#include "client/diagnostics/transit_time.h"
#include "client/seat/client_channel.h"
#include "common/base/time.h"
#include "common/transport/secure_channel.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/link_test_messages.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Result of a link test. Values that were not measured are absent, not 0.
struct LinkTestResult {
  double seconds = 0;                              ///< duration of the test [s]
  double tick_hz = 0;                              ///< datagrams per second, each way
  std::size_t datagram_up = 0, datagram_down = 0;  ///< size with header and tag [bytes]

  struct Direction {
    std::uint64_t sent = 0;  ///< datagrams known to have been sent
    std::uint64_t lost = 0;
    std::uint64_t reordered = 0;  ///< arrived after a newer one
    double longest_gap = 0;       ///< longest time without a newer datagram [s]
    [[nodiscard]] double loss_percent() const noexcept {
      return sent == 0 ? 0 : 100 * static_cast<double>(lost) / static_cast<double>(sent);
    }
  };
  std::optional<Direction> up{}, down{};  ///< to the server, from the server; absent: no reply arrived
  std::uint64_t duplicates = 0;           ///< duplicates from the server
  std::uint64_t refused = 0;              ///< received, but not authentic or not of this connection

  std::optional<double> rtt_min{}, rtt_p50{}, rtt_p99{},
      rtt_max{};                   ///< round trip without the time either end waits for its tick [s]
  std::optional<double> jitter{};  ///< 99th percentile of the delay of a LINK_REPORT relative to the fastest one [s]
  std::uint32_t pauses = 0;        ///< silences longer than the gate's limit; each would have released the force
  double silent_at_end = 0;        ///< time since the newest datagram when the test stopped [s]
  double silence_limit = 0, loop_age_max = 0;  ///< limits of the scene's gate [s]

  std::optional<double> clock_step{};  ///< largest change between this machine's wall clock and its monotonic clock [s]
  std::optional<double>
      transit_step{};  ///< largest lasting change of the minimum transit time down: new route or server clock [s]

  std::uint64_t ticks = 0, late_ticks = 0, missed_ticks = 0;  ///< of this client; late: by more than 1 ms
  double wake_p99 = 0, wake_max = 0;                          ///< lateness of this client's ticks [s]
};

/// Client end of a link test (proto/wire/link_test_messages.h): sends LINK_PROBE at the scene's rate and measures loss,
/// delay and jitter of both directions. Sans-I/O; no heap after construction.
class LinkTest {
 public:
  LinkTest(const SeatSetup& setup, const transport::SecureChannel::Params& link);

  /// Handles one received datagram. @param arrived  arrival time on this machine's monotonic clock
  void on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept;
  /// Advances the test by one tick of 1 / `SeatSetup::tick_hz`.
  /// @param late         lateness of this tick
  /// @param missed       ticks skipped since the last call
  /// @param wall_offset  wall clock minus monotonic clock
  void on_tick(Time now, Duration late, std::uint32_t missed, Duration wall_offset) noexcept;
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;
  /// Ends the sending of LINK_PROBE; datagrams still in flight are received and counted. Gaps and pauses count until
  /// now.
  void stop_sending(Time now) noexcept;
  /// Ends the test: sends CLOSE three times, so that the server stops sending.
  void leave() noexcept;

  [[nodiscard]] bool finished() const noexcept { return leaving_ && close_due_ == 0; }
  /// True if the server ended the connection.
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  /// Time since the newest LINK_REPORT, or since the first tick if none arrived.
  [[nodiscard]] Duration silence(Time now) const noexcept;
  [[nodiscard]] LinkTestResult findings(Time now) const;

 private:
  SeatSetup setup_;
  Duration tick_length_;
  ClientChannel channel_;
  std::optional<Time> began_;
  std::uint32_t tick_ = 0;
  std::size_t up_size_ = 0, down_size_ = 0;
  bool probe_due_ = false, leaving_ = false, closed_ = false;
  std::optional<Time> stopped_;
  Duration gap_until_stop_{};
  unsigned close_due_ = 0;
  std::uint64_t path_answers_ = 0;  ///< PATH_RESPONSE datagrams sent

  // Received from the server.
  std::optional<wire::LinkReport> report_;
  std::uint64_t echo_newest_ = 0;  ///< echoed counter in the message of `report_`
  Duration echo_age_max_{}, rtt_min_ = Duration::max();
  std::optional<Time> newest_;  ///< arrival of the newest LINK_REPORT
  std::uint32_t pauses_ = 0;

  TransitTime transit_;
  TickStatistics ticks_;
};

}  // namespace tandem::client
