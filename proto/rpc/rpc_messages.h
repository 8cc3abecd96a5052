#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/secret.h"
#include "proto/rpc/rpc_limits.h"
#include "proto/rpc/rpc_lists.h"
#include "proto/rpc/rpc_notes.h"
#include "proto/rpc/rpc_service.h"
#include "proto/spec/access_role.h"
#include "proto/spec/registry_spec.h"
#include "proto/wire/wire_messages.h"

/// Structs of the messages on the control connection (proto/schema/rpc.proto). proto/rpc/rpc_codec.h encodes and
/// decodes them, and enforces every bound written here in both directions.
namespace tandem::rpc {

/// Device parameters that the server needs before it assigns a seat.
struct DeviceFacts {
  std::uint32_t joints = 1;    ///< 1 ... kAxesMax
  std::uint32_t tip_axes = 1;  ///< 1 ... kAxesMax
  bool simulated = false, prismatic = false;
  double force_peak_n = 0, damping_n_s_m = 0, mass_kg = 0;  ///< 0 ... 1e4; 0: unknown
  double latency_s = 0;  ///< delay of the force after the reading, without the hold of a tick; 0 ... kLatencyMax
  friend bool operator==(const DeviceFacts&, const DeviceFacts&) = default;
};

/// Credential of a join, at most one of these. None: a client on the same machine (a loopback server decides).
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

/// Selection of a session: an id, a code of 10 characters, or the only session.
using SessionChoice = std::variant<std::monostate, Id, std::string>;

struct Hello {
  std::vector<std::uint32_t> versions{kProtocolVersionMin,
                                      kProtocolVersion};  ///< 1 ... 8 of them, ascending, 1 ... 65535
  SessionChoice session;
  std::string seat;  ///< a name, or empty
  Credential credential;
  std::uint32_t client_cid = 0;
  DeviceFacts device;
  bool has_aes = false, link_test = false, watch = false;  ///< `watch`: without seat and link test
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// [1/s] and [1], each 1 ... 1e6.
struct RateLimits {
  std::uint32_t datagrams_per_s = 1250, datagrams_burst = 64, authority_per_s = 60, authority_burst = 120,
                commands_per_s = 10, commands_burst = 20;
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
  std::string person{};                ///< name in the ticket; empty: not named
  std::vector<std::string> members{};  ///< addresses of the service's servers, at most kMembersMax; from version 3 on
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

/// Reason of an ErrorReply. The numbers are sent on the wire: append-only.
enum class ErrorCode : std::uint8_t {
  kVersion = 1,      ///< no version in common
  kNotEnrolled = 2,  ///< this workstation's key is unknown or revoked
  kTicket = 3,       ///< the text names the violated rule
  kCode = 4,         ///< the code is wrong, used or expired
  kResume = 5,       ///< no reservation for this resume secret
  kNoSession = 6,
  kSessionOver = 7,
  kNoSeat = 8,
  kSeatTaken = 9,
  kDeviceUnfit = 10,
  kFull = 11,        ///< this server has no capacity for more
  kDraining = 12,    ///< this server is about to exit
  kBlocked = 13,     ///< too many wrong codes from this address or key
  kNotAllowed = 14,  ///< this role may not do this
  kTooFast = 15,     ///< rate limit exceeded
  kBadFrame = 16,    ///< not a frame, or a frame out of sequence
  kInternal = 17,    ///< a failure of the server; its log has the cause
  kOutdated = 18,    ///< the request names a version that is not the newest
  kNotNow = 19,      ///< possible at a later time
};
inline constexpr std::uint8_t kErrorCodes = 19;

struct ErrorReply {
  ErrorCode code = ErrorCode::kInternal;
  std::string text;                 ///< at most kTextMax
  std::uint32_t retry_after_s = 0;  ///< at most 86400
  friend bool operator==(const ErrorReply&, const ErrorReply&) = default;
};

struct Enroll {
  Secret<16> code;
  bool service = false;  ///< the reply may have `members`; only for a server that shows a credential of a service
  friend bool operator==(const Enroll&, const Enroll&) = default;
};
struct EnrollAck {
  std::string workstation;             ///< a name
  std::vector<std::string> members{};  ///< addresses of the service's servers, at most kMembersMax
  friend bool operator==(const EnrollAck&, const EnrollAck&) = default;
};

struct StopSession {
  Id session_id{};
  std::string why;  ///< at most kTextMax
  friend bool operator==(const StopSession&, const StopSession&) = default;
};
struct ResumeSession {
  Id session_id{};
  std::uint32_t stop = 0;  ///< number of the stop to end
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
  std::uint32_t version = 0;  ///< the version that it replaces
  std::vector<double> alpha;  ///< 1 ... kMastersMax values in [0, 1], sum 1 within 1e-9
  friend bool operator==(const SetAuthority&, const SetAuthority&) = default;
};
struct AuthorityReply {
  bool applied = false;  ///< decided and announced; authority begins to move 50 ticks later
  std::uint32_t tool = 0;
  std::uint32_t version = 0;  ///< version of the last decision
  std::vector<double> alpha;  ///< authority of the last decision, as above
  friend bool operator==(const AuthorityReply&, const AuthorityReply&) = default;
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
struct Ok {
  /// Why the order, which was carried out, is not stored, with the remedy; at most kTextMax. Empty: it is, or the
  /// server stores nothing.
  std::string not_stored{};
  friend bool operator==(const Ok&, const Ok&) = default;
};

struct RemoveParticipant {
  Id session_id{};
  std::string seat;  ///< a name
  std::string why;   ///< at most kTextMax
  friend bool operator==(const RemoveParticipant&, const RemoveParticipant&) = default;
};
struct StatusRequest {
  Id session_id{};
  friend bool operator==(const StatusRequest&, const StatusRequest&) = default;
};
struct StatusSeat {
  std::string name;
  AccessRole role = AccessRole::kTrainee;
  bool taken = false, heard = false;
  bool master = false;   ///< MASTER seat: the k-th of these is the k-th element of StatusTool::alpha
  std::string person{};  ///< name in the ticket of the person who has it; empty: not named
  friend bool operator==(const StatusSeat&, const StatusSeat&) = default;
};
struct StatusTool {
  std::string name;
  std::vector<double> alpha;  ///< requested authority; at most kMastersMax values in [0, 1]
  friend bool operator==(const StatusTool&, const StatusTool&) = default;
};
/// Largest shed level of an overloaded server (server/policy/load_shedder.h).
inline constexpr std::uint32_t kShedMax = 6;
/// Kind of a stop. The numbers are sent on the wire: append-only.
enum class StopKind : std::uint8_t { kPause = 1, kStop = 2, kFault = 3 };
/// Origin and reason of a stop, for all participants.
struct StatusStop {
  std::uint32_t number = 0;
  StopKind kind = StopKind::kStop;
  std::string seat, workstation;  ///< names; at most one of them. Neither: the session itself
  AccessRole role = AccessRole::kObserver;
  std::string why;       ///< reason given with the stop, at most kTextMax
  double ago_s = 0;      ///< [s] 0 ... 1e9
  std::string ends;      ///< roles that may end it, for display, at most kTextMax; empty: it is over
  bool yours = false;    ///< the requesting client may end it
  std::string person{};  ///< name in the ticket of that person; empty: not named
  friend bool operator==(const StatusStop&, const StatusStop&) = default;
};
/// Progress of a draining server.
struct StatusDrain {
  std::uint32_t left_s = 0;        ///< time until all hands are disengaged
  std::uint32_t sessions = 0;      ///< number of sessions that are not over
  std::uint32_t participants = 0;  ///< number of occupied seats
  friend bool operator==(const StatusDrain&, const StatusDrain&) = default;
};
/// A recent event of a session: a resume or a removal, with its origin.
struct StatusEvent {
  std::uint32_t number = 0;  ///< from 1; increases by 1 within one run of the session
  std::string text;          ///< for display, at most kTextMax
  friend bool operator==(const StatusEvent&, const StatusEvent&) = default;
};
inline constexpr std::size_t kStatusEventsMax = 4;
/// Largest number of connected recorders in a status; a session has fewer places for them.
inline constexpr std::uint32_t kRecordersMax = 64;
/// Recording of a session, for all participants. At least one of `by_server` and `by_recorders` is set.
struct StatusRecording {
  bool by_server = false;          ///< the server writes a recording
  std::uint32_t by_recorders = 0;  ///< number of connected recorders, at most kRecordersMax
  bool pseudonyms = false;         ///< the server's recording has no names of participants
  std::uint64_t dropped = 0;       ///< ticks that the server's recording dropped so far
  std::string trouble{};           ///< why it drops ticks now, at most kTextMax; empty: it drops none
  friend bool operator==(const StatusRecording&, const StatusRecording&) = default;
};
/// Stops, restarts and moves, which Status::stops counts together.
struct StatusCounts {
  std::uint32_t stops = 0;     ///< stops and pauses
  std::uint32_t restarts = 0;  ///< restores after the end or death of its server
  std::uint32_t moves = 0;     ///< restores at a server to which it was handed over
  friend bool operator==(const StatusCounts&, const StatusCounts&) = default;
};
/// Status of a session for clients of its control connection.
struct Status {
  Id session_id{};
  std::string name;
  SessionPhase phase = SessionPhase::kWaiting;
  std::uint32_t stops = 0, authority_version = 0;
  double time_s = 0;  ///< session time [s], 0 ... 1e9
  bool draining = false;
  std::uint32_t shed = 0;              ///< shed level of the server, 0 ... kShedMax
  std::vector<StatusSeat> seats;       ///< at most kListedSeatsMax
  std::vector<StatusTool> tools;       ///< at most kToolsMax
  std::optional<StatusStop> stop{};    ///< the newest stop, if this server knows its origin
  std::optional<StatusDrain> drain{};  ///< while the server drains
  /// Reason why no seat controls any tool while the session runs, at most kTextMax. Empty: a seat does, or the session
  /// does not run.
  std::string held{};
  std::vector<StatusEvent> events{};           ///< at most kStatusEventsMax, newest last
  std::uint32_t notes = 0;                     ///< number of the newest note; 0: none, or the client may not read notes
  std::optional<StatusRecording> recording{};  ///< while the session is recorded
  /// Why the server cannot record the session, and the remedy, at most kTextMax. Empty: it can, or does.
  std::string no_recording{};
  std::optional<StatusCounts> counts{};  ///< nullopt: the server does not know them
  /// Why the server cannot store the state of the session, with the remedy; at most kTextMax. Empty: it can.
  std::string not_stored{};
  friend bool operator==(const Status&, const Status&) = default;
};

/// A person or workstation that gets a ticket.
struct SeatHolder {
  std::string seat, workstation;   ///< names; seat empty: a console
  std::string person{};            ///< a name, or empty: the ticket names no person
  AccessRole role = AccessRole{};  ///< of a console; with a seat it has no meaning
  friend bool operator==(const SeatHolder&, const SeatHolder&) = default;
};
struct CreateSession {
  std::string name;                   ///< a name
  std::string scene{};                ///< a name, or empty: exactly one of `scene` and `scene_text` is empty
  std::string scene_text{};           ///< at most kSceneTextMax
  bool tickets_only = false;          ///< no session code
  std::uint32_t life_s = 0;           ///< [s] 0 ... kLifeMaxS; 0: no limit
  std::vector<SeatHolder> holders{};  ///< at most kHoldersMax, each seat once
  friend bool operator==(const CreateSession&, const CreateSession&) = default;
};
struct SeatTicket {
  std::string seat, workstation;  ///< names; seat empty: a console
  std::vector<std::byte> ticket;  ///< 1 ... kTicketMax
  std::string person{};           ///< a name, or empty
  AccessRole role = AccessRole::kTrainee;
  friend bool operator==(const SeatTicket&, const SeatTicket&) = default;
};
struct SessionCreated {
  ListedSession session;
  std::string code;                 ///< 10 characters of 0-9 A-Z, or empty
  std::vector<SeatTicket> tickets;  ///< at most kHoldersMax
  friend bool operator==(const SessionCreated&, const SessionCreated&) = default;
};
struct EndSession {
  Id session_id{};
  std::string why{};  ///< at most kTextMax
  friend bool operator==(const EndSession&, const EndSession&) = default;
};
struct SceneListRequest {
  friend bool operator==(const SceneListRequest&, const SceneListRequest&) = default;
};
/// A seat of a scene in a SceneList.
struct SceneSeat {
  std::uint32_t scene = 0;  ///< place of its scene in the list
  std::string name;         ///< a name
  AccessRole role = AccessRole::kObserver;
  friend bool operator==(const SceneSeat&, const SceneSeat&) = default;
};
struct SceneList {
  std::vector<std::string> scenes;  ///< names, at most kScenesMax, ascending
  bool more = false;
  /// Seats of the scenes in their order, at most kSceneSeatsMax. A scene without any is not known to the sender.
  std::vector<SceneSeat> seats{};
  /// Session time after which a session of each scene ends by itself, in [0, kTimeMax] [s]. 0: no scheduled end, or the
  /// sender could not read the scene. One per scene, or none: the sender gives no durations.
  std::vector<double> durations_s{};
  friend bool operator==(const SceneList&, const SceneList&) = default;
};

/// Order to start or end the recording of a session.
struct RecordSession {
  Id session_id{};
  bool on = false;
  friend bool operator==(const RecordSession&, const RecordSession&) = default;
};

/// The message of a frame, in the order of Kind.
using Body = std::variant<Hello, Welcome, ErrorReply, Enroll, EnrollAck, SessionListRequest, SessionList, StopSession,
                          ResumeSession, PauseSession, SetAuthority, AuthorityReply, Drain, Ping, Pong, Ok,
                          RemoveParticipant, StatusRequest, Status, CreateSession, SessionCreated, EndSession, Note,
                          SceneListRequest, SceneList, NotesRequest, NoteList, RecordSession, Elsewhere>;

/// Kind of the message in a frame. It is readable before the payload, so that roles are checked first. The number is
/// the field's number in ControlFrame.
enum class Kind : std::uint8_t {
  kHello = 3,
  kWelcome,
  kErrorReply,
  kEnroll,
  kEnrollAck,
  kSessionListRequest,
  kSessionList,
  kStopSession,
  kResumeSession,
  kPauseSession,
  kSetAuthority,
  kAuthorityReply,
  kDrain,
  kPing,
  kPong,
  kOk,
  kRemoveParticipant,
  kStatusRequest,
  kStatus,
  kCreateSession,
  kSessionCreated,
  kEndSession,
  kNote,
  kSceneListRequest,
  kSceneList,
  kNotesRequest,
  kNoteList,
  kRecordSession,
  kElsewhere
};
inline constexpr std::size_t kKinds = std::variant_size_v<Body>;
static_assert(static_cast<std::size_t>(Kind::kElsewhere) == static_cast<std::size_t>(Kind::kHello) + kKinds - 1);

struct Frame {
  std::uint32_t request = 0;
  Body body;
  friend bool operator==(const Frame&, const Frame&) = default;
};
[[nodiscard]] inline Kind kind_of(const Frame& frame) noexcept {
  return static_cast<Kind>(frame.body.index() + static_cast<std::size_t>(Kind::kHello));
}

}  // namespace tandem::rpc
