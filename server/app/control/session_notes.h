#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "server/app/control/session_note.h"

namespace tandem::server {

/// A note with what decides who may read it.
struct AuthoredNote {
  rpc::StoredNote note;      ///< numbered by SessionNotes::add
  std::string author;        ///< SessionNotes::author_of
  std::string form{}, of{};  ///< of a sheet: its form and the seat of the assessed person
  bool closed = false;       ///< of a sheet: final
};
/// @pre note.json is an object
[[nodiscard]] AuthoredNote authored(const SessionNote& note);

/// Marks and sheets of one session, for its clients. It decides who may read what: raters must not influence each
/// other, so that a sheet of another author is hidden until one's own sheet of that form about that seat is closed.
/// A closed sheet is final. Bounded: the oldest mark is dropped, one sheet too many is rejected.
class SessionNotes {
 public:
  static constexpr std::size_t kMarksMax = 500, kSheetsMax = 200;

  /// Identity of an author: the person whom the ticket names; else the role with ephemeral keys, where one user has all
  /// consoles; else this one join, because several persons can share a workstation.
  [[nodiscard]] static std::string author_of(const rpc::Welcome& joined, bool keys_on_disk);

  /// Why a note is rejected, without scores of others; empty: it is not.
  [[nodiscard]] std::string problem(const AuthoredNote& note) const;
  /// Adds a note, and numbers it. A sheet replaces the author's earlier one of that form about that seat.
  void add(AuthoredNote note);
  /// Notes with numbers above `after` that this author may read, as many as one reply holds.
  [[nodiscard]] rpc::NoteList list(const std::string& author, std::uint32_t after) const;
  /// Number of the newest note; 0: none.
  [[nodiscard]] std::uint32_t newest() const noexcept { return newest_; }

 private:
  [[nodiscard]] bool may_read(const std::string& author, const AuthoredNote& note) const;
  [[nodiscard]] const AuthoredNote* sheet_of(const std::string& author, const AuthoredNote& like) const;

  std::vector<AuthoredNote> notes_;  ///< in the order of their numbers
  std::size_t marks_ = 0;            ///< in `notes_`
  std::uint32_t newest_ = 0;
};

}  // namespace tandem::server
