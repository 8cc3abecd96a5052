#pragma once

#include <cstdint>
#include <string>

#include "server/app/control/session_note.h"

namespace tandem::server {

/// Marks and sheets of the sessions, one append-only file of JSON lines per session: NAME-ID.notes.jsonl, with the
/// first 8 digits of the id. For its owner only.
class NoteLog {
 public:
  static constexpr std::uint64_t kFileMax = 64U << 20U;  ///< [bytes] of one file; further notes are rejected

  /// @param folder  existing folder; empty: nothing is stored
  explicit NoteLog(std::string folder) : folder_(std::move(folder)) {}
  /// Appends a note as one line. @return why it could not be stored; empty: it is stored, or there is no folder
  [[nodiscard]] std::string append(const SessionNote& note, std::int64_t wall_s) const;

 private:
  std::string folder_;
};

}  // namespace tandem::server
