#include "server/app/process/shard_pool.h"

#include <algorithm>
#include <limits>

#include "common/transport/datagram.h"
#include "server/session/connection_id.h"

namespace tandem::server {
namespace {

/// Offset of a connection id's slot in a datagram: the second lowest byte of the little-endian u32 after version,
/// phase and two zeros.
constexpr std::size_t kCidAt = 4;
constexpr std::size_t kSlotAt = kCidAt + 1;
static_assert(slot_of(std::uint32_t{7} << 8 * (kSlotAt - kCidAt)) == 7);

constexpr double kPunctual = 1e-3;  // [s]

}  // namespace

ShardPool::ShardPool(std::span<const double> tick_hz) {
  steering_.byte = kSlotAt;
  for (std::size_t slot = 0; slot < tick_hz.size(); ++slot) {
    auto found = std::ranges::find(rates_, tick_hz[slot]);
    if (found == rates_.end()) found = rates_.insert(rates_.end(), tick_hz[slot]);
    steering_.socket_of[slot] = static_cast<std::uint8_t>(found - rates_.begin());
  }
  steering_.sockets = rates_.size();
  // The kernel's program is fixed once the sockets are bound, so free slots are shared out now.
  for (std::size_t slot = tick_hz.size(); !rates_.empty() && slot < Shard::kSessionsMax; ++slot)
    steering_.socket_of[slot] = static_cast<std::uint8_t>(slot % rates_.size());
}

void ShardPool::take_sockets(std::vector<io::UdpSocket> sockets) {
  for (std::size_t i = 0; i < rates_.size(); ++i)
    shards_.push_back(std::make_unique<Shard>(std::move(sockets[i]), rates_[i]));
}

void ShardPool::run() {
  for (const auto& shard : shards_) threads_.emplace_back([&shard] { shard->run(); });
}

void ShardPool::stop(wire::CloseReason why) noexcept {
  for (const auto& shard : shards_) shard->stop(why);
}

void ShardPool::join() {
  stop();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

std::uint64_t ShardPool::punctual() const noexcept {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const auto& shard : shards_) {
    std::uint64_t in_time = 0;
    for (std::size_t i = 0; i < TickHistogram::kBounds.size() && TickHistogram::kBounds[i] <= kPunctual; ++i)
      in_time += shard->load().lateness().count(i);
    fewest = std::min(fewest, in_time);
  }
  return fewest;
}

}  // namespace tandem::server
