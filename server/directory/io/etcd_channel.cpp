#include "server/directory/io/etcd_channel.h"

#include <grpcpp/grpcpp.h>

namespace tandem::directory {

std::shared_ptr<grpc::Channel> etcd_channel(const EtcdOptions& options, std::size_t endpoint) {
  // etcd ends connections with pings more often than every 5 s.
  constexpr int kPing = 6000, kPingAnswer = 2000, kReconnect = 200, kReconnectMost = 1000, kMessageMax = 32 << 20;
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kPing);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kPingAnswer);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kReconnect);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kReconnectMost);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetMaxReceiveMessageSize(kMessageMax);
  auto credentials = grpc::InsecureChannelCredentials();
  if (!options.authority.empty()) {
    credentials = grpc::SslCredentials({options.authority, options.key, options.certificate});
    if (!options.name_in_certificate.empty()) arguments.SetSslTargetNameOverride(options.name_in_certificate);
  }
  return grpc::CreateCustomChannel(options.endpoints[endpoint], credentials, arguments);
}

}  // namespace tandem::directory
