#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "netsim/replay/journal_events.h"
#include "netsim/replay/replay_keys.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// First place where a replay and its recording differ.
struct ReplayDifference {
  std::uint64_t tick = 0;          ///< number of the tick in the journal, from 0
  std::uint32_t session_tick = 0;  ///< of the session's clock
  std::string channel;             ///< such as `/trainer/measured_cp`, or `/trainer/outputs` for what it was sent
  std::string recorded, replayed;  ///< values in words
};

/// Feeds an input journal into the server's session core, and compares what the session sends with the hashes of the
/// journal. Local slaves are made and stepped as in the recording server. Pure: the same events give the same session.
class SessionReplay {
 public:
  /// @param scene  of the recording; must outlive this. Another scene replays too, and differs.
  explicit SessionReplay(const SceneSpec& scene) : scene_(&scene) {}

  /// Applies the next event. @return false once the replay ended: by a difference or an error
  bool apply(const JournalEvent& event);
  /// Called after each tick, before the outputs are compared; a returned difference ends the replay. `tick` and
  /// `session_tick` are filled here. May be empty.
  std::function<std::optional<ReplayDifference>(const server::Session& session)> compare = {};

  /// Session of the last JournalBegin; null before the first.
  [[nodiscard]] const server::Session* session() const noexcept { return session_.get(); }
  [[nodiscard]] const std::optional<ReplayDifference>& difference() const noexcept { return difference_; }
  /// Why the journal cannot be replayed (further); empty: it can.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Build texts of recorders other than this program's (server::build_text).
  [[nodiscard]] const std::vector<std::string>& other_builds() const noexcept { return other_builds_; }
  /// SHA-256 of the recorded scene is that of the replayed one, or the one given to `expect_scene`.
  [[nodiscard]] bool same_scene() const noexcept { return same_scene_; }
  /// Sets the hash of the recorded scene. A file's scene may have another text, without phases behind the session's
  /// end. Call it before the first event.
  void expect_scene(const server::Checkpoint::Hash& hash) noexcept { expected_scene_ = hash; }
  struct Counts {
    std::uint64_t sessions = 0, ticks = 0, datagrams = 0, outputs = 0;  ///< outputs: hashes that were compared
  };
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }

 private:
  struct Seat {
    std::optional<ReplayKeys> keys;
    std::uint16_t output = 0;  ///< newest hash of the recording
  };

  void apply_event(const JournalBegin& begin);
  void apply_event(const JournalAdmit& admit);
  void apply_event(const JournalDatagram& datagram);
  void apply_event(const JournalCommand& command);
  void apply_event(const JournalRemove& remove);
  void apply_event(const JournalEnd& end);
  void apply_event(const JournalContacts& contacts);
  void apply_event(const JournalTick& tick);
  void apply_event(const JournalOverflow& overflow);
  void compare_outputs(const JournalTick& tick);
  void differ(ReplayDifference difference);
  [[nodiscard]] std::string seat_name(std::size_t seat) const;

  const SceneSpec* scene_;
  std::unique_ptr<server::Session> session_;
  server::InputJournal digests_{{}, 0};  ///< of the replayed session: only its digests of outputs are read
  std::array<Seat, kSeatsMax> seats_{};
  std::optional<ReplayDifference> difference_;
  std::string error_;
  std::vector<std::string> other_builds_;
  bool same_scene_ = true;
  std::optional<server::Checkpoint::Hash> expected_scene_;
  Counts counts_;
  std::array<std::byte, transport::kDatagramMax> buffer_{};
};

}  // namespace tandem::netsim
