#pragma once

#include <cstdint>

/// Messages of a link test. A link-test peer joins only to measure its link and takes no seat. It sends LINK_PROBE and
/// receives LINK_REPORT at the scene's rate. They are as long as the STATE and FORCE of the scene's first seat, so that
/// the link carries the traffic of a seat. Nothing in them reaches a session. Joining, encryption and closing are those
/// of a seat.
namespace tandem::wire {

/// Client to server, every tick. It carries no values: the preamble is what the test needs.
struct LinkProbe {};

/// Server to client, every tick. Counters of the LINK_PROBEs of this peer. Together with Preamble::echo_counter, the
/// newest counter that was used, they give the loss from client to server.
struct LinkReport {
  std::uint32_t used = 0;  ///< each newer than all before
  std::uint32_t late = 0;  ///< authentic, but older than one already used: the network reordered them
};

}  // namespace tandem::wire
