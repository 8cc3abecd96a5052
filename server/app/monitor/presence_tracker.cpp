#include "server/app/monitor/presence_tracker.h"

#include <utility>

#include "common/base/format.h"
#include "common/base/session_timeout.h"
#include "server/app/monitor/session_status.h"
#include "server/report/audit_event.h"
#include "server/session/stop_text.h"

namespace tandem::server {

namespace {

/// Text of a stop: its author, and who may end it. The session registry reports stops by consoles of this server, with
/// name and reason.
std::string stop_text(const char* what, const SessionStatus& status, const SceneSpec& scene) {
  const StopLatch::Latest& latest = status.stop.latest();
  const std::string who = may_end_text(status.stop, scene, connected_seats_mask(status));
  std::string head = what;
  if (latest.by < scene.seats.size()) {
    head += " by " + scene.seats[latest.by].name;
  } else if (latest.by == AuditEvent::kControlPlane && latest.restored) {
    head += " by " + std::string(latest.words.workstation.view());
    if (!latest.words.why.empty()) head += ": " + std::string(latest.words.why.view());
  }
  head += ": ";
  if (latest.by == AuditEvent::kControlPlane && !latest.restored) head.clear();
  return head + "all hands are released" + (who.empty() ? "" : "; it can be ended by: " + who);
}

}  // namespace

PresenceTracker::Events PresenceTracker::update(Time now, const SessionStatus& status, const SceneSpec& scene) {
  using State = wire::SessionState;
  Events news;
  const bool runs = status.state != State::kWaiting && status.state != State::kEnding && !status.waiting;
  std::size_t came = 0, lost = 0, left = 0, taken = 0;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatStatus& now_there = status.seats[i];
    Seat& seat = seats_[i];
    const std::string& name = scene.seats[i].name;
    if (now_there.taken && !seat.taken) news.events.push_back({"joined", name, name + " joined"});
    if (!now_there.taken && seat.taken) news.events.push_back({"left", name, name + " left"});
    seat.taken = now_there.taken;
    came += now_there.ever_taken ? 1 : 0;
    taken += now_there.taken ? 1 : 0;
    if (!runs || !now_there.ever_taken || now_there.alive) {
      if (seat.warned && now_there.alive) news.events.push_back({"back", name, name + " is back"});
      seat.away_since.reset();
      seat.warned = false;
      continue;
    }
    if (!seat.away_since) seat.away_since = now;
    if (now - *seat.away_since < kLost) continue;
    lost += now - *seat.away_since >= kSessionTimeout ? 1 : 0;
    left += now_there.taken ? 0 : 1;
    if (!now_there.taken) continue;  // it left, which was reported
    if (!seat.warned)
      news.events.push_back(
          {"gone", name, name + " has been gone for 10 s; its authority went to the other seats, or the tool is braked",
           true});
    seat.warned = true;
  }
  if (state_ != status.state) {
    if (status.state == State::kRunning)
      news.events.push_back(
          {"running", "", state_ && state_ != State::kWaiting ? "the session runs again" : "the session runs"});
    if (status.state == State::kPaused) news.events.push_back({"paused", "", stop_text("PAUSED", status, scene)});
    if (status.state == State::kStopped) news.events.push_back({"stopped", "", stop_text("STOPPED", status, scene)});
    if (status.state == State::kOverloaded)
      news.events.push_back({"overloaded", "",
                             "OVERLOADED: this machine is too busy to keep time (three ticks in a row more than 5 ms "
                             "late); all hands are released and engaged again automatically",
                             true});
    if (status.state == State::kHeld)
      news.events.push_back({"braked", "", "BRAKED: " + held_reason_text(status, scene)});
    state_ = status.state;
  }
  const bool deserted = runs && came > 0 && taken == 0;
  if (deserted && !std::exchange(all_left_before_, deserted) && scene.endless())
    news.events.push_back(
        {"everybody_left", "",
         format("all participants left: the session ends in %.0f s, unless a client joins it again", seconds(kLost))});
  all_left_before_ = deserted;
  news.all_lost = runs && came > 0 && lost == came;
  news.all_left = runs && came > 0 && left == came;
  return news;
}

}  // namespace tandem::server
