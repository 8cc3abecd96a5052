#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "client/seat.h"
#include "hal/device.h"
#include "proto/seat_setup.h"

namespace tandem::client {

/// What a person wants to see of his seat: plain data, copied out of the servo thread now and then.
struct ClientStatus {
  wire::SessionState session = wire::SessionState::kWaiting;
  wire::GateState gate = wire::GateState::kOff;
  bool heard = false;  ///< anything at all from the server
  bool closed = false;
  wire::CloseReason close_reason = wire::CloseReason::kDone;
  std::uint32_t stops = 0;    ///< how many so far
  std::uint32_t missing = 0;  ///< required seats that are not ready
  double session_time = -1;   ///< [s], negative before the session began
  double silence_s = 0;       ///< since the server last answered something newer of this seat [s]: one that speaks and hears nothing counts as silent
  bool own_stop = false;  ///< the person stopped the own hand
  bool touching = false;  ///< the slave of the tool touches something
  std::optional<std::array<double, 3>> keys_m{};  ///< where keys hold the hand, from its start: right, away, up [m]; nothing: no keys move it
  std::optional<double> distance_m{};  ///< from the hand to the tool, where the port is a tip
  std::optional<double> beside_leader_m{};  ///< from the hand that leads to the own one, by now; nothing: no other hand leads
  std::uint32_t authority_version = 0;
  double alpha = 0;
  wire::Handover handover = wire::Handover::kNone;  ///< what was last told of the own weight, for a second and as long as it moves
  std::uint32_t handovers = 0;                      ///< how often there was something to tell
  double handover_s = 0;                            ///< until it begins [s]; negative: it began
  double handover_from = 0;                         ///< own weight when it was told
  bool handover_done = false;                       ///< it began, and the own weight stands still again
  wire::HandoverParties handover_parties;           ///< who decided it, and who gains
  double force_n = 0;         ///< delivered to the hand [N]
  std::array<double, 3> x{};  ///< tip [m]
  double rtt_ms = 0, rtt_p50_ms = 0, rtt_p99_ms = 0;
  double down_loss_percent = 0, down_longest_gap_ms = 0, down_age_p99_ms = 0;
  double energy_in_j = 0, energy_out_j = 0, dissipated_j = 0, refused_j = 0, delivered_j = 0, margin_min_j = 0;
  double given_after_loss_max_j = 0;
  double force_peak_n = 0;  ///< so far [N]
  std::uint32_t gate_trips = 0, late_ticks = 0;
  bool motors_hot = false, motors_latched = false;  ///< the hand was let go for it; and only the person's button lets it be engaged again
  std::uint32_t hot_trips = 0;   ///< times
  std::optional<double> heat_max;  ///< of the hottest motor so far, 1: too hot; where the device tells it
  std::uint32_t rejoins = 0;  ///< connections after the first
  bool coming_back = false;   ///< somebody asks for the seat again
  std::uint64_t sent = 0, accepted = 0, late_datagrams = 0, refused_datagrams = 0;
};

/// How a seat's life ended.
enum class SeatEnd : std::uint8_t { kDone, kServerStopped, kLeft, kServerLost, kDeviceLost, kSeatGone };

[[nodiscard]] const char* to_text(SeatEnd end) noexcept;

/// Whether a seat's life was what it should be. Without a session there is nothing to judge, and that is no pass.
enum class SeatVerdict : std::uint8_t { kPass, kFail, kNotJudged };
[[nodiscard]] const char* to_text(SeatVerdict verdict) noexcept;
[[nodiscard]] const char* to_text(Role role) noexcept;

/// Why the motors gave no force, if they were too hot; empty: they were not.
[[nodiscard]] std::string motors_text(const ClientStatus& status);

/// What the client knows of the run, for machines.
struct ClientReport {
  std::string server, device_note;
  double seconds = 0;  ///< at the seat
  double away_longest_s = 0;  ///< without news of the server, of those times after which it came back
  SeatEnd end = SeatEnd::kDone;
  ClientStatus last;
  hal::DeviceStats device;
  hal::DeviceHistograms histograms;
  std::uint64_t trace_dropped = 0;
  bool realtime = false;
};
[[nodiscard]] SeatVerdict verdict_of(const ClientReport& report) noexcept;
[[nodiscard]] std::string to_json(const ClientReport& report, const SeatSetup& setup);

/// The same of somebody who never had a seat. @param why  as it was told
[[nodiscard]] std::string unattended_json(const std::string& seat, const std::string& server, const std::string& device, const std::string& why);

}  // namespace tandem::client
