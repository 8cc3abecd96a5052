#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Reads the repository as text: files, their code without comments and literals, their includes.
namespace tandem::tidy {

/// One file; `path` is relative to the root, with '/'. `code` is `text` with comments and the inside of string and
/// character literals blanked. Both have the same length and line ends, so an offset denotes the same place in both.
struct SourceFile {
  std::string path;
  std::string text;
  std::string code;
};

struct Include {
  std::string path;
  bool quoted = false;  ///< "x" instead of <x>
  std::size_t line = 0;
};

/// A violation at `path:line` (line 0: the whole file).
struct Finding {
  std::string path;
  std::size_t line = 0;
  std::string message;
};

/// Returns the findings as the message of a failed test.
[[nodiscard]] std::string to_string(const std::vector<Finding>& findings);

/// Returns C++ source with comments and literals blanked. Recognises raw strings and digit separators.
[[nodiscard]] std::string blank_comments_and_literals(std::string_view text);

[[nodiscard]] SourceFile make_source(std::string path, std::string text);
[[nodiscard]] std::vector<Include> includes_of(const SourceFile& file);

/// Returns the lines (from 1) on which `word` occurs in `text`. Where `word` begins or ends with an identifier
/// character, the neighbour must not be one: "mutex" is not found in "mutexes". A '*' at the end of `word` matches any
/// continuation.
[[nodiscard]] std::vector<std::size_t> lines_with(std::string_view text, std::string_view word);

[[nodiscard]] bool is_cpp(std::string_view path);
/// Returns whether `path` is `folder` or lies in it.
[[nodiscard]] bool is_within(std::string_view path, std::string_view folder);
/// Returns whether one of the folders of `path` is called `name`.
[[nodiscard]] bool has_folder(std::string_view path, std::string_view name);

/// Returns all text files of the source folders and of the top level, sorted by path.
[[nodiscard]] std::vector<SourceFile> read_repository(const std::filesystem::path& root);

}  // namespace tandem::tidy
