#include "server/app/control/session_notes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/base/sanitize.h"
#include "server/session/checkpoint.h"

namespace tandem::server {
namespace {

bool is_sheet(const AuthoredNote& note) noexcept { return note.note.kind == rpc::NoteKind::kSheet; }

}  // namespace

AuthoredNote authored(const SessionNote& note) {
  AuthoredNote out{.note = {.kind = note.kind,
                            .time_s = note.time_s,
                            .person = note.person,
                            .workstation = note.workstation,
                            .seat = note.seat,
                            .role = note.role,
                            .json = note.json},
                   .author = note.author};
  const nlohmann::json parsed = nlohmann::json::parse(note.json, nullptr, false);
  if (note.kind != rpc::NoteKind::kSheet || !parsed.is_object()) return out;
  const auto text = [&parsed](const char* key) {
    const auto found = parsed.find(key);
    return found != parsed.end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  out.form = text("sheet");
  out.of = text("of");
  const auto closed = parsed.find("closed");
  out.closed = closed != parsed.end() && closed->is_boolean() && closed->get<bool>();
  return out;
}

std::string SessionNotes::author_of(const rpc::Welcome& joined, bool keys_on_disk) {
  if (!joined.person.empty()) return "person/" + joined.person;
  if (!keys_on_disk) return "role/" + std::string(to_text(joined.role));
  const auto hash = resume_hash(joined.resume_secret.bytes, {});  // the secret itself must not be stored
  return "join/" + to_hex(std::span{hash}.first(8));
}

const AuthoredNote* SessionNotes::sheet_of(const std::string& author, const AuthoredNote& like) const {
  const auto found = std::ranges::find_if(notes_, [&](const AuthoredNote& row) {
    return is_sheet(row) && row.author == author && row.form == like.form && row.of == like.of;
  });
  return found == notes_.end() ? nullptr : &*found;
}

std::string SessionNotes::problem(const AuthoredNote& note) const {
  if (!is_sheet(note)) return {};
  const AuthoredNote* const own = sheet_of(note.author, note);
  if (own != nullptr && own->closed)
    return "your sheet " + sanitize(note.form, 32) + " about " + sanitize(note.of, 32) + " is closed, which is final";
  if (own == nullptr && notes_.size() - marks_ >= kSheetsMax)
    return format("this session has %zu sheets already, and a server takes no more", kSheetsMax);
  return {};
}

void SessionNotes::add(AuthoredNote note) {
  note.note.number = ++newest_;
  if (is_sheet(note)) {
    if (const AuthoredNote* const own = sheet_of(note.author, note); own != nullptr)
      notes_.erase(notes_.begin() + (own - notes_.data()));
  } else if (++marks_ > kMarksMax) {
    --marks_;
    notes_.erase(std::ranges::find_if_not(notes_, is_sheet));
  }
  notes_.push_back(std::move(note));
}

bool SessionNotes::may_read(const std::string& author, const AuthoredNote& note) const {
  if (!is_sheet(note) || note.author == author) return true;
  const AuthoredNote* const own = sheet_of(author, note);
  return note.closed && own != nullptr && own->closed;
}

rpc::NoteList SessionNotes::list(const std::string& author, std::uint32_t after) const {
  rpc::NoteList out;
  std::size_t size = 0;
  for (const AuthoredNote& row : notes_) {
    if (row.note.number <= after || !may_read(author, row)) continue;
    size += row.note.json.size();
    if (out.notes.size() == rpc::kNotesMax || size > rpc::kNotesBytesMax) {
      out.more = true;
      break;
    }
    out.notes.push_back(row.note);
    out.notes.back().yours = row.author == author;
  }
  return out;
}

}  // namespace tandem::server
