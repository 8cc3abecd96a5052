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

/// The server, or all between here and there, was gone when the test stopped: it is not whole, however long it took.
[[nodiscard]] bool server_lost(const LinkFindings& findings) noexcept;

/// Limits are the scene's own (silence, age of the loop) where it has some, else the bands of the design notes (network, 2.4):
/// good up to 20 ms round trip, 2 ms jitter, 0.1 % loss; usable up to 10 ms jitter, 10 % loss, gaps of 50 ms; else bad.
[[nodiscard]] LinkVerdict judge(const LinkFindings& findings);

[[nodiscard]] const char* to_text(LinkGrade grade) noexcept;
/// Everything measured, a line each, for a terminal.
[[nodiscard]] std::string summary(const LinkFindings& findings);

}  // namespace tandem::client
