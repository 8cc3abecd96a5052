#include "server/app/status.h"

#include <cstdio>

#include "common/base/format.h"
#include "server/stop_words.h"

namespace tandem::server {
namespace {

std::string seat_text(const SeatStatus& seat, const std::string& name) {
  if (!seat.taken) return name + " gone";
  if (!seat.alive) return name + " silent";
  if (seat.gate == wire::GateState::kOff) return name + " joining";
  std::string text =
      format("%s %s alpha %.2f rtt %.1f ms", name.c_str(), to_text(seat.gate), seat.alpha, seat.link.rtt_p50_ms);
  if (seat.link.up.loss_percent + seat.link.down.loss_percent > 0)
    text += format(" loss %.1f/%.1f %%", seat.link.up.loss_percent, seat.link.down.loss_percent);
  text += format(" margin %.0f mJ", seat.margin_j * 1e3);
  if (seat.gate_trips > 0) text += format(" trips %u", seat.gate_trips);
  if (seat.late_ticks > 0) text += format(" late %u", seat.late_ticks);
  return text;
}

}  // namespace

std::uint32_t seats_heard(const SessionStatus& status) noexcept {
  std::uint32_t seats = 0;
  for (std::size_t i = 0; i < status.seats.size(); ++i) seats |= status.seats[i].taken && status.seats[i].alive ? 1U << i : 0U;
  return seats;
}

std::string waiting_for(const SessionStatus& status, const SceneSpec& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatStatus& seat = status.seats[i];
    if (!scene.seats[i].required || seat.ready) continue;
    text += (text.empty() ? "" : ", ") + scene.seats[i].name;
    text += !seat.taken  ? (seat.ever_taken ? " (left)" : " (nobody joined)")
            : seat.alive ? " (not ready)"
                         : " (silent)";
  }
  return text;
}

std::string why_held(const SessionStatus& status, const SceneSpec& scene) {
  std::string silent;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatStatus& seat = status.seats[i];
    if (!seat.ever_taken || (seat.taken && seat.alive)) continue;
    silent += (silent.empty() ? "" : ", ") + scene.seats[i].name + (seat.taken ? " is silent" : " has left");
  }
  return silent.empty() ? "nobody entitled is present" : silent;
}

std::string status_line(const SessionStatus& status, const SceneSpec& scene) {
  std::string line = scene.endless() ? format("%.1f s ", status.time) : format("%.1f/%g s ", status.time, scene.duration);
  switch (status.state) {
    case wire::SessionState::kWaiting: {
      const std::string whom = waiting_for(status, scene);
      line = whom.empty() ? "engaging" : "waiting for " + whom;
      break;
    }
    case wire::SessionState::kRunning:
      line += "running";
      break;
    case wire::SessionState::kHeld:
      line += "HELD (" + why_held(status, scene) + ")";
      break;
    case wire::SessionState::kPaused:
      line += "PAUSED (ends it: " + who_ends(status.stop, scene, seats_heard(status)) + ")";
      break;
    case wire::SessionState::kStopped:
      line += "STOPPED (ends it: " + who_ends(status.stop, scene, seats_heard(status)) + ")";
      break;
    case wire::SessionState::kEnding:
      line += "ending";
      break;
    case wire::SessionState::kPassive:
      line += "PASSIVE (this machine is too busy to keep time; goes on by itself)";
      break;
  }
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    if (status.seats[i].ever_taken) line += " | " + seat_text(status.seats[i], scene.seats[i].name);
  if (status.machine.relief.rung > Rung::kNothing) line += format(" | goes without: %s", to_text(status.machine.relief.rung));
  return line + format(" | late ticks %llu", static_cast<unsigned long long>(status.machine.late_ticks));
}

}  // namespace tandem::server
