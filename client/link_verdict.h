#pragma once

#include <string>
#include <vector>

#include "client/link_test.h"

namespace tandem::client {

/// Whether hands can hold a tool over this link.
enum class LinkGrade { kGood, kUsable, kBad };

struct LinkVerdict {
  LinkGrade grade = LinkGrade::kGood;
  std::string words;                ///< what it means for a hand, one sentence
  std::vector<std::string> advice;  ///< each finding that is worth acting on, with its remedy
};

/// Limits are the scene's own (silence, age of the loop) where it has some, else those of ARCHITECTURE's table of delays.
[[nodiscard]] LinkVerdict judge(const LinkFindings& findings);

[[nodiscard]] const char* to_text(LinkGrade grade) noexcept;
/// Everything measured, a line each, for a terminal.
[[nodiscard]] std::string summary(const LinkFindings& findings);

}  // namespace tandem::client
