#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace tandem::io {

/// Breaks hand-written help at `width`: paragraphs are filled, tables keep their columns, commands of examples are continued with a backslash so
/// that they can be copied. A line that begins with a space belongs to a table or an example; a blank line, a heading and `Exit:` begin anew.
[[nodiscard]] std::string filled(std::string_view text, std::size_t width);

/// One line of other text, broken between words: a command with a backslash, a row of a table below its second column.
[[nodiscard]] std::string broken_line(std::string_view line, std::size_t width);

/// The help of all our programs: options in groups, everything wrapped to the terminal (elsewhere to the variable COLUMNS, else to 80 columns).
class HelpText final : public CLI::Formatter {
 public:
  /// @param width  0: of the terminal behind standard output, 40 to 120
  explicit HelpText(std::size_t width = 0) : width_(width) {}
  /// Gives this formatter to a program and all its commands, and sorts options without a group into the usual ones.
  static void give_to(CLI::App& app);

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;

 private:
  [[nodiscard]] std::size_t width() const;
  [[nodiscard]] std::string two_columns(const std::string& left, const std::string& right) const;

  std::size_t width_;
};

}  // namespace tandem::io
