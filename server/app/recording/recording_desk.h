#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/lesson.h"
#include "server/app/control/session_note.h"

namespace tandem::server {

/// Contributions of other threads to the recording of a session: participants, events, marks and sheets. It also has
/// the state of the recording for participants. It exists for the whole session; a recording may start and end. Its
/// queue is bounded. Thread-safe; no member waits for a disk.
class RecordingDesk {
 public:
  static constexpr std::size_t kItemsMax = 4096;  ///< events, marks and sheets that wait; further ones are counted
  static constexpr std::size_t kOrdersMax = 256;  ///< orders whose persons are known; events come within a second
  static constexpr std::size_t kNamesMax = 1000;  ///< pseudonyms; further participants are P?

  /// @param pseudonyms  participants are P1, P2 ... in the order in which they come
  RecordingDesk(std::size_t seats, bool pseudonyms) : persons_(seats), workstations_(seats), pseudonyms_(pseudonyms) {}

  // ---- Any thread without real-time duties ----
  /// The state of the recording; nullopt: none runs.
  [[nodiscard]] std::optional<rpc::StatusRecording> status() const;
  /// A participant has this seat from now on.
  /// @param person       name in the participant's ticket; empty: none, and the name is that of the workstation
  /// @param workstation  name of the participant's workstation
  void set_person(std::size_t seat, const std::string& person, const std::string& workstation = {});
  /// A person gives an order, whose events may come before or after its outcome.
  /// @return its number, from 1, for `add_event`
  [[nodiscard]] std::uint32_t add_order(const std::string& person);
  /// Adds an event of the audit log.
  /// @param order  number of the order that it follows from, which names its person; 0: none
  void add_event(LessonEvent event, std::uint32_t order = 0);
  /// Adds a mark or a sheet. Its JSON has been checked to be an object.
  void add_note(const SessionNote& note);

  /// A recording begins, and any earlier one may change nothing here from now on: it may still be ending.
  /// @return its number, from 1, for `set_status` and `take`
  [[nodiscard]] std::uint32_t begin(rpc::StatusRecording status);

  // ---- The recording's thread ----
  /// Events, marks and sheets that came since the last call.
  struct Items {
    std::vector<LessonEvent> events;
    std::vector<LessonMark> marks;
    std::vector<LessonSheet> sheets;
    std::uint64_t lost = 0;  ///< items that did not fit, so far
  };
  /// @return none for an earlier recording than the newest
  [[nodiscard]] Items take(std::uint32_t recording);
  /// Participants by seat, as the file names them; empty: none yet.
  [[nodiscard]] std::vector<std::string> persons() const;
  /// Seats whose name is that of a workstation, by seat.
  [[nodiscard]] std::vector<bool> workstations() const;
  /// Sets the state, unless a later recording has begun; nullopt: the recording is over.
  void set_status(std::uint32_t recording, std::optional<rpc::StatusRecording> status);

 private:
  /// Name for the file. @pre the lock is held
  [[nodiscard]] std::string named(const std::string& person);
  [[nodiscard]] bool room();

  mutable std::mutex lock_;
  std::vector<std::string> persons_;
  std::vector<bool> workstations_;
  bool pseudonyms_;
  std::map<std::string, std::string> names_;                              ///< pseudonym of each participant
  std::array<std::pair<std::uint32_t, std::string>, kOrdersMax> orders_;  ///< number and person, by number
  std::uint32_t order_ = 0;                                               ///< number of the last one
  std::uint32_t recording_ = 0;                                           ///< number of the newest recording
  Items items_;
  std::optional<rpc::StatusRecording> status_;
};

}  // namespace tandem::server
