#pragma once

#include "proto/control.pb.h"
#include "proto/control_messages.h"

/// Private to proto/*.cpp: control messages between our structs and protobuf's.
namespace tandem::control {

/// @return false: a value is beyond its bound
[[nodiscard]] bool from_pb(const pb::control::ControlFrame& in, Body& out);
/// Values as they are; judging them is from_pb's.
void to_pb(const Body& in, pb::control::ControlFrame& out);
/// Overwrites the secrets it holds.
void wipe_secrets(pb::control::ControlFrame& frame) noexcept;

}  // namespace tandem::control
