#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "common/auth/limiter.h"
#include "common/auth/origin.h"
#include "common/base/time.h"

namespace tandem::auth {

/// Distributes slots and TLS handshakes per second among TCP connections that have not proved an enrolled key.
///
/// A new connection has sent nothing and occupies only its socket. After its first byte it waits for a handshake.
/// Handshakes begin at `handshakes_per_s`, at most `pending` at a time. The shares are per network and, within a
/// network, per address:
/// - The next handshake belongs to the least recently served network and, in it, to the least recently served address.
/// Among its connections the one that waits longest is next.
/// - When slots are short, longest queue drop selects the connection to close. It is the oldest one of the address with
/// most slots, in the network with most slots. A network or an address within its share therefore loses nothing to
/// those beyond it. Connections silent for longer than `grace` are closed first, unless they are the only one of their
/// network: a client sends within one round trip.
/// - `reserved` slots and every second handshake are for returning addresses: those from which a seat was joined
/// recently. Whether a connection holds a valid resume secret is known only after its handshake.
///
/// Memory: at most `limits.places` entries, and the service times of `kRemembered` networks and addresses. Every call
/// costs at most one pass over them. Source: longest queue drop, B. Suter, T. V. Lakshman, D. Stiliadis, A. K.
/// Choudhury, "Buffer management schemes for supporting TCP in gigabit routers with per-flow queueing", IEEE JSAC
/// 17(6), 1999.
class PendingSlots {
 public:
  using Id = std::uint64_t;
  static constexpr std::size_t kRemembered = 1024;

  struct Limits {
    std::size_t places = 1024;                                ///< all connections; at least 1
    std::size_t pending = 256;                                ///< connections in a handshake; at least 1
    double handshakes_per_s = 300, handshakes_at_once = 300;  ///< [1/s], [1] after a pause
    Duration first_byte = std::chrono::seconds(5);
    Duration first_byte_pressed = std::chrono::seconds(1);  ///< while at least half of the slots are taken
    Duration grace = std::chrono::milliseconds(100);        ///< of silence: one round trip
    Duration deadline = std::chrono::seconds(5);            ///< from arrival to the end of the handshake
    /// Returns the part of `places` or `pending` that is reserved for returning addresses.
    [[nodiscard]] static constexpr std::size_t reserved(std::size_t of) noexcept { return of / 8; }
  };
  explicit PendingSlots(const Limits& limits) noexcept
      : limits_(limits), handshakes_(limits.handshakes_per_s, limits.handshakes_at_once) {}

  struct Placed {
    Id id = 0;
    std::optional<Id> evicted;  ///< the caller must close it; it is already removed here
  };
  /// Adds a connection. @param returning  whether a seat was joined from this address recently
  [[nodiscard]] Placed arrive(const Origin& origin, bool returning, Time now);
  /// Records the first byte of a connection, which then waits for a handshake. Further calls change nothing.
  void first_byte(Id id) noexcept;
  /// Returns the connection whose handshake begins now, if one waits and the rate permits. `evicted` is the connection
  /// whose handshake the caller must abort for it.
  [[nodiscard]] std::optional<Placed> next_handshake(Time now);
  /// Removes a connection that was closed or proved an enrolled key. Unknown ids change nothing.
  void leave(Id id);
  /// Removes and returns a connection beyond its deadline, which the caller must close; nullopt if there is none. Call
  /// until nullopt.
  [[nodiscard]] std::optional<Id> expire(Time now);
  /// Returns when to call `expire` and `next_handshake` again if no other event comes first; nullopt: not needed.
  [[nodiscard]] std::optional<Time> next_event(Time now);
  /// Removes and returns the connection that `arrive` would close for a new one. For a caller without free descriptors.
  [[nodiscard]] std::optional<Id> evict(Time now);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t in_handshake() const noexcept { return in_handshake_; }
  [[nodiscard]] bool under_pressure() const noexcept { return 2 * entries_.size() >= limits_.places; }

 private:
  enum class Stage : std::uint8_t { kSilent, kWaiting, kHandshake };
  struct Group {
    std::size_t members = 0;   ///< in the current pass
    std::size_t silent = 0;    ///< of them: silent for longer than the grace
    std::size_t held = 0;      ///< slots in any stage; the group is erased with the last one
    std::uint64_t served = 0;  ///< serial number of its last handshake; 0: none, or dropped
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
  /// The last handshakes of networks or addresses, including those that hold no slot now.
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
  [[nodiscard]] bool silent_too_long(const Entry& entry, Time now) const noexcept {
    return entry.stage == Stage::kSilent && now - entry.arrived >= limits_.grace;
  }
  /// Closes one of the connections for which `compete` holds, but not the new one, which counts for its network and
  /// address.
  /// @return nullopt: there is none
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
  bool returning_served_last_ = false;
};

}  // namespace tandem::auth
