#include "client/app/seat_supervisor.h"

#include <poll.h>
#include <sys/signalfd.h>

#include <iterator>
#include <utility>

#include "client/app/console_commands.h"
#include "client/app/seat_screen.h"
#include "client/app/session_status_text.h"
#include "common/base/format.h"
#include "common/base/session_timeout.h"
#include "common/io/clock.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr double kServerLost = seconds(kSessionTimeout);  // [s] silence after which a seat without reconnect ends
constexpr double kServerSilenceMax = 0.5;                 // [s] silence up to which the server counts as present
constexpr Duration kLeaveMax = 2s;                        // time for the gate to ramp out and for CLOSE to be sent
constexpr int kPollIntervalMs = 100;
constexpr std::size_t kSecretsKept = 2;
constexpr Duration kBetweenKeyMessages = 1s;

ResumeState resume_state(const JoinedSeat& seat) {
  return {.session = seat.welcome.session_id,
          .epoch = seat.welcome.epoch,
          .secrets = {seat.welcome.resume_secret},
          .setup = seat.setup,
          .server = seat.server,
          .local = seat.local,
          .service = seat.service,
          .members = seat.welcome.members,
          .last = seat.udp};
}

}  // namespace

SeatSupervisor::SeatSupervisor(const Context& context, io::UdpSocket socket)
    : o_(context),
      socket_(std::move(socket)),
      resume_state_(resume_state(context.joined)),
      connection_(context.joined.connection),
      begin_(io::monotonic_now()),
      shown_at_(begin_),
      server_(begin_, initial_backoff()) {}

void SeatSupervisor::leave(const std::string& why) {
  if (leaving_since_) return;
  o_.runner.commands().leave();  // before anything that may take time
  leaving_since_ = io::monotonic_now();
  if (reconnector_) reconnector_->cancel();
  o_.line.note(why);
}

ExitReason SeatSupervisor::run() {
  if (keys_.interactive()) o_.line.note(o_.keyboard.help());
  if (o_.options.observer != nullptr) o_.options.observer->on_joined(o_.seat.setup());
  status_poller_ = std::make_unique<SessionStatusPoller>(connection_, resume_state_.session);
  while (true) {
    // poll() ignores negative file descriptors, which mark absent files.
    pollfd files[] = {{o_.runner.finished_fd(), POLLIN, 0},
                      {o_.signals, POLLIN, 0},
                      {keys_.fd(), POLLIN, 0},
                      {reconnects() ? reconnector_->done_fd() : -1, POLLIN, 0},
                      {status_poller_ ? status_poller_->status_fd() : -1, POLLIN, 0}};
    poll(files, std::size(files), kPollIntervalMs);
    const ClientStatus status = o_.runner.status();
    if (files[0].revents != 0) {
      if (o_.runner.device_lost() || !server_restarts(status) || !may_reconnect()) break;
      o_.runner.clear_finished();
    }
    if (files[1].revents != 0) {
      const std::string by{io::pending_signal()};
      signalfd_siginfo taken;
      [[maybe_unused]] const auto got = ::read(o_.signals, &taken, sizeof taken);
      leave("ended by " + by + ": releasing the hand");
    }
    handle_keys();
    check_device();
    const Time now = io::monotonic_now();
    const bool closed = status.closed && !server_.outdated(status.reconnects);
    if (leaving_since_ && (closed || now - *leaving_since_ > kLeaveMax)) break;  // no server receives CLOSE
    if (o_.options.duration_s > 0 && seconds(now - begin_) > o_.options.duration_s)
      leave("the time given by --duration is over: releasing the hand");
    if (!leaving_since_)
      if (const auto end = check_server(status)) return *end;
    show_status_changes(status);
    update_observer(status);
    show(status);
  }
  status_poller_.reset();  // query_removal_reason needs the connection for itself
  if (o_.runner.device_lost()) return ExitReason::kDeviceLost;
  const ClientStatus last = o_.runner.status();
  if (leaving_since_ || last.close_reason == wire::CloseReason::kLeaving) return ExitReason::kLeft;
  if (last.close_reason == wire::CloseReason::kRemoved || last.close_reason == wire::CloseReason::kRevoked) {
    const std::string why = last.close_reason == wire::CloseReason::kRemoved
                                ? query_removal_reason(connection_.get(), resume_state_.session)
                                : "";
    exit_detail_ = last.close_reason == wire::CloseReason::kRemoved
                       ? "an instructor or operator removed this client; ask for a ticket to join again" +
                             (why.empty() ? "" : ". The server says: " + why)
                       : "this workstation was revoked on the server; ask its admin to enrol it again";
    return ExitReason::kSeatGone;
  }
  return last.close_reason == wire::CloseReason::kDone ? ExitReason::kDone : ExitReason::kServerStopped;
}

void SeatSupervisor::handle_keys() {
  for (std::string key = keys_.next(); !key.empty(); key = keys_.next()) {
    if (key == "b" && o_.device.phase() == hal::Phase::kFault) reset_requested_ = o_.device.reset().has_value();
    if (o_.options.observer != nullptr) o_.options.observer->on_key(key);
    const KeyboardControls::KeyResult pressed =
        o_.keyboard.on_key(key, o_.runner.status(), last_status_ ? &*last_status_ : nullptr);
    if (pressed.leaves) leave("releasing the hand");
    const Time now = io::monotonic_now();
    if (pressed.why.empty() || (pressed.why == key_message_ && now - key_message_at_ < kBetweenKeyMessages))
      continue;  // a key that is held repeats
    key_message_ = pressed.why;
    key_message_at_ = now;
    o_.line.note(pressed.why);
  }
}

void SeatSupervisor::check_device() {
  if (o_.device.phase() == hal::Phase::kFault && !std::exchange(fault_reported_, true))
    o_.line.warn(
        "the device has a fault: no complete answer for 10 ms, or its readings jumped faster than a hand moves. It "
        "gives no force; check the device, then press b");
  if (reset_requested_ && o_.device.phase() == hal::Phase::kReady) {  // only after the user's key
    reset_requested_ = fault_reported_ = false;
    static_cast<void>(o_.device.enable());
  }
  if (!leaving_since_ && o_.hardware != nullptr && o_.hardware->watchdog_lost())
    leave(
        "the process tandem-watchdog ended, which sends zero forces if this program fails: releasing the hand; join "
        "again");
}

std::optional<ExitReason> SeatSupervisor::check_server(const ClientStatus& status) {
  const Time now = io::monotonic_now();
  static_cast<void>(o_.runner.connections().take_old());
  const bool outdated = server_.outdated(status.reconnects);
  if (const auto outage =
          server_.update(now, !outdated && status.heard && !status.closed && status.silence_s < kServerSilenceMax))
    o_.line.note(format("the server is back after %.1f s; the force comes up slowly", *outage));
  if (o_.options.reconnect_timeout_s <= 0)
    return status.silence_s > kServerLost ? std::optional(ExitReason::kServerLost) : std::nullopt;
  if (reconnector_ && reconnector_->done()) return finish_reconnect();
  if (reconnector_) {
    note_distrust(reconnector_->distrust());
    answer_ = reconnector_->answer();
  }
  if (server_.absence(now) > o_.options.reconnect_timeout_s) return ExitReason::kServerLost;
  if (outdated) return std::nullopt;  // a reconnect would invalidate the new connection
  // The session goes on at another server of the service, perhaps at once.
  if (server_restarts(status) && resume_state_.service) server_.hasten(hastened_backoff());
  // The force gate already released the force after the silence limit.
  if (reconnector_ || !server_.reconnect_due(now)) return std::nullopt;
  if (server_.on_reconnect(initial_backoff())) {
    run_notice_.on_break();
    o_.line.note(
        format("%s; your hand is free. Reconnecting, for up to %.0f s (--reconnect-timeout); q or Ctrl-C ends it",
               server_restarts(status) ? "the server ended or gave the session away; your seat is kept"
                                       : "the server fell silent",
               o_.options.reconnect_timeout_s));
  }
  reconnector_ = std::make_unique<Reconnector>(o_.join_options, resume_state_, o_.seat, o_.runner, socket_);
  return std::nullopt;
}

void SeatSupervisor::note_distrust(std::string why) {
  if (why.empty() || why == distrust_) return;
  distrust_ = std::move(why);
  o_.line.note("this seat cannot come back to a server that answers: " + distrust_);
}

std::optional<ExitReason> SeatSupervisor::finish_reconnect() {
  auto resumed = reconnector_->take();
  if (!resumed) {
    reconnector_.reset();
    const ClientStatus status = o_.runner.status();
    if (resumed.error().kind != ResumeError::Kind::kGone || (!status.closed && status.silence_s < kServerSilenceMax))
      return std::nullopt;
    exit_detail_ = resumed.error().reason + "; join again";
    return ExitReason::kSeatGone;
  }
  // The servo thread gets its connection first, so that nothing below delays it.
  socket_ = io::duplicate(resumed->swap->socket);
  o_.runner.connections().offer(std::move(resumed->swap));
  server_.on_connected(io::monotonic_now());
  const rpc::Welcome& welcome = resumed->joined.welcome;
  const bool moved = resumed->joined.server != resume_state_.server && resumed->joined.service;
  o_.line.note(moved
                   ? "the server at " + io::to_text(resumed->joined.udp) + " has the session now and gave the seat back"
               : welcome.epoch > resume_state_.epoch
                   ? (resumed->joined.service ? "the server has the session again and gave the seat back"
                                              : "the server was restarted and gave the seat back")
                   : "the server gave the seat back");
  resume_state_.epoch = welcome.epoch;
  resume_state_.server = resumed->joined.server;
  resume_state_.last = resumed->joined.udp;
  if (resumed->joined.service) resume_state_.service = resumed->joined.service;
  if (!welcome.members.empty()) resume_state_.members = welcome.members;
  resume_state_.secrets.insert(resume_state_.secrets.begin(), welcome.resume_secret);
  if (resume_state_.secrets.size() > kSecretsKept) resume_state_.secrets.resize(kSecretsKept);
  if (status_poller_) status_poller_->cancel();  // the old server may not answer any more
  status_poller_.reset();
  connection_ = resumed->joined.connection;
  last_status_.reset();
  status_poller_ = std::make_unique<SessionStatusPoller>(connection_, resume_state_.session);
  reconnector_.reset();
  distrust_.clear();
  answer_.clear();
  return std::nullopt;
}

void SeatSupervisor::show_status_changes(const ClientStatus& status) {
  if (!status_poller_) return;
  if (auto newer = status_poller_->take()) {
    if (newer->stop)
      newer->stop->ends = complete_commands(newer->stop->ends, o_.join_options, newer->name, !o_.joined.local);
    const std::string lines = status_changes_text(last_status_.value_or(rpc::Status{}), *newer);
    for (std::size_t at = 0; at < lines.size();) {
      const std::size_t end = lines.find('\n', at);
      o_.line.note(lines.substr(at, end - at));
      at = end + 1;
    }
    last_status_ = std::move(*newer);
  }
  if (status_poller_->ended()) last_status_.reset();
  const bool changed = status.session != status_at_poll_.session || status.stops != status_at_poll_.stops ||
                       status.authority_version != status_at_poll_.authority_version ||
                       status.missing != status_at_poll_.missing;
  if (!changed || status.closed) return;
  status_at_poll_ = status;
  status_poller_->poll_now();
}

void SeatSupervisor::update_observer(const ClientStatus& status) {
  SeatObserver* const observer = o_.options.observer;
  if (observer == nullptr || leaving_since_) return;
  for (const std::string& text : observer->messages(seconds(io::monotonic_now().time_since_epoch()), status))
    o_.line.note(text);
  if (const std::string why = observer->leave_reason(); !why.empty()) leave(why);
}

void SeatSupervisor::show(ClientStatus status) {
  if (std::exchange(motors_hot_, status.motors.hot) != status.motors.hot) {
    if (status.motors.hot) {
      o_.line.warn(motors_text(status));
    } else {
      o_.line.note(status.motors.latched ? motors_text(status) : "the motors are cool again");
    }
  }
  // The status from the server reports the end of a stop, with the participant who ended it.
  const bool reported =
      status_poller_ && !status_poller_->ended() &&
      (session_before_ == wire::SessionState::kStopped || session_before_ == wire::SessionState::kPaused);
  if (status.session != session_before_ && run_notice_.update(status.session, reported))
    o_.line.note("the session runs");
  if (status.session != session_before_ && status.session == wire::SessionState::kOverloaded) {
    o_.line.note(
        "OVERLOADED: the server is too busy to keep time; the hand is released, and engaged again automatically");
    run_notice_.on_break();
  }
  session_before_ = status.session;
  const Time now = io::monotonic_now();
  if (const std::string transfer = transfer_notices_.message(seconds(now), status, o_.seat.setup(), last_status_);
      !transfer.empty())
    o_.line.note(transfer);
  if (now - shown_at_ < std::chrono::milliseconds(o_.line.interval_ms())) return;
  shown_at_ = now;
  status.reconnecting = reconnects();
  status.keys_m = o_.keyboard.keys();
  o_.line.show(seat_screen(status, o_.seat.setup(), last_status_));
}

std::string SeatSupervisor::exit_message(ExitReason end) const {
  switch (end) {
    case ExitReason::kDone:
      return "the session is over";
    case ExitReason::kServerStopped:
      return "the server ended the session";
    case ExitReason::kLeft:
      return "left the seat";
    case ExitReason::kServerLost:
      if (!distrust_.empty())
        return "server lost: the one that answers is not accepted for this seat: " + distrust_ +
               ". Then join again by a new ticket or the session's code";
      return server_lost_text(server_restarts(o_.runner.status()),
                              o_.options.reconnect_timeout_s > 0 ? o_.options.reconnect_timeout_s : kServerLost,
                              answer_);
    case ExitReason::kDeviceLost:
      return "device lost: it is unplugged or stopped answering; plug it in and join again";
    case ExitReason::kSeatGone:
      return "the seat is gone: " + exit_detail_;
  }
  return "";
}

}  // namespace tandem::client
