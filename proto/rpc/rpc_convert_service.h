#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/schema/rpc.pb.h"

/// Private to proto/rpc: conversion of the messages about a service. `read` returns false if a value is out of its
/// bound.
namespace tandem::rpc {

[[nodiscard]] bool read(const pb::rpc::Elsewhere& in, Elsewhere& out);
void write(const Elsewhere& in, pb::rpc::Elsewhere& out);
[[nodiscard]] bool read_members(const google::protobuf::RepeatedPtrField<std::string>& in,
                                std::vector<std::string>& out);

}  // namespace tandem::rpc
