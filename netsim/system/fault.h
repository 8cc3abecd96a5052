#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/time.h"

namespace tandem::netsim {

/// A fault at an end of the network (client, device, user or server), as soak tests and scenarios inject it. Faults of
/// the network itself are in netsim/models.
struct Fault {
  /// Kinds of faults.
  enum class Kind : std::uint8_t {
    kPause,       ///< the client's process is suspended (VM, SIGSTOP) and continues later; its device goes on
    kRestart,     ///< the client's process dies at `at` and starts again after `length`; it then joins its seat again
    kNotANumber,  ///< the device's readings are NaN
    kOutOfRange,  ///< the device's readings are finite and absurd
    kFrozen,      ///< the device repeats its last reading
    kReplay,      ///< datagrams that the seat received or sent, old ones too, are delivered again: one per tick
    kJunk,        ///< random bytes reach both ends, one datagram per tick
    kLiar,        ///< the client's STATE reports an energy account that runs backwards: sealed, well-formed, wrong
    kServerLate,  ///< the server's thread is suspended and then runs the missed ticks; concerns no seat
    kServerRestart,  ///< the server dies and restarts after `length` from its last checkpoint; all clients join again;
                     ///< concerns no seat
    kStopHand,       ///< the user stops their own hand, and resumes after `length`
    kStopAll,        ///< the user stops the session, or pauses it; an instructor resumes after `length`
    kHostile,        ///< the client sends, under its own keys, STATE that no client may send or no hand can produce
    kHot,            ///< the device reports that its motors are too hot
  };
  Kind kind = Kind::kPause;  ///< kind of the fault
  std::string seat;          ///< empty: every seat
  Duration at{};             ///< from the start of the network [0, 30 d]
  Duration length{};         ///< (0, 1 h]

  friend bool operator==(const Fault&, const Fault&) = default;
};

/// Name of one kind.
struct FaultName {
  Fault::Kind kind;       ///< the kind
  std::string_view name;  ///< as scenarios spell it
  std::string_view what;  ///< description for reports
};
/// All kinds in order.
inline constexpr std::array<FaultName, 14> kFaultNames{{
    {Fault::Kind::kPause, "PAUSE", "the client's program is suspended"},
    {Fault::Kind::kRestart, "RESTART", "the client's program dies and restarts"},
    {Fault::Kind::kNotANumber, "NOT_A_NUMBER", "the device's readings are NaN"},
    {Fault::Kind::kOutOfRange, "OUT_OF_RANGE", "the device's readings are absurd"},
    {Fault::Kind::kFrozen, "FROZEN", "the device repeats its last reading"},
    {Fault::Kind::kReplay, "REPLAY", "old datagrams are replayed"},
    {Fault::Kind::kJunk, "JUNK", "random bytes arrive"},
    {Fault::Kind::kLiar, "LIAR", "the client's energy account runs backwards"},
    {Fault::Kind::kServerLate, "SERVER_LATE", "the server's thread is suspended"},
    {Fault::Kind::kServerRestart, "SERVER_RESTART", "the server dies and resumes from its checkpoint"},
    {Fault::Kind::kStopHand, "STOP_HAND", "the participant stops their own hand"},
    {Fault::Kind::kStopAll, "STOP_ALL", "the participant stops the session"},
    {Fault::Kind::kHostile, "HOSTILE", "the client sends forbidden messages"},
    {Fault::Kind::kHot, "HOT", "the device's motors are too hot"},
}};
/// Whether the fault concerns the server and no seat.
[[nodiscard]] constexpr bool of_server(Fault::Kind kind) noexcept {
  return kind == Fault::Kind::kServerLate || kind == Fault::Kind::kServerRestart;
}
/// Returns the name of a kind, as scenarios spell it.
[[nodiscard]] constexpr std::string_view name(Fault::Kind kind) noexcept {
  return kFaultNames[static_cast<std::size_t>(kind)].name;
}

}  // namespace tandem::netsim
