#pragma once

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>

#include "common/io/command_line.h"
#include "common/io/usage_errors.h"

/// Options that give a ticket. All users of the computer can read a command line (ps), so a file is preferable.
namespace tandem::client {

struct TicketOption {
  std::string text;  ///< `ticket:...`, `@FILE`, or a file's name
  std::string file;  ///< file name, or `-` for standard input
};

inline void add_ticket_options(const io::Command& command, TicketOption& ticket, const char* what) {
  command
      .add_option("--ticket", ticket.text,
                  std::string(what) +
                      "; @FILE: the first line of that file, so that the ticket appears in no list of processes")
      .value_name("TICKET|@FILE");
  command.add_option("--ticket-file", ticket.file, "the same as --ticket @FILE; `-`: the first line of standard input")
      .value_name("FILE");
}

/// Returns the text of the ticket; empty if none is given, or if an error was added to `errors`.
/// @param file_option  name of the option that gave `file`
[[nodiscard]] inline std::string ticket_of(const TicketOption& given, io::UsageErrors& errors,
                                           const char* file_option = "--ticket-file") {
  if (!given.text.empty() && !given.file.empty()) {
    errors.add("--ticket-file: cannot be combined with --ticket; give one of them");
    return {};
  }
  const bool named = !given.file.empty() || given.text.starts_with('@');
  std::string name = !given.file.empty() ? given.file : named ? given.text.substr(1) : given.text;
  const char* const option = given.file.empty() ? "--ticket" : file_option;
  if (name.empty() && !named) return {};
  const auto trimmed = [](const std::string& text) {  // a ticket may be copied from an indented line
    const auto begin = text.find_first_not_of(" \t\r\n"), end = text.find_last_not_of(" \t\r\n");
    return begin == std::string::npos ? std::string() : text.substr(begin, end + 1 - begin);
  };
  if (!named && trimmed(name).starts_with("ticket:")) return trimmed(name);
  std::string line;
  std::ifstream file;
  const bool named_stdin = name == "-" && named;
  errno = 0;
  if (!named_stdin) file.open(name);
  const int error = errno;
  std::istream& in = named_stdin ? std::cin : file;
  if (!std::getline(in, line)) {
    if (!named) return name;  // not a file: join_seat reports the expected form
    const std::string why =
        file.is_open() || named_stdin ? " is empty" : std::string(" cannot be read: ") + std::strerror(error);
    errors.add(std::string(option) + ": " +
               (name.empty() ? "@ needs a file's name"
                             : name + why + "; write the ticket to it: tandem-server ticket ... > FILE"));
    return {};
  }
  if (line = trimmed(line); line.starts_with("ticket:")) return line;
  errors.add(std::string(option) + ": " + name + ": its first line is no ticket, which begins with `ticket:`");
  return {};
}

}  // namespace tandem::client
