#pragma once

#include <cstdint>

#include "proto/wire/wire_messages.h"

/// A link-test peer joins only to measure its link and takes no seat. It exchanges STATE and FORCE of the scene's sizes
/// at the scene's rate, so that its link carries the traffic of a seat. It does not affect a session: the server
/// ignores the contents of its STATE, and its FORCE carries a LinkTestReport. Joining, encryption and closing are those
/// of a seat.
namespace tandem::wire {

/// Counters of the STATEs received from a link-test peer. Together with Preamble::echo_counter, the newest counter that
/// was used, they give the loss from client to server.
struct LinkTestReport {
  std::uint32_t acted = 0;  ///< STATEs used: each newer than all before
  std::uint32_t late = 0;   ///< authentic STATEs older than one already used: the network reordered them
};

/// The FORCE for a link-test peer. The report uses the fields session_tick and authority_version.
[[nodiscard]] inline ForceMessage to_force_message(const LinkTestReport& visit) noexcept {
  ForceMessage m;
  m.session_tick = visit.acted;
  m.authority_version = visit.late;
  return m;
}
[[nodiscard]] inline LinkTestReport link_test_report_of(const ForceMessage& m) noexcept {
  return {m.session_tick, m.authority_version};
}

}  // namespace tandem::wire
