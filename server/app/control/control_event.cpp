#include "server/app/control/control_event.h"

#include "common/base/enumerator_count.h"

namespace tandem::server {

static_assert(kControlEvents == enumerator_count<ControlEvent>());

std::string_view to_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kNames{
      "accepted", "rate_limited", "handshake_failed", "deadline", "too_much_input", "bad_frame", "not_enrolled",
      "blocked",  "enrolled",     "code_refused",     "welcomed", "refused",        "command",   "command_rate_limited",
      "error",    "forbidden",    "evicted",          "idle",     "too_many"};
  const auto i = static_cast<std::size_t>(event);
  return i < kNames.size() ? kNames[i] : "?";
}

std::string_view control_event_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kWords{"connected",
                                                                "connected too often",
                                                                "failed in the TLS handshake",
                                                                "took too long",
                                                                "sent too much",
                                                                "sent an invalid message",
                                                                "is not enrolled here",
                                                                "is blocked after too many wrong codes",
                                                                "was enrolled",
                                                                "was refused for a wrong code",
                                                                "joined",
                                                                "was refused",
                                                                "sent a command",
                                                                "sent commands too often",
                                                                "met an error",
                                                                "may not do that",
                                                                "was closed for another connection",
                                                                "was silent for too long",
                                                                "had too many connections"};
  const auto i = static_cast<std::size_t>(event);
  return i < kWords.size() ? kWords[i] : "?";
}

}  // namespace tandem::server
