#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/socket_address.h"
#include "common/io/udp_socket.h"
#include "common/link/link.h"
#include "common/trust/pin.h"
#include "hal/device.h"
#include "proto/control_messages.h"
#include "proto/seat_setup.h"

namespace tandem::trust {
class ControlClient;
}

namespace tandem::client {

/// What somebody wants of a server.
struct Asking {
  io::SocketAddress server;
  std::string seat;            ///< empty: only to judge the link (proto/visit.h)
  std::string session;         ///< name, code or id; empty: the only one
  std::string ticket;          ///< as `tandem-server ticket` printed it; empty: none
  std::string state;           ///< folder of this workstation's key as typed; empty: the usual place
  hal::DeviceCaps caps;
  Duration patience{};         ///< for a server that does not answer
  int signals = -1;            ///< file of signals.h
  std::optional<AccessRole> console{};  ///< no seat and no visit: who looks after a session. On the server's own computer: in this role
};

/// A seat that was given.
struct GivenSeat {
  SeatSetup setup;
  link::Link::Params link;
  io::SocketAddress udp;       ///< where its datagrams go
  control::Welcome welcome;
  trust::Pin server;           ///< its key
  bool local = false;          ///< known by what it laid down for this user on this computer, not by an enrolment
  std::shared_ptr<trust::ControlClient> connection{};  ///< by which it was given; the seat does not need it. Null: of who judges his link
};

/// A control connection of somebody who sits on no seat.
struct Console {
  control::Welcome welcome;
  std::shared_ptr<trust::ControlClient> connection;
};

/// Why there is none.
struct NotSeated {
  bool interrupted = false;    ///< a signal ended it
  std::string reason;          ///< cause and remedy; or which signal
};

/// Joins over a TLS connection: proves both keys, shows a ticket, a code, or on this very computer what the server laid down for its
/// user, and takes the datagrams' secrets. Waits for the answer.
[[nodiscard]] std::expected<GivenSeat, NotSeated> ask_for_seat(const Asking& asking);

/// Joins without a seat, by a ticket. @pre asking.console, no asking.seat
[[nodiscard]] std::expected<Console, NotSeated> ask_for_console(const Asking& asking);

/// A seat that this client had, and what it may come back with.
struct OwnSeat {
  control::Id session{};
  std::uint64_t epoch = 0;             ///< a server of a lower one is an old one
  std::vector<Secret<32>> secrets;     ///< newest first: a server that died may know only the one before
  SeatSetup setup;
  trust::Pin server;
  bool local = false;                  ///< then a server of another key is the same one if this user's runtime folder knows that key
};
/// Why nobody came back.
struct NotBack {
  enum class Kind : std::uint8_t {
    kAgain,        ///< nobody there, or not now
    kGone,         ///< the seat is not his any more, or the session is over: asking again is no use
    kNotNeeded,    ///< meanwhile the server is heard again
    kInterrupted,
  } kind = Kind::kAgain;
  std::string reason;      ///< for a person
  Duration wait{};         ///< kAgain: not before
};
/// One attempt to come back, over a new TLS connection: to the same server only, and never to one of a lower epoch. Blocks for at most
/// twice `asking.patience`; `asking.signals` readable: it gives up.
/// @param wanted  asked just before it is said who comes back: from then on the old connection is void
[[nodiscard]] std::expected<GivenSeat, NotBack> ask_for_own_seat(const Asking& asking, const OwnSeat& own, const std::function<bool()>& wanted);

/// Words of the server or of this client with what was typed to reach it added to the `tandem-client` commands in them.
/// @param session  the name of the one joined; empty: none was
[[nodiscard]] std::string complete_commands(std::string text, const Asking& asking, const std::string& session = {}, bool by_ticket = false);

/// The sessions that are open there.
[[nodiscard]] std::expected<control::SessionList, NotSeated> ask_for_sessions(const Asking& asking);

/// Tells the server that a seat just given will not be used, so that it is free for others at once.
void give_back(const io::UdpSocket& socket, const GivenSeat& given, const hal::DeviceCaps& caps);

}  // namespace tandem::client
