#pragma once

#include <string>
#include <vector>

#include "tests/support/process.h"

namespace tandem::test {

/// Members of one etcd cluster on loopback, each with ports and a data folder of its own. They end with this object,
/// which also removes their data.
class EtcdCluster {
 public:
  /// Path of Debian's etcd; empty if it is not installed.
  [[nodiscard]] static std::string program();

  /// @param members  1 to 9
  explicit EtcdCluster(std::size_t members);
  ~EtcdCluster();
  EtcdCluster(const EtcdCluster&) = delete;
  EtcdCluster& operator=(const EtcdCluster&) = delete;

  /// "host:port" for clients, by member.
  [[nodiscard]] const std::vector<std::string>& endpoints() const noexcept { return endpoints_; }
  [[nodiscard]] std::size_t size() const noexcept { return endpoints_.size(); }
  [[nodiscard]] Process& member(std::size_t i) { return members_[i]; }
  /// Ends a member at once, as a power failure does.
  void kill(std::size_t i);
  /// Starts a member that has ended, with its former data.
  void restart(std::size_t i);
  /// Folder with the data of a member.
  [[nodiscard]] std::string data(std::size_t i) const;

 private:
  [[nodiscard]] Process start(std::size_t i) const;

  std::string folder_, initial_;
  std::vector<std::string> endpoints_, peers_;
  std::vector<Process> members_;
};

}  // namespace tandem::test
