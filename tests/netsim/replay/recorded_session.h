#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/base/rng.h"
#include "netsim/replay/journal_reader.h"
#include "netsim/replay/record_values.h"
#include "netsim/replay/session_replay.h"
#include "server/session/session.h"

namespace tandem::netsim::test {

using Piece = std::vector<std::byte>;

/// Key that hides addresses in tests.
inline constexpr transport::HashKey kAddressKey{std::byte{7}};

/// A recorder of a session: it keeps the journal in pieces, and a hash of the record of each tick.
class RecordedSession {
 public:
  explicit RecordedSession(std::size_t capacity = server::InputJournal::kCapacity) : journal(kAddressKey, capacity) {}

  /// Call it after every tick.
  void take(const server::Session& session) {
    drain();
    if (session.clock().ticked()) ticks_[session.clock().last_tick()] = hash_of(session);
  }
  void drain() {
    std::array<std::byte, 4096> buffer;
    while (const std::size_t size = journal.drain(buffer))
      pieces.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  }

  struct Outcome {
    std::optional<ReplayDifference> difference;
    std::string error;
    SessionReplay::Counts counts;
    std::uint64_t compared = 0;  ///< records of ticks
    std::size_t rest = 0;        ///< bytes behind the last whole record
    [[nodiscard]] std::string words() const {
      return !difference ? error
                         : error + "tick " + std::to_string(difference->tick) + ", " + difference->channel +
                               ": recorded " + difference->recorded + ", replayed " + difference->replayed;
    }
  };
  /// Replays the pieces and compares outputs and records.
  /// @param change  may change an event before it is replayed
  template <class Change>
  Outcome replay(const SceneSpec& scene, Change&& change) const {
    Outcome out;
    SessionReplay replay{scene};
    replay.compare = [&](const server::Session& session) -> std::optional<ReplayDifference> {
      const auto recorded = ticks_.find(session.clock().last_tick());
      if (recorded == ticks_.end()) return std::nullopt;  // the test took no record of it
      ++out.compared;
      if (recorded->second == hash_of(session)) return std::nullopt;
      return ReplayDifference{.channel = "record", .recorded = "another", .replayed = "record"};
    };
    JournalReader reader;
    const auto feed = [&] {
      while (auto event = reader.next()) {
        change(*event);
        if (!replay.apply(*event)) return false;
      }
      return reader.error().empty();
    };
    bool more = true;
    for (auto piece = pieces.begin(); more && piece != pieces.end(); ++piece) more = reader.add(*piece) && feed();
    out.difference = replay.difference();
    out.error = replay.error() + reader.error();
    out.counts = replay.counts();
    out.rest = reader.rest();
    return out;
  }
  [[nodiscard]] Outcome replay(const SceneSpec& scene) const {
    return replay(scene, [](JournalEvent&) {});
  }
  /// All bytes of the journal.
  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> all;
    for (const Piece& piece : pieces)
      all.insert(all.end(), piece.begin() + server::InputJournal::kPieceHeader, piece.end());
    return all;
  }
  [[nodiscard]] std::size_t ticks() const { return ticks_.size(); }

  server::InputJournal journal;
  std::vector<Piece> pieces;

 private:
  /// Hash of the record that the last tick made, and of whether it made one.
  std::uint64_t hash_of(const server::Session& session) const {
    if (!session.recorded()) return 0;
    std::vector<double> values;
    RecordValues::read(session.scene(), session.record(), values);
    std::uint64_t hash = 1;
    for (const double value : values) hash = mix64(hash ^ std::bit_cast<std::uint64_t>(value));
    return hash;
  }

  struct HashTime {
    std::size_t operator()(Time t) const noexcept {
      return static_cast<std::size_t>(mix64(static_cast<std::uint64_t>(t.time_since_epoch().count())));
    }
  };
  std::unordered_map<Time, std::uint64_t, HashTime> ticks_;
};

}  // namespace tandem::netsim::test
