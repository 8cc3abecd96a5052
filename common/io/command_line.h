#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/io/option_check.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The command line of all Tandem programs. CLI11, which takes seconds to compile, is included by command_line.cpp
/// only.
namespace tandem::io {

/// One option or positional argument of a command. A handle: copies refer to the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  /// Sets the name of the value in the help, such as `FILE|-`; default: its type and the allowed values.
  Option& value_name(const std::string& name);
  Option& required();
  /// Sets the heading of the option in the help; default: by its name, such as "Output" for `--json`.
  Option& group(const std::string& heading);
  /// Checks the text before its conversion. At most one check per option.
  Option& check(const OptionCheck& check);
  /// Takes one value each time that the option is given. Default of a list: all words up to the next option.
  Option& one_value();
  /// Allows the option without a value, which then stays as it was; `Command::given` reports that it was there.
  Option& optional_value();

 private:
  CLI::Option* option_;
};

/// A program or one of its commands. A handle: copies refer to the same command, which lives as long as its Program.
class Command {
 public:
  Command() = default;  ///< no command: only for assignment
  Command(CLI::App& app, std::function<int()>& chosen) : app_(&app), chosen_(&chosen) {}

  /// Adds a command that calls `run` when the user chooses it. @return the command, and the arguments that `run` gets
  template <class Arguments>
  [[nodiscard]] std::pair<Command, Arguments&> add_command(const std::string& name, const std::string& description,
                                                           int (*run)(const Arguments&)) const {
    const auto arguments = std::make_shared<Arguments>();  // its options refer to it as long as the program lives
    return {add_command(name, description, [arguments, run] { return run(*arguments); }), *arguments};
  }

  /// Adds an option (`--name`) or a positional argument (`NAME`).
  /// @tparam Value  std::string, double, std::uint64_t or std::vector<std::string>
  /// @param  value  receives the value, and must live as long as the program
  template <class Value>
  Option add_option(const std::string& name, Value& value, const std::string& description) const;
  /// Adds an option without a value.
  Option add_flag(const std::string& name, bool& value, const std::string& description) const;
  /// Appends the words after the options of this command to `rest`, unknown options too.
  void take_rest(std::vector<std::string>& rest) const;
  void alias(const std::string& name) const;
  void footer(const std::string& text) const;

  /// Returns whether the user gave this option; false also if the command has none of this name.
  [[nodiscard]] bool given(const std::string& option) const;

 private:
  [[nodiscard]] Command add_command(const std::string& name, const std::string& description,
                                    const std::function<int()>& run) const;

  CLI::App* app_ = nullptr;
  std::function<int()>* chosen_ = nullptr;
};

/// A program and its command line: help, version, usage errors and exit codes.
class Program {
 public:
  /// @param run  what the program does; empty: it requires one of its commands
  Program(const std::string& name, const std::string& version, const std::string& description,
          std::function<int()> run = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] Command root() { return {*app_, run_}; }

  /// Parses the words after the program's name and runs the chosen command. Usage errors end with exit code 2; an
  /// unknown command is reported with its nearest match. Unexpected exceptions end with 1.
  [[nodiscard]] int run(const std::vector<std::string>& words);

 private:
  std::unique_ptr<CLI::App> app_;
  std::function<int()> run_;
};

/// Accepts one of `names`, upper or lower case; the text becomes that name.
[[nodiscard]] OptionCheck one_of(const std::vector<std::string>& names);

}  // namespace tandem::io
