#pragma once

#include <expected>
#include <map>
#include <memory>
#include <string>

#include "server/app/service/service_options.h"
#include "server/directory/directory_view.h"
#include "server/directory/io/etcd_directory.h"
#include "server/service/servers_table.h"
#include "server/service/service_catalogue.h"

namespace tandem::server {

/// The directory of a service as a command sees it: servers, owners and sessions.
class ServiceQuery {
 public:
  struct Failure {
    int code = 1;  ///< exit code
    std::string text;
  };
  /// Reads a configuration with a block `directory`, then the whole directory, for at most 5 s.
  [[nodiscard]] static std::expected<std::unique_ptr<ServiceQuery>, Failure> open(const std::string& config);

  [[nodiscard]] const directory::DirectoryView& view() const noexcept { return view_; }
  [[nodiscard]] const ServiceCatalogue& catalogue() const noexcept { return catalogue_; }
  [[nodiscard]] const ServiceKeys& keys() const noexcept { return keys_; }
  /// Where the directory was read, for a person who finds less in it than expected.
  [[nodiscard]] const std::string& place() const noexcept { return place_; }
  /// Asks for the rest of the leases of all servers, for at most 2 s. Those without an answer are missing.
  [[nodiscard]] LeaseRests lease_rests();
  /// Begins a transaction.
  void begin(directory::Transaction transaction) { directory_.begin(++operation_, transaction); }
  /// Follows the directory until `done` returns true. @return false: the time is over
  template <class Done>
  bool wait(Duration limit, Done&& done) {
    for (const Time end = now() + limit; now() < end; pause()) {
      step();
      if (done()) return true;
    }
    return false;
  }

 private:
  ServiceQuery(const ServiceOptions& options, const std::string& config);
  static Time now() noexcept;
  static void pause();
  void step();

  std::string place_;
  directory::EtcdDirectory directory_;
  ServiceKeys keys_;
  directory::DirectoryView view_;
  ServiceCatalogue catalogue_;
  directory::OperationId operation_ = 0;
  std::map<directory::OperationId, directory::Reply> other_replies_;  ///< that belong to neither copy
  std::string trouble_ = "no answer in time";
};

}  // namespace tandem::server
