#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace tandem::io {

/// Wraps hand-written help at `width`. Paragraphs are filled and tables keep their columns. Commands in examples are
/// continued with a backslash, so that users can copy them. A line that begins with a space belongs to a table or an
/// example. A blank line, a heading and `Exit:` begin a new paragraph.
[[nodiscard]] std::string fill_paragraphs(std::string_view text, std::size_t width);

/// Wraps one line of other text between words: a command with a backslash, a table row below its second column.
[[nodiscard]] std::string wrap_line(std::string_view line, std::size_t width);

/// Help formatter of all Tandem programs: options in groups, wrapped to the terminal (without one to the variable
/// COLUMNS, else to 80 columns).
class HelpFormatter final : public CLI::Formatter {
 public:
  /// @param width  0: width of the terminal behind standard output, 40 to 120
  explicit HelpFormatter(std::size_t width = 0) : width_(width) {}
  /// Installs this formatter in a program and all its commands, and sorts options without a group into the usual ones.
  static void install(CLI::App& app);

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
