#include "common/auth/io/audit_log.h"

#include <algorithm>

#include "common/auth/io/append_file.h"
#include "common/base/sanitize.h"

namespace tandem::auth {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : sanitize(text, AuditLog::kTextMax)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string line_of(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail,
                    const std::string& more = {}) {
  std::string line =
      "{\"ts\":" + std::to_string(now) + ",\"event\":" + quoted(event) + ",\"name\":" + quoted(name) + more;
  if (!detail.empty()) line += ",\"detail\":" + quoted(detail);
  return line + "}\n";
}

}  // namespace

std::string AuditLog::write(const StateDirectory& folder, std::int64_t now, std::string_view event,
                            std::string_view name, std::string_view detail) {
  std::string problem = put(folder, now, line_of(now, event, name, detail));
  if (problem.empty()) return problem;
  if (owed_ == 0) lost_since_ = now;
  ++owed_;
  ++lost_;
  return problem;
}

std::string AuditLog::retry(const StateDirectory& folder, std::int64_t now) {
  return error_.empty() ? std::string{} : put(folder, now, {});
}

std::string AuditLog::put(const StateDirectory& folder, std::int64_t now, const std::string& line) {
  const AppendFile file(folder, kFile, AppendFile::TornLine::kEnded);
  std::string text, rotation;
  if (owed_ > 0)
    text = line_of(now, "audit_lost", "", "since " + std::to_string(lost_since_) + ": " + error_,
                   ",\"lines\":" + std::to_string(owed_));
  text += line;
  if (const std::uint64_t size = folder.stamp(kFile).size;
      limits_ && size > 0 && size + text.size() > limits_->file_max) {
    const auto moved =
        file.rotate(limits_->file_max - std::min<std::uint64_t>(text.size(), limits_->file_max), limits_->older);
    if (!moved) rotation = moved.error();
    if (moved && *moved > 0)
      text = line_of(now, "audit_rotated", "", std::to_string(*moved) + " bytes are in " + kFile + ".1") + text;
  }
  std::string problem = text.empty() ? std::string{} : file.append(text);
  if (problem.empty()) owed_ = 0;
  error_ = problem.empty() ? rotation : problem;
  return problem;
}

}  // namespace tandem::auth
