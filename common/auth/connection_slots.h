#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "common/auth/key_fingerprint.h"
#include "common/auth/limiter.h"
#include "common/base/time.h"

namespace tandem::auth {

/// Slots of connections that proved an enrolled key. A joined connection serves a seat, a console or a link test; any
/// other connection is bare. Bare connections are limited per key and per source, and close when idle. They are closed
/// first when slots are short. Joined connections are never closed.
class ConnectionSlots {
 public:
  using Id = std::uint64_t;

  struct Limits {
    std::size_t places = 2048;                 ///< of all connections
    std::size_t per_key = 4, per_source = 16;  ///< bare connections
    Duration idle = std::chrono::seconds(10);  ///< of a bare connection: since its last request was answered
    Duration settle = std::chrono::seconds(
        1);  ///< younger bare connections do not count per key and source, because many may join at once
    /// Number of bare connections that joined ones leave space for, beyond `places` if needed: resume secrets arrive
    /// over them.
    [[nodiscard]] static constexpr std::size_t reserved(std::size_t places) noexcept {
      return places < 64 ? 1 : places / 64;
    }
  };
  explicit ConnectionSlots(const Limits& limits) noexcept : limits_(limits) {}

  void enter(Id id, const KeyFingerprint& key, const Source& source, Time now);
  /// Marks a connection as busy with a request, until the next call with `false`. Busy connections are not closed.
  void set_busy(Id id, bool busy, Time now);
  void set_joined(Id id, bool joined, Time now);
  void leave(Id id) { entries_.erase(id); }
  /// Returns whether another connection may join now. A connection with a resume secret always may, because it replaces
  /// the lost one.
  [[nodiscard]] bool may_join(bool by_resume) const noexcept { return by_resume || joined() < limits_.places; }

  enum class Cause : std::uint8_t { kIdle, kPerKey, kPerSource, kFull };
  struct Closed {
    Id id = 0;
    Cause cause = Cause::kIdle;
  };
  /// Removes and returns a bare connection beyond a limit, which the caller must close; nullopt if there is none. Call
  /// until nullopt.
  [[nodiscard]] std::optional<Closed> close_one(Time now);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t joined() const noexcept;

 private:
  struct Entry {
    KeyFingerprint key;
    Source source;
    Time entered{}, heard{};
    bool busy = false, joined = false;
  };
  using Entries = std::map<Id, Entry>;

  Limits limits_;
  Entries entries_;
};

}  // namespace tandem::auth
