#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/auth/io/server_keystore.h"
#include "server/app/service/repeated_task.h"
#include "server/app/service/service_thread.h"

namespace tandem::server {

/// Keeps the files with workstations and codes in a server's state folder equal to those of its service
/// (server/service/shared_registry.h). A thread of its own reads and writes them, so that a slow disk delays no
/// renewal of the lease. Commands in the same folder, such as `tandem-server enroll`, change the files as ever.
class RegistryMirror {
 public:
  static constexpr const char* kFile = "service_registry";  ///< the last agreement of files and directory

  /// Reads the agreement of an earlier run. A damaged file counts as none: the lists of both sides are then joined.
  [[nodiscard]] static RegistryAgreement read_agreement(const auth::StateDirectory& folder);

  /// @param keys     of the state folder, for this object alone
  /// @param service  must outlive this
  /// @param trouble  receives errors of the files, each once until it is over; on the thread, and in `stop`
  RegistryMirror(auth::ServerKeystore keys, ServiceThread& service, std::function<void(const std::string&)> trouble)
      : keys_(std::move(keys)),
        service_(service),
        on_trouble_(std::move(trouble)),
        task_(kInterval, [this] { return compare(); }, on_trouble_) {}

  /// Between two writes that change nothing but the revision.
  static constexpr Duration kRevisionInterval = std::chrono::seconds(10);
  /// Whether the stored agreement has to be replaced: always, unless only the revision differs and it is recent.
  /// @param age  since it was stored
  [[nodiscard]] static bool worth_storing(const RegistryAgreement& agreed, const RegistryAgreement& stored,
                                          Duration age);

  void start();
  /// Compares once more, so that the newest revision is stored.
  void stop();

 private:
  static constexpr Duration kInterval = std::chrono::milliseconds(100);  ///< between two looks at the files
  /// Compares files and directory once. @return the error
  [[nodiscard]] std::string compare();

  auth::ServerKeystore keys_;
  ServiceThread& service_;
  std::optional<auth::RegistryLists> lists_;  ///< as last read; nullopt: not yet, or they could not be
  RegistryAgreement stored_;
  std::chrono::steady_clock::time_point stored_at_{};
  bool stops_ = false;
  std::function<void(const std::string&)> on_trouble_;
  RepeatedTask task_;
};

}  // namespace tandem::server
