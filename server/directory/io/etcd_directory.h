#pragma once

#include <memory>

#include "server/directory/directory.h"
#include "server/directory/io/etcd_options.h"

namespace tandem::directory {

/// The directory in etcd, through gRPC. A thread of its own begins the calls; gRPC's threads take the answers. `begin`
/// and `poll` only move a request or a reply through a queue: they never wait for the network.
///
/// Every call goes to one member of etcd. When a call fails there, the next ones go to the next endpoint; not if the
/// member answers that it is full.
class EtcdDirectory final : public Directory {
 public:
  /// Requests and watches that may be open at a time; further ones get a reply kUnknown.
  static constexpr std::size_t kOpenMax = 2048;
  /// Of these, for requests by which a server keeps its lease: Grant, Renew, and transactions that only read.
  static constexpr std::size_t kReserved = 64;

  struct Counters {
    std::uint64_t begun = 0, unknown = 0, refused = 0, overflowed = 0;
    std::uint64_t endpoint_changes = 0;
  };

  /// Connects when the first operation begins. @pre `options.problem()` is empty
  explicit EtcdDirectory(EtcdOptions options);
  /// Ends all calls and waits for their ends.
  ~EtcdDirectory() override;
  EtcdDirectory(const EtcdDirectory&) = delete;
  EtcdDirectory& operator=(const EtcdDirectory&) = delete;

  void begin(OperationId operation, const Request& request) override;
  [[nodiscard]] std::optional<Reply> poll() override;
  void notify_by(const std::function<void()>& told) override;
  [[nodiscard]] Counters counters() const;

  class Core;  ///< state that the threads share

 private:
  std::unique_ptr<Core> core_;
};

}  // namespace tandem::directory
