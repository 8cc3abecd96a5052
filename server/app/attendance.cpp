#include "server/app/attendance.h"

#include <utility>

#include "common/base/format.h"
#include "common/base/silence.h"
#include "server/app/status.h"
#include "server/audit.h"
#include "server/stop_words.h"

namespace tandem::server {

namespace {

/// By whom, if from a seat, and who may end it. Of a console the house tells who it is and why; that is not told twice.
std::string stop_text(const char* what, const SessionStatus& status, const SceneSpec& scene) {
  const std::uint8_t by = status.stop.newest().by;
  const std::string who = who_ends(status.stop, scene, seats_heard(status));
  const std::string head = by == AuditEvent::kControlPlane ? std::string() : what + (by < scene.seats.size() ? " by " + scene.seats[by].name : std::string()) + ": ";
  return head + "all hands are let go" + (who.empty() ? "" : "; who may end it: " + who);
}

}  // namespace

Attendance::News Attendance::look(Time now, const SessionStatus& status, const SceneSpec& scene) {
  using State = wire::SessionState;
  News news;
  const bool runs = status.state != State::kWaiting && status.state != State::kEnding && !status.waits;
  std::size_t came = 0, lost = 0, left = 0, taken = 0;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatStatus& now_there = status.seats[i];
    Seat& seat = seats_[i];
    const std::string& name = scene.seats[i].name;
    if (now_there.taken && !seat.taken) news.notes.push_back({"joined", name, name + " joined"});
    if (!now_there.taken && seat.taken) news.notes.push_back({"left", name, name + " left"});
    seat.taken = now_there.taken;
    came += now_there.ever_taken ? 1 : 0;
    taken += now_there.taken ? 1 : 0;
    if (!runs || !now_there.ever_taken || now_there.alive) {
      if (seat.warned && now_there.alive) news.notes.push_back({"back", name, name + " is back"});
      seat.away_since.reset();
      seat.warned = false;
      continue;
    }
    if (!seat.away_since) seat.away_since = now;
    if (now - *seat.away_since < kLost) continue;
    lost += now - *seat.away_since >= kSessionSilence ? 1 : 0;
    left += now_there.taken ? 0 : 1;
    if (!now_there.taken) continue;  // left, and that was told
    if (!seat.warned)
      news.notes.push_back({"gone", name, name + " has been gone for 10 s; its weight went to the others, or the tool is held", true});
    seat.warned = true;
  }
  if (state_ != status.state) {
    if (status.state == State::kRunning)
      news.notes.push_back({"running", "", state_ && state_ != State::kWaiting ? "the session runs again" : "the session runs"});
    if (status.state == State::kPaused)
      news.notes.push_back({"paused", "", stop_text("PAUSED", status, scene)});
    if (status.state == State::kStopped) news.notes.push_back({"stopped", "", stop_text("STOPPED", status, scene)});
    if (status.state == State::kPassive)
      news.notes.push_back({"passive", "", "PASSIVE: this machine is too busy to keep time (three ticks in a row more than 5 ms late); all hands are let go and come back by themselves", true});
    if (status.state == State::kHeld) news.notes.push_back({"held", "", "HELD: " + why_held(status, scene) + ", the tools are braked"});
    state_ = status.state;
  }
  const bool deserted = runs && came > 0 && taken == 0;
  if (deserted && !std::exchange(deserted_, deserted) && scene.endless())
    news.notes.push_back({"everybody_left", "", format("everybody left: the session ends in %.0f s, unless somebody joins it again", seconds(kLost))});
  deserted_ = deserted;
  news.all_lost = runs && came > 0 && lost == came;
  news.all_left = runs && came > 0 && left == came;
  return news;
}

}  // namespace tandem::server
