#pragma once

#include <unistd.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/app/typed_line.h"
#include "common/io/terminal.h"

namespace tandem::client {

/// Reads the lines of an input until it ends or a signal arrives. A terminal's own editing is off meanwhile: the
/// terminal would keep the begin of a line out of sight behind a notice, and join it to the next order.
class ConsoleLines {
 public:
  static constexpr int kIdleMs = 1000;  ///< `next` returns at the latest after so long
  static constexpr std::size_t kArrivedMax = 65536;

  /// @param prompt  shown before each line if the input is a terminal
  ConsoleLines(int signals, int server, int input = STDIN_FILENO, std::string prompt = {});

  /// Shows the prompt, and behind it the begin of a line that was typed already.
  void show_prompt() const;
  /// Returns the next line; nullopt at the end of input, after a signal, if the server is gone, or if `idle`.
  std::optional<std::string> next();

  /// Input of a time without a connection.
  struct Arrived {
    std::vector<std::string> lines;
    std::string begun;  ///< begin of a line whose end had not arrived
  };
  /// Takes the input that has arrived already, at most kArrivedMax bytes of it. The begin of a line is dropped too, and
  /// so is its end if that arrives later through a pipe: a part of an order may be another order.
  Arrived take_arrived();

  /// Watches another connection from now on.
  void set_server(int server) {
    server_ = server;
    server_gone_ = false;
  }
  /// True if `next` returned because kIdleMs have passed.
  [[nodiscard]] bool idle() const { return idle_; }
  /// True if the server closed the connection while no request was pending.
  [[nodiscard]] bool server_gone() const { return server_gone_; }

 private:
  std::optional<std::string> take_line();
  /// Reads the keys that wait. @return false at the end of input
  bool read_keys();

  int signals_, server_, input_;
  std::string prompt_;
  bool server_gone_ = false, idle_ = false;
  bool skips_end_ = false;  ///< the begin of the next line was dropped
  std::optional<io::KeyReader> keys_;
  TypedLine typed_;
  std::string text_;
};

}  // namespace tandem::client
