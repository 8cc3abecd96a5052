#include "common/io/program.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/suggestions.h"
#include "common/io/help_formatter.h"
#include "common/io/output_file.h"
#include "common/io/print.h"

namespace tandem::io {
namespace {

/// Returns the option that a message of CLI11 names, such as `--delay: "-5" is out of range`; empty: none.
std::string option_of(const std::string& message) {
  const std::size_t begin = message.find("--");
  if (begin == std::string::npos) return {};
  const std::size_t end = message.find_first_of(": ,=", begin);
  return message.substr(begin, end == std::string::npos ? end : end - begin);
}

/// Removes an option and its values from the words of a command line. @return whether it was there
bool take_out(std::vector<std::string>& words, const CLI::Option& option, const std::string& name) {
  const std::size_t before = words.size();
  for (std::size_t i = 0; i < words.size();) {
    const bool whole = words[i] == name, with_value = words[i].starts_with(name + "=");
    if (!whole && !with_value) {
      ++i;
      continue;
    }
    const bool value_follows =
        whole && option.get_items_expected_min() > 0 && i + 1 < words.size() && !words[i + 1].starts_with("--");
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i),
                words.begin() + static_cast<std::ptrdiff_t>(i + (value_follows ? 2 : 1)));
  }
  return words.size() < before;
}

CLI::Option* find_option(CLI::App& app, const std::string& name) {
  for (CLI::App* command : app.get_subcommands())
    if (CLI::Option* const option = command->get_option_no_throw(name)) return option;
  return app.get_option_no_throw(name);
}

/// Appends the nearest known option, which CLI11 does not report for an unknown option.
std::string with_nearest(CLI::App& app, std::string message) {
  const std::string name = option_of(message);
  if (name.empty() || message.find("not expected") == std::string::npos) return message;
  std::vector<std::string> known;
  const auto collect = [&](const CLI::App& of) {
    for (const CLI::Option* const option : of.get_options())
      for (const std::string& known_name : option->get_lnames()) known.push_back("--" + known_name);
  };
  collect(app);
  for (const CLI::App* const command : app.get_subcommands()) collect(*command);
  const std::string* const nearest = nearest_match(name, known);
  return nearest == nullptr ? message : message + "; did you mean " + *nearest + "?";
}

/// Collects all usage errors; CLI11 stops at the first one. The words that an error names are removed and the rest is
/// parsed again, as long as words can be removed.
std::vector<std::string> all_mistakes(CLI::App& app, const CLI::ParseError& first, std::vector<std::string> words) {
  std::vector<std::string> mistakes{first.what()};
  for (;;) {
    const std::string& last = mistakes.back();
    const std::string missing = last.substr(0, last.find(" is required"));
    if (CLI::Option* const needed = missing.size() < last.size() ? find_option(app, missing) : nullptr;
        needed != nullptr && needed->get_required()) {
      needed->required(false);
    } else {
      const std::string name = option_of(last);
      const CLI::Option* const option = name.empty() ? nullptr : find_option(app, name);
      if (option == nullptr || !take_out(words, *option, name)) return mistakes;
    }
    try {
      app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 expects them in reverse order
      return mistakes;
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return mistakes;  // help and version are no errors
      mistakes.emplace_back(error.what());
    }
  }
}

/// Returns the exit code of a program whose command ended with `code`. If the reader of standard output closed it, as
/// `head` does, unwritten output is no error.
int finish(const CLI::App& app, int code) {
  const int before = errno;  // of the last write, if that was the command's last failed call
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const bool of_a_write = before == ENOSPC || before == EDQUOT || before == EFBIG || before == EIO;
  const int error = errno != 0 ? errno : of_a_write ? before : 0;
  if ((flushed && std::ferror(stdout) == 0) || error == EPIPE || reader_closed(stdout)) return code;
  print_formatted(stderr, "%s: standard output could not be written to the end%s\n", app.get_name().c_str(),
                  error != 0 ? (": " + write_error_text(error)).c_str() : "");
  return code != 0 ? code : 1;
}

}  // namespace

int run_program(CLI::App& app, const std::function<int()>& action, int argc, char** argv) {
  HelpFormatter::install(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 does not report the unknown word when a command is missing.
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (!word.empty() && !word.starts_with('-') && app.get_subcommands().empty() && !app.get_subcommands({}).empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      print_formatted(stderr, "%s: no command is called \"%s\"; %s\n", app.get_name().c_str(), argv[1],
                      suggest(word, known).c_str());
      return 2;
    }
    // Help and version are no errors; every usage error is 2, regardless of CLI11's code.
    if (error.get_exit_code() == 0) return finish(app, app.exit(error));
    // Found before the words are parsed again, because that changes the named command.
    const std::string meant = with_nearest(app, error.what());
    std::vector<std::string> all = all_mistakes(app, error, {argv + 1, argv + argc});
    all.front() = meant;
    for (const std::string& mistake : all)
      print(stderr, (&mistake == &all.front() ? mistake : with_nearest(app, mistake)) + "\n");
    if (all.size() > 1) std::fprintf(stderr, "%zu mistakes; nothing was started\n", all.size());
    std::fputs("Run with --help for more information.\n", stderr);
    return 2;
  }
  try {
    return finish(app, action());
  } catch (const std::exception& error) {
    print_formatted(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return 1;
  }
}

}  // namespace tandem::io
