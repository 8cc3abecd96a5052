#pragma once

#include <string>
#include <vector>

/// What is wrong with a file that a person wrote, in a form that can be counted, sorted, tested and printed.
namespace tandem {

/// One mistake. Files are never corrected silently and never half accepted: all mistakes are listed together.
struct InputError {
  std::string file;
  int line = 0;         ///< from 1; 0: the place is unknown (JSON, decoded bytes, something that is missing)
  int column = 0;       ///< from 1, of the offending value, or of the key when the key itself is wrong; 0: unknown
  std::string key;      ///< path of the key, such as `seat[1].hand.k_n_m`; may be empty
  std::string value;    ///< as written; empty when there is none
  std::string message;  ///< what is wrong, what is allowed, and the remedy where there is one

  friend bool operator==(const InputError&, const InputError&) = default;
};

using InputErrors = std::vector<InputError>;

/// Adds what a later look at a file found, but for what an earlier mistake explains: one of the same key or of a key within
/// it. So that people learn all their mistakes at once and none twice.
void add_unexplained(InputErrors& earlier, InputErrors later);

/// `FILE:LINE:COLUMN: KEY = VALUE: MESSAGE`; parts that are unknown are left out.
[[nodiscard]] std::string to_text(const InputError& error);

/// One line per mistake, each ending in a line feed.
[[nodiscard]] std::string to_text(const InputErrors& errors);

}  // namespace tandem
