#pragma once

#include "common/base/axes.h"
#include "common/base/port_sample.h"
#include "common/base/time.h"
#include "common/control/authority.h"
#include "common/control/channel.h"
#include "common/control/channel_energy_bounded.h"
#include "common/control/energy_ledger.h"
#include "common/control/esc_hub.h"
#include "common/control/force_gate.h"
#include "common/control/gain_schedule.h"

/// @file
/// Control laws of shared teleoperation. CMake target `Tandem::control`; depends on the C++ library only.
///
/// | part | classes |
/// |---|---|
/// | channel law, the two ends of a seat's spring | tandem::control::ChannelEnd, tandem::control::EnergyBoundedEnd |
/// | laws by name | tandem::control::channel_laws, tandem::control::make_channel_end |
/// | energy account of one axis | tandem::control::EnergyLedger |
/// | last limit before the motor | tandem::control::ForceGate |
/// | authority and its tank | tandem::control::ToolAuthority, tandem::control::AuthorityTank |
/// | Energy Shared Control of n masters and m tools | tandem::control::EscHub |
///
/// To write a law, derive from tandem::control::EnergyBoundedEnd and implement `move`. The base class moves the
/// reference only as far as the ledger pays, so the law is passive for any target. The functions of a tick take no
/// heap, no lock and no clock. Example: tests/examples/02_control_law.cpp.

/// Types that all parts share: time without a clock, axes, samples of a port. Units are SI unless a name has another.
namespace tandem {}
