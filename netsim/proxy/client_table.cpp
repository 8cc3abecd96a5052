#include "netsim/proxy/client_table.h"

namespace tandem::netsim {
namespace {

// Layout of a path index: generation of the place, place, direction.
constexpr std::uint32_t kDirectionBits = 1;
constexpr std::uint32_t kPlaceBits = 6;
static_assert(ClientTable::kMax == std::size_t{1} << kPlaceBits);

}  // namespace

std::optional<std::uint32_t> ClientTable::add() noexcept {
  for (std::uint32_t place = 0; place < kMax; ++place) {
    if (present(place)) continue;
    clients_[place].number = seen_++;
    ++size_;
    return place;
  }
  return std::nullopt;
}

void ClientTable::remove(std::uint32_t place) noexcept {
  for (auto& link : clients_[place].directions) link.reset();
  ++clients_[place].generation;
  --size_;
}

std::uint32_t ClientTable::path_index(std::uint32_t place, Direction direction) const noexcept {
  return (clients_[place].generation << (kPlaceBits + kDirectionBits)) | (place << kDirectionBits) |
         static_cast<std::uint32_t>(direction);
}

std::optional<ClientTable::Flow> ClientTable::find(std::uint32_t index) const noexcept {
  const Flow flow{(index >> kDirectionBits) & std::uint32_t{kMax - 1}, static_cast<Direction>(index & 1U)};
  return present(flow.place) && index == path_index(flow.place, flow.direction) ? std::optional{flow} : std::nullopt;
}

}  // namespace tandem::netsim
