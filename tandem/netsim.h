#pragma once

#include "common/base/time.h"
#include "netsim/engine/network.h"
#include "netsim/models/path_spec.h"
#include "netsim/profiles/capacity_csv.h"
#include "netsim/profiles/network_csv.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/fault.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/scene_run.h"
#include "netsim/system/simulation_config.h"
#include "proto/text/scene_text.h"
#include "server/report/report.h"

/// @file
/// Simulated networks, and whole sessions in virtual time. CMake target `Tandem::netsim`.
///
/// | part | classes |
/// |---|---|
/// | named networks | tandem::netsim::shipped_profile, tandem::netsim::parse_profile |
/// | recorded networks | tandem::netsim::parse_network_csv, tandem::netsim::parse_capacity |
/// | impairments of one link by numbers | tandem::netsim::SimpleNetwork, tandem::netsim::LinkSpec |
/// | virtual network for datagrams of one's own | tandem::netsim::Network |
/// | session of Tandem's server, clients and devices | tandem::netsim::run_scene, tandem::netsim::run_simulation |
/// | result, with the violated invariants | tandem::netsim::RunReport |
///
/// No function reads a clock. The same arguments and the same build give the same result, byte for byte. The header
/// `tandem/testing.h` adds a GoogleTest fixture. Examples: tests/examples/04_delay_injection.cpp and
/// tests/examples/05_two_hands.cpp.
namespace tandem::netsim {

using server::RunReport;
using server::SeatReport;
using server::ToolReport;
using server::Violation;

}  // namespace tandem::netsim
