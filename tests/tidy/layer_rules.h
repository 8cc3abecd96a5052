#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "tests/tidy/source_text.h"

/// Compares the sources with the layers and allowed dependencies of ARCHITECTURE.md, which layer_table.cpp holds as
/// data.
namespace tandem::tidy {

/// A layer: a folder and everything it may include besides the C++ library, as prefixes of our headers and names of
/// libraries. The longest `folder` that a path begins with decides. It may also be the beginning of a file name, such
/// as "netsim/quality/quality_json". Folders called app may include everything except another program's app. Folders
/// called io may include what their layer may, and the operating system.
struct Layer {
  std::string_view folder;
  std::vector<std::string_view> may_include;  ///< our folders or files
  std::vector<std::string_view> libraries;    ///< "Eigen", "asio", ...
  std::string_view reason;
};

/// Words or headers that must not occur in some folders.
struct Ban {
  enum class In { kCode, kInclude, kText };  ///< words in code; whole includes; words anywhere, including comments
  In in = In::kCode;
  std::vector<std::string_view> words;
  std::vector<std::string_view> folders;      ///< folders of the ban; empty: everywhere
  std::vector<std::string_view> not_folders;  ///< names of folders ("app", "io") or path prefixes that are exempt
  std::vector<std::string_view> allowed;      ///< exempt files, each with its reason beside it in the table
  std::string_view reason;
};

[[nodiscard]] std::span<const Layer> layers();
[[nodiscard]] std::span<const Ban> bans();

/// Largest number of lines of a .h or .cpp file.
inline constexpr std::size_t kLinesMax = 400;

/// Checks all rules for one file.
[[nodiscard]] std::vector<Finding> check_layers(const SourceFile& file);

/// Finds files outside proto that include one of its private headers. A header of proto is private if it includes
/// generated code, directly or indirectly.
[[nodiscard]] std::vector<Finding> check_generated(std::span<const SourceFile> files);

/// Finds entries of the root that the list of this function and .gitignore do not name.
[[nodiscard]] std::vector<Finding> check_top_level(const std::filesystem::path& root);

}  // namespace tandem::tidy
