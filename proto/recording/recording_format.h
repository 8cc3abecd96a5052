#pragma once

#include <string>
#include <string_view>

/// Names that the writer and the reader of a recording share (server/recording/README.md).
namespace tandem::rec {

inline constexpr std::string_view kProfile = "x-tandem";   ///< of the MCAP header
inline constexpr std::string_view kFormat = "3";           ///< value of `format` in the metadata record `session`
inline constexpr std::string_view kEncoding = "protobuf";  ///< of schemas and messages

/// Metadata records.
inline constexpr const char* kSessionRecord = "session";
inline constexpr const char* kSceneRecord = "scene";
inline constexpr const char* kParticipantsRecord = "participants";
/// Seats whose name in the record before is that of a workstation, which several persons may share: seat, `true` or
/// `false`. Only in files with such seats.
inline constexpr const char* kWorkstationsRecord = "workstations";
/// Name of the workstation of all clients on loopback, for files without that record.
inline constexpr std::string_view kLoopbackWorkstation = "local";
inline constexpr const char* kRolesRecord = "roles";
inline constexpr const char* kCountsRecord = "counts";
inline constexpr const char* kPartRecord = "part";  ///< at the end of a file

/// Keys of the files of one recording: its name and the number of a file from 1 in the record `session`, and in the
/// record `part` whether no file follows.
inline constexpr const char* kRecordingKey = "recording";
inline constexpr const char* kPartKey = "part";
inline constexpr const char* kPreviousKey = "previous_file";
inline constexpr const char* kLastKey = "last";

/// Key of the record `session`: the values of tools are rounded.
inline constexpr const char* kToolsKey = "tools";
inline constexpr const char* kRoundedTools = "16 significant bits";

/// Key of the record `session`: why a server's recording has no inputs. Absent: it has them, or an older server made
/// it.
inline constexpr const char* kNoInputsKey = "no_inputs";

/// Keys of the metadata of a channel: its kind, and the seat or tool that it shows.
inline constexpr const char* kKindKey = "kind";
inline constexpr const char* kNameKey = "name";
inline constexpr std::string_view kSeatKind = "seat", kToolKind = "tool", kSessionKind = "session", kViewKind = "view";

inline constexpr std::string_view kAuthorityTopic = "/authority", kSessionTopic = "/session", kInputsTopic = "/inputs",
                                  kLinkTopic = "/link", kEventsTopic = "/events", kMarksTopic = "/marks",
                                  kSheetsTopic = "/sheets", kCountsTopic = "/counts", kSceneTopic = "/view/scene",
                                  kTransformTopic = "/tf", kLogTopic = "/log";

}  // namespace tandem::rec
