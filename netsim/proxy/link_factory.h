#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "netsim/engine/addresses.h"
#include "netsim/engine/link_direction.h"
#include "netsim/engine/link_timeline.h"
#include "netsim/engine/path.h"
#include "netsim/engine/schedule.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Prepared change of the network of a running proxy, including all memory. LinkFactory::prepare_change creates it on
/// any thread; ProxyCore::change uses it once on the packet thread. Afterwards it holds the previous network, which
/// another thread frees.
struct LinkChange {
  /// New paths of one client.
  struct Client {
    std::uint64_t number = 0;  ///< by order of arrival, from 0
    std::array<std::unique_ptr<Path>, kDirections> paths = {};
  };
  std::optional<LinkSpec> for_new;  ///< link of later clients; empty: unchanged
  LinkSpec link;                    ///< requested link
  std::vector<Client> clients = {};
  std::array<std::unique_ptr<Path>, kDirections> shared = {};  ///< paths of the shared link, in place of the clients'
};

/// Resources of a future client of a proxy, used once.
struct PreparedLink {
  std::uint64_t version = 0;  ///< version of the link of new clients
  std::uint64_t number = 0;   ///< of the client by order of arrival, from 0
  Addresses addresses;
  std::array<std::optional<LinkDirection>, kDirections> directions = {};  ///< empty if clients share their link
};

/// Creates the links of a proxy's clients and changes of the network. Immutable: any thread may use it. All randomness
/// is keyed by the number of a client, so that the n-th client gets the n-th link of the virtual network.
class LinkFactory {
 public:
  /// @param spec    initial link; it determines whether all clients share one link
  /// @param events  changes by network time, for clients named "1", "2", ... in order of arrival
  LinkFactory(const LinkSpec& spec, std::uint64_t seed, std::vector<NetworkEvent> events);

  [[nodiscard]] bool shared() const noexcept { return shared_; }
  /// Creates one direction of the link that all clients share. Events that name a client do not apply to it.
  /// @throws std::invalid_argument listing all errors of the spec.
  [[nodiscard]] std::shared_ptr<LinkTimeline> shared_link(const LinkSpec& link, Direction direction) const;

  /// Allocates the resources of a future client.
  /// @param link     link of new clients in that version: the initial one, or that of the newest LinkChange::for_new
  /// @throws std::invalid_argument listing all errors of the spec.
  [[nodiscard]] PreparedLink prepare_client(const LinkSpec& link, std::uint64_t version, std::uint64_t number) const;
  /// Allocates a change of the network. Of the events only outages are inserted; the others take effect at their times.
  /// @param numbers  connected clients to change (ClientTable::number)
  /// @param all      true: also clients that arrive later or have arrived since
  /// @throws std::invalid_argument listing all errors of the spec, or if the change covers only some clients of a
  /// shared link.
  [[nodiscard]] LinkChange prepare_change(const LinkSpec& link, std::span<const std::uint64_t> numbers, bool all) const;

 private:
  bool shared_;
  std::uint64_t seed_;
  std::vector<NetworkEvent> events_;
  std::vector<NetworkEvent> outages_;  ///< outages of the events
};

}  // namespace tandem::netsim
