#include "server/app/control/note_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/auth/io/server_keystore.h"
#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/io/fd.h"
#include "proto/rpc/rpc_texts.h"

namespace tandem::server {
namespace {

using LineJson = nlohmann::ordered_json;

/// A line of the file; nullopt: it is none, or a value is out of the bounds of a note.
std::optional<SessionNote> note_of_line(const std::string& text) {
  const LineJson line = LineJson::parse(text, nullptr, false);
  if (!line.is_object()) return std::nullopt;
  const auto word = [&line](const char* key) {
    const auto found = line.find(key);
    return found != line.end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  const auto role = access_role_named(word("role"));
  const auto note = line.find("note"), time = line.find("time_s");
  const std::string kind = word("kind");
  if (!role || note == line.end() || !note->is_object() || time == line.end() || !time->is_number())
    return std::nullopt;
  SessionNote out{.session = word("session"),
                  .workstation = word("workstation"),
                  .seat = word("seat"),
                  .person = word("person"),
                  .author = word("author"),
                  .role = *role,
                  .time_s = time->get<double>(),
                  .kind = kind == rpc::to_text(rpc::NoteKind::kMark) ? rpc::NoteKind::kMark : rpc::NoteKind::kSheet,
                  .json = note->dump(-1, ' ', false, LineJson::error_handler_t::replace)};
  const bool named = rpc::is_name(out.workstation) && (out.seat.empty() || rpc::is_name(out.seat)) &&
                     (out.person.empty() || rpc::is_name(out.person));
  const bool good = named && (kind == "mark" || kind == "sheet") && out.time_s >= 0 && out.time_s <= rpc::kTimeMax &&
                    rpc::is_text(out.json, rpc::kNoteMax);
  return good ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace

std::string NoteLog::append(const SessionNote& note, std::int64_t wall_s) const {
  if (folder_.empty()) return {};
  const LineJson line{{"ts", wall_s},
                      {"session", note.session},
                      {"id", to_hex(note.session_id)},
                      {"tick", note.tick},
                      {"time_s", note.time_s},
                      {"person", note.person},
                      {"workstation", note.workstation},
                      {"role", std::string(to_text(note.role))},
                      {"seat", note.seat},
                      {"author", note.author},
                      {"kind", rpc::to_text(note.kind)},
                      {"note", LineJson::parse(note.json, nullptr, false)}};
  std::string text = line.dump(-1, ' ', false, LineJson::error_handler_t::replace) + "\n";
  const std::string path = path_of(note.session, note.session_id);
  const io::Fd file{::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600)};
  struct stat status{};
  if (!file.open() || ::fstat(file.get(), &status) != 0) return path + ": " + std::strerror(errno);
  // A crash may have left a part of a line. This note would be unreadable as its end.
  if (char last = 0; status.st_size > 0 && ::pread(file.get(), &last, 1, status.st_size - 1) == 1 && last != '\n')
    text.insert(text.begin(), '\n');
  if (static_cast<std::uint64_t>(status.st_size) + text.size() > kFileMax)
    return format("the notes of this session would exceed %llu MiB", static_cast<unsigned long long>(kFileMax >> 20U));
  const ssize_t size = ::write(file.get(), text.data(), text.size());
  if (size == static_cast<ssize_t>(text.size())) return {};
  std::string problem = path + ": " + std::strerror(size < 0 ? errno : ENOSPC);
  if (size > 0 && ::ftruncate(file.get(), status.st_size) != 0) return problem + "; its last line is not whole";
  return problem;
}

std::string NoteLog::path_of(const std::string& session, const rpc::Id& id) const {
  return folder_ + "/" + session + "-" + to_hex(id).substr(0, 8) + ".notes.jsonl";
}

std::vector<AuthoredNote> NoteLog::load(const std::string& session, const rpc::Id& id) const {
  std::vector<AuthoredNote> notes;
  if (folder_.empty()) return notes;
  std::ifstream file(path_of(session, id));
  std::uint64_t read = 0;
  for (std::string text; read <= kFileMax && std::getline(file, text);) {
    read += text.size() + 1;
    if (auto note = note_of_line(text)) notes.push_back(authored(*note));
  }
  return notes;
}

}  // namespace tandem::server
