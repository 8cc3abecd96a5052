#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "proto/rpc/rpc_messages.h"
#include "server/console/evaluation_sheets.h"

namespace tandem::console {

inline constexpr std::size_t kFrameMax = 16384;    ///< frame of a browser [bytes]
inline constexpr unsigned kFramesPerSecond = 240;  ///< frames of one browser

/// The page drew state `n`.
struct Ack {
  std::uint64_t n = 0;
};
/// The page asks for the scene of a session, 32 hexadecimal digits.
struct Watch {
  std::uint64_t id = 0;
  std::string session;
};
/// Command of a person, as the server receives it.
struct Order {
  std::uint64_t id = 0;
  rpc::Body body;
};
/// The person takes a free MASTER seat of the watched session. `ticket`: for that seat; empty: by the gateway's right.
struct TakeSeat {
  std::uint64_t id = 0;
  std::string seat, ticket;
};
/// The person leaves the seat of this page.
struct LeaveSeat {
  std::uint64_t id = 0;
};
/// Where the person in the seat of this page points [m], frame of the scene; `pressed`: holds the handle.
struct Pointer {
  std::array<double, 3> x{};
  bool pressed = false;
};
/// The person asks for a URL for another browser.
struct Invite {
  std::uint64_t id = 0;
};
/// A mark on the timeline.
struct MarkFrame {
  std::uint64_t id = 0;
  std::optional<double> t_s;  ///< session time [s]
  std::string text;
};
/// A sheet of an evaluator. Its form, items and points are checked.
struct SheetFrame {
  std::uint64_t id = 0;
  EvaluationSheet sheet;
};
using BrowserFrame = std::variant<Ack, Watch, Order, TakeSeat, LeaveSeat, Pointer, Invite, MarkFrame, SheetFrame>;

struct FrameError {
  bool close = false;  ///< no JSON object: the gateway closes the connection
  std::optional<std::uint64_t> id{};
  std::string text;  ///< cause and remedy
};

/// Parses a frame of a browser. Refuses unknown types and keys, values out of range, and orders that the role may not
/// give (server/policy/roles.h).
/// @param session  the session of the gateway's connection, which orders get
[[nodiscard]] std::expected<BrowserFrame, FrameError> parse_browser_frame(std::string_view text, AccessRole role,
                                                                          const rpc::Id& session);

}  // namespace tandem::console
