#pragma once

#include <etcd.grpc.pb.h>
#include <grpcpp/grpcpp.h>

#include "server/directory/directory.h"

namespace tandem::directory {

/// Turns requests of the directory into messages of etcd, and answers of etcd into replies.

[[nodiscard]] etcdserverpb::TxnRequest to_etcd(const Transaction& transaction);
[[nodiscard]] etcdserverpb::WatchRequest to_etcd(const Watch& watch);

/// Outcome of a call that etcd did not answer with OK. Only kUnknown leaves open whether etcd executed the request.
[[nodiscard]] Outcome outcome_of(const grpc::Status& status);
[[nodiscard]] Reply failed(OperationId operation, const grpc::Status& status);

[[nodiscard]] Reply from_etcd(OperationId operation, const etcdserverpb::TxnResponse& answer);
[[nodiscard]] Reply from_etcd(OperationId operation, const etcdserverpb::LeaseGrantResponse& answer);
[[nodiscard]] Reply from_etcd(OperationId operation, const etcdserverpb::LeaseKeepAliveResponse& answer);
[[nodiscard]] Reply from_etcd(OperationId operation, const etcdserverpb::LeaseTimeToLiveResponse& answer);
[[nodiscard]] Reply from_etcd(OperationId operation, const etcdserverpb::WatchResponse& answer);
/// For answers that have a header only.
[[nodiscard]] Reply from_header(OperationId operation, const etcdserverpb::ResponseHeader& header);

}  // namespace tandem::directory
