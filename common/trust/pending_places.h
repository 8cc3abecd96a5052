#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "common/base/time.h"
#include "common/trust/limiter.h"
#include "common/trust/origin.h"

namespace tandem::trust {

/// Shares out what a server gives to TCP connections that have not proved an enrolled key: places, and TLS handshakes per second.
///
/// A connection arrives silent, and holds no more than its socket. After its first byte it waits for a handshake; handshakes begin at
/// `handshakes_per_s`, at most `pending` at a time. The shares are per network and, within a network, per address:
/// - The next handshake goes to the network that was served least recently, in it to the address that was served least recently, of that
///   address to the connection that waits longest.
/// - When places are short, the connection to close is found by longest queue drop: the oldest connection of the address that holds most
///   places, in the network that holds most. A network or an address within its share therefore loses nothing to those beyond it.
///   Connections that stay silent for longer than `grace` go before all others, unless theirs is the only one of its network: a client
///   speaks within one round trip.
/// - `reserved` places, and every second handshake, are for returning addresses: those from which somebody on a seat came recently.
///   Whether a connection holds a valid resume secret is known only after its handshake.
///
/// Memory: at most `limits.places` entries and the service times of `kRemembered` networks and addresses. Every call costs at most one
/// pass over them. Source: longest queue drop, B. Suter, T. V. Lakshman, D. Stiliadis, A. K. Choudhury, "Buffer management schemes for
/// supporting TCP in gigabit routers with per-flow queueing", IEEE JSAC 17(6), 1999.
class PendingPlaces {
 public:
  using Id = std::uint64_t;
  static constexpr std::size_t kRemembered = 1024;

  struct Limits {
    std::size_t places = 1024;        ///< connections in all; at least 1
    std::size_t pending = 256;        ///< of them in a handshake; at least 1
    double handshakes_per_s = 300, handshakes_at_once = 300;  ///< [1/s], [1] after a rest
    Duration first_byte = std::chrono::seconds(5);
    Duration first_byte_pressed = std::chrono::seconds(1);  ///< while at least half of the places are taken
    Duration grace = std::chrono::milliseconds(100);        ///< of silence: one round trip
    Duration deadline = std::chrono::seconds(5);            ///< from arrival to the end of the handshake
    /// Of `places` or `pending`, for returning addresses.
    [[nodiscard]] static constexpr std::size_t reserved(std::size_t of) noexcept { return of / 8; }
  };
  explicit PendingPlaces(const Limits& limits) noexcept : limits_(limits), handshakes_(limits.handshakes_per_s, limits.handshakes_at_once) {}

  struct Placed {
    Id id = 0;
    std::optional<Id> evicted;  ///< must be closed; it has left already
  };
  /// @param returning  whether somebody on a seat came from there recently
  [[nodiscard]] Placed arrive(const Origin& origin, bool returning, Time now);
  /// The connection sent something: it waits for a handshake. Further calls change nothing.
  void first_byte(Id id) noexcept;
  /// The connection whose handshake begins now, if one waits and the rate permits; `evicted` is one whose handshake must be broken off for it.
  [[nodiscard]] std::optional<Placed> next_handshake(Time now);
  /// The connection is closed, or proved an enrolled key. Unknown ids change nothing.
  void leave(Id id);
  /// A connection that is beyond its time and has left: it must be closed. Until there is none.
  [[nodiscard]] std::optional<Id> expire(Time now);
  /// When to call `expire` and `next_handshake` again, if nothing else happens before. Nothing: not needed.
  [[nodiscard]] std::optional<Time> next_event(Time now);
  /// The connection that `arrive` would close for a newcomer; it has left. For a caller that has no descriptors left.
  [[nodiscard]] std::optional<Id> evict(Time now);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t in_handshake() const noexcept { return in_handshake_; }
  [[nodiscard]] bool pressed() const noexcept { return 2 * entries_.size() >= limits_.places; }

 private:
  enum class Stage : std::uint8_t { kSilent, kWaiting, kHandshake };
  struct Group {
    std::size_t members = 0;  ///< of the pass that is under way
    std::size_t silent = 0;   ///< of them: silent for longer than the grace
    std::size_t held = 0;     ///< places, of any stage: the group goes with the last
    std::uint64_t served = 0; ///< when it was given its last handshake, as a serial number; 0: never, or forgotten
  };
  using Networks = std::map<Origin::Network, Group>;
  using Addresses = std::map<Origin, Group>;
  struct Entry {
    Time arrived{};
    Stage stage = Stage::kSilent;
    bool returning = false;
    Networks::iterator network;
    Addresses::iterator address;
  };
  using Entries = std::map<Id, Entry>;  ///< in the order of arrival
  /// The last handshakes of networks or addresses, also of those that hold no place now.
  template <class Key>
  class Served {
   public:
    [[nodiscard]] std::uint64_t at(const Key& key) const {
      const auto found = serials_.find(key);
      return found == serials_.end() ? 0 : found->second;
    }
    void serve(const Key& key, std::uint64_t serial);

   private:
    std::map<Key, std::uint64_t> serials_;
  };

  [[nodiscard]] Time due(const Entry& entry) const noexcept;
  [[nodiscard]] bool silent_too_long(const Entry& entry, Time now) const noexcept { return entry.stage == Stage::kSilent && now - entry.arrived >= limits_.grace; }
  /// Closes one of the connections that `compete`, but not `newcomer`, which is counted with its network and address. @return nothing: there is none
  template <class Compete>
  [[nodiscard]] std::optional<Id> close_one(Time now, Id newcomer, const Compete& compete);
  [[nodiscard]] Entries::iterator next_to_serve(bool returning_only);
  void erase(Entries::iterator entry);

  Limits limits_;
  TokenBucket handshakes_;
  Entries entries_;
  std::set<Id> silent_;  ///< of the entries
  Networks networks_;
  Addresses addresses_;
  Served<Origin::Network> networks_served_;
  Served<Origin> addresses_served_;
  Id last_id_ = 0;
  std::uint64_t serial_ = 0;
  std::size_t in_handshake_ = 0, returning_ = 0, returning_in_handshake_ = 0, waiting_ = 0;
  bool returning_had_the_last_ = false;
};

}  // namespace tandem::trust
