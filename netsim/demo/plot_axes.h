#pragma once

/// Units and titles that the figures and tables of the demo share.
namespace tandem::netsim::demo {

/// Factor from metres, radians and joules to mm, mrad and mJ.
inline constexpr double kMilli = 1e3;
inline constexpr const char* kTimeAxis = "time [s]";

}  // namespace tandem::netsim::demo
