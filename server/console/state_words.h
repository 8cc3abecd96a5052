#pragma once

#include <array>

#include "proto/wire/wire_messages.h"

/// Words of the protocol with the page for states of a seat and a session (PROTOCOL.md).
namespace tandem::console {

[[nodiscard]] constexpr const char* page_word(wire::GateState gate) noexcept {
  constexpr std::array kWords{"OFF", "OFF", "RISING", "ON", "RELEASING", "LATCHED", "FAULT"};
  const auto i = static_cast<std::size_t>(gate);
  return i < kWords.size() ? kWords[i] : "FAULT";
}

/// In kHeld no seat controls a tool, but the session runs, unless its server does not reach the directory of the
/// service: state_json.cpp reads that from the status. In kOverloaded all hands are released, as in a stop.
[[nodiscard]] constexpr const char* page_word(wire::SessionState state) noexcept {
  constexpr std::array kWords{"WAITING", "RUNNING", "RUNNING", "PAUSED", "STOPPED", "OVER", "STOPPED"};
  const auto i = static_cast<std::size_t>(state);
  return i < kWords.size() ? kWords[i] : "OVER";
}

}  // namespace tandem::console
