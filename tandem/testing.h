#pragma once

#include "netsim/testing/network_test.h"
#include "tandem/netsim.h"

/// @file
/// GoogleTest fixture for programs of one's own over simulated networks: tandem::netsim::NetworkTest. CMake target
/// `Tandem::testing`, which exists if GoogleTest is installed. Example: tests/examples/04_delay_injection.cpp.
