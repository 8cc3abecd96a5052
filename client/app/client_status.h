#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal/core/device.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Status of one seat for the user: plain data, copied out of the servo thread every 64 ticks.
struct ClientStatus {
  wire::SessionState session = wire::SessionState::kWaiting;  ///< state of the session
  wire::GateState gate = wire::GateState::kOff;               ///< state of the own force gate
  bool heard = false;                                         ///< a FORCE arrived on this connection
  bool closed = false;                                        ///< either end has closed the seat
  wire::CloseReason close_reason = wire::CloseReason::kDone;  ///< reason, once closed
  std::uint32_t stops = 0;                                    ///< number of stops so far
  std::uint32_t missing = 0;                                  ///< required seats that are not ready
  double session_time = -1;                                   ///< session time [s]; negative before the session began
  double silence_s = 0;  ///< time since the server last acknowledged a newer datagram of this seat [s]; a server that
                         ///< sends but receives nothing counts as silent
  bool local_stop = false;  ///< the user stopped this seat
  bool touching = false;    ///< the slave of the tool is in contact
  std::optional<std::array<double, 3>>
      keys_m{};  ///< position set by keys, relative to its start: right, away, up [m]; empty: not moved by keys
  std::optional<double> distance_m{};  ///< between device and tool [m]; only for TIP ports
  std::optional<double>
      offset_from_leader_m{};  ///< distance between the leader's tip and the own tip [m]; empty: no other leader
  std::uint32_t authority_version = 0;  ///< counts changes of authority
  double alpha = 0;                     ///< own authority [0, 1]
  wire::TransferNotice transfer =
      wire::TransferNotice::kNone;  ///< last transfer notice, kept for 1000 ticks and while the authority changes
  std::uint32_t transfers = 0;      ///< number of transfer notices so far
  double transfer_begins_s = 0;     ///< time until the transfer begins [s]; negative: it began
  double transfer_from = 0;         ///< own authority at the notice
  bool transfer_done = false;       ///< the transfer began and the own authority is constant again
  wire::TransferParties transfer_parties;  ///< seat that decided the transfer, and master that gains
  double force_n = 0;                      ///< delivered at the tip [N]
  std::array<double, 3> x{};               ///< tip [m]
  double rtt_ms = 0,                       ///< newest round-trip time [ms]
      rtt_p50_ms = 0,                      ///< its median [ms]
      rtt_p99_ms = 0;                      ///< its 99th percentile [ms]
  double down_loss_percent = 0,            ///< datagrams lost from the server [%]
      down_longest_gap_ms = 0,             ///< longest time without one [ms]
      down_age_p99_ms = 0;                 ///< 99th percentile of the age of the newest one [ms]
  double energy_in_j = 0,                  ///< absorbed by the channel [J]
      energy_out_j = 0,                    ///< paid by the ledger [J]
      dissipated_j = 0,                    ///< turned into heat by the hand's end [J]
      refused_j = 0,                       ///< refused by the ledger [J]
      delivered_j = 0,                     ///< given to the hand by the motor [J]
      margin_min_j = 0;                    ///< smallest margin of the ledger [J]
  double given_after_loss_max_j = 0;       ///< largest energy that the motor gave during one loss of the link [J]
  double force_peak_n = 0;                 ///< largest delivered force so far [N]
  std::uint32_t gate_trips = 0,            ///< losses of the link that released the hand
      late_ticks = 0;                      ///< ticks that began more than 1 ms late
  /// Seat released because of hot motors. Latched: only the user's reset re-engages it.
  bool motors_hot = false,
       motors_latched = false;  ///< seat released because of hot motors; latched: only the user's reset re-engages it
  std::uint32_t hot_trips = 0;  ///< number of releases because of hot motors
  std::optional<double> heat_max;  ///< largest heat of the hottest motor so far, 1: too hot; empty: not reported
  std::uint32_t reconnects = 0;    ///< number of connections after the first
  bool reconnecting = false;       ///< a Reconnector is active
  std::uint64_t sent = 0,          ///< datagrams sent
      accepted = 0,                ///< datagrams received and accepted
      late_datagrams = 0,          ///< received, but out of date
      refused_datagrams = 0;       ///< received and refused
};

/// Reason for which a seat ended.
enum class ExitReason : std::uint8_t { kDone, kServerStopped, kLeft, kServerLost, kDeviceLost, kSeatGone };

[[nodiscard]] const char* to_text(ExitReason end) noexcept;

/// Verdict on a run of a seat. A run without a session is not judged, which is not a pass.
enum class SeatVerdict : std::uint8_t { kPass, kFail, kNotJudged };
[[nodiscard]] const char* to_text(SeatVerdict verdict) noexcept;
[[nodiscard]] const char* to_text(Role role) noexcept;

/// Returns why the motors give no force after they were too hot; empty if they were not.
[[nodiscard]] std::string motors_text(const ClientStatus& status);

/// Report of one run of a seat, for the JSON output.
struct ClientReport {
  std::string server,                  ///< address of the server
      device_note;                     ///< description of the device
  double seconds = 0;                  ///< time at the seat [s]
  double outage_longest_s = 0;         ///< longest outage of the server that ended [s]
  ExitReason end = ExitReason::kDone;  ///< reason of the end
  ClientStatus last;                   ///< status at the end
  hal::DeviceStats device;             ///< statistics of the device
  hal::DeviceHistograms histograms;    ///< periods and round trips of the device
  std::uint64_t trace_dropped = 0;     ///< samples that the trace lacks
  bool realtime = false;               ///< the servo thread had real-time priority
};
[[nodiscard]] SeatVerdict verdict_of(const ClientReport& report) noexcept;
[[nodiscard]] std::string to_json(const ClientReport& report, const SeatSetup& setup);

/// Returns the JSON report of a failed join. @param why  reason as shown to the user
[[nodiscard]] std::string join_failure_json(const std::string& seat, const std::string& server,
                                            const std::string& device, const std::string& why);

}  // namespace tandem::client
