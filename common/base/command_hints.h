#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tandem {

/// Returns a message in which `options` are added to every command named between backquotes, so that users can type it
/// as shown. Example: a text with `ticket --session a` becomes, by `with_options(text, "tandem-server ticket", "
/// --state s")`, one with `tandem-server ticket --state s --session a`. A command that already has the first of the
/// options stays as it is.
[[nodiscard]] inline std::string with_options(std::string text, std::string_view command, std::string_view options) {
  const std::string begin = "`" + std::string(command);
  const std::string_view first = options.substr(0, options.find(' ', 1));
  if (options.empty()) return text;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t after = at + begin.size();
    const std::size_t end = text.find('`', after);
    if (end == std::string::npos) return text;
    const bool whole_word = text[after] == ' ' || after == end;
    const bool has_it = std::string_view(text).substr(after, end - after).find(first) != std::string_view::npos;
    if (whole_word && !has_it) text.insert(after, options);
  }
  return text;
}

/// The same for several commands of one program.
[[nodiscard]] inline std::string with_options(std::string text, std::string_view program,
                                              std::initializer_list<std::string_view> commands,
                                              std::string_view options) {
  for (const std::string_view command : commands)
    text = with_options(std::move(text), std::string(program) + " " + std::string(command), options);
  return text;
}

/// Returns a message without the commands it names in parentheses and backquotes, for narrow output: `an operator
/// (`control resume`)` becomes `an operator`.
[[nodiscard]] inline std::string strip_commands(std::string text) {
  constexpr std::string_view kBegin = " (`", kEnd = "`)";
  for (std::size_t at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at)) {
    const std::size_t end = text.find(kEnd, at + kBegin.size());
    if (end == std::string::npos) break;
    text.erase(at, end + kEnd.size() - at);
  }
  return text;
}

/// Returns one word of a command line, quoted for a shell where that is needed.
[[nodiscard]] inline std::string shell_quote(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:=,+%@";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) return std::string(text);
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Returns ` --state DIR` as typed in a shell; empty for an empty directory name.
[[nodiscard]] inline std::string state_option(const std::string& folder) {
  return folder.empty() ? std::string() : " --state " + shell_quote(folder);
}

}  // namespace tandem
