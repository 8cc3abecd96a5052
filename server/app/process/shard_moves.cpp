// Sessions that pass from one shard to another between two ticks.
#include <algorithm>

#include "common/io/clock.h"
#include "server/app/process/shard.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// Rest of the period that a move needs, or half of a shorter period: the target must have the session before its next
/// tick. The kernel needs most of it for the program: 90 us (median) if the slots alternate between two sockets.
constexpr Duration kRestNeeded = 300us;
/// Ticks after which a session moves although each of them left too little of its period; it then misses one tick.
constexpr int kWaitedTicksMax = 64;

}  // namespace

void Shard::begin_move(ShardRequest& move) noexcept {
  move.result = JoinResult::kSessionOver;  // unless the target completes it
  if (moving_ != nullptr || move.target == this || stop_.load(std::memory_order_relaxed)) return;
  moving_ = &move;
  waited_ticks_ = 0;
}

/// The kernel's program changes first, then the socket is read: datagrams that came before belong to this shard's
/// socket, and the session gets them here. Those that come later wait in the socket of the target.
void Shard::pass_on() noexcept {
  ShardRequest& move = *moving_;
  LiveSession& live = *move.session;
  if (sessions_[live.slot()] != &live) return reject_move();  // it is over
  const Duration rest = time_of(next_tick()) - io::monotonic_now();
  if (rest < std::min(kRestNeeded, period_ / 2) && ++waited_ticks_ < kWaitedTicksMax) return;
  if (!move.steering->attach(socket_.fd.get())) return reject_move();
  receive();
  forget(live);
  moving_ = nullptr;
  if (move.target->take_over(move)) return;
  serve(live);
  move.steering_before->attach(socket_.fd.get());
  complete(move);
}

void Shard::reject_move() noexcept {
  ShardRequest& move = *moving_;
  moving_ = nullptr;
  move.result = JoinResult::kSessionOver;
  complete(move);
}

bool Shard::take_over(ShardRequest& move) noexcept {
  ShardRequest* none = nullptr;
  if (!arrival_.compare_exchange_strong(none, &move, std::memory_order_release, std::memory_order_relaxed))
    return false;
  wake_.signal();
  return true;
}

void Shard::serve_arrival() noexcept {
  if (arrival_.load(std::memory_order_relaxed) == nullptr) return;
  ShardRequest& move = *arrival_.exchange(nullptr, std::memory_order_acquire);
  serve(*move.session);
  move.result = JoinResult::kAccepted;
  complete(move);
}

void Shard::open_arrivals() noexcept {
  ShardRequest* closed = &closed_;
  arrival_.compare_exchange_strong(closed, nullptr, std::memory_order_relaxed);
}

bool Shard::close_arrivals() noexcept {
  ShardRequest* none = nullptr;
  if (arrival_.compare_exchange_strong(none, &closed_, std::memory_order_acq_rel)) return true;
  serve_arrival();
  return false;
}

}  // namespace tandem::server
