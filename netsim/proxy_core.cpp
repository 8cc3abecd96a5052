#include "netsim/proxy_core.h"

#include "netsim/link_watch.h"

namespace tandem::netsim {
namespace {

// The name of a lane in the queue: generation of the place, place, direction.
constexpr std::uint32_t kDirectionBits = 1;
constexpr std::uint32_t kPlaceBits = 6;
static_assert(ProxyCore::kClientsMax == std::size_t{1} << kPlaceBits);

void add(PathCounters& to, const PathCounters& from) noexcept {
  to.in += from.in;
  to.copies += from.copies;
  to.out += from.out;
  for (std::size_t i = 0; i < kOutcomes; ++i) to.by_outcome[i] += from.by_outcome[i];
  to.bytes_in += from.bytes_in;
  to.bytes_out += from.bytes_out;
  to.delay_sum_ns += from.delay_sum_ns;
}

}  // namespace

ProxyCore::ProxyCore(const LinkSpec& spec, std::uint64_t seed)
    : spec_(spec), seed_(seed), queue_(kSlots, kClientsMax * kDirections), places_(kClientsMax) {
  // A spec that cannot be simulated is refused here, not when the first client comes.
  static_cast<void>(Path(spec.up, RandomKey{seed}));
  static_cast<void>(Path(spec.down, RandomKey{seed}));
}

std::optional<std::uint32_t> ProxyCore::add_client() {
  for (std::uint32_t number = 0; number < kClientsMax; ++number) {
    Client& place = places_[number];
    if (place.lanes[0]) continue;
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      place.lanes[static_cast<std::size_t>(direction)].emplace(
          spec_[direction], Path::key_for(seed_, clients_seen_, direction), Path::key_for(seed_, clients_seen_));
    }
    ++clients_;
    ++clients_seen_;
    return number;
  }
  return std::nullopt;
}

void ProxyCore::remove_client(std::uint32_t client) noexcept {
  if (client >= kClientsMax || !places_[client].lanes[0]) return;
  Client& place = places_[client];
  for (std::size_t direction = 0; direction < kDirections; ++direction) {
    PathCounters& counters = place.lanes[direction]->counters;
    counters.by_outcome[static_cast<std::size_t>(Outcome::kOverflow)] += counters.in_flight();
    add(left_[direction], counters);
    place.lanes[direction].reset();
  }
  place.watch = nullptr;
  ++place.generation;
  --clients_;
}

Outcome ProxyCore::ingress(Time now, std::uint32_t client, Direction direction,
                           std::span<const std::byte> bytes) noexcept {
  if (client >= kClientsMax) return Outcome::kOverflow;
  auto& lane = places_[client].lanes[static_cast<std::size_t>(direction)];
  if (!lane) return Outcome::kOverflow;
  if (lane->counters.in_flight() >= kPerLaneMax) {  // one client that floods must not take the room of the others
    ++lane->counters.in;
    lane->counters.bytes_in += bytes.size();
    ++lane->counters.by_outcome[static_cast<std::size_t>(Outcome::kOverflow)];
    if (LinkWatch* const watch = places_[client].watch) watch->decided(direction, now, lane->path.count(), true);
    return Outcome::kOverflow;
  }
  const Outcome outcome = submit(lane->path, queue_, lane->counters, now, lane_name(client, direction), bytes);
  if (LinkWatch* const watch = places_[client].watch) {
    watch->decided(direction, now, lane->path.count() - 1, dropped(outcome));
  }
  return outcome;
}

std::optional<ProxyCore::Egress> ProxyCore::take(Time now) noexcept {
  while (const auto item = queue_.take(now)) {
    const auto direction = static_cast<Direction>(item->lane & 1U);
    const std::uint32_t client = (item->lane >> kDirectionBits) & (kClientsMax - 1);
    auto& lane = places_[client].lanes[static_cast<std::size_t>(direction)];
    if (!lane || item->lane != lane_name(client, direction)) {  // for a client that left: counted when it did
      queue_.recycle(item->slot);
      continue;
    }
    const auto bytes = queue_.bytes(*item);
    lane->counters.left(*item, bytes.size());
    if (LinkWatch* const watch = places_[client].watch) watch->arrived(direction, item->sent, item->at, item->index);
    return Egress{client, direction, bytes, *item};
  }
  return std::nullopt;
}

const PathCounters& ProxyCore::counters(std::uint32_t client, Direction direction) const noexcept {
  static constexpr PathCounters kNothing;
  if (client >= kClientsMax) return kNothing;
  const auto& lane = places_[client].lanes[static_cast<std::size_t>(direction)];
  return lane ? lane->counters : kNothing;
}

PathCounters ProxyCore::total(Direction direction) const noexcept {
  PathCounters sum = left_[static_cast<std::size_t>(direction)];
  for (const Client& place : places_) {
    if (const auto& lane = place.lanes[static_cast<std::size_t>(direction)]) add(sum, lane->counters);
  }
  return sum;
}

void ProxyCore::watch(std::uint32_t client, LinkWatch* watch) noexcept {
  if (client < kClientsMax && places_[client].lanes[0]) places_[client].watch = watch;
}

std::uint32_t ProxyCore::lane_name(std::uint32_t client, Direction direction) const noexcept {
  return (places_[client].generation << (kPlaceBits + kDirectionBits)) | (client << kDirectionBits) |
         static_cast<std::uint32_t>(direction);
}

}  // namespace tandem::netsim
