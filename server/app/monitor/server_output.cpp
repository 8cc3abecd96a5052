#include "server/app/monitor/server_output.h"

#include <unistd.h>

#include "common/base/sanitize.h"
#include "common/io/help_text.h"
#include "common/io/print.h"

namespace tandem::server {

void ServerOutput::print(const std::string& text) {
  if (!may_be_stored()) clear();  // on a terminal the rest of a longer status line would stay behind the text
  std::fputs(io::wrap_for_terminal(text, stream_).c_str(), stream_);
  std::fflush(stream_);
}

bool ServerOutput::may_be_stored() const noexcept { return ::isatty(::fileno(stream_)) != 1; }

void ServerOutput::report(io::Level level, const io::LogEvent& event, const std::string& text) {
  io::log_event(level, event);
  if (io::logs_json()) return;
  if (level >= io::Level::kWarn) return line_.warn(text);
  line_.note(text);
}

void ServerOutput::error(const std::string& what) const { io::log(io::Level::kError, command_ + ": " + what); }

void ServerOutput::post_control_event(const ControlEventRecord& news) {
  const bool trouble = news.event == ControlEvent::kTrouble;
  switch (news.event) {
    case ControlEvent::kNotEnrolled:
    case ControlEvent::kBlocked:
    case ControlEvent::kCodeRefused:
    case ControlEvent::kRefused:
    case ControlEvent::kTrouble:
      break;
    default:
      return;
  }
  // Without an address the event is about the server itself.
  const std::string who = news.address.empty() ? "" : news.address + " " + news.workstation;
  const std::string colon = who.empty() ? "" : ": ";
  if (io::logs_json())
    return io::log_event(trouble ? io::Level::kError : io::Level::kWarn,
                         {.event = std::string(to_text(news.event)), .text = who + colon + news.detail});
  if (trouble) return posted_.add(io::Level::kError, who + colon + sanitize(news.detail));
  posted_.add(io::Level::kWarn, who + " " + std::string(control_event_text(news.event)) +
                                    (news.detail.empty() ? "" : ": ") + sanitize(news.detail));
}

void ServerOutput::post_checkpoint_error(const std::string& what) {
  if (io::logs_json()) return io::log_event(io::Level::kError, {.event = "checkpoint_trouble", .text = what});
  posted_.add(io::Level::kError, "checkpoint: " + what);
}

void ServerOutput::post_checkpoint_recovery(const std::string& what) {
  if (io::logs_json()) return io::log_event(io::Level::kWarn, {.event = "checkpoint_recovered", .text = what});
  posted_.add(io::Level::kWarn, "checkpoint: " + what);
}

void ServerOutput::post_message(const std::string& text) {
  if (!io::logs_json()) posted_.add(io::Level::kInfo, text);
}

void ServerOutput::print_posted() {
  for (const MessageQueue::Line& line : posted_.take()) {
    if (line.level == io::Level::kInfo) line_.note(line.text);
    if (line.level == io::Level::kWarn) line_.warn(line.text);
    if (line.level != io::Level::kError) continue;
    line_.clear();
    io::log(io::Level::kError, line.text);
  }
}

bool ServerOutput::due(Time now) const noexcept {
  return now - shown_ >= std::chrono::milliseconds(line_.interval_ms());
}

void ServerOutput::show(Time now, std::span<const SessionScreenEntry> sessions, const std::string& drain,
                        const std::string& list) {
  shown_ = now;
  const std::size_t rows = line_.rows_max();
  line_.show(screen_items(sessions, drain, rows, list), rows);
}

}  // namespace tandem::server
