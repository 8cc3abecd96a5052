#include "tests/tidy/source_text.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tandem::tidy {
namespace {

constexpr std::array<std::string_view, 8> kFolders{"client", "common", "hal",    "netsim",
                                                   "proto",  "server", "tandem", "tests"};
constexpr std::array<std::string_view, 10> kTextEndings{".h",    ".cpp",       ".proto", ".txt", ".cmake",
                                                        ".json", ".textproto", ".md",    ".sh",  ".csv"};

bool is_identifier(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Blanks [from, to) but keeps line ends.
void blank(std::string& text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < std::min(to, text.size()); ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

/// Returns the index of the quote that ends the literal opened at `open`, or the end of its line.
std::size_t end_of_literal(std::string_view text, std::size_t open) {
  for (std::size_t i = open + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == text[open] || text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

/// Returns whether the quote at `quote` opens a raw string: R", uR", LR", u8R".
bool opens_raw_string(std::string_view text, std::size_t quote) {
  if (quote == 0 || text[quote - 1] != 'R') return false;
  std::size_t first = quote - 1;
  while (first > 0 && is_identifier(text[first - 1])) --first;
  const std::string_view prefix = text.substr(first, quote - first);
  return prefix == "R" || prefix == "uR" || prefix == "UR" || prefix == "LR" || prefix == "u8R";
}

}  // namespace

std::string to_string(const std::vector<Finding>& findings) {
  std::string all;
  for (const Finding& f : findings) {
    all += "  " + f.path + (f.line == 0 ? "" : ":" + std::to_string(f.line)) + ": " + f.message + "\n";
  }
  return all;
}

std::string blank_comments_and_literals(std::string_view text) {
  std::string out(text);
  std::size_t i = 0;
  while (i < text.size()) {
    if (text.substr(i, 2) == "//") {
      const std::size_t end = std::min(text.find('\n', i), text.size());
      blank(out, i, end);
      i = end;
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t close = text.find("*/", i + 2);
      const std::size_t end = close == std::string_view::npos ? text.size() : close + 2;
      blank(out, i, end);
      i = end;
    } else if (text[i] == '"' && opens_raw_string(text, i)) {
      const std::size_t paren = std::min(text.find('(', i), text.size());
      const std::string closing = ")" + std::string(text.substr(i + 1, paren - i - 1)) + "\"";
      const std::size_t close = text.find(closing, paren);
      const std::size_t end = close == std::string_view::npos ? text.size() : close + closing.size();
      blank(out, i + 1, end - 1);
      i = end;
    } else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || !is_identifier(text[i - 1])))) {
      const std::size_t end = end_of_literal(text, i);
      blank(out, i + 1, end);
      i = end + 1;
    } else {
      ++i;
    }
  }
  return out;
}

SourceFile make_source(std::string path, std::string text) {
  std::string code = is_cpp(path) ? blank_comments_and_literals(text) : text;
  return {std::move(path), std::move(text), std::move(code)};
}

std::vector<Include> includes_of(const SourceFile& file) {
  std::vector<Include> found;
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < file.code.size(); ++line) {
    const std::size_t end = std::min(file.code.find('\n', begin), file.code.size());
    const std::string_view code = std::string_view(file.code).substr(begin, end - begin);
    const std::string_view text = std::string_view(file.text).substr(begin, end - begin);
    begin = end + 1;
    const std::size_t hash = code.find_first_not_of(" \t");
    if (hash == std::string_view::npos || code[hash] != '#') continue;
    const std::size_t word = code.find_first_not_of(" \t", hash + 1);
    if (word == std::string_view::npos || !code.substr(word).starts_with("include")) continue;
    const std::size_t open = text.find_first_of("<\"", word);
    if (open == std::string_view::npos) continue;
    const std::size_t close = text.find(text[open] == '<' ? '>' : '"', open + 1);
    if (close == std::string_view::npos) continue;
    found.push_back({std::string(text.substr(open + 1, close - open - 1)), text[open] == '"', line});
  }
  return found;
}

std::vector<std::size_t> lines_with(std::string_view text, std::string_view word) {
  const bool open_end = word.ends_with('*');
  if (open_end) word.remove_suffix(1);
  std::vector<std::size_t> lines;
  std::size_t line = 1;
  std::size_t counted = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t after = at + word.size();
    if (is_identifier(word.front()) && at > 0 && is_identifier(text[at - 1])) continue;
    if (!open_end && is_identifier(word.back()) && after < text.size() && is_identifier(text[after])) continue;
    line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    counted = at;
    if (lines.empty() || lines.back() != line) lines.push_back(line);
  }
  return lines;
}

bool is_cpp(std::string_view path) { return path.ends_with(".h") || path.ends_with(".cpp"); }

bool is_within(std::string_view path, std::string_view folder) {
  return path == folder || (path.starts_with(folder) && path.substr(folder.size()).starts_with('/'));
}

bool has_folder(std::string_view path, std::string_view name) {
  for (std::size_t slash = path.find('/'); slash != std::string_view::npos; slash = path.find('/')) {
    if (path.substr(0, slash) == name) return true;
    path.remove_prefix(slash + 1);
  }
  return false;
}

std::vector<SourceFile> read_repository(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<SourceFile> files;
  const auto add = [&](const fs::path& path) {
    files.push_back(make_source(fs::relative(path, root).generic_string(), read_file(path)));
  };
  const auto is_text = [](const std::string& name) {
    return std::ranges::any_of(kTextEndings, [&](std::string_view end) { return name.ends_with(end); });
  };
  for (const std::string_view folder : kFolders) {
    if (!fs::is_directory(root / folder)) continue;
    for (auto at = fs::recursive_directory_iterator(root / folder); at != fs::recursive_directory_iterator(); ++at) {
      const std::string name = at->path().filename().string();
      if (name == "node_modules") at.disable_recursion_pending();  // packages of others, not in the repository
      if (at->is_regular_file() && is_text(name)) add(at->path());
    }
  }
  for (const auto& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && (is_text(name) || name == "demo" || name == "test")) add(entry.path());
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace tandem::tidy
