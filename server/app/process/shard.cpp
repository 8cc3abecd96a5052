#include "server/app/process/shard.h"

#include <poll.h>

#include <algorithm>
#include <span>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/process/address_conversion.h"
#include "server/session/connection_id.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 70;  // above the device threads, because a late server delays all participants
// Limit of receiving per tick, so that a flood cannot delay the tick: for others' datagrams, and for each seat's.
constexpr Duration kReadingMax = 200us, kReadingPerSeat = 1500ns;
constexpr std::size_t kRequestsMax = 256;
constexpr std::uint64_t kMeasuredTicks = 4;
constexpr Duration kIdle = 20ms;  // between two ticks without a session

PeerSlots& slots_of(Session& session, ShardRequest::Peers peers) noexcept {
  return peers == ShardRequest::Peers::kWatchers ? session.watchers().slots() : session.link_test_peers().slots();
}

}  // namespace

Shard::Shard(io::UdpSocket socket, double tick_hz)
    : socket_(std::move(socket)),
      period_(from_seconds(1.0 / tick_hz)),
      idle_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(kIdle / period_))),
      requests_(kRequestsMax),
      completed_(2 * kRequestsMax),
      load_(period_) {}

bool Shard::add_session(LiveSession& session) noexcept {
  if (sessions_[session.slot()] != nullptr) return false;
  serve(session);
  stagger(session);
  return true;
}

void Shard::serve(LiveSession& session) noexcept {
  sessions_[session.slot()] = served_[count_++] = &session;
  seats_ += session.scene().seats.size();
  served_count_.store(count_, std::memory_order_relaxed);
}

void Shard::forget(const LiveSession& session) noexcept {
  sessions_[session.slot()] = nullptr;
  const auto end = served_.begin() + static_cast<std::ptrdiff_t>(count_--);
  const auto gone = std::find(served_.begin(), end, &session);
  std::copy(gone + 1, end, gone);
  seats_ -= session.scene().seats.size();
  served_count_.store(count_, std::memory_order_relaxed);
}

/// Lets the consoles of different sessions get TELEMETRY at different ticks. A session that passes to another shard
/// keeps its turn, because the ticks there have the same numbers.
void Shard::stagger(LiveSession& session) noexcept {
  session.set_last_tick(tick_);
  session.session().watchers().set_phase(static_cast<std::uint32_t>(tick_ + session.slot()));
}

void Shard::stop(wire::CloseReason why) noexcept {
  stop_reason_.store(why, std::memory_order_relaxed);
  stop_.store(true, std::memory_order_release);
  wake_.signal();
}

bool Shard::post(ShardRequest& request) noexcept {
  request.posted_to = this;
  if (posted_ == kRequestsMax || !requests_.push(&request)) return false;
  ++posted_;
  wake_.signal();
  return true;
}

ShardRequest* Shard::next_completed() noexcept {
  ShardRequest* const request = completed_.take().value_or(nullptr);
  if (request != nullptr) --request->posted_to->posted_;
  return request;
}

void Shard::clear_completions() noexcept { completions_.clear(); }

void Shard::end_all(wire::CloseReason why) noexcept {
  for (LiveSession* s : std::span{served_}.first(count_)) s->session().end(why);
  if (moving_ != nullptr) reject_move();
}

std::uint64_t Shard::next_tick() const noexcept { return serving() ? tick_ + 1 : (tick_ / idle_ + 1) * idle_; }

/// Ticks that a shard without sessions skips are not missed.
void Shard::skip_idle_ticks(Time now) noexcept {
  if (!serving() && now < time_of(next_tick())) tick_ = tick_at(now);
}

void Shard::run() noexcept {
  load_.set_realtime(io::request_realtime(kPriority));
  tick_ = tick_at(io::monotonic_now());
  for (LiveSession* s : std::span{served_}.first(count_)) stagger(*s);
  open_arrivals();
  while (true) {
    wait_until(time_of(next_tick()));
    skip_idle_ticks(io::monotonic_now());
    serve_arrival();
    execute_requests(io::monotonic_now());
    if (stop_.load(std::memory_order_acquire)) {
      if (!serving() && close_arrivals()) break;
      end_all(stop_reason_.load(std::memory_order_relaxed));
    }
    Time now = io::monotonic_now();
    if (now < time_of(next_tick())) continue;
    reading_left_ = kReadingMax + static_cast<std::int64_t>(seats_) * kReadingPerSeat;
    receive();
    now = io::monotonic_now();
    const std::uint64_t next = next_tick();
    tick_ = next + load_.begin_tick(now, now - time_of(next), serving());
    const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    tick(now);
    load_.end_tick(now, before, io::read_clock(CLOCK_THREAD_CPUTIME_ID));
    if (moving_ != nullptr) pass_on();
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
  for (Time now = began; now - began < reading_left_; now = io::monotonic_now()) {
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
  reading_left_ -= io::monotonic_now() - began;
  if (unmatched > 0) unmatched_datagrams_.fetch_add(unmatched, std::memory_order_relaxed);
}

void Shard::execute_requests(Time now) noexcept {
  bool any = false;
  while (const auto request = requests_.take()) {
    execute(now, **request);
    any = (*request != moving_ && completed_.push(*request)) || any;
  }
  if (any) completions_.signal();
}

void Shard::complete(ShardRequest& request) noexcept {
  completed_.push(&request);
  completions_.signal();
}

void Shard::execute(Time now, ShardRequest& request) noexcept {
  LiveSession* const live = request.session;
  const LiveSession* const place = sessions_[live->slot()];
  const bool stopping = stop_.load(std::memory_order_relaxed);
  if (request.what == ShardRequest::What::kAddSession) {
    request.result = !stopping && add_session(*live) ? JoinResult::kAccepted : JoinResult::kSessionOver;
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
      live->session().end(request.why);
      break;
    case ShardRequest::What::kMoveSession:
      begin_move(request);
      break;
    case ShardRequest::What::kAddSession:
      break;
  }
}

void Shard::tick(Time now) noexcept {
  // Reading the clock is a system call, so few ticks measure, and each of them one session.
  const bool measures = tick_ % kMeasuredTicks == 0;
  bool ended = false;
  for (std::size_t i = 0; i < count_;) {
    LiveSession& live = *served_[i];
    const auto missed = live.begin_tick(tick_);
    if (missed) step(now, *missed, live, measures && i == measured_);
    if (!missed || !live.session().over()) {
      ++i;
      // The sessions after this one get what has arrived meanwhile, and their clients send just before their turn
      // (client::TickPhase). The last one served is then as fresh as the first.
      if (2 * out_.size() >= kSendMax) {
        flush();
        receive();
        now = io::monotonic_now();
      }
      continue;
    }
    forget(live);
    live.finish(now, load_.machine());
    ended = true;
  }
  if (measures) measured_ = measured_ + 1 < count_ ? measured_ + 1 : 0;
  flush();
  if (ended) completions_.signal();
}

void Shard::step(Time now, std::uint32_t missed, LiveSession& live, bool measured) noexcept {
  if (measured && 2 * out_.size() > kSendMax) flush();  // so that it does not pay for sending the datagrams of others
  const Duration before = measured ? io::read_clock(CLOCK_THREAD_CPUTIME_ID) : Duration::zero();
  send(live.tick(now, time_of(tick_), missed, load_.machine()), live.session());
  if (measured) live.add_cost(io::read_clock(CLOCK_THREAD_CPUTIME_ID) - before);
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
