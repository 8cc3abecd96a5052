#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/service/service_member.h"

namespace tandem::server {

/// Returns how to find out why etcd does not answer. @param tls_options  of etcdctl; empty: without TLS
[[nodiscard]] std::string directory_remedy(const std::string& endpoints, const std::string& tls_options);

/// Turns changes of a member's state into lines for the operator of the server: one line per change.
class ServiceNews {
 public:
  struct Line {
    bool warning = false;
    std::string event;  ///< one word, for the log
    std::string text;
  };

  /// @param endpoints    of the directory, for messages
  /// @param tls_options  of etcdctl, if the server talks to the directory by TLS
  ServiceNews(std::string server, std::string endpoints, directory::LeaseTimes times, std::string tls_options = {})
      : server_(std::move(server)),
        endpoints_(std::move(endpoints)),
        times_(times),
        tls_options_(std::move(tls_options)) {}

  /// @param now  of the clock of the member
  [[nodiscard]] std::vector<Line> update(Time now, const ServiceStatus& status);

 private:
  enum class State : std::uint8_t { kStarting, kUnreachable, kNameTaken, kMember, kNoAnswer };

  std::string server_, endpoints_;
  directory::LeaseTimes times_;
  std::string tls_options_;
  State state_ = State::kStarting;
  bool stranger_ = false;
  bool held_ = false, recovers_ = false;
  std::uint64_t losses_ = 0;
  std::optional<Time> began_, name_taken_since_;
};

}  // namespace tandem::server
