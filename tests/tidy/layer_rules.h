#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "tests/tidy/source_text.h"

/// The table of rooms of ARCHITECTURE.md as data, and the engine that holds sources against it.
namespace tandem::tidy {

/// A folder and all it may include besides the C++ library: prefixes of our own headers and names of libraries.
/// The longest `folder` that a path begins with decides ("netsim/world" takes netsim/world.h and netsim/world/ alike).
/// Folders called app may include all but another program's app, folders called io what their room may and the
/// operating system besides.
struct Room {
  std::string_view folder;
  std::vector<std::string_view> may_include;  ///< folders or files of ours
  std::vector<std::string_view> libraries;    ///< "Eigen", "asio", ...
  std::string_view reason;
};

/// Words or headers that must not occur in some folders.
struct Ban {
  enum class In { kCode, kInclude, kText };  ///< words in code; whole includes; words anywhere, comments too
  In in = In::kCode;
  std::vector<std::string_view> words;
  std::vector<std::string_view> folders;      ///< where; empty: everywhere
  std::vector<std::string_view> not_folders;  ///< names of folders ("app", "io") or path prefixes that are free of it
  std::vector<std::string_view> allowed;      ///< files that may, each with its reason beside it in the table
  std::string_view reason;
};

[[nodiscard]] std::span<const Room> rooms();
[[nodiscard]] std::span<const Ban> bans();

/// Longest .h or .cpp file.
inline constexpr std::size_t kLinesMax = 400;
/// Files that may be longer, printed by the test.
[[nodiscard]] std::span<const std::string_view> longer_files();

/// All rules over one file.
[[nodiscard]] std::vector<Finding> check_layers(const SourceFile& file);

/// Headers of proto that include generated code, directly or through each other, are private: who outside includes one?
[[nodiscard]] std::vector<Finding> check_generated(std::span<const SourceFile> files);

/// Entries of the root that product.md does not prescribe and .gitignore does not name.
[[nodiscard]] std::vector<Finding> check_top_level(const std::filesystem::path& root);

}  // namespace tandem::tidy
