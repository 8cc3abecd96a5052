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

constexpr int kPriority = 70;  // above the device threads, because a late server delays all participants
constexpr Duration kLateTick = 1ms;
/// Divisor of the lateness without real-time priority, when a busy machine is often 5 ms late. Hands are then released
/// after three ticks in a row that are 20 ms late, which is when their own gates release too.
constexpr int kLateUnpromised = 4;
constexpr Duration kReadingMax = 200us;  // limit of receiving per tick, so that a flood cannot delay the tick
constexpr std::size_t kRequestsMax = 256;
constexpr std::uint64_t kLoadTicks = 1000;

}  // namespace

Shard::Shard(io::UdpSocket socket, double tick_hz)
    : socket_(std::move(socket)),
      period_(from_seconds(1.0 / tick_hz)),
      requests_(kRequestsMax),
      completed_(2 * kRequestsMax),
      load_shedder_(period_) {}

bool Shard::add_session(LiveSession& session) noexcept {
  LiveSession*& place = sessions_[session.slot()];
  if (place != nullptr) return false;
  place = &session;
  return true;
}

void Shard::stop(wire::CloseReason why) noexcept {
  stop_reason_.store(why, std::memory_order_relaxed);
  stop_.store(true, std::memory_order_release);
  wake_.signal();
}

bool Shard::post(ShardRequest& order) noexcept {
  if (!requests_.push(&order)) return false;
  wake_.signal();
  return true;
}

ShardRequest* Shard::next_completed() noexcept {
  ShardRequest* const* const next = completed_.front();
  if (next == nullptr) return nullptr;
  ShardRequest* const order = *next;
  completed_.pop();
  return order;
}

void Shard::clear_completions() noexcept { completions_.clear(); }

void Shard::run() noexcept {
  machine_.realtime = io::request_realtime(kPriority);
  Time due = io::monotonic_now() + period_;
  const auto hosting = [&] {
    return std::ranges::any_of(sessions_, [](const LiveSession* s) { return s != nullptr; });
  };
  while (true) {
    wait_until(due);
    execute_requests(io::monotonic_now());
    if (stop_.load(std::memory_order_acquire)) {
      if (!hosting()) break;
      for (LiveSession* s : sessions_)
        if (s != nullptr) s->session().end(stop_reason_.load(std::memory_order_relaxed));
    }
    Time now = io::monotonic_now();
    if (now < due) continue;
    receive();
    now = io::monotonic_now();
    const Duration late = now - due;
    const auto missed = static_cast<std::uint32_t>(late / period_);
    lateness_.add(std::max(late, Duration::zero()));
    if (hosting()) {
      if (late > kLateTick) late_ticks_.fetch_add(1, std::memory_order_relaxed);
      machine_.late_ticks += late > kLateTick ? 1 : 0;
      machine_.missed_ticks += missed;
    }
    update_load_state(now, late);
    const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    tick(now, missed);
    const Duration used = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    used_ = used - before;
    measure_tick(used_);
    measure_core(now, used);
    last_tick_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
    due += (missed + 1) * period_;
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
  std::uint64_t strays = 0;
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
        ++strays;
      }
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) {
      read_until_ = now;
      break;
    }
  }
  if (strays > 0) unmatched_datagrams_.fetch_add(strays, std::memory_order_relaxed);
}

void Shard::execute_requests(Time now) noexcept {
  bool any = false;
  for (ShardRequest* const* next = requests_.front(); next != nullptr; next = requests_.front()) {
    ShardRequest* const order = *next;
    requests_.pop();
    execute_requests(now, *order);
    any = completed_.push(order) || any;
  }
  if (any) completions_.signal();
}

void Shard::execute_requests(Time now, ShardRequest& order) noexcept {
  LiveSession* const hosted = order.session;
  LiveSession*& place = sessions_[hosted->slot()];
  const bool stopping = stop_.load(std::memory_order_relaxed);
  if (order.what == ShardRequest::What::kAddSession) {
    order.result = stopping || place != nullptr ? JoinResult::kSessionOver : JoinResult::kAccepted;
    if (order.result == JoinResult::kAccepted) place = hosted;
    return;
  }
  order.result = JoinResult::kSessionOver;
  if (place != hosted) return;
  switch (order.what) {
    case ShardRequest::What::kQuerySeat:
      order.result = hosted->session().participants().may_admit(now, order.seat, order.same_owner);
      if (order.result == JoinResult::kAccepted) {
        const SeatEndpoint& seat = hosted->session().seat(order.seat);
        order.silence = seat.taken() ? seat.silence(now) : Duration::zero();
        order.ever_heard = seat.ever_heard();
      }
      break;
    case ShardRequest::What::kAdmit:
      order.result = hosted->session().admit(now, order.seat, order.connection, order.same_owner);
      break;
    case ShardRequest::What::kAdmitLinkTest:
      order.result = hosted->session().admit_link_test_peer(now, order.connection.link, &order.place);
      break;
    case ShardRequest::What::kCommand:
      order.outcome = tandem::server::execute_command(hosted->session(), now, order.command);
      order.result = JoinResult::kAccepted;
      break;
    case ShardRequest::What::kRevokeSeat:
      order.outcome.result = remove_client(hosted->session(), order.seat, order.cid, wire::CloseReason::kRevoked);
      order.outcome.tick = hosted->session().clock().session_tick();
      order.result = JoinResult::kAccepted;
      break;
    case ShardRequest::What::kQueryLinkTest:
      order.place = hosted->session().link_test_peers().places_free(now);
      order.result = JoinResult::kAccepted;
      break;
    case ShardRequest::What::kRemoveLinkTest:
      static_cast<void>(
          hosted->session().link_test_peers().remove(order.place, order.cid, wire::CloseReason::kRevoked));
      break;
    case ShardRequest::What::kEndSession:
      hosted->session().end(wire::CloseReason::kServerStops);
      order.result = JoinResult::kAccepted;
      break;
    case ShardRequest::What::kAddSession:
      break;
  }
}

void Shard::tick(Time now, std::uint32_t missed) noexcept {
  bool ended = false;
  for (LiveSession*& hosted : sessions_) {
    if (hosted == nullptr) continue;
    hosted->tick(now, missed, machine_);
    send(now, hosted->session());
    if (!hosted->session().over()) continue;
    hosted->finish(now, machine_);
    hosted = nullptr;
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

void Shard::update_load_state(Time now, Duration late) noexcept {
  machine_.load_state = load_shedder_.step(now, machine_.realtime ? late : late / kLateUnpromised, used_);
  shed_level_.store(machine_.load_state.level, std::memory_order_relaxed);
  overloaded_.store(machine_.load_state.overloaded, std::memory_order_relaxed);
}

void Shard::measure_tick(Duration spent) noexcept {
  spent_.add(spent.count());
  lengths_.add(spent);
  if (spent_.count() < kLoadTicks) return;
  load_.store(static_cast<double>(spent_.quantile(0.99)) / static_cast<double>(period_.count()),
              std::memory_order_relaxed);
  spent_ = Histogram{};
}

void Shard::measure_core(Time now, Duration used) noexcept {
  if (core_since_ != Time{} && now - core_since_ < 1s) return;
  if (core_since_ != Time{})
    cpu_share_.store(seconds(used - core_used_) / seconds(now - core_since_), std::memory_order_relaxed);
  core_since_ = now;
  core_used_ = used;
}

}  // namespace tandem::server
