#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/rpc/rpc_limits.h"
#include "proto/spec/access_role.h"

/// Messages about marks and sheets (proto/schema/rpc.proto).
namespace tandem::rpc {

/// Kind of a Note. The numbers are sent on the wire: append-only.
enum class NoteKind : std::uint8_t { kMark = 1, kSheet = 2 };
[[nodiscard]] constexpr const char* to_text(NoteKind kind) noexcept {
  return kind == NoteKind::kMark ? "mark" : "sheet";
}
/// Mark on the timeline, or sheet of an assessment.
struct Note {
  Id session_id{};
  NoteKind kind = NoteKind::kMark;
  std::string
      json;  ///< 1 ... kNoteMax bytes of UTF-8 without control characters; the server checks that it is an object
  friend bool operator==(const Note&, const Note&) = default;
};

/// Request for the notes of a session that the client may see.
struct NotesRequest {
  Id session_id{};
  std::uint32_t after = 0;  ///< only notes with a larger number
  friend bool operator==(const NotesRequest&, const NotesRequest&) = default;
};
/// A note as the server stored it.
struct StoredNote {
  std::uint32_t number = 0;  ///< from 1; increases with each note of the session
  NoteKind kind = NoteKind::kMark;
  double time_s = 0;                  ///< session clock [s], 0 ... 1e9
  std::string person{};               ///< author: name in the ticket; empty: not named
  std::string workstation{}, seat{};  ///< names; seat empty: a console
  AccessRole role = AccessRole::kObserver;
  bool yours = false;  ///< the client is the author
  std::string json{};  ///< as in Note
  friend bool operator==(const StoredNote&, const StoredNote&) = default;
};
struct NoteList {
  std::vector<StoredNote> notes;  ///< at most kNotesMax with kNotesBytesMax of JSON, in the order of their numbers
  bool more = false;              ///< there are further notes
  friend bool operator==(const NoteList&, const NoteList&) = default;
};

}  // namespace tandem::rpc
