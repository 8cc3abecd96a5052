#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>

#include "common/base/time.h"
#include "common/io/socket_address.h"
#include "common/io/udp_socket.h"
#include "common/link/link.h"
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

/// The sessions that are open there.
[[nodiscard]] std::expected<control::SessionList, NotSeated> ask_for_sessions(const Asking& asking);

/// Tells the server that a seat just given will not be used, so that it is free for others at once.
void give_back(const io::UdpSocket& socket, const GivenSeat& given, const hal::DeviceCaps& caps);

}  // namespace tandem::client
