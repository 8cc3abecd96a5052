#pragma once

#include <grpcpp/channel.h>

#include <cstddef>
#include <memory>

#include "server/directory/io/etcd_options.h"

namespace tandem::directory {

/// Opens a connection to one endpoint of the options, with TLS if they name an authority. It connects by itself, and
/// again after a loss.
[[nodiscard]] std::shared_ptr<grpc::Channel> etcd_channel(const EtcdOptions& options, std::size_t endpoint);

}  // namespace tandem::directory
