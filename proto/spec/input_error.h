#pragma once

#include <string>
#include <vector>

/// Errors in a file that a user wrote, in a form that can be counted, sorted, tested and printed.
namespace tandem {

/// One error. A file is never corrected silently and never accepted in part: all its errors are listed together.
struct InputError {
  std::string file;
  int line = 0;         ///< from 1; 0: the location is unknown (JSON, decoded bytes, a missing key)
  int column = 0;       ///< from 1; of the rejected value, or of the key if the key itself is wrong; 0: unknown
  std::string key;      ///< path of the key, such as `seat[1].hand.k_n_m`; may be empty
  std::string value;    ///< as written; empty when there is none
  std::string message;  ///< cause, allowed range, and remedy if there is one

  friend bool operator==(const InputError&, const InputError&) = default;
};

using InputErrors = std::vector<InputError>;

/// Appends the errors of a later check, except those that an earlier error explains: errors of the same key or of a key
/// within it. The user then reads all errors at once and none twice.
void add_unexplained(InputErrors& earlier, InputErrors later);

/// `FILE:LINE:COLUMN: KEY = VALUE: MESSAGE`; unknown parts are omitted.
[[nodiscard]] std::string to_text(const InputError& error);

/// One line per error, each ending in a line feed.
[[nodiscard]] std::string to_text(const InputErrors& errors);

}  // namespace tandem
