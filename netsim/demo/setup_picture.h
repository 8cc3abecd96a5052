#pragma once

#include <string>

/// Drawing of the set-up: two hands, the network, the server with slave and wall. Pure functions.
namespace tandem::netsim::demo {

/// @param real_time  processes over UDP; otherwise virtual time
/// @return one <svg> element that is legible at a width of 370 px
[[nodiscard]] std::string setup_picture(bool real_time);

}  // namespace tandem::netsim::demo
