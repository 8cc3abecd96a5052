#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "server/recording/io/recording_repair.h"

namespace tandem::server {

/// Closes the recordings that an earlier server left in its folders, on a thread of low priority: sessions start
/// meanwhile. It removes spools of inputs that it left. It looks for the files once, before the server makes new ones.
class LeftoverRepair {
 public:
  /// @param folders    of recordings
  /// @param on_result  called on the thread, once per file
  LeftoverRepair(const std::vector<std::string>& folders, std::function<void(const RecordingRepair&)> on_result);
  /// Waits for the file that is being repaired.
  ~LeftoverRepair();
  LeftoverRepair(const LeftoverRepair&) = delete;
  LeftoverRepair& operator=(const LeftoverRepair&) = delete;

 private:
  std::vector<std::string> files_;
  std::function<void(const RecordingRepair&)> on_result_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace tandem::server
