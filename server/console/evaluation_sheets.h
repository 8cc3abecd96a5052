#pragma once

#include <cstdint>
#include <expected>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace tandem::console {

/// A rating scale: its items, and the points that an item can get.
struct SheetForm {
  const char* name;
  std::int64_t least, most;
  std::span<const char* const> items;
};

/// Returns OSATS (global rating, Martin et al. 1997), GEARS (Goh et al. 2012), GOALS (Vassiliou et al. 2005) or
/// CHECKLIST; null: another name.
[[nodiscard]] const SheetForm* sheet_form(std::string_view name) noexcept;

/// A sheet of one evaluator about one person.
struct EvaluationSheet {
  std::string form;                              ///< name of a SheetForm
  std::string of;                                ///< seat of the evaluated person
  std::map<std::string, std::int64_t> scores{};  ///< by item; items may be missing
  bool closed = false;
};

/// Checks form, items and points. @return error: names the wrong key and what is allowed
[[nodiscard]] std::expected<void, std::string> check(const EvaluationSheet& sheet);

}  // namespace tandem::console
