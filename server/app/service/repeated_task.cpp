#include "server/app/service/repeated_task.h"

#include "common/io/thread_without_signals.h"

namespace tandem::server {

void RepeatedTask::start() {
  thread_ = io::thread_without_signals([this] { run(); });
}

void RepeatedTask::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RepeatedTask::run() {
  std::string trouble;
  while (true) {
    std::string problem = task_();
    if (!problem.empty() && problem != trouble) on_trouble_(problem);
    trouble = std::move(problem);
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, interval_, [this] { return stopping_; })) return;
  }
}

}  // namespace tandem::server
