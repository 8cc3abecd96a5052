#pragma once

#include <cstdio>
#include <span>
#include <string>

#include "common/io/log.h"
#include "common/io/terminal.h"
#include "server/app/control/control_event.h"
#include "server/app/monitor/message_queue.h"
#include "server/app/monitor/session_status.h"

namespace tandem::server {

/// Output of a server process for its operator: text and a status line on the terminal, or log lines as JSON. Members
/// named `post` are for any thread; all others belong to one.
class ServerOutput {
 public:
  /// @param command         name of the command, for errors
  /// @param status_line     shows the status line
  /// @param to_stderr       standard output is in use for a report
  ServerOutput(std::string command, bool status_line, bool to_stderr)
      : command_(std::move(command)), stream_(to_stderr ? stderr : stdout), line_(!status_line) {}

  /// Prints text, wrapped for a terminal.
  void print(const std::string& text);
  /// Whether others may read or store what is printed: a journal, a file or a pipe.
  [[nodiscard]] bool may_be_stored() const noexcept;
  /// Logs an event; without a JSON log prints `text` above the status line. Levels from kWarn on are warnings.
  void report(io::Level level, const io::LogEvent& event, const std::string& text);
  /// Prints a line above the status line, also with a JSON log.
  void note(const std::string& text) { line_.note(text); }
  /// Reports an error of the command.
  void error(const std::string& what) const;

  /// Reports rejections and errors of the control plane.
  void post_control_event(const ControlEventRecord& news);
  /// Reports an error of the checkpoint store.
  void post_checkpoint_error(const std::string& what);
  /// Reports that the store writes again.
  void post_checkpoint_recovery(const std::string& what);
  /// Reports an executed command. A JSON log has it already.
  void post_message(const std::string& text);
  /// Prints the posted messages.
  void print_posted();

  /// Shows the status line if it is due.
  /// @param drain  shown first; empty: the server does not drain
  /// @param list   command that lists all sessions of this server
  [[nodiscard]] bool due(Time now) const noexcept;
  void show(Time now, std::span<const SessionScreenEntry> sessions, const std::string& drain, const std::string& list);
  /// Removes the status line, so that other text can be printed.
  void clear() { line_.clear(); }

 private:
  std::string command_;
  std::FILE* stream_;
  io::StatusLine line_;
  MessageQueue posted_;
  Time shown_{};
};

}  // namespace tandem::server
