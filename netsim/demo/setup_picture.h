#pragma once

#include <string>

/// The set-up as a drawing: two hands, the network between, the server with slave and wall. Pure.
namespace tandem::netsim::demo {

/// @param real_time  processes over UDP; otherwise virtual time
/// @return one <svg> element that stays readable at 370 px
[[nodiscard]] std::string setup_picture(bool real_time);

}  // namespace tandem::netsim::demo
