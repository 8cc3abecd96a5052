#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"

/// Versions of the control connection, and bounds of its messages (proto/rpc/rpc_messages.h).
namespace tandem::rpc {

inline constexpr std::uint32_t kFrameVersion = 1;  ///< version of the frames
/// Newest version of the whole protocol (handshake, frames, datagrams), and the oldest that this release supports.
/// Version 3 adds `Elsewhere` and `Welcome::members`; datagrams are those of version 2.
inline constexpr std::uint32_t kProtocolVersion = 3, kProtocolVersionMin = 2;
inline constexpr std::uint32_t kVersionOfServices = 3;
inline constexpr std::size_t kFrameMax = 65536;  ///< one frame without its length [bytes]
inline constexpr std::size_t kTextMax = 480;     ///< texts for display [bytes of UTF-8 without control characters]
inline constexpr double kLatencyMax = 1;         ///< of a device [s]
inline constexpr std::size_t kNameMax = 32;      ///< names: A-Z a-z 0-9 _ -
inline constexpr std::size_t kVersionsMax = 8;
inline constexpr std::size_t kTicketMax = 512;  ///< more than a ticket has, so that a wrong length is a ticket error
inline constexpr std::size_t kSessionCodeSize = 10;
/// Sessions of a server: as many as the byte of a connection id tells apart that has the session's slot
/// (server/session/connection_id.h). The kernel distributes datagrams to threads by this byte.
inline constexpr std::size_t kSessionsMax = 256;
inline constexpr std::size_t kListedSessionsMax = 48, kListedSeatsMax = kSeatsMax;  ///< of a SessionList, one page
inline constexpr std::size_t kSceneTextMax = 49152;        ///< scene in a CreateSession [bytes]
inline constexpr std::uint32_t kLifeMaxS = 86400;          ///< of a created session [s]
inline constexpr std::size_t kNoteMax = 8192;              ///< JSON of a Note [bytes]
inline constexpr std::size_t kHoldersMax = 2 * kSeatsMax;  ///< persons with a ticket in a CreateSession
inline constexpr std::size_t kScenesMax = 256;             ///< names in a SceneList
inline constexpr std::size_t kSceneSeatsMax = 512;         ///< seats in a SceneList
inline constexpr std::size_t kNotesMax = 64;               ///< notes in a NoteList
inline constexpr std::size_t kNotesBytesMax = 49152;       ///< JSON of all notes in a NoteList [bytes]

inline constexpr std::size_t kMembersMax = 16;    ///< addresses of a service's servers in one message
inline constexpr std::size_t kAddressMax = 96;    ///< HOST:PORT of a server [bytes]
inline constexpr std::size_t kVoucherMax = 2560;  ///< in an Elsewhere [bytes]

using Id = std::array<std::byte, 16>;

}  // namespace tandem::rpc
