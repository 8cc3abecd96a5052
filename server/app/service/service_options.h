#pragma once

#include <string>

#include "server/directory/io/etcd_options.h"
#include "server/directory/lease_times.h"

namespace tandem::server {

/// How a server is a member of a service of several servers, validated.
struct ServiceOptions {
  directory::EtcdOptions etcd{};
  std::string prefix = "/tandem/v1/";
  directory::LeaseTimes times{};
  std::string server{};       ///< name in the service; empty: that of the membership
  std::string address{};      ///< HOST:PORT for clients; empty: the address at which it listens
  std::string zone{};         ///< empty: none
  std::string tls_options{};  ///< of etcdctl, with the files of the configuration; empty: without TLS
  bool balance = true;        ///< sessions move to less used servers by themselves
};

/// Times of a lease: sessions are held after two thirds of it, and it is renewed six times in its duration.
[[nodiscard]] inline directory::LeaseTimes lease_times(Duration ttl) {
  directory::LeaseTimes times;
  times.ttl = ttl;
  times.hold_after = ttl * 2 / 3;
  times.renew_every = ttl / 6;
  return times;
}

}  // namespace tandem::server
