#include "common/io/command_line.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string_view>

#include "common/base/suggestions.h"
#include "common/io/help_text.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/screen_block.h"

namespace tandem::io {
namespace {

constexpr std::size_t kWidthMin = 40, kWidthMax = 120;

/// Groups in display order; others appear between "Options" and "Output".
constexpr const char* kNeeded = "Needed";
constexpr const char* kConnection = "Connection";
constexpr const char* kOptions = "Options";
constexpr const char* kOutput = "Output";
constexpr const char* kHelp = "Help";

/// Returns the group of an option that has no group of its own.
const char* group_of(const CLI::Option& option) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 26> kGroups{{{"server", kConnection},
                                                                                     {"session", kConnection},
                                                                                     {"seat", kConnection},
                                                                                     {"ticket", kConnection},
                                                                                     {"ticket-file", kConnection},
                                                                                     {"state", kConnection},
                                                                                     {"role", kConnection},
                                                                                     {"listen", kConnection},
                                                                                     {"to", kConnection},
                                                                                     {"address", kConnection},
                                                                                     {"workstation", kConnection},
                                                                                     {"timeout", kConnection},
                                                                                     {"json", kOutput},
                                                                                     {"csv", kOutput},
                                                                                     {"trace", kOutput},
                                                                                     {"junit", kOutput},
                                                                                     {"html", kOutput},
                                                                                     {"log", kOutput},
                                                                                     {"metrics", kOutput},
                                                                                     {"quiet", kOutput},
                                                                                     {"out", kOutput},
                                                                                     {"keep", kOutput},
                                                                                     {"output", kOutput},
                                                                                     {"plot", kOutput},
                                                                                     {"help", kHelp},
                                                                                     {"version", kHelp}}};
  if (option.get_required()) return kNeeded;
  for (const std::string& name : option.get_lnames())
    for (const auto& [known, group] : kGroups)
      if (name == known) return group;
  return kOptions;
}

std::size_t rank_of(const std::string& group) {
  constexpr std::array<std::string_view, 3> kFirst{kNeeded, kConnection, kOptions};
  const auto at = std::ranges::find(kFirst, group);
  if (at != kFirst.end()) return static_cast<std::size_t>(at - kFirst.begin());
  return group == kOutput ? 98 : group == kHelp ? 99 : 50;
}

/// Help formatter of all Tandem programs: options in groups, wrapped to the terminal (without one to the variable
/// COLUMNS, else to 80 columns).
class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    std::string text = make_description(app) + "\n" + make_usage(app, std::move(name)) + make_positionals(app);
    std::vector<std::string> groups = app->get_groups();
    std::ranges::stable_sort(groups, {}, rank_of);
    for (const std::string& group : groups) {
      const auto options =
          app->get_options([&](const CLI::Option* o) { return o->get_group() == group && o->nonpositional(); });
      if (!group.empty() && !options.empty()) text += make_group(group, false, options);
    }
    return text + make_subcommands(app, CLI::AppFormatMode::Normal) + "\n" + make_footer(app);
  }
  std::string make_description(const CLI::App* app) const override {
    return fill_paragraphs(app->get_description(), width());
  }
  std::string make_footer(const CLI::App* app) const override { return fill_paragraphs(app->get_footer(), width()); }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return option_row(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option),
                      width());
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return option_row(command->get_name(), command->get_description(), width());
  }

 private:
  static std::size_t width() {
    return std::clamp(screen_size(STDOUT_FILENO).columns, kWidthMin + 1, kWidthMax + 1) - 1;
  }
};

/// Installs the formatter in a program and all its commands, and sorts options without a group into the usual ones.
void format_help(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  // Same style as the descriptions of the other options.
  for (const auto& [name, words] :
       {std::pair{"--help", "prints this and ends"}, {"--version", "prints the version and ends"}})
    if (CLI::Option* const option = app.get_option_no_throw(name)) option->description(words);
  for (CLI::Option* const option : app.get_options())
    if (option->get_group() == "Options") option->group(group_of(*option));
  for (CLI::App* const command : app.get_subcommands({})) format_help(*command);
}

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

/// Returns the program and the command that the user named, as in `tandem-server move`.
std::string command_called(const CLI::App& app) {
  std::string called = app.get_name();
  std::vector<CLI::App*> named = app.get_subcommands();
  while (!named.empty()) {
    called += " " + named.front()->get_name();
    named = named.front()->get_subcommands();
  }
  return called;
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

Option& Option::value_name(const std::string& name) {
  option_->option_text(name);
  return *this;
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::group(const std::string& heading) {
  option_->group(heading);
  return *this;
}

Option& Option::check(const OptionCheck& check) {
  option_->transform(CLI::Validator(check, check.allowed()));
  return *this;
}

Option& Option::one_value() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::optional_value() {
  option_->expected(0, 1);
  return *this;
}

Command Command::add_command(const std::string& name, const std::string& description,
                             const std::function<int()>& run) const {
  CLI::App* const command = app_->add_subcommand(name, description);
  command->callback([chosen = chosen_, run] { *chosen = run; });
  return {*command, *chosen_};
}

template <class Value>
Option Command::add_option(const std::string& name, Value& value, const std::string& description) const {
  return Option(*app_->add_option(name, value, description));
}
template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, double&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&) const;

Option Command::add_flag(const std::string& name, bool& value, const std::string& description) const {
  return Option(*app_->add_flag(name, value, description));
}

void Command::take_rest(std::vector<std::string>& rest) const {
  app_->prefix_command();
  app_->parse_complete_callback([app = app_, &rest] { std::ranges::copy(app->remaining(), std::back_inserter(rest)); });
}

void Command::alias(const std::string& name) const { app_->alias(name); }

void Command::footer(const std::string& text) const { app_->footer(text); }

bool Command::given(const std::string& option) const {
  const CLI::Option* const found = app_->get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

Program::Program(const std::string& name, const std::string& version, const std::string& description,
                 std::function<int()> run)
    : app_(std::make_unique<CLI::App>(description, name)), run_(std::move(run)) {
  app_->set_version_flag("--version", name + " " + version);
  if (!run_) app_->require_subcommand(1);
}

Program::~Program() = default;

int Program::run(const std::vector<std::string>& words) {
  CLI::App& app = *app_;
  format_help(app);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 expects them in reverse order
  } catch (const CLI::ParseError& error) {
    // CLI11 does not report the unknown word when a command is missing.
    const std::string word = words.empty() ? "" : words.front();
    if (!word.empty() && !word.starts_with('-') && app.get_subcommands().empty() && !app.get_subcommands({}).empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      print_formatted(stderr, "%s: no command is called \"%s\"; %s\n", app.get_name().c_str(), word.c_str(),
                      suggest(word, known).c_str());
      return 2;
    }
    // Help and version are no errors; every usage error is 2, regardless of CLI11's code.
    if (error.get_exit_code() == 0) return finish(app, app.exit(error));
    // Found before the words are parsed again, because that changes the named command.
    const std::string meant = with_nearest(app, error.what()), called = command_called(app);
    std::vector<std::string> all = all_mistakes(app, error, words);
    all.front() = meant;
    for (const std::string& mistake : all)
      print(stderr, called + ": " + (&mistake == &all.front() ? mistake : with_nearest(app, mistake)) + "\n");
    if (all.size() > 1) std::fprintf(stderr, "%zu mistakes; nothing was started\n", all.size());
    print(stderr, called + " --help lists what it takes\n");
    return 2;
  }
  try {
    return finish(app, run_());
  } catch (const std::exception& error) {
    print_formatted(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return 1;
  }
}

OptionCheck one_of(const std::vector<std::string>& names) {
  const CLI::Validator member = CLI::IsMember(names, CLI::ignore_case);
  return {[member, names](std::string& text) {
            return member(text).empty() ? std::string() : "\"" + text + "\" is unknown; " + suggest(text, names);
          },
          member.get_description()};
}

}  // namespace tandem::io
