#include "common/auth/io/audit_log.h"

#include <algorithm>
#include <utility>

#include "common/auth/io/append_file.h"
#include "common/base/sanitize.h"

namespace tandem::auth {
namespace {

constexpr std::size_t kTogetherMax = 16U << 10;  // [bytes] written with one sync, below the least size of a file

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

void AuditLog::write_behind(std::shared_ptr<const StateDirectory> folder) {
  behind_ =
      std::jthread([this, folder = std::move(folder)](const std::stop_token& stop) { append_queued(*folder, stop); });
}

void AuditLog::append_queued(const StateDirectory& folder, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (queued_.wait(lock, stop, [this] { return !queue_.empty(); })) {
    Lines next{0, {}, 0};  // one sync for all
    for (; !queue_.empty() && next.text.size() < kTogetherMax; queue_.pop_front()) {
      next.now = queue_.front().now;
      next.text += queue_.front().text;
      next.count += queue_.front().count;
    }
    lock.unlock();
    append(folder, next);
    lock.lock();
  }
}

std::string AuditLog::write(const StateDirectory& folder, std::int64_t now, std::string_view event,
                            std::string_view name, std::string_view detail) {
  Lines line{now, line_of(now, event, name, detail), 1};
  if (!behind_.joinable()) return append(folder, line);
  const std::lock_guard lock(mutex_);
  if (queue_.size() >= kQueuedMax) {
    count_lost(now, 1);
  } else {
    queue_.push_back(std::move(line));
    queued_.notify_one();
  }
  return {};
}

std::string AuditLog::retry(const StateDirectory& folder, std::int64_t now) {
  std::unique_lock lock(mutex_);
  if (error_.empty()) return {};
  const Lines none{now, {}, 0};
  if (behind_.joinable()) {
    if (queue_.empty()) queue_.push_back(none);
    queued_.notify_one();
    return error_;
  }
  lock.unlock();
  return put(folder, none);
}

std::string AuditLog::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

std::uint64_t AuditLog::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void AuditLog::count_lost(std::int64_t now, std::uint64_t count) {
  if (owed_ == 0) lost_since_ = now;
  owed_ += count;
  lost_ += count;
}

std::string AuditLog::append(const StateDirectory& folder, const Lines& lines) {
  std::string problem = put(folder, lines);
  if (problem.empty() || lines.count == 0) return problem;
  const std::lock_guard lock(mutex_);
  count_lost(lines.now, lines.count);
  return problem;
}

std::string AuditLog::put(const StateDirectory& folder, const Lines& lines) {
  const AppendFile file(folder, kFile, AppendFile::TornLine::kEnded);
  std::string text, rotation;
  std::unique_lock lock(mutex_);
  const std::uint64_t owed = owed_;
  if (owed > 0)
    text = line_of(lines.now, "audit_lost", "", "since " + std::to_string(lost_since_) + ": " + error_,
                   ",\"lines\":" + std::to_string(owed));
  lock.unlock();
  text += lines.text;
  if (const std::uint64_t size = folder.stamp(kFile).size;
      limits_ && size > 0 && size + text.size() > limits_->file_max) {
    const auto moved =
        file.rotate(limits_->file_max - std::min<std::uint64_t>(text.size(), limits_->file_max), limits_->older);
    if (!moved) rotation = moved.error();
    if (moved && *moved > 0)
      text = line_of(lines.now, "audit_rotated", "", std::to_string(*moved) + " bytes are in " + kFile + ".1") + text;
  }
  std::string problem = text.empty() ? std::string{} : file.append(text);
  lock.lock();
  if (problem.empty()) owed_ -= owed;
  error_ = problem.empty() ? rotation : problem;
  return problem;
}

}  // namespace tandem::auth
