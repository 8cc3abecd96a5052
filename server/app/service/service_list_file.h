#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <optional>
#include <string>

#include "common/auth/io/state_directory.h"
#include "server/app/service/repeated_task.h"
#include "server/app/service/service_thread.h"
#include "server/service/service_list.h"

namespace tandem::server {

/// Keeps the list of the service's sessions in the state folder of a running server, for `tandem-server ticket` and
/// `sessions` there, at most a second old.
class ServiceListFile {
 public:
  /// @param folder, service  must outlive this
  /// @param trouble  receives errors of the file, each once until it is over; on the thread
  ServiceListFile(const auth::StateDirectory& folder, ServiceThread& service,
                  std::function<void(const std::string&)> trouble)
      : folder_(folder), service_(service), task_(kInterval, [this] { return update(); }, std::move(trouble)) {}
  ~ServiceListFile() { stop(); }

  void start() { task_.start(); }
  /// Removes the file.
  void stop();

 private:
  /// Between two looks at whether the directory answers; each fifth one is at the whole list.
  static constexpr Duration kInterval = std::chrono::milliseconds(200);
  static constexpr unsigned kWhole = 5;

  /// Writes the list if it has changed. @return the error
  [[nodiscard]] std::string update();

  const auth::StateDirectory& folder_;
  ServiceThread& service_;
  ServiceListReader reader_;
  bool written_ = false;  ///< as of the last look
  unsigned looks_ = 0;
  RepeatedTask task_;
};

/// Reads the list of the service whose server runs from this folder; nullopt: the server belongs to none, or has
/// written no list yet.
[[nodiscard]] std::expected<std::optional<ServiceList>, std::string> read_service_list(
    const auth::StateDirectory& folder);

}  // namespace tandem::server
