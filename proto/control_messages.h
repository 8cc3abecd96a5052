#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/axes.h"
#include "common/base/secret.h"
#include "proto/access_role.h"
#include "proto/wire.h"

/// Owned forms of what travels over the control connection (proto/control.proto). Bytes are made and read by proto/control_codec.h,
/// which holds every bound that is written here, in both directions.
namespace tandem::control {

inline constexpr std::uint32_t kFrameVersion = 1;     ///< of the frames
inline constexpr std::uint32_t kProtocolVersion = 1;  ///< of everything: handshake, frames, datagrams
inline constexpr std::size_t kFrameMax = 65536;       ///< one frame without its length [bytes]
inline constexpr std::size_t kTextMax = 480;          ///< texts for people [bytes of UTF-8 without control characters]
inline constexpr double kLatencyMax = 1;              ///< of a device [s]
inline constexpr std::size_t kNameMax = 32;           ///< names: A-Z a-z 0-9 _ -
inline constexpr std::size_t kVersionsMax = 8;
inline constexpr std::size_t kTicketMax = 512;        ///< more than a ticket has: another length is the ticket's own mistake
inline constexpr std::size_t kSessionCodeSize = 10;
inline constexpr std::size_t kSessionsMax = 48, kListedSeatsMax = kSeatsMax;

using Id = std::array<std::byte, 16>;

/// What the server must know of a device before it gives a seat.
struct DeviceFacts {
  std::uint32_t joints = 1;    ///< 1 ... kAxesMax
  std::uint32_t tip_axes = 1;  ///< 1 ... kAxesMax
  bool simulated = false, prismatic = false;
  double force_peak_n = 0, damping_n_s_m = 0, mass_kg = 0;  ///< 0 ... 1e4; 0: unknown
  double latency_s = 0;  ///< from a reading to the force that answers it, beside the hold of a tick; 0 ... kLatencyMax
  friend bool operator==(const DeviceFacts&, const DeviceFacts&) = default;
};

/// Why somebody may join: at most one of these; none: who is on this very machine (a loopback server decides).
struct TicketCredential {
  std::vector<std::byte> bytes;  ///< 1 ... kTicketMax
  friend bool operator==(const TicketCredential&, const TicketCredential&) = default;
};
struct ResumeCredential {
  Secret<32> secret;
  friend bool operator==(const ResumeCredential&, const ResumeCredential&) = default;
};
struct CodeCredential {
  std::string code;  ///< 10 characters of 0-9 A-Z
  friend bool operator==(const CodeCredential&, const CodeCredential&) = default;
};
using Credential = std::variant<std::monostate, TicketCredential, ResumeCredential, CodeCredential>;

/// Which session: an id, a code of 10 characters, or the only one.
using SessionChoice = std::variant<std::monostate, Id, std::string>;

struct Hello {
  std::vector<std::uint32_t> versions{kProtocolVersion};  ///< 1 ... 8 of them, ascending, 1 ... 65535
  SessionChoice session;
  std::string seat;  ///< a name, or empty
  Credential credential;
  std::uint32_t client_cid = 0;
  DeviceFacts device;
  bool has_aes = false, visit = false;
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// [1/s] and [1], each 1 ... 1e6.
struct RateLimits {
  std::uint32_t datagrams_per_s = 1250, datagrams_burst = 64, authority_per_s = 60, authority_burst = 120, commands_per_s = 10, commands_burst = 20;
  friend bool operator==(const RateLimits&, const RateLimits&) = default;
};

enum class Cipher : std::uint8_t { kAes256Gcm, kChaCha20Poly1305 };

struct Welcome {
  std::uint32_t version = kProtocolVersion;  ///< 1 ... 65535
  Id session_id{};
  std::string session_name;  ///< a name
  std::uint64_t epoch = 0;
  std::uint32_t server_cid = 0;
  Cipher cipher = Cipher::kAes256Gcm;
  std::string seat;  ///< a name, or empty
  AccessRole role = AccessRole::kObserver;
  std::vector<std::byte> setup;  ///< at most wire::kSetupMax
  std::uint16_t udp_port = 1;    ///< 1 ... 65535
  Secret<32> resume_secret;
  std::uint32_t authority_version = 0;
  RateLimits limits;
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

/// Append-only: numbers travel.
enum class Reason : std::uint8_t {
  kVersion = 1,       ///< no version in common
  kNotEnrolled = 2,   ///< this workstation's key is unknown, or was revoked
  kTicket = 3,        ///< the text says which rule it breaks
  kCode = 4,          ///< a wrong, used or expired code
  kResume = 5,        ///< nothing to resume under this secret
  kNoSession = 6,
  kSessionOver = 7,
  kNoSeat = 8,
  kSeatTaken = 9,
  kDeviceUnfit = 10,
  kFull = 11,         ///< this server has no room for more
  kDraining = 12,     ///< this server is about to end
  kBlocked = 13,      ///< too many wrong codes from this address or of this key
  kNotAllowed = 14,   ///< this role may not
  kTooFast = 15,      ///< too many of these per second
  kBadFrame = 16,     ///< not a frame, or one out of turn
  kTrouble = 17,      ///< the server could not, for reasons of its own; its log says which
  kOutdated = 18,     ///< what it names is not the newest any more
  kNotNow = 19,       ///< it could be asked for again later
};
inline constexpr std::uint8_t kReasons = 19;

struct Refused {
  Reason reason = Reason::kTrouble;
  std::string text;                 ///< at most kTextMax
  std::uint32_t retry_after_s = 0;  ///< at most 86400
  friend bool operator==(const Refused&, const Refused&) = default;
};

struct Enrol {
  Secret<16> code;
  friend bool operator==(const Enrol&, const Enrol&) = default;
};
struct EnrolAck {
  std::string workstation;  ///< a name
  friend bool operator==(const EnrolAck&, const EnrolAck&) = default;
};

enum class SessionPhase : std::uint8_t { kWaiting, kRunning, kPaused, kStopped, kEnding, kPassive };
[[nodiscard]] constexpr const char* to_text(SessionPhase phase) noexcept {
  constexpr const char* kNames[] = {"waiting", "running", "paused", "stopped", "ending", "passive"};
  return phase <= SessionPhase::kPassive ? kNames[static_cast<std::size_t>(phase)] : "?";
}
struct ListedSeat {
  std::string name;
  AccessRole role = AccessRole::kTrainee;
  bool taken = false, required = false;
  friend bool operator==(const ListedSeat&, const ListedSeat&) = default;
};
struct ListedSession {
  Id id{};
  std::string name;
  SessionPhase phase = SessionPhase::kWaiting;
  std::vector<ListedSeat> seats;  ///< at most kListedSeatsMax
  friend bool operator==(const ListedSession&, const ListedSession&) = default;
};
struct SessionListRequest {
  friend bool operator==(const SessionListRequest&, const SessionListRequest&) = default;
};
struct SessionList {
  std::vector<ListedSession> sessions;  ///< at most kSessionsMax
  bool more = false;
  friend bool operator==(const SessionList&, const SessionList&) = default;
};

struct StopSession {
  Id session_id{};
  std::string why;  ///< at most kTextMax
  friend bool operator==(const StopSession&, const StopSession&) = default;
};
struct ResumeSession {
  Id session_id{};
  std::uint32_t stop = 0;  ///< number of the stop it ends
  friend bool operator==(const ResumeSession&, const ResumeSession&) = default;
};
struct PauseSession {
  Id session_id{};
  std::string why{};  ///< at most kTextMax
  friend bool operator==(const PauseSession&, const PauseSession&) = default;
};
struct SetAuthority {
  Id session_id{};
  std::uint32_t tool = 0;     ///< below kToolsMax
  std::uint32_t version = 0;  ///< that it replaces
  std::vector<double> alpha;  ///< 1 ... kMastersMax weights in [0, 1], together 1 within 1e-9
  friend bool operator==(const SetAuthority&, const SetAuthority&) = default;
};
struct AuthorityAnswer {
  bool applied = false;       ///< it won: decided and announced, and weights begin to move 50 ticks later
  std::uint32_t tool = 0;
  std::uint32_t version = 0;  ///< decided last
  std::vector<double> alpha;  ///< decided last, as above
  friend bool operator==(const AuthorityAnswer&, const AuthorityAnswer&) = default;
};
struct Drain {
  std::uint32_t grace_s = 0;  ///< at most 3600
  friend bool operator==(const Drain&, const Drain&) = default;
};
struct Ping {
  std::uint64_t nonce = 0;
  friend bool operator==(const Ping&, const Ping&) = default;
};
struct Pong {
  std::uint64_t nonce = 0;
  friend bool operator==(const Pong&, const Pong&) = default;
};
struct Done {
  friend bool operator==(const Done&, const Done&) = default;
};

struct RemovePerson {
  Id session_id{};
  std::string seat;  ///< a name
  std::string why;   ///< at most kTextMax
  friend bool operator==(const RemovePerson&, const RemovePerson&) = default;
};
struct StatusRequest {
  Id session_id{};
  friend bool operator==(const StatusRequest&, const StatusRequest&) = default;
};
struct StatusSeat {
  std::string name;
  AccessRole role = AccessRole::kTrainee;
  bool taken = false, heard = false;
  bool master = false;  ///< has a weight: the k-th of these is the k-th of StatusTool::alpha
  friend bool operator==(const StatusSeat&, const StatusSeat&) = default;
};
struct StatusTool {
  std::string name;
  std::vector<double> alpha;  ///< asked for; at most kMastersMax in [0, 1]
  friend bool operator==(const StatusTool&, const StatusTool&) = default;
};
/// Rungs of the ladder by which a busy server goes without things (server/load_ladder.h).
inline constexpr std::uint32_t kShedMax = 6;
/// Numbers travel: append-only.
enum class StopKind : std::uint8_t { kPause = 1, kStop = 2, kFault = 3 };
/// Who stopped a session, and why, as everybody in it may read.
struct StatusStop {
  std::uint32_t number = 0;
  StopKind kind = StopKind::kStop;
  std::string seat, workstation;  ///< names; at most one of them. None: the session itself
  AccessRole role = AccessRole::kObserver;
  std::string why;                ///< his words, at most kTextMax
  double ago_s = 0;               ///< [s] 0 ... 1e9
  std::string ends;               ///< who may end it, for people, at most kTextMax; empty: it is over
  bool yours = false;             ///< who asked may
  friend bool operator==(const StatusStop&, const StatusStop&) = default;
};
/// How far a server is on its way to its end.
struct StatusDrain {
  std::uint32_t left_s = 0;    ///< until all hands are let go
  std::uint32_t sessions = 0;  ///< not over yet
  std::uint32_t people = 0;    ///< on their seats
  friend bool operator==(const StatusDrain&, const StatusDrain&) = default;
};
/// What happened to a session lately: a resume or a removal, and by whom.
struct StatusNews {
  std::uint32_t number = 0;  ///< 1 ...; counts up within one run of the session
  std::string text;          ///< for people, at most kTextMax
  friend bool operator==(const StatusNews&, const StatusNews&) = default;
};
inline constexpr std::size_t kStatusNewsMax = 4;
/// A session as somebody at a control connection may see it.
struct Status {
  Id session_id{};
  std::string name;
  SessionPhase phase = SessionPhase::kWaiting;
  std::uint32_t stops = 0, authority_version = 0;
  double time_s = 0;  ///< of the session [s], 0 ... 1e9
  bool draining = false;
  std::uint32_t shed = 0;  ///< what the server goes without, 0 ... kShedMax
  std::vector<StatusSeat> seats;  ///< at most kListedSeatsMax
  std::vector<StatusTool> tools;  ///< at most kToolsMax
  std::optional<StatusStop> stop{};    ///< the newest, if this server knows who made it
  std::optional<StatusDrain> drain{};  ///< while the server drains
  std::string held{};                  ///< why nobody leads any tool while the session runs, at most kTextMax; empty: somebody does, or it does not run
  std::vector<StatusNews> news{};      ///< at most kStatusNewsMax, newest last
  friend bool operator==(const Status&, const Status&) = default;
};

/// In the order of Kind.
using Body = std::variant<Hello, Welcome, Refused, Enrol, EnrolAck, SessionListRequest, SessionList, StopSession, ResumeSession, PauseSession,
                          SetAuthority, AuthorityAnswer, Drain, Ping, Pong, Done, RemovePerson, StatusRequest, Status>;

/// Which message a frame carries: readable before its payload is (roles are checked there). The number is the field's in ControlFrame.
enum class Kind : std::uint8_t {
  kHello = 3, kWelcome, kRefused, kEnrol, kEnrolAck, kSessionListRequest, kSessionList, kStopSession, kResumeSession, kPauseSession,
  kSetAuthority, kAuthorityAnswer, kDrain, kPing, kPong, kDone, kRemovePerson, kStatusRequest, kStatus
};
inline constexpr std::size_t kKinds = std::variant_size_v<Body>;
static_assert(static_cast<std::size_t>(Kind::kStatus) == static_cast<std::size_t>(Kind::kHello) + kKinds - 1);

struct Frame {
  std::uint32_t request = 0;
  Body body;
  friend bool operator==(const Frame&, const Frame&) = default;
};
[[nodiscard]] inline Kind kind_of(const Frame& frame) noexcept {
  return static_cast<Kind>(frame.body.index() + static_cast<std::size_t>(Kind::kHello));
}

}  // namespace tandem::control
