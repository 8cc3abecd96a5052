#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tidy/source_text.h"

/// Finds words that the prose rule of CONTRIBUTING.md bans: idioms, gendered pronouns, and clauses without a named
/// actor.
namespace tandem::tidy {

/// A word or phrase that comments, messages, documents and test names do not use.
struct BannedPhrase {
  std::string_view phrase;  ///< lower case; single spaces
  std::string_view instead;
};

[[nodiscard]] std::span<const BannedPhrase> banned_phrases();

/// Returns the prose of a file, with the same length and line ends as its text. Prose is: comments, string literals and
/// test names of C++ sources, everything in a document, the comments of scripts, schemas and CMake files. All other
/// characters are blank.
[[nodiscard]] std::string prose_of(const SourceFile& file);

/// Returns every use of a banned phrase in the prose of `file`. Also returns every sentence that begins with "Who" or
/// with "What" and is no question.
[[nodiscard]] std::vector<Finding> check_prose(const SourceFile& file);

}  // namespace tandem::tidy
