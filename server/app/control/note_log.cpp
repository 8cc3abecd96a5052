#include "server/app/control/note_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/auth/io/server_keystore.h"
#include "common/base/format.h"
#include "common/io/fd.h"

namespace tandem::server {

std::string NoteLog::append(const SessionNote& note, std::int64_t wall_s) const {
  if (folder_.empty()) return {};
  using Json = nlohmann::ordered_json;
  const Json line{{"ts", wall_s},
                  {"session", note.session},
                  {"id", auth::to_hex(note.session_id)},
                  {"tick", note.tick},
                  {"time_s", note.time_s},
                  {"workstation", note.workstation},
                  {"role", std::string(to_text(note.role))},
                  {"seat", note.seat},
                  {"kind", rpc::to_text(note.kind)},
                  {"note", Json::parse(note.json, nullptr, false)}};
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  const std::string path =
      folder_ + "/" + note.session + "-" + auth::to_hex(note.session_id).substr(0, 8) + ".notes.jsonl";
  const io::Fd file{::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600)};
  struct stat status{};
  if (!file.open() || ::fstat(file.get(), &status) != 0) return path + ": " + std::strerror(errno);
  if (static_cast<std::uint64_t>(status.st_size) + text.size() > kFileMax)
    return format("the notes of this session would exceed %llu MiB", static_cast<unsigned long long>(kFileMax >> 20U));
  const ssize_t size = ::write(file.get(), text.data(), text.size());
  if (size == static_cast<ssize_t>(text.size())) return {};
  std::string problem = path + ": " + std::strerror(size < 0 ? errno : ENOSPC);
  if (size > 0 && ::ftruncate(file.get(), status.st_size) != 0) return problem + "; its last line is not whole";
  return problem;
}

}  // namespace tandem::server
