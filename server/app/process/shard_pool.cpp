#include "server/app/process/shard_pool.h"

#include <algorithm>

#include "common/base/format.h"
#include "common/io/processors.h"
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

ShardPool::ShardPool(const ServerOptions& options) {
  std::vector<SessionDemand> sessions;
  for (const SessionOptions& session : options.sessions)
    sessions.push_back({session.scene.tick_hz, session.scene.seats.size()});
  const std::size_t threads = options.threads > 0 ? options.threads : io::available_processors();
  rates_ = shard_rates(sessions, std::min(threads, io::Steering::kSocketsMax), options.created_max);
  const std::vector<std::size_t> placed = first_placement(sessions, rates_);
  steering_.byte = kSlotAt;
  steering_.sockets = rates_.size();
  steering_.grows = options.service;  // it may own sessions of any rate
  for (std::size_t slot = 0; slot < placed.size(); ++slot)
    steering_.socket_of[slot] = static_cast<std::uint8_t>(placed[slot]);
}

void ShardPool::take_sockets(std::vector<io::UdpSocket> sockets) {
  socket_ = io::duplicate(sockets.front());
  for (std::size_t i = 0; i < rates_.size(); ++i)
    shards_.push_back(std::make_unique<Shard>(std::move(sockets[i]), rates_[i]));
}

std::expected<std::size_t, std::string> ShardPool::add(double tick_hz) {
  if (!steering_.grows) return std::unexpected("this server is no member of a service");
  if (shards_.size() >= io::Steering::kSocketsMax)
    return std::unexpected(format("this server has %zu threads for ticks, the most", shards_.size()));
  auto socket = io::bind_udp_beside(socket_);
  if (!socket) return std::unexpected(socket.error());
  {
    const std::lock_guard lock(adding_);
    shards_.push_back(std::make_unique<Shard>(std::move(*socket), tick_hz));
  }
  rates_.push_back(tick_hz);
  steering_.sockets = rates_.size();
  if (running_) threads_.emplace_back([shard = shards_.back().get()] { shard->run(); });
  return shards_.size() - 1;
}

io::Steering ShardPool::steering_with(std::size_t slot, std::size_t shard) const noexcept {
  io::Steering changed = steering_;
  changed.socket_of[slot] = static_cast<std::uint8_t>(shard);
  return changed;
}

bool ShardPool::assign(std::size_t slot, std::size_t shard) {
  if (shard_of_slot(slot) == shard) return true;
  const io::Steering changed = steering_with(slot, shard);
  if (!io::SteeringProgram{changed}.attach(socket_.fd.get())) return false;
  steering_ = changed;
  return true;
}

void ShardPool::run() {
  for (const auto& shard : shards_) threads_.emplace_back([shard = shard.get()] { shard->run(); });
  running_ = true;
}

void ShardPool::stop(wire::CloseReason why) noexcept {
  for (const auto& shard : shards_) shard->stop(why);
}

void ShardPool::join() {
  stop();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  running_ = false;
}

std::vector<std::optional<std::uint64_t>> ShardPool::punctual() const {
  const std::lock_guard lock(adding_);
  std::vector<std::optional<std::uint64_t>> all;
  for (const auto& shard : shards_) {
    std::optional<std::uint64_t>& in_time = all.emplace_back();
    if (shard->ended()) continue;
    in_time = 0;
    for (std::size_t i = 0; i < TickHistogram::kBounds.size() && TickHistogram::kBounds[i] <= kPunctual; ++i)
      *in_time += shard->load().lateness().count(i);
  }
  return all;
}

}  // namespace tandem::server
