#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "common/base/time.h"
#include "common/trust/limiter.h"
#include "common/trust/pin.h"

namespace tandem::trust {

/// Shares out the places of connections that proved an enrolled key. A connection is joined while it speaks for somebody on a seat, for a
/// console or for a test of a link; otherwise it is bare. Bare ones are bounded per key and per source and end when they are idle; when
/// places are short they go first. Joined ones are never closed.
class ConnectionPlaces {
 public:
  using Id = std::uint64_t;

  struct Limits {
    std::size_t places = 2048;                           ///< of all connections
    std::size_t per_key = 4, per_source = 16;            ///< bare connections
    Duration idle = std::chrono::seconds(10);            ///< of a bare connection: since its last request was answered
    Duration settle = std::chrono::seconds(1);           ///< a bare connection this young is not counted per key and source: many may join at once
    /// Bare connections that joined ones leave room for, beyond `places` if need be: a resume secret is shown over one.
    [[nodiscard]] static constexpr std::size_t reserved(std::size_t places) noexcept { return places < 64 ? 1 : places / 64; }
  };
  explicit ConnectionPlaces(const Limits& limits) noexcept : limits_(limits) {}

  void enter(Id id, const Pin& key, const Source& source, Time now);
  /// From now on, until it is said again with `false`, a request of the connection is being carried out: it is not closed.
  void set_busy(Id id, bool busy, Time now);
  void set_joined(Id id, bool joined, Time now);
  void leave(Id id) { entries_.erase(id); }
  /// Whether another connection may join now. Somebody who shows a resume secret takes over the place of the connection that was lost.
  [[nodiscard]] bool may_join(bool by_resume) const noexcept { return by_resume || joined() < limits_.places; }

  enum class Cause : std::uint8_t { kIdle, kPerKey, kPerSource, kFull };
  struct Closed {
    Id id = 0;
    Cause cause = Cause::kIdle;
  };
  /// A bare connection beyond a limit: it must be closed and has left. Until there is none.
  [[nodiscard]] std::optional<Closed> close_one(Time now);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t joined() const noexcept;

 private:
  struct Entry {
    Pin key;
    Source source;
    Time entered{}, heard{};
    bool busy = false, joined = false;
  };
  using Entries = std::map<Id, Entry>;

  Limits limits_;
  Entries entries_;
};

}  // namespace tandem::trust
