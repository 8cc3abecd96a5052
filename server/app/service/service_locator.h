#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "server/app/control/session_locator.h"
#include "server/app/service/service_thread.h"

namespace tandem::server {

/// Finds sessions by the member's copy of the directory.
class ServiceLocator final : public SessionLocator {
 public:
  static constexpr std::size_t kMembersMax = 16;

  /// @param server  name of this server  @param thread  must outlive this
  ServiceLocator(std::string server, ServiceThread& thread) : server_(std::move(server)), thread_(thread) {}

  [[nodiscard]] Found locate(const rpc::SessionChoice& choice) override;
  [[nodiscard]] std::vector<Elsewhere> elsewhere() const override;
  [[nodiscard]] std::vector<std::string> members() const override;
  [[nodiscard]] bool fresh() const noexcept override;
  /// Remembers the addresses of the present members, from any thread. A client that joins while a server is down must
  /// know where it will be again.
  void remember_members();

 private:
  std::string server_;
  ServiceThread& thread_;
  mutable std::mutex lock_;
  std::map<std::string, std::string> addresses_;  ///< of all members that were seen, at most kMembersMax, by name
};

/// Turns the record of a server into the location of a session. Returns nothing if key or voucher is no hexadecimal
/// text of the right length.
[[nodiscard]] std::optional<ServerLocation> location_of(const directory::ServerRecord& record,
                                                        const std::string& session, std::uint64_t revision);

/// Returns addresses of members, each once, at most kMembersMax: of server `own` first, also while the directory does
/// not have its record; then of the present ones, then of others that were seen. Keys are names.
[[nodiscard]] std::vector<std::string> member_addresses(const std::string& own,
                                                        const std::map<std::string, directory::ServerRecord>& present,
                                                        const std::map<std::string, std::string>& seen);

}  // namespace tandem::server
