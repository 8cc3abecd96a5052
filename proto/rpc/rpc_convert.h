#pragma once

#include "proto/rpc/rpc_messages.h"
#include "proto/schema/rpc.pb.h"

/// Private to proto/rpc: conversion of control messages between owned structs and protobuf.
namespace tandem::rpc {

/// Converts and checks a message. @return false if a value is out of its bound
[[nodiscard]] bool from_pb(const pb::rpc::ControlFrame& in, Body& out);
/// Converts a message without checks; from_pb checks.
void to_pb(const Body& in, pb::rpc::ControlFrame& out);
/// Overwrites the secrets in `frame`.
void wipe_secrets(pb::rpc::ControlFrame& frame) noexcept;

}  // namespace tandem::rpc
