#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "netsim/engine/addresses.h"
#include "netsim/engine/link_direction.h"

namespace tandem::netsim {

/// Places of the clients of a proxy. A place is reused when its client leaves. Its generation then distinguishes
/// datagrams of the client that left from those of its successor. The constructor allocates all memory.
class ClientTable {
 public:
  static constexpr std::size_t kMax = 64;

  struct Client {
    std::array<std::optional<LinkDirection>, kDirections> directions;  ///< both or none
    std::uint64_t number = 0;                                          ///< by order of arrival
    Addresses addresses;
    std::uint32_t generation = 0;
  };

  ClientTable() : clients_(kMax) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }    ///< number of connected clients
  [[nodiscard]] std::uint64_t seen() const noexcept { return seen_; }  ///< number of clients so far
  [[nodiscard]] bool present(std::uint32_t place) const noexcept {
    return place < kMax && clients_[place].directions[0].has_value();
  }
  /// Returns the client in a place [0, kMax).
  [[nodiscard]] Client& operator[](std::uint32_t place) noexcept { return clients_[place]; }
  [[nodiscard]] const Client& operator[](std::uint32_t place) const noexcept { return clients_[place]; }
  /// Returns the number of a connected client, by order of arrival from 0.
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint32_t place) const noexcept {
    return present(place) ? std::optional{clients_[place].number} : std::nullopt;
  }
  /// Returns one direction of a client's link; null without a client.
  [[nodiscard]] LinkDirection* link(std::uint32_t place, Direction direction) noexcept TANDEM_REALTIME {
    return present(place) ? &*clients_[place].directions[static_cast<std::size_t>(direction)] : nullptr;
  }
  [[nodiscard]] const LinkDirection* link(std::uint32_t place, Direction direction) const noexcept TANDEM_REALTIME {
    return present(place) ? &*clients_[place].directions[static_cast<std::size_t>(direction)] : nullptr;
  }
  /// Returns whether an address of a connected client is dead at `now`.
  [[nodiscard]] bool dead(Time now, std::uint32_t place, std::uint32_t address) const noexcept TANDEM_REALTIME {
    return present(place) && clients_[place].addresses.dead(address, now);
  }

  /// Takes a free place for the next client, whose directions the caller then sets.
  /// @return its place; empty if all places are taken
  std::optional<std::uint32_t> add() noexcept;
  /// Frees the place of a connected client. Datagrams with its path indices belong to no client afterwards.
  void remove(std::uint32_t place) noexcept;

  /// Place and direction of a datagram.
  struct Flow {
    std::uint32_t place = 0;
    Direction direction = Direction::kUp;
  };
  /// Returns the number of a direction of a client's link in a queue of datagrams.
  [[nodiscard]] std::uint32_t path_index(std::uint32_t place, Direction direction) const noexcept TANDEM_REALTIME;
  /// Returns the flow of a path index; empty if its client left.
  [[nodiscard]] std::optional<Flow> find(std::uint32_t path_index) const noexcept TANDEM_REALTIME;

  /// Calls `each(link)` for both directions of every connected client.
  template <typename Each>
  void for_each(const Each& each) noexcept {
    for (Client& client : clients_)
      for (auto& link : client.directions)
        if (link) each(*link);
  }
  template <typename Each>
  void for_each(const Each& each) const noexcept {
    for (const Client& client : clients_)
      for (const auto& link : client.directions)
        if (link) each(*link);
  }

 private:
  std::vector<Client> clients_;
  std::size_t size_ = 0;
  std::uint64_t seen_ = 0;
};

}  // namespace tandem::netsim
