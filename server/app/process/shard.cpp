#include "server/app/process/shard.h"

#include <poll.h>

#include <algorithm>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/process/address_conversion.h"
#include "server/session/connection_id.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 70;            // above the device threads, because a late server delays all participants
constexpr Duration kReadingMax = 200us;  // limit of receiving per tick, so that a flood cannot delay the tick
constexpr std::size_t kRequestsMax = 256;

PeerSlots& slots_of(Session& session, ShardRequest::Peers peers) noexcept {
  return peers == ShardRequest::Peers::kWatchers ? session.watchers().slots() : session.link_test_peers().slots();
}

}  // namespace

Shard::Shard(io::UdpSocket socket, double tick_hz)
    : socket_(std::move(socket)),
      period_(from_seconds(1.0 / tick_hz)),
      requests_(kRequestsMax),
      completed_(2 * kRequestsMax),
      load_(period_) {}

bool Shard::add_session(LiveSession& session) noexcept {
  LiveSession*& place = sessions_[session.slot()];
  if (place != nullptr) return false;
  place = &session;
  stagger(session);
  return true;
}

/// Lets the consoles of different sessions get TELEMETRY at different ticks.
void Shard::stagger(LiveSession& session) noexcept { session.session().watchers().set_phase(ticks_ + session.slot()); }

void Shard::stop(wire::CloseReason why) noexcept {
  stop_reason_.store(why, std::memory_order_relaxed);
  stop_.store(true, std::memory_order_release);
  wake_.signal();
}

bool Shard::post(ShardRequest& request) noexcept {
  if (!requests_.push(&request)) return false;
  wake_.signal();
  return true;
}

ShardRequest* Shard::next_completed() noexcept { return completed_.take().value_or(nullptr); }

void Shard::clear_completions() noexcept { completions_.clear(); }

void Shard::run() noexcept {
  load_.set_realtime(io::request_realtime(kPriority));
  Time due = io::monotonic_now() + period_;
  const auto serving = [&] {
    return std::ranges::any_of(sessions_, [](const LiveSession* s) { return s != nullptr; });
  };
  while (true) {
    wait_until(due);
    execute_requests(io::monotonic_now());
    if (stop_.load(std::memory_order_acquire)) {
      if (!serving()) break;
      for (LiveSession* s : sessions_)
        if (s != nullptr) s->session().end(stop_reason_.load(std::memory_order_relaxed));
    }
    Time now = io::monotonic_now();
    if (now < due) continue;
    receive();
    now = io::monotonic_now();
    const std::uint32_t missed = load_.begin_tick(now, now - due, serving());
    const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    tick(now, due + missed * period_, missed);
    load_.end_tick(now, before, io::read_clock(CLOCK_THREAD_CPUTIME_ID));
    due += (missed + 1) * period_;
    ticks_ += missed + 1;
  }
  execute_requests(io::monotonic_now());  // reply to pending requests that the session is over
  completions_.signal();
}

/// Waits until `due`, or until a request or `stop` arrives. Datagrams do not wake the thread: no session needs them
/// earlier, and one wake-up each would double the processor time. The kernel has recorded their arrival times.
void Shard::wait_until(Time due) noexcept {
  pollfd wake{wake_.get(), POLLIN, 0};
  const timespec rest = io::to_timespec(due - io::monotonic_now());
  ppoll(&wake, 1, &rest, nullptr);
  if (wake.revents != 0) wake_.clear();
}

void Shard::receive() noexcept {
  std::uint64_t unmatched = 0;
  const Time began = io::monotonic_now();
  for (Time now = began; now - began < kReadingMax; now = io::monotonic_now()) {
    const int count = in_.receive(socket_.fd.get());
    const Duration wall = io::read_clock(CLOCK_REALTIME);
    const Time read = io::monotonic_now();  // the same time on the monotonic clock
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const auto header = in_.too_long(i) ? std::nullopt : transport::read_header(in_.bytes(i));
      const std::size_t slot = header ? slot_of(header->cid) : kSessionsMax;
      if (slot < kSessionsMax && sessions_[slot] != nullptr) {
        // A datagram that was not in the last batch arrived later, even if the wall clock was set.
        const Time came = std::max(read - in_.details(i, wall).age, read_until_);
        sessions_[slot]->session().on_datagram(came, endpoint_of(in_.from(i)), in_.bytes(i));
      } else {
        ++unmatched;
      }
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) {
      read_until_ = now;
      break;
    }
  }
  if (unmatched > 0) unmatched_datagrams_.fetch_add(unmatched, std::memory_order_relaxed);
}

void Shard::execute_requests(Time now) noexcept {
  bool any = false;
  while (const auto request = requests_.take()) {
    execute(now, **request);
    any = completed_.push(*request) || any;
  }
  if (any) completions_.signal();
}

void Shard::execute(Time now, ShardRequest& request) noexcept {
  LiveSession* const live = request.session;
  LiveSession*& place = sessions_[live->slot()];
  const bool stopping = stop_.load(std::memory_order_relaxed);
  if (request.what == ShardRequest::What::kAddSession) {
    request.result = stopping || place != nullptr ? JoinResult::kSessionOver : JoinResult::kAccepted;
    if (request.result != JoinResult::kAccepted) return;
    place = live;
    stagger(*live);
    return;
  }
  request.result = place == live ? JoinResult::kAccepted : JoinResult::kSessionOver;
  if (place != live) return;
  switch (request.what) {
    case ShardRequest::What::kQuerySeat:
      request.result = live->session().participants().may_admit(now, request.seat, request.same_owner);
      if (request.result == JoinResult::kAccepted) {
        const SeatEndpoint& seat = live->session().seat(request.seat);
        request.silence = seat.taken() ? seat.silence(now) : Duration::zero();
        request.ever_heard = seat.ever_heard();
      }
      break;
    case ShardRequest::What::kAdmit:
      request.result = live->session().admit(now, request.seat, request.connection, request.same_owner);
      break;
    case ShardRequest::What::kAdmitPeer:
      request.result = slots_of(live->session(), request.peers)
                           .admit(now, request.connection.link, request.place, request.every_tick);
      break;
    case ShardRequest::What::kCommand:
      request.outcome = execute_command(live->session(), now, request.command);
      break;
    case ShardRequest::What::kRevokeSeat:
      request.outcome.result = remove_client(live->session(), request.seat, request.cid, wire::CloseReason::kRevoked);
      request.outcome.tick = live->session().clock().session_tick();
      break;
    case ShardRequest::What::kQueryPeers:
      request.place = slots_of(live->session(), request.peers).places_free(now);
      break;
    case ShardRequest::What::kRemovePeer:
      static_cast<void>(
          slots_of(live->session(), request.peers).remove(request.place, request.cid, wire::CloseReason::kRevoked));
      break;
    case ShardRequest::What::kEndSession:
      live->session().end(wire::CloseReason::kServerStops);
      break;
    case ShardRequest::What::kAddSession:
      break;
  }
}

void Shard::tick(Time now, Time due, std::uint32_t missed) noexcept {
  bool ended = false;
  for (LiveSession*& live : sessions_) {
    if (live == nullptr) continue;
    send(live->tick(now, due, missed, load_.machine()), live->session());
    if (!live->session().over()) continue;
    live->finish(now, load_.machine());
    live = nullptr;
    ended = true;
  }
  flush();
  if (ended) completions_.signal();
}

void Shard::send(Time now, Session& session) noexcept {
  while (true) {
    const std::size_t slot = out_.size();
    const auto due = session.poll_transmit(now, buffers_[slot]);
    if (!due) return;
    addresses_[slot] = address_of(due->to);
    out_.add(std::span{buffers_[slot]}.first(due->size), &addresses_[slot], nullptr);
    if (out_.size() == kSendMax) flush();
  }
}

void Shard::flush() noexcept {
  if (out_.size() > 0) out_.send(socket_.fd.get());  // an unsent datagram counts as lost in the network
}

}  // namespace tandem::server
