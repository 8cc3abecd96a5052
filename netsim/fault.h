#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/time.h"

namespace tandem::netsim {

/// Something that goes wrong at an end of the network, not in it: what swarms and scenarios do to workstations and server.
struct Fault {
  enum class Kind : std::uint8_t {
    kPause,       ///< the client's program stands still (VM, SIGSTOP) and comes back; its device goes on
    kRestart,     ///< the client's program dies at `at` and is started again after `length`: it asks for its seat anew
    kNotANumber,  ///< the device's readings are NaN
    kOutOfRange,  ///< the device's readings are finite and absurd
    kFrozen,      ///< the device repeats its last reading
    kReplay,      ///< datagrams the seat has heard, and those it has sent, come once more, old ones too, one each tick
    kJunk,        ///< random bytes reach both ends, one datagram each tick
    kLiar,        ///< the client's STATE tells an energy account that runs backwards: sealed, well-formed, wrong
    kServerLate,  ///< the server's thread stands still and then makes up for it; concerns no seat
    kServerRestart,  ///< the server dies and goes on after `length` from its last checkpoint; everybody joins anew; concerns no seat
    kStopHand,    ///< the person stops his own hand, and resumes after `length`
    kStopAll,     ///< the person stops the session, or pauses it; instructors resume after `length`
    kHostile,     ///< the client's STATE becomes, under its own keys, what nobody may send or no hand can be
    kHot,         ///< the device tells that its motors are too hot
  };
  Kind kind = Kind::kPause;
  std::string seat;   ///< empty: every seat
  Duration at{};      ///< from the start of the network [0, 30 d]
  Duration length{};  ///< (0, 1 h]

  friend bool operator==(const Fault&, const Fault&) = default;
};

struct FaultName {
  Fault::Kind kind;
  std::string_view name;  ///< as scenarios spell it
  std::string_view what;  ///< for people
};
inline constexpr std::array<FaultName, 14> kFaultNames{{
    {Fault::Kind::kPause, "PAUSE", "the client's program stands still"},
    {Fault::Kind::kRestart, "RESTART", "the client's program dies and is started again"},
    {Fault::Kind::kNotANumber, "NOT_A_NUMBER", "the device's readings are NaN"},
    {Fault::Kind::kOutOfRange, "OUT_OF_RANGE", "the device's readings are absurd"},
    {Fault::Kind::kFrozen, "FROZEN", "the device repeats its last reading"},
    {Fault::Kind::kReplay, "REPLAY", "old datagrams come once more"},
    {Fault::Kind::kJunk, "JUNK", "random bytes arrive"},
    {Fault::Kind::kLiar, "LIAR", "the client's energy account runs backwards"},
    {Fault::Kind::kServerLate, "SERVER_LATE", "the server's thread stands still"},
    {Fault::Kind::kServerRestart, "SERVER_RESTART", "the server dies and goes on from its checkpoint"},
    {Fault::Kind::kStopHand, "STOP_HAND", "the person stops his own hand"},
    {Fault::Kind::kStopAll, "STOP_ALL", "the person stops the session"},
    {Fault::Kind::kHostile, "HOSTILE", "the client sends what nobody may"},
    {Fault::Kind::kHot, "HOT", "the device's motors are too hot"},
}};
[[nodiscard]] constexpr bool of_server(Fault::Kind kind) noexcept {
  return kind == Fault::Kind::kServerLate || kind == Fault::Kind::kServerRestart;
}
[[nodiscard]] constexpr std::string_view name(Fault::Kind kind) noexcept {
  return kFaultNames[static_cast<std::size_t>(kind)].name;
}

}  // namespace tandem::netsim
