#pragma once

#include <string>
#include <vector>

#include "client/diagnostics/link_test.h"

namespace tandem::client {

/// Grade of a link for force feedback.
enum class LinkGrade { kGood, kUsable, kBad };

struct LinkVerdict {
  LinkGrade grade = LinkGrade::kGood;
  std::string text;                 ///< consequence for the user, one sentence
  std::vector<std::string> advice;  ///< each finding that limits the grade, with its remedy
};

/// True if the server or the network was already gone when the test stopped. Such a test is incomplete.
[[nodiscard]] bool server_lost(const LinkTestResult& findings) noexcept;

/// Returns the grade of a link with reasons. Limits of silence and loop age are those of the scene. All others are
/// fixed bands. Good: up to 20 ms round trip, 2 ms jitter, 0.1 % loss. Usable: up to 10 ms jitter, 10 % loss, gaps of
/// 50 ms. Else bad.
[[nodiscard]] LinkVerdict assess_link(const LinkTestResult& findings);

[[nodiscard]] const char* to_text(LinkGrade grade) noexcept;
/// Returns all measured values, one line each, for a terminal.
[[nodiscard]] std::string summary(const LinkTestResult& findings);

}  // namespace tandem::client
