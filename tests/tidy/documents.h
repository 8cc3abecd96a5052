#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tidy/source_text.h"

/// Keeps ARCHITECTURE.md and README.md true: what they name exists.
namespace tandem::tidy {

/// What a document may name.
struct Known {
  std::set<std::string, std::less<>> tests;     ///< "Suite.Name"
  std::set<std::string, std::less<>> programs;  ///< "tandem-server", "./demo", ...
  std::string option_texts;                     ///< sources and scripts in which "--option" must occur
};

/// Tests from TEST, TEST_F, TEST_P, TYPED_TEST below tests/; programs from tandem_program(...) and the scripts of the
/// root.
[[nodiscard]] Known known_things(std::span<const SourceFile> files);

/// Fewest invariants ARCHITECTURE.md lists (the ten of the design).
inline constexpr std::size_t kInvariantsMin = 10;

/// The section whose heading contains "Invariants" lists them as "1. ..." or "| 1 | ...", numbered from 1 without gaps.
/// Each names, in backticks, at least one test that exists as `Suite.Name` and at least one file that enforces it.
[[nodiscard]] std::vector<Finding> check_invariants(const SourceFile& document, const Known& known,
                                                    const std::filesystem::path& root);

/// Each `Suite.Name` and each path into a room, in backticks, anywhere in the document, exists.
[[nodiscard]] std::vector<Finding> check_references(const SourceFile& document, const Known& known,
                                                    const std::filesystem::path& root);

/// Each row of the document's tables names, in backticks, at least one test that exists as `Suite.Name`.
[[nodiscard]] std::vector<Finding> check_rows(const SourceFile& document, const Known& known);

/// In ``` blocks: a line that begins with tandem-... or ./... (after "$ " or NAME=value) names an existing program, and
/// each of its --options occurs in the sources.
[[nodiscard]] std::vector<Finding> check_commands(const SourceFile& document, const Known& known);

}  // namespace tandem::tidy
