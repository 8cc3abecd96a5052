#pragma once

#include <condition_variable>
#include <expected>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/auth/io/state_directory.h"
#include "server/app/service/service_thread.h"
#include "server/service/service_list.h"

namespace tandem::server {

/// Keeps the list of the service's sessions in the state folder of a running server, for `tandem-server ticket` and
/// `sessions` there. A thread of its own writes it, at most once a second, so that a slow disk delays no session.
class ServiceListFile {
 public:
  /// @param folder, service  must outlive this
  /// @param trouble  receives errors of the file, each once until it is over; on the thread
  ServiceListFile(const auth::StateDirectory& folder, ServiceThread& service,
                  std::function<void(const std::string&)> trouble)
      : folder_(folder), service_(service), on_trouble_(std::move(trouble)) {}
  ~ServiceListFile() { stop(); }

  void start();
  /// Removes the file.
  void stop();

 private:
  void run();
  /// Writes the list if it has changed. @return the error
  [[nodiscard]] std::string update();

  const auth::StateDirectory& folder_;
  ServiceThread& service_;
  std::function<void(const std::string&)> on_trouble_;
  ServiceListReader reader_;
  bool written_ = false;  ///< as of the last look
  std::string trouble_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

/// Reads the list of the service whose server runs from this folder; nullopt: the server belongs to none, or has
/// written no list yet.
[[nodiscard]] std::expected<std::optional<ServiceList>, std::string> read_service_list(
    const auth::StateDirectory& folder);

}  // namespace tandem::server
