#include "common/io/help_formatter.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "common/io/screen_block.h"
#include "common/io/text_layout.h"

namespace tandem::io {
namespace {

constexpr std::size_t kWidthMin = 40, kWidthMax = 120;
constexpr std::size_t kMissing = std::string_view::npos;

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

std::size_t indent_of(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

std::string_view trimmed(std::string_view line) {
  line.remove_prefix(indent_of(line));
  while (line.ends_with(' ')) line.remove_suffix(1);
  return line;
}

/// Returns where the second column of a table row begins; kMissing: it has only one.
std::size_t second_column(std::string_view line) {
  const std::size_t gap = line.find("  ", indent_of(line));
  return gap == kMissing ? kMissing : line.find_first_not_of(' ', gap);
}

/// Returns whether a line begins with a Tandem program, with or without its directory.
bool is_command(std::string_view line) {
  std::string_view word = trimmed(line);
  word = word.substr(0, word.find(' '));
  if (const auto slash = word.rfind('/'); slash != kMissing && !word.starts_with("./")) word.remove_prefix(slash + 1);
  return word.starts_with("tandem-") || word.starts_with("./");
}

/// Returns whether a line such as `Exit: ...` begins a new paragraph.
bool begins_paragraph(std::string_view line) {
  const std::size_t end = line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
  return end != kMissing && end > 0 && line[end] == ':' && line.front() >= 'A' && line.front() <= 'Z';
}

/// Allows breaks before each part in brackets in syntax words that are wider than a line.
std::string with_breaks(std::string_view text, std::size_t room) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size() - 1) + 1;  // with the space
    const std::string_view word = text.substr(at, end - at);
    for (const char c : word) out += c == '[' && display_width(word) > room ? std::string(" [") : std::string(1, c);
    at = end;
  }
  return out;
}

/// Returns a command over several lines that a shell reads as one.
std::string command_lines(std::string_view command, std::size_t width, std::size_t indent) {
  std::string out;
  std::vector<std::string> lines = wrap_words(command, width > indent + 4 ? width - indent - 2 : 1, 4);
  for (std::size_t i = 0; i < lines.size(); ++i)
    out += std::string(indent, ' ') + lines[i] + (i + 1 < lines.size() ? " \\\n" : "\n");
  return out;
}

/// Collects and fills paragraphs.
class Filling {
 public:
  explicit Filling(std::size_t width) : width_(width) {}

  void line(std::string_view line, std::string_view next) {
    if (trimmed(line).empty()) {
      flush();
      out_ += '\n';
    } else if (line.front() == ' ') {
      indented(line);
    } else if (next.starts_with(' ') && line.size() < 50 && !line.ends_with('.')) {
      flush();  // a heading
      out_ += std::string(line) + "\n";
    } else {
      if (row_ || begins_paragraph(line)) flush();
      add(trimmed(line));
    }
  }
  std::string end() {
    flush();
    return std::move(out_);
  }

 private:
  void indented(std::string_view line) {
    const std::size_t indent = indent_of(line);
    const bool continues = row_ && indent > indent_ && (hang_ == kMissing || indent >= hang_ || command_);
    if (continues) return add(trimmed(line));
    flush();
    row_ = true;
    indent_ = indent;
    command_ = is_command(line);
    hang_ = command_ ? kMissing : second_column(line);
    if (hang_ == kMissing) return add(trimmed(line));
    left_ = trimmed(line.substr(0, hang_));
    add(trimmed(line.substr(hang_)));
  }
  void add(std::string_view words) { text_ += (text_.empty() ? "" : " ") + std::string(words); }
  void flush() {
    if (text_.empty() && left_.empty()) return;
    if (command_) {
      out_ += command_lines(text_, width_, indent_);
    } else {
      std::string start(indent_, ' ');
      std::size_t hang = row_ ? indent_ + 2 : 0;
      if (hang_ != kMissing) {
        start += left_;
        hang = hang_ <= width_ / 2 ? hang_ : indent_ + 4;
        if (display_width(start) + 2 > hang) {
          for (const std::string& part : wrap_words(with_breaks(start, width_), width_, indent_ + 4))
            out_ += part + "\n";
          start.clear();
        }
        start.resize(std::max(start.size(), hang), ' ');
      }
      const std::vector<std::string> lines =
          wrap_words(with_breaks(text_, width_ - hang), width_, hang, display_width(start));
      for (std::size_t i = 0; i < lines.size(); ++i) out_ += (i == 0 ? start : "") + lines[i] + "\n";
    }
    text_.clear();
    left_.clear();
    row_ = command_ = false;
    indent_ = 0;
    hang_ = kMissing;
  }

  std::size_t width_;
  std::string out_, text_, left_;
  bool row_ = false, command_ = false;
  std::size_t indent_ = 0, hang_ = kMissing;
};

}  // namespace

std::string fill_paragraphs(std::string_view text, std::size_t width) {
  Filling filling{width};
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    filling.line(line, text.substr(0, text.find('\n')));
  }
  return filling.end();
}

std::string wrap_line(std::string_view line, std::size_t width) {
  const std::size_t indent = indent_of(line);
  if (indent > 0 && is_command(line)) return command_lines(trimmed(line), width, indent);
  const std::size_t second = second_column(line);
  const std::size_t hang = second == kMissing ? 0 : display_width(line.substr(0, second));
  std::string out;
  for (const std::string& part : wrap_words(line, width, hang > 0 && hang <= width / 2 ? hang : indent + 2))
    out += part + "\n";
  return out;
}

void HelpFormatter::install(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  // Same style as the descriptions of the other options.
  for (const auto& [name, words] :
       {std::pair{"--help", "prints this and ends"}, {"--version", "prints the version and ends"}})
    if (CLI::Option* const option = app.get_option_no_throw(name)) option->description(words);
  for (CLI::Option* const option : app.get_options())
    if (option->get_group() == "Options") option->group(group_of(*option));
  for (CLI::App* const command : app.get_subcommands({})) install(*command);
}

std::size_t HelpFormatter::width() const {
  return width_ > 0 ? width_ : std::clamp(screen_size(STDOUT_FILENO).columns, kWidthMin + 1, kWidthMax + 1) - 1;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
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

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return fill_paragraphs(app->get_description(), width());
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  return fill_paragraphs(app->get_footer(), width());
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  return two_columns(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns(command->get_name(), command->get_description());
}

std::string HelpFormatter::two_columns(const std::string& left, const std::string& right) const {
  const std::size_t column = std::min<std::size_t>(28, width() / 3);
  std::string flat = right;
  std::ranges::replace(flat, '\n', ' ');
  std::string start = "  " + left;
  std::string out;
  if (display_width(start) + 2 > column) {
    out = start + "\n";
    start.clear();
  }
  start.resize(std::max(start.size(), column), ' ');
  const std::vector<std::string> lines = wrap_words(with_breaks(flat, width() - column), width(), column, column);
  for (std::size_t i = 0; i < lines.size(); ++i) out += (i == 0 ? start : "") + lines[i] + "\n";
  return out;
}

}  // namespace tandem::io
