#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tidy/source_text.h"

/// Checks that every test, path and command that ARCHITECTURE.md and README.md name exists.
namespace tandem::tidy {

/// Names that a document may use.
struct Known {
  std::set<std::string, std::less<>> tests;     ///< "Suite.Name"
  std::set<std::string, std::less<>> programs;  ///< "tandem-server", "./demo", ...
  std::string option_texts;                     ///< sources and scripts in which "--option" must occur
};

/// Collects tests from TEST, TEST_F, TEST_P, TYPED_TEST below tests/, and programs from tandem_program(...) and the
/// scripts of the root.
[[nodiscard]] Known known_things(std::span<const SourceFile> files);

/// Smallest number of invariants in ARCHITECTURE.md (the ten of the design).
inline constexpr std::size_t kInvariantsMin = 10;

/// Checks the section whose heading contains "Invariants". It lists them as "1. ..." or "| 1 | ...", numbered from 1
/// without gaps. Each names, in backticks, at least one test that exists as `Suite.Name` and at least one file that
/// enforces it.
[[nodiscard]] std::vector<Finding> check_invariants(const SourceFile& document, const Known& known,
                                                    const std::filesystem::path& root);

/// Checks that each `Suite.Name` and each path into a source folder exists, wherever the document names it in
/// backticks.
[[nodiscard]] std::vector<Finding> check_references(const SourceFile& document, const Known& known,
                                                    const std::filesystem::path& root);

/// Checks that each row of the document's tables names, in backticks, at least one test that exists as `Suite.Name`.
[[nodiscard]] std::vector<Finding> check_rows(const SourceFile& document, const Known& known);

/// Checks the commands in ``` blocks. A line that begins with tandem-... or ./... (after "$ " or NAME=value) names an
/// existing program, and each of its --options occurs in the sources.
[[nodiscard]] std::vector<Finding> check_commands(const SourceFile& document, const Known& known);

}  // namespace tandem::tidy
