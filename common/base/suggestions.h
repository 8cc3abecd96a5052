#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem {

/// Returns the edit distance with insertions, deletions, substitutions and swaps of neighbours [Damerau 1964, optimal
/// string alignment].
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// Returns the known word nearest to `word`, ignoring case; nullptr if none is near. Where spelling decides nothing, a
/// word of at least three letters is near to the known words that begin with it; the first of them is returned.
[[nodiscard]] inline const std::string* nearest_match(std::string_view word, std::span<const std::string> known) {
  const auto lower = [](std::string_view text) {
    std::string out(text);
    for (char& c : out)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
  };
  // Words are cut, so that a hostile file cannot cause quadratic time.
  const std::string head = lower(word.substr(0, 64));
  const std::string* nearest = nullptr;
  std::size_t best = std::max<std::size_t>(2, head.size() / 3) + 1;
  for (const auto& candidate : known) {
    if (candidate.empty()) continue;
    if (const auto distance = edit_distance(head, lower(candidate)); distance < best) {
      best = distance;
      nearest = &candidate;
    }
  }
  if (nearest != nullptr || head.size() < 3) return nearest;
  for (const auto& candidate : known)
    if (lower(candidate).starts_with(head)) return &candidate;
  return nullptr;
}

/// Returns the hint for an unknown word: `did you mean x?` if a known word is near, then all known words.
[[nodiscard]] inline std::string suggest(std::string_view word, std::span<const std::string> known) {
  std::string all;
  for (const auto& candidate : known)
    if (!candidate.empty()) all += (all.empty() ? "" : ", ") + candidate;
  const std::string* const nearest = nearest_match(word, known);
  std::string text;
  if (nearest != nullptr) text = "did you mean " + *nearest + "? ";
  return text + (all.empty() ? "none is available" : "known here: " + all);
}

/// Returns the same hint, if the known words are the names of `rows`.
template <class Rows>
[[nodiscard]] std::string suggest_name(std::string_view word, const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return suggest(word, names);
}

}  // namespace tandem
