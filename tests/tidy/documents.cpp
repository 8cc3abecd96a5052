#include "tests/tidy/documents.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace tandem::tidy {
namespace {

constexpr std::array<std::string_view, 8> kFolders{"client", "common", "hal",    "netsim",
                                                   "proto",  "server", "tandem", "tests"};
constexpr std::string_view kSpace = " \t\r\n";

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view trim(std::string_view s) {
  const std::size_t first = s.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!(line = trim(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of(kSpace), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

/// Returns the text between each pair of backticks on a line.
std::vector<std::string_view> quoted_in(std::string_view line) {
  std::vector<std::string_view> quoted;
  std::size_t open = line.find('`');
  while (open != std::string_view::npos) {
    const std::size_t close = line.find('`', open + 1);
    if (close == std::string_view::npos) break;
    quoted.push_back(line.substr(open + 1, close - open - 1));
    open = line.find('`', close + 1);
  }
  return quoted;
}

bool is_name(std::string_view s) {
  return !s.empty() && s.front() >= 'A' && s.front() <= 'Z' && std::ranges::all_of(s, is_word);
}

/// Returns whether `s` has the form `Suite.Name`, both beginning with a capital.
bool looks_like_test(std::string_view s) {
  const std::size_t dot = s.find('.');
  return dot != std::string_view::npos && is_name(s.substr(0, dot)) && is_name(s.substr(dot + 1));
}

/// Returns whether `s` is a path into a folder of kFolders, without wildcards or placeholders.
bool looks_like_path(std::string_view s) {
  const std::size_t slash = s.find('/');
  return slash != std::string_view::npos && std::ranges::find(kFolders, s.substr(0, slash)) != kFolders.end() &&
         std::ranges::all_of(s, [](char c) { return is_word(c) || c == '/' || c == '.' || c == '-'; });
}

/// Returns the number of an item, "12. ..." or "| 12 | ..."; nullopt for other lines.
std::optional<std::size_t> item_number(std::string_view line) {
  line = trim(line);
  const bool row = line.starts_with('|');
  if (row) line = trim(line.substr(1));
  std::size_t digits = 0;
  while (digits < line.size() && line[digits] >= '0' && line[digits] <= '9') ++digits;
  if (digits == 0 || digits > 4) return std::nullopt;
  const std::string_view rest = row ? trim(line.substr(digits)) : line.substr(digits);
  if (!rest.starts_with(row ? "|" : ". ")) return std::nullopt;
  return std::stoul(std::string(line.substr(0, digits)));
}

struct Item {
  std::size_t number = 0;
  std::size_t line = 0;
  std::vector<std::string_view> quoted;
};

std::vector<Item> invariants_of(std::string_view text) {
  std::vector<Item> items;
  bool inside = false;
  bool fenced = false;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (line.starts_with("```")) fenced = !fenced;
    if (!fenced && line.starts_with('#')) {
      inside = line.find("nvariants") != std::string_view::npos;
      continue;
    }
    if (!inside || fenced) continue;
    if (const auto n = item_number(line)) items.push_back({*n, number, {}});
    if (items.empty()) continue;
    for (const std::string_view q : quoted_in(line)) items.back().quoted.push_back(q);
  }
  return items;
}

void add_tests(const SourceFile& file, std::set<std::string, std::less<>>& tests) {
  const std::string_view code = file.code;
  for (std::size_t at = code.find("TEST"); at != std::string_view::npos; at = code.find("TEST", at + 1)) {
    const std::size_t open = code.find('(', at);
    if (open == std::string_view::npos) return;
    const std::string_view macro = code.substr(at, open - at);
    if (macro != "TEST" && macro != "TEST_F" && macro != "TEST_P") continue;
    const std::size_t comma = code.find(',', open);
    const std::size_t close = code.find(')', open);
    if (comma == std::string_view::npos || close == std::string_view::npos || comma > close) continue;
    tests.insert(std::string(trim(code.substr(open + 1, comma - open - 1))) + "." +
                 std::string(trim(code.substr(comma + 1, close - comma - 1))));
  }
}

/// Adds tests that are programs: add_test(NAME Suite.Name ...).
void add_program_tests(const SourceFile& file, std::set<std::string, std::less<>>& tests) {
  constexpr std::string_view kDeclaration = "add_test(NAME ";
  const std::string_view text = file.text;
  for (std::size_t at = text.find(kDeclaration); at != std::string_view::npos; at = text.find(kDeclaration, at + 1)) {
    const auto words = words_of(text.substr(at + kDeclaration.size(), 100));
    if (!words.empty()) tests.emplace(words.front());
  }
}

void add_programs(const SourceFile& file, std::set<std::string, std::less<>>& programs) {
  constexpr std::string_view kDeclaration = "tandem_program(";
  const std::string_view text = file.text;
  for (std::size_t at = text.find(kDeclaration); at != std::string_view::npos; at = text.find(kDeclaration, at + 1)) {
    const auto words = words_of(text.substr(at + kDeclaration.size(), 100));
    if (!words.empty() && words.front().starts_with("tandem-")) programs.emplace(words.front());
  }
}

/// Returns "tandem-server" for its path in a build folder.
std::string_view without_build_folder(std::string_view command) {
  for (const std::string_view prefix : {"./build/", "build/"}) {
    if (command.starts_with(prefix)) return command.substr(command.rfind('/') + 1);
  }
  return command;
}

bool is_assignment(std::string_view word) {
  const std::size_t equals = word.find('=');
  return equals != std::string_view::npos && is_name(word.substr(0, equals));
}

}  // namespace

Known known_things(std::span<const SourceFile> files) {
  Known known;
  for (const SourceFile& file : files) {
    if (is_cpp(file.path) && is_within(file.path, "tests")) add_tests(file, known.tests);
    if (file.path.ends_with("CMakeLists.txt")) {
      add_programs(file, known.programs);
      add_program_tests(file, known.tests);
    }
    if (file.path == "demo" || file.path == "test") known.programs.insert("./" + file.path);
    const bool script =
        file.path == "demo" || file.path == "test" || file.path.ends_with(".sh") || file.path == "tests/sim/mutations";
    if (script || (is_cpp(file.path) && !is_within(file.path, "tests/tidy"))) known.option_texts += file.text;
  }
  return known;
}

std::vector<Finding> check_invariants(const SourceFile& document, const Known& known,
                                      const std::filesystem::path& root) {
  std::vector<Finding> findings;
  const std::vector<Item> items = invariants_of(document.text);
  if (items.size() < kInvariantsMin) {
    findings.push_back({document.path, 0,
                        "lists " + std::to_string(items.size()) +
                            " numbered invariants under a heading \"Invariants\"; the design has " +
                            std::to_string(kInvariantsMin)});
  }
  std::size_t expected = 0;
  for (const Item& item : items) {
    const std::string name = "invariant " + std::to_string(item.number);
    if (item.number != ++expected) {
      findings.push_back({document.path, item.line, name + " should be number " + std::to_string(expected)});
    }
    const bool tested = std::ranges::any_of(item.quoted, [&](auto q) { return known.tests.contains(q); });
    if (!tested) findings.push_back({document.path, item.line, name + " names no existing test as `Suite.Name`"});
    const bool enforced = std::ranges::any_of(
        item.quoted, [&](auto q) { return looks_like_path(q) && std::filesystem::exists(root / q); });
    if (!enforced) findings.push_back({document.path, item.line, name + " names no existing file that enforces it"});
  }
  return findings;
}

std::vector<Finding> check_references(const SourceFile& document, const Known& known,
                                      const std::filesystem::path& root) {
  std::vector<Finding> findings;
  std::size_t number = 0;
  bool fenced = false;
  for (const std::string_view line : lines_of(document.text)) {
    ++number;
    if (line.starts_with("```")) fenced = !fenced;
    if (fenced) continue;
    for (const std::string_view q : quoted_in(line)) {
      if (looks_like_test(q) && !known.tests.contains(q)) {
        findings.push_back({document.path, number, "there is no test " + std::string(q)});
      }
      if (looks_like_path(q) && !std::filesystem::exists(root / q)) {
        findings.push_back({document.path, number, "there is no " + std::string(q)});
      }
    }
  }
  return findings;
}

std::vector<Finding> check_rows(const SourceFile& document, const Known& known) {
  std::vector<Finding> findings;
  std::size_t number = 0;
  bool body = false;  // of a table: below the line of dashes
  for (const std::string_view line : lines_of(document.text)) {
    ++number;
    const bool row = line.starts_with('|');
    if (body && row && std::ranges::none_of(quoted_in(line), [&](auto q) { return known.tests.contains(q); })) {
      findings.push_back({document.path, number, "this row names no existing test as `Suite.Name`"});
    }
    body = row && (body || line.starts_with("|-"));
  }
  return findings;
}

std::vector<Finding> check_commands(const SourceFile& document, const Known& known) {
  std::vector<Finding> findings;
  std::size_t number = 0;
  bool fenced = false;
  bool continued = false;
  for (const std::string_view line : lines_of(document.text)) {
    ++number;
    if (trim(line).starts_with("```")) {
      fenced = !fenced;
      continued = false;
      continue;
    }
    if (!fenced) continue;
    auto words = words_of(line);
    while (!words.empty() && (words.front() == "$" || is_assignment(words.front()))) words.erase(words.begin());
    if (words.empty()) continue;
    const std::string_view command = without_build_folder(words.front());
    const bool begins = command.starts_with("tandem-") || command.starts_with("./");
    if (begins && !known.programs.contains(command)) {
      findings.push_back({document.path, number, "there is no program " + std::string(command)});
    }
    if (!begins && !continued) continue;
    continued = words.back() == "\\";
    for (const std::string_view word : words) {
      if (word.starts_with('#')) break;
      const std::string_view option = word.substr(0, word.find('='));
      if (!option.starts_with("--") || option.size() < 4 || option == "--help" || option == "--version") continue;
      if (lines_with(known.option_texts, option).empty()) {
        findings.push_back({document.path, number, "no program knows the option " + std::string(option)});
      }
    }
  }
  return findings;
}

}  // namespace tandem::tidy
