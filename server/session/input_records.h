#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Layout of the records of an input journal (server/session/input_journal.h). Numbers are little-endian and without
/// padding; u, i and f are unsigned, signed and floating-point. A record begins with a byte InputRecord, then the
/// fields below. Zeros may lie between two records.
///
///   kBegin          u16 length of the rest, u8 kInputJournalVersion, u8 n, n bytes of build text, 32 bytes SHA-256 of
///                   the scene, 7 x f64 scale of the axes, i64 time at which slaves and session begin [ns],
///                   u16 m, m bytes of checkpoint (m = 0: none)
///   kAdmit          u8 seat, u8 flags (1: the seat's owner), i64 dt, u32 server's and u32 client's connection id,
///                   u32 joints, u32 tip axes, u8 device flags (1: simulated, 2: prismatic), f64 peak force [N],
///                   f64 damping [N s/m], f64 mass [kg], f64 latency [s], f64 force scale of the ticket
///   kDatagram       u8 seat (5 bits) and flags (kNewAddress, kTokenTaken), u8 wire::Type, u8 key phase, u16 n, i64 dt,
///                   i64 counter beyond the one that follows the last, u64 address if kNewAddress, u64 token if
///                   kTokenTaken, n bytes of plaintext
///   kStop, kPause   i64 dt, u8 role, u8 seat, u32 connection id
///   kResume         as kStop, then u32 number of the stop
///   kAuthority      as kStop, then u32 tool, u32 version, u8 n, n x f64 authority
///   kRemove         u8 seat, u8 wire::CloseReason
///   kEnd            u8 wire::CloseReason
///   kContacts       u8 tool whose surfaces come from a source outside of the scene
///   kTick           i64 dt, u32 missed ticks, u32 n, bit i for each seat to which this tick sent, u16 hash for each of
///                   them in order
///   kSettings       u8 ShedLevel, u8 flags (1: overloaded, 2: telemetry at every tick, 4: the server may not act),
///                   u32 record interval [ticks]; of the next kTick
///   kOverflow       u64 number of kTick records before the journal lost one
///
/// dt is the time since the last record with a dt, since the time in kBegin for the first [ns]. Addresses are keyed
/// hashes. A hash of outputs covers everything that the seat was sent since kBegin (the low 16 bits of
/// OutputDigest::value): outputs that differ once differ in the hashes of all later ticks, but for one in 2^16.
namespace tandem::server {

inline constexpr std::uint8_t kInputJournalVersion = 2;

enum class InputRecord : std::uint8_t {
  kBegin = 1,
  kAdmit,
  kDatagram,
  kStop,
  kPause,
  kResume,
  kAuthority,
  kRemove,
  kEnd,
  kContacts,
  kTick,
  kSettings,
  kOverflow,
};

namespace input {
inline constexpr unsigned kSeatMask = 0x1f, kNewAddress = 0x20, kTokenTaken = 0x40;  ///< of kDatagram
inline constexpr std::size_t kBuildMax = 120;                                        ///< build text [bytes]
}  // namespace input

}  // namespace tandem::server
