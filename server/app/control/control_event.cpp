#include "server/app/control/control_event.h"

#include "common/base/enumerator_count.h"

namespace tandem::server {

static_assert(kControlEvents == enumerator_count<ControlEvent>());

namespace {

struct ControlEventTexts {
  std::string_view name = "?", clause = "?";
};

ControlEventTexts texts_of(ControlEvent event) noexcept {
  constexpr std::array<ControlEventTexts, kControlEvents> kTexts{{
      {"accepted", "connected"},
      {"rate_limited", "connected too often"},
      {"handshake_failed", "failed in the TLS handshake"},
      {"deadline", "took too long"},
      {"too_much_input", "sent too much"},
      {"bad_frame", "sent an invalid message"},
      {"not_enrolled", "is not enrolled here"},
      {"blocked", "is blocked after too many wrong codes"},
      {"enrolled", "was enrolled"},
      {"code_refused", "was refused for a wrong code"},
      {"welcomed", "joined"},
      {"refused", "was refused"},
      {"command", "sent a command"},
      {"command_rate_limited", "sent commands too often"},
      {"error", "met an error"},
      {"forbidden", "may not do that"},
      {"evicted", "was closed for another connection"},
      {"idle", "was silent for too long"},
      {"too_many", "had too many connections"},
      {"elsewhere", "was sent to another server of the service"},
  }};
  const auto i = static_cast<std::size_t>(event);
  return i < kTexts.size() ? kTexts[i] : ControlEventTexts{};
}

}  // namespace

std::string_view to_text(ControlEvent event) noexcept { return texts_of(event).name; }
std::string_view control_event_text(ControlEvent event) noexcept { return texts_of(event).clause; }

}  // namespace tandem::server
