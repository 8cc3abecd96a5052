#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/auth/key_fingerprint.h"
#include "proto/rpc/rpc_messages.h"

/// Messages of the gateway to the page, as JSON texts. A value that is not known is null. Texts of participants are
/// valid UTF-8 afterwards.
namespace tandem::console {

[[nodiscard]] std::string session_hex(const rpc::Id& session);
[[nodiscard]] const char* phase_text(rpc::SessionPhase phase) noexcept;
/// Abilities of a page beyond those of the person's role.
struct PageOffers {
  bool seats = false;              ///< the gateway gives seats to browsers
  bool invite = false;             ///< the person may ask for a URL for another browser
  std::string play{};              ///< seat to take at once; empty: none
  bool proved = false;             ///< the person's name is that of a ticket
  bool recordings = false;         ///< the gateway has recordings; the role decides whether the person sees them
  const rpc::SceneList* scenes{};  ///< from which the person may create sessions; null: none
  std::string workstation{};       ///< of the gateway; empty: not known
};
/// @param person    name for display
/// @param release   version of the program
/// @param sessions  those that the person may see
[[nodiscard]] std::string hello_json(std::string_view person, AccessRole role, std::string_view release,
                                     std::span<const rpc::ListedSession> sessions, const PageOffers& offers = {});
[[nodiscard]] std::string event_json(const rpc::Id& session, const rpc::StatusEvent& event);
[[nodiscard]] std::string reply_json(std::optional<std::uint64_t> id, bool ok, std::string_view text);
/// A created session with the tickets of its seats, for the person who created it only.
/// @param server  address of the server, as the gateway reaches it
/// @param own     key of the gateway's workstation: browsers can use tickets for it only
[[nodiscard]] std::string tickets_json(const rpc::SessionCreated& created, std::string_view server,
                                       const auth::KeyFingerprint& own);
/// @param level   info, warning or error
/// @param server  "lost", "gone" (the gateway does not try again) or "back"; empty: the notice is about something else
[[nodiscard]] std::string notice_json(std::string_view level, std::string_view text, std::string_view server = {});

}  // namespace tandem::console
