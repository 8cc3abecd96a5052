#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/app/missing_session.h"
#include "common/auth/key_fingerprint.h"
#include "common/base/time.h"
#include "common/io/name_resolver.h"
#include "common/io/socket_address.h"
#include "common/io/udp_socket.h"
#include "common/transport/secure_channel.h"
#include "hal/core/device.h"
#include "proto/rpc/rpc_messages.h"
#include "proto/spec/registry_spec.h"
#include "proto/spec/scene_spec.h"
#include "proto/text/seat_setup.h"

namespace tandem::auth {
class ControlClient;
}

namespace tandem::client {

/// Facts by which a console whose connection was lost comes back.
struct ConsoleReturn {
  rpc::Id session{};
  Secret<32> secret;  ///< of its Welcome
};

/// Options of a request to a server: a seat, a link test, a console or the session list.
struct JoinOptions {
  io::SocketAddress server = {};
  std::string seat = {};     ///< empty without `console`: link test (proto/wire/link_test_messages.h)
  std::string session = {};  ///< name, code or id; empty: the only session of the server
  std::string ticket = {};   ///< output of `tandem-server ticket`; empty: none
  std::string state = {};    ///< state directory with this workstation's key; empty: the default directory
  hal::DeviceCaps caps = {};
  Duration timeout{};                             ///< connect and reply timeout
  int signals = -1;                               ///< signalfd (common/io/signals.h); -1: none
  bool watch = false;                             ///< with `console`: it also gets TELEMETRY
  std::vector<io::SocketAddress> alternatives{};  ///< tried after `server`: other addresses of it, or of its service
  std::vector<std::string> typed{};               ///< HOST:PORT as given, for addresses learnt at earlier joins
  std::string unresolved{};                       ///< given names without address, for errors; empty: none
  io::NameResolver names = io::NameResolver::system();  ///< for names that servers of a service give
  std::optional<AccessRole>
      console{};  ///< joins as console instead of a seat; the role counts only on the server's own computer
  /// With `console`: joins for a drain, only at a server that `server` and `alternatives` name. If another one has the
  /// session, or they name several of a service, the join fails before the ticket is used.
  bool drains = false;
  /// With `console`: comes back as the console of an earlier connection, which this one replaces, instead of by the
  /// ticket.
  std::optional<ConsoleReturn> back{};
};

/// A joined seat.
struct JoinedSeat {
  SeatSetup setup;
  transport::SecureChannel::Params link;
  io::SocketAddress udp;  ///< destination of the datagrams
  rpc::Welcome welcome;
  auth::KeyFingerprint server;          ///< key of the server
  std::optional<ServicePin> service{};  ///< service of the server; nullopt: none, or not known to this workstation
  bool local = false;                   ///< key found in this user's runtime directory, not by enrolment
  std::shared_ptr<auth::ControlClient>
      connection{};  ///< control connection of the join, optional for the seat; null for link tests
};

/// A control connection without a seat.
struct Console {
  rpc::Welcome welcome;
  std::shared_ptr<auth::ControlClient> connection;
  auth::KeyFingerprint workstation{};  ///< key of this workstation
  bool service = false;                ///< the server belongs to a service: it lists the sessions of all its servers
  io::SocketAddress server{};          ///< address of the connection
};

/// A console that watches the session.
struct JoinedWatcher {
  SceneSpec scene;  ///< of the session
  transport::SecureChannel::Params link;
  io::SocketAddress udp;  ///< destination of the datagrams
  Console console;
};

/// Reason of a failed join.
struct JoinError {
  bool interrupted = false;  ///< a signal ended it
  std::string reason;        ///< cause and remedy, or the name of the signal
  /// Where the connected server sends this client, no server answers that the service vouches for. The connection is
  /// still that of the connected one.
  bool owner_unreachable = false;
  std::optional<rpc::ErrorCode> refused{};  ///< code of the server's reply; nullopt: it gave none
  bool absent = false;                      ///< no program listens at the address
};

/// Joins a seat, or starts a link test, over a TLS connection. Both ends prove their keys. The client presents a ticket
/// or a code, or on the server's own computer a ticket signed with the key in the user's runtime directory. The
/// datagram secrets are exported from the connection. Blocks until the reply.
[[nodiscard]] std::expected<JoinedSeat, JoinError> join_seat(const JoinOptions& options);

/// Joins without a seat, by a ticket. @pre options.console, no options.seat
[[nodiscard]] std::expected<Console, JoinError> join_console(const JoinOptions& options);

/// Joins without a seat, by a ticket, and with datagrams that show the session.
/// @pre options.console, options.watch, no options.seat
[[nodiscard]] std::expected<JoinedWatcher, JoinError> join_watcher(const JoinOptions& options);

/// Credentials and facts that a client needs to resume its seat.
struct ResumeState {
  rpc::Id session{};
  std::uint64_t epoch = 0;          ///< a server with a lower epoch is outdated and not accepted
  std::vector<Secret<32>> secrets;  ///< newest first; a restarted server may know only the previous one
  SeatSetup setup;
  auth::KeyFingerprint server;
  bool local = false;  ///< true: any server key in this user's runtime directory is accepted, not only `server`
  std::optional<ServicePin> service{};               ///< every server of this service is accepted too
  std::vector<std::string> members{};                ///< HOST:PORT of servers of the service
  std::optional<io::SocketAddress> last{}, first{};  ///< peer of the datagrams; where the next attempt begins
};
/// Reason of a failed resume.
struct ResumeError {
  enum class Kind : std::uint8_t {
    kAgain,      ///< server unreachable or temporarily unable; retry
    kGone,       ///< the seat or session is gone; a retry is useless
    kNotNeeded,  ///< the server answers on the old connection again
    kInterrupted,
  } kind = Kind::kAgain;
  std::string reason;      ///< text for the user
  std::string distrust{};  ///< why this client rejects the key of a server that answered; empty: it rejects none
  Duration wait{};         ///< kAgain: shortest wait before the next attempt
  bool coming = false;     ///< a server of the service is about to serve the session: no other one needs to be asked
  std::optional<io::SocketAddress> answered{};  ///< server that replied, for `ResumeState::first`
  SeatAnswer heard = SeatAnswer::kNone;         ///< of all servers that were asked
  std::string answer{};  ///< reason at a server that was reached, one with `heard`; empty: none was reached
};
/// Tries once to resume a seat over a new TLS connection: at the server that had it, then at the other servers of its
/// service, each for 1 s at most. Waits for the addresses of names only after that, for 1 s in total. Follows them to
/// the owner of the session. Accepts only the same server or one of the same service, with the same or a higher epoch.
/// Each secret gets one connection; `options.timeout` limits each connect and each reply. A readable `options.signals`
/// file cancels the attempt.
/// @param wanted  called just before the request, because the request invalidates the old connection; false cancels
[[nodiscard]] std::expected<JoinedSeat, ResumeError> resume_seat(const JoinOptions& options, const ResumeState& own,
                                                                 const std::function<bool()>& wanted);

/// Returns `text` with the options of this connection appended to each `tandem-client control` and `enroll` command in
/// it, so that the user can paste the command.
/// @param session    name of the joined session; empty: none
/// @param by_ticket  true: the commands also need a ticket file
[[nodiscard]] std::string complete_commands(std::string text, const JoinOptions& options,
                                            const std::string& session = {}, bool by_ticket = false);

/// Returns what a participant reads when the session of a connection has moved to another server of the service.
[[nodiscard]] std::string moved_text(const rpc::Elsewhere& to);

/// Returns the open sessions of the server, or of its whole service.
[[nodiscard]] std::expected<rpc::SessionList, JoinError> list_sessions(const JoinOptions& options);

/// Sends CLOSE for a seat that was just joined and will not be used, so that other clients can join it at once.
void release_seat(const io::UdpSocket& socket, const JoinedSeat& given, const hal::DeviceCaps& caps);

}  // namespace tandem::client
