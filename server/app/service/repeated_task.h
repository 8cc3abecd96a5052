#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "common/base/time.h"

namespace tandem::server {

/// Repeats a task on a thread of its own, so that a slow disk delays nothing else, and reports each error of the task
/// once until it is over.
class RepeatedTask {
 public:
  /// @param interval  between the end of one run of the task and the begin of the next
  /// @param task      returns its error; empty: none
  /// @param trouble   receives errors, on the thread
  RepeatedTask(Duration interval, std::function<std::string()> task, std::function<void(const std::string&)> trouble)
      : interval_(interval), task_(std::move(task)), on_trouble_(std::move(trouble)) {}
  ~RepeatedTask() { stop(); }
  RepeatedTask(const RepeatedTask&) = delete;
  RepeatedTask& operator=(const RepeatedTask&) = delete;

  void start();
  /// Waits for the end of a run of the task.
  void stop();
  [[nodiscard]] bool running() const noexcept { return thread_.joinable(); }

 private:
  void run();

  Duration interval_;
  std::function<std::string()> task_;
  std::function<void(const std::string&)> on_trouble_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace tandem::server
