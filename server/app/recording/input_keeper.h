#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/base/time.h"
#include "server/app/recording/kept_inputs.h"

namespace tandem::server {

/// Keeps the inputs of all sessions of a server, on two ordinary threads: one drains the journals and never waits, the
/// other one packs and writes the spools. Neither runs before the first session is added.
class InputKeeper {
 public:
  static constexpr Duration kDrainInterval = std::chrono::milliseconds(10);
  static constexpr Duration kKeepInterval = std::chrono::milliseconds(20);

  InputKeeper() = default;
  ~InputKeeper();
  InputKeeper(const InputKeeper&) = delete;
  InputKeeper& operator=(const InputKeeper&) = delete;

  /// Keeps the inputs of a session until nothing else refers to them. They are then released on the thread that writes,
  /// because the disk may take long to free them.
  void add(std::shared_ptr<KeptInputs> inputs);
  /// Processor time of both threads.
  [[nodiscard]] Duration cpu() const noexcept { return Duration{drain_ns_.load() + keep_ns_.load()}; }

 private:
  [[nodiscard]] std::vector<std::shared_ptr<KeptInputs>> all();
  void release_unused();
  void drain();
  void keep();
  [[nodiscard]] bool pause(Duration interval);

  std::mutex lock_;
  std::condition_variable stopped_;
  std::vector<std::shared_ptr<KeptInputs>> inputs_;
  bool stop_ = false;
  std::atomic<std::int64_t> drain_ns_{0}, keep_ns_{0};
  std::thread drainer_, keeper_;
};

}  // namespace tandem::server
