#pragma once

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <functional>
#include <optional>
#include <thread>

namespace tandem::server {

/// Thread that runs the io_context of a control plane, with all signals blocked.
class ControlThread {
 public:
  [[nodiscard]] asio::io_context& context() noexcept { return context_; }
  void start();
  /// Runs `last` on the thread, then ends and joins it.
  void stop(std::function<void()> last);
  ~ControlThread();

 private:
  asio::io_context context_{1};
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work_;
  std::thread thread_;
};

}  // namespace tandem::server
