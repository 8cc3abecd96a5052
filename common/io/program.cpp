#include "common/io/program.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/nearest.h"
#include "common/io/help_text.h"
#include "common/io/output_file.h"
#include "common/io/print.h"

namespace tandem::io {
namespace {

/// The option that a message of CLI11 is about, such as `--delay: "-5" is out of range`; empty: none is named.
std::string option_of(const std::string& message) {
  const std::size_t begin = message.find("--");
  if (begin == std::string::npos) return {};
  const std::size_t end = message.find_first_of(": ,=", begin);
  return message.substr(begin, end == std::string::npos ? end : end - begin);
}

/// Takes an option and its values out of the words of a command line. @return whether it was there
bool take_out(std::vector<std::string>& words, const CLI::Option& option, const std::string& name) {
  const std::size_t before = words.size();
  for (std::size_t i = 0; i < words.size();) {
    const bool whole = words[i] == name, with_value = words[i].starts_with(name + "=");
    if (!whole && !with_value) {
      ++i;
      continue;
    }
    const bool value_follows = whole && option.get_items_expected_min() > 0 && i + 1 < words.size() && !words[i + 1].starts_with("--");
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i), words.begin() + static_cast<std::ptrdiff_t>(i + (value_follows ? 2 : 1)));
  }
  return words.size() < before;
}

CLI::Option* find_option(CLI::App& app, const std::string& name) {
  for (CLI::App* command : app.get_subcommands())
    if (CLI::Option* const option = command->get_option_no_throw(name)) return option;
  return app.get_option_no_throw(name);
}

/// CLI11 says which option it did not know, not which one may be meant.
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
  const std::string* const nearest = nearest_of(name, known);
  return nearest == nullptr ? message : message + "; did you mean " + *nearest + "?";
}

/// CLI11 stops at the first mistake. People want all of them: what the mistake is about is put aside, and the rest is
/// parsed again, as long as something can be put aside.
std::vector<std::string> all_mistakes(CLI::App& app, const CLI::ParseError& first, std::vector<std::string> words) {
  std::vector<std::string> mistakes{first.what()};
  for (;;) {
    const std::string& last = mistakes.back();
    const std::string missing = last.substr(0, last.find(" is required"));
    if (CLI::Option* const needed = missing.size() < last.size() ? find_option(app, missing) : nullptr; needed != nullptr && needed->get_required()) {
      needed->required(false);
    } else {
      const std::string name = option_of(last);
      const CLI::Option* const option = name.empty() ? nullptr : find_option(app, name);
      if (option == nullptr || !take_out(words, *option, name)) return mistakes;
    }
    try {
      app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the back
      return mistakes;
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return mistakes;  // help and version are no mistakes
      mistakes.emplace_back(error.what());
    }
  }
}

/// Exit code of a program whose command came to its end with `code`. Where the reader of standard output went away, as `head` does, nobody misses the rest.
int finish(const CLI::App& app, int code) {
  const int before = errno;  // of the last write, if that was the command's last call that failed
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const bool of_a_write = before == ENOSPC || before == EDQUOT || before == EFBIG || before == EIO;
  const int error = errno != 0 ? errno : of_a_write ? before : 0;
  if ((flushed && std::ferror(stdout) == 0) || error == EPIPE || reader_gone(stdout)) return code;
  printf_for_people(stderr, "%s: standard output could not be written to the end%s\n", app.get_name().c_str(), error != 0 ? (": " + why_not_written(error)).c_str() : "");
  return code != 0 ? code : 1;
}

}  // namespace

int run_program(CLI::App& app, const std::function<int()>& action, int argc, char** argv) {
  HelpText::give_to(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 does not say which word it did not know when a command is missing.
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (!word.empty() && !word.starts_with('-') && app.get_subcommands().empty() && !app.get_subcommands({}).empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      printf_for_people(stderr, "%s: no command is called \"%s\"; %s\n", app.get_name().c_str(), argv[1], suggest(word, known).c_str());
      return 2;
    }
    // Help and version are ends, not mistakes; every mistake in arguments is 2, whatever CLI11 calls it.
    if (error.get_exit_code() == 0) return finish(app, app.exit(error));
    // Looked up before the words are parsed again, which changes which command was named.
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
    printf_for_people(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return 1;
  }
}

}  // namespace tandem::io
