#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "client/app/engaged_values.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Last transfer of authority over the tool of a seat.
struct TransferStatus {
  wire::TransferNotice notice = wire::TransferNotice::kNone;  ///< kept for 1000 ticks and while the authority changes
  std::uint32_t count = 0;                                    ///< number of transfer notices so far
  double begins_s = 0;            ///< time until the transfer begins [s]; negative: it began
  double from = 0;                ///< own authority at the notice
  bool done = false;              ///< the transfer began and the own authority is constant again
  wire::TransferParties parties;  ///< seat that decided the transfer, and master that gains
};

/// Datagrams of a seat over all its connections.
struct DatagramCounts {
  std::uint64_t sent = 0,  ///< sent
      accepted = 0,        ///< received and accepted
      late = 0,            ///< received, but out of date
      refused = 0;         ///< received and refused
};

/// Link between a seat and its server.
struct LinkStatus {
  double rtt_ms = 0,             ///< newest round-trip time [ms]
      rtt_p50_ms = 0,            ///< its median [ms]
      rtt_p99_ms = 0;            ///< its 99th percentile [ms]
  double down_loss_percent = 0,  ///< datagrams lost from the server [%]
      down_longest_gap_ms = 0,   ///< longest time without a datagram of the server [ms]
      down_age_p99_ms = 0;       ///< 99th percentile of the age of the newest one [ms]
  DatagramCounts datagrams;      ///< counters
};

/// Energies of a seat [J], cumulative; `margin_min_j` and `given_after_loss_max_j` are extremes so far.
struct EnergyStatus {
  double in_j = 0,                    ///< absorbed by the channel
      out_j = 0,                      ///< paid by the ledger
      dissipated_j = 0,               ///< turned into heat at the hand's end
      refused_j = 0,                  ///< refused by the ledger
      delivered_j = 0,                ///< given to the hand by the motor
      margin_min_j = 0;               ///< smallest margin of the ledger
  double given_after_loss_max_j = 0;  ///< largest energy that the motor gave during one loss of the link
};

/// Heat of the motors of a seat's device.
struct MotorStatus {
  bool hot = false;                ///< the seat is released because of hot motors
  bool latched = false;            ///< only the user's reset re-engages the seat
  std::uint32_t hot_trips = 0;     ///< number of releases because of hot motors
  std::optional<double> heat_max;  ///< largest heat of the hottest motor so far, 1: too hot; empty: not reported
};

/// Status of one seat for the user: plain data, copied out of the servo thread (client/app/status_pace.h).
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
  std::uint32_t authority_version = 0;  ///< version of the authority in force
  double alpha = 0;                     ///< own authority [0, 1]
  TransferStatus transfer;              ///< last transfer of authority
  double force_n = 0;                   ///< delivered at the tip [N]
  double force_peak_n = 0;              ///< largest delivered force so far [N]
  std::array<double, 3> x{};            ///< tip [m]
  LinkStatus link;                      ///< link to the server
  EnergyStatus energy;                  ///< energies of channel and motor
  MotorStatus motors;                   ///< heat of the motors
  std::uint32_t gate_trips = 0,         ///< losses of the link that released the hand
      late_ticks = 0;                   ///< ticks that began more than 1 ms late
  std::uint32_t reconnects = 0;         ///< number of connections after the first
  bool reconnecting = false;            ///< a Reconnector is active
  EngagedValues engaged;                ///< authority and distance to the leader's hand while it was engaged
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
  double outage_longest_s = 0;         ///< longest outage of the server [s]
  ExitReason end = ExitReason::kDone;  ///< reason of the end
  ClientStatus last;                   ///< status at the end
  hal::DeviceStats device;             ///< statistics of the device
  hal::DeviceHistograms histograms;    ///< periods and round trips of the device
  std::uint64_t trace_dropped = 0;     ///< samples that the trace lacks
  bool realtime = false;               ///< the servo thread had real-time priority
};
[[nodiscard]] SeatVerdict verdict_of(const ClientReport& report) noexcept;
[[nodiscard]] std::string to_json(const ClientReport& report, const SeatSetup& setup);

/// Returns why a seat ended that waited for its server in vain. @param announced  the server had said that it ends here
/// @param waited_s  for which the seat waited [s]
/// @param answer    newest reason of a server that was reached meanwhile; empty: none was reached
[[nodiscard]] std::string server_lost_text(bool announced, double waited_s, const std::string& answer = {});

/// Returns the JSON report of a failed join. @param why  reason as shown to the user
[[nodiscard]] std::string join_failure_json(const std::string& seat, const std::string& server,
                                            const std::string& device, const std::string& why);

}  // namespace tandem::client
