#include "client/app/vigil.h"

#include <poll.h>
#include <sys/signalfd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "client/app/control_words.h"
#include "client/app/seat_screen.h"
#include "common/base/format.h"
#include "common/base/silence.h"
#include "common/io/clock.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr double kServerLost = seconds(kSessionSilence);  // [s] without news, where nobody comes back
constexpr double kNews = 0.5;       // [s] silence up to which the server is there
constexpr Duration kLeaveMax = 2s;  // for the gate to ramp out and the server to be told
constexpr int kLookEveryMs = 100;
constexpr Duration kStandstill = 400ms;  // between two looks
constexpr std::size_t kSecretsKept = 2;
constexpr Duration kBetweenKeys = 1s;

OwnSeat own_seat(const GivenSeat& given) {
  return {given.welcome.session_id, given.welcome.epoch, {given.welcome.resume_secret}, given.setup, given.server, given.local};
}

}  // namespace

Vigil::Vigil(const Over& over, io::UdpSocket socket)
    : o_(over), kept_(std::move(socket)), own_(own_seat(over.given)), connection_(over.given.connection), begin_(io::monotonic_now()), shown_(begin_), news_(begin_), looked_(begin_), patience_(draw_wait_before_return()) {}

void Vigil::leave(const std::string& why) {
  if (left_) return;
  o_.line.note(why);
  left_ = io::monotonic_now();
  coming_.reset();
  o_.pump.leave();
}

SeatEnd Vigil::keep() {
  if (keys_.interactive()) o_.line.note(o_.person.help());
  if (o_.plan.companion != nullptr) o_.plan.companion->begin(o_.seat.setup());
  words_ = std::make_unique<SessionWords>(connection_, own_.session);
  while (true) {
    // What is not there has a negative number, which is passed over.
    pollfd files[] = {{o_.pump.finished_fd(), POLLIN, 0}, {o_.signals, POLLIN, 0}, {keys_.fd(), POLLIN, 0}, {coming_ ? coming_->done_fd() : -1, POLLIN, 0}, {words_ ? words_->news_fd() : -1, POLLIN, 0}};
    poll(files, std::size(files), kLookEveryMs);
    const ClientStatus status = o_.pump.status();
    if (files[0].revents != 0) {
      if (o_.pump.device_lost() || !returns(status) || !may_come_back()) break;
      o_.pump.finished_read();
    }
    if (files[1].revents != 0) {
      const std::string by{io::signal_that_came()};
      signalfd_siginfo taken;
      [[maybe_unused]] const auto got = ::read(o_.signals, &taken, sizeof taken);
      leave("ended by " + by + ": letting go");
    }
    hear_person();
    see_device();
    const Time now = io::monotonic_now();
    if (left_ && (status.closed || now - *left_ > kLeaveMax)) break;  // nobody is there to be told
    if (o_.plan.duration_s > 0 && seconds(now - begin_) > o_.plan.duration_s) leave("the time given by --duration is over: letting go");
    if (!left_)
      if (const auto end = see_server(status)) return *end;
    see_words(status);
    see_companion(status);
    show(status);
  }
  words_.reset();  // the connection is for the last question now
  if (o_.pump.device_lost()) return SeatEnd::kDeviceLost;
  const ClientStatus last = o_.pump.status();
  if (left_ || last.close_reason == wire::CloseReason::kLeaving) return SeatEnd::kLeft;
  if (last.close_reason == wire::CloseReason::kRemoved || last.close_reason == wire::CloseReason::kRevoked) {
    const std::string why = last.close_reason == wire::CloseReason::kRemoved ? ask_why_gone(connection_.get(), own_.session) : "";
    trouble_ = last.close_reason == wire::CloseReason::kRemoved ? "the seat was taken away by somebody who may; ask him for a ticket" + (why.empty() ? "" : ". The server says: " + why)
                                                                : "this workstation was revoked on the server; ask its admin to enrol it again";
    return SeatEnd::kSeatGone;
  }
  return last.close_reason == wire::CloseReason::kDone ? SeatEnd::kDone : SeatEnd::kServerStopped;
}

void Vigil::hear_person() {
  for (std::string key = keys_.next(); !key.empty(); key = keys_.next()) {
    if (key == "b" && o_.device.phase() == hal::Phase::kFault) wants_force_again_ = o_.device.reset().has_value();
    if (o_.plan.companion != nullptr) o_.plan.companion->pressed(key);
    const Person::Pressed pressed = o_.person.press(key, o_.pump.status(), known_ ? &*known_ : nullptr);
    if (pressed.leaves) leave("letting go");
    const Time now = io::monotonic_now();
    if (pressed.why.empty() || (pressed.why == key_told_ && now - key_told_at_ < kBetweenKeys)) continue;  // a key that is held repeats itself
    key_told_ = pressed.why;
    key_told_at_ = now;
    o_.line.note(pressed.why);
  }
}

void Vigil::see_device() {
  if (o_.device.phase() == hal::Phase::kFault && !std::exchange(fault_told_, true))
    o_.line.warn("the device has a fault: it gave no whole answer for 10 ms, or its readings jumped as no hand does. No force comes; "
                 "look at it, then press b");
  if (wants_force_again_ && o_.device.phase() == hal::Phase::kReady) {  // a person asked for it, just now
    wants_force_again_ = fault_told_ = false;
    static_cast<void>(o_.device.enable());
  }
  if (!left_ && o_.held != nullptr && o_.held->unguarded())
    leave("somebody ended the process that would send zeros if this program died: letting go; join again");
}

std::optional<SeatEnd> Vigil::see_server(const ClientStatus& status) {
  const Time now = io::monotonic_now();
  // A program that stood still itself heard nothing; that says nothing of the server.
  if (now - looked_ > kStandstill) news_ += now - looked_;
  looked_ = now;
  static_cast<void>(o_.pump.take_old());
  const bool there = status.heard && !status.closed && status.silence_s < kNews;
  if (there) {
    if (std::exchange(away_, false)) {
      away_longest_s_ = std::max(away_longest_s_, seconds(now - news_));
      o_.line.note(format("the server is back after %.1f s; the force comes up slowly", seconds(now - news_)));
    }
    news_ = now;
  }
  if (o_.plan.rejoin_s <= 0) return status.silence_s > kServerLost ? std::optional(SeatEnd::kServerLost) : std::nullopt;
  if (coming_ && coming_->done()) return take_back();
  if (seconds(now - news_) > o_.plan.rejoin_s) return SeatEnd::kServerLost;
  // Silence alone made the gate ramp out long before. A new connection gets its time to be heard.
  if (there || coming_ || now - std::max(news_, handed_over_) < patience_) return std::nullopt;
  if (!std::exchange(away_, true))
    o_.line.note(format("%s; your hand is free. Coming back by itself, for up to %.0f s (--rejoin); q or Ctrl-C ends it",
                        returns(status) ? "the server ended and keeps your seat for its next start" : "the server fell silent", o_.plan.rejoin_s));
  patience_ = draw_wait_before_return();
  coming_ = std::make_unique<ComeBack>(o_.asked, own_, o_.seat, o_.pump, kept_);
  return std::nullopt;
}

std::optional<SeatEnd> Vigil::take_back() {
  auto back = coming_->take();
  if (!back) {
    coming_.reset();
    const ClientStatus status = o_.pump.status();
    if (back.error().kind != NotBack::Kind::kGone || (!status.closed && status.silence_s < kNews)) return std::nullopt;
    trouble_ = back.error().reason + "; join again";
    return SeatEnd::kSeatGone;
  }
  // The hand first: nothing of what follows may keep it from its new connection.
  kept_ = io::duplicate(back->handover->socket);
  o_.pump.hand_over(std::move(back->handover));
  handed_over_ = io::monotonic_now();
  const control::Welcome& welcome = back->given.welcome;
  o_.line.note(welcome.epoch > own_.epoch ? "the server was restarted and gave the seat back" : "the server gave the seat back");
  own_.epoch = welcome.epoch;
  own_.server = back->given.server;
  own_.secrets.insert(own_.secrets.begin(), welcome.resume_secret);
  if (own_.secrets.size() > kSecretsKept) own_.secrets.resize(kSecretsKept);
  if (words_) words_->give_up();  // its server may be one that answers nothing any more
  words_.reset();
  connection_ = back->given.connection;
  known_.reset();
  words_ = std::make_unique<SessionWords>(connection_, own_.session);
  coming_.reset();
  return std::nullopt;
}

void Vigil::see_words(const ClientStatus& status) {
  if (!words_) return;
  if (auto said = words_->take()) {
    if (said->stop) said->stop->ends = complete_commands(said->stop->ends, o_.asked, said->name, !o_.given.local);
    const std::string news = news_text(known_.value_or(control::Status{}), *said);
    for (std::size_t at = 0; at < news.size();) {
      const std::size_t end = news.find('\n', at);
      o_.line.note(news.substr(at, end - at));
      at = end + 1;
    }
    known_ = std::move(*said);
  }
  if (words_->ended()) known_.reset();
  const bool changed = status.session != asked_at_.session || status.stops != asked_at_.stops || status.authority_version != asked_at_.authority_version || status.missing != asked_at_.missing;
  if (!changed || status.closed) return;
  asked_at_ = status;
  words_->hurry();
}

void Vigil::see_companion(const ClientStatus& status) {
  Companion* const companion = o_.plan.companion;
  if (companion == nullptr || left_) return;
  for (const std::string& text : companion->say(seconds(io::monotonic_now().time_since_epoch()), status)) o_.line.note(text);
  if (const std::string why = companion->why_leave(); !why.empty()) leave(why);
}

void Vigil::show(ClientStatus status) {
  if (std::exchange(motors_hot_, status.motors_hot) != status.motors_hot) {
    if (status.motors_hot) {
      o_.line.warn(motors_text(status));
    } else {
      o_.line.note(status.motors_latched ? motors_text(status) : "the motors are cool again");
    }
  }
  // Of the end of a stop the server's words tell, with who ended it.
  const bool words_tell = words_ && !words_->ended() && (before_ == wire::SessionState::kStopped || before_ == wire::SessionState::kPaused);
  if (status.session != before_ && status.session == wire::SessionState::kRunning && !words_tell) o_.line.note("the session runs");
  if (status.session != before_ && status.session == wire::SessionState::kPassive)
    o_.line.note("PASSIVE: the server is too busy to keep time; the hand is let go, and engaged again by itself");
  before_ = status.session;
  const Time now = io::monotonic_now();
  if (const std::string told = handovers_.say(seconds(now.time_since_epoch()), status, o_.seat.setup(), known_); !told.empty()) o_.line.note(told);
  if (now - shown_ < std::chrono::milliseconds(o_.line.interval_ms())) return;
  shown_ = now;
  status.coming_back = coming_ != nullptr;
  status.keys_m = o_.person.keys();
  o_.line.show(seat_screen(status, o_.seat.setup(), known_));
}

std::string Vigil::farewell(SeatEnd end) const {
  switch (end) {
    case SeatEnd::kDone: return "the session is over";
    case SeatEnd::kServerStopped: return "the server ended the session";
    case SeatEnd::kLeft: return "left the seat";
    case SeatEnd::kServerLost:
      return format("server lost: no news for %.0f s; the force was let go after the first losses. Look at the network and the server, then join again",
                    o_.plan.rejoin_s > 0 ? o_.plan.rejoin_s : kServerLost);
    case SeatEnd::kDeviceLost: return "device lost: it is unplugged or stopped answering; plug it in and join again";
    case SeatEnd::kSeatGone: return "the seat is gone: " + trouble_;
  }
  return "";
}

}  // namespace tandem::client
