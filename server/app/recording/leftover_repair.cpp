#include "server/app/recording/leftover_repair.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "server/recording/io/input_spool.h"

namespace tandem::server {

namespace {
constexpr int kLeastPriority = 19;  // nice value

std::vector<std::string> leftovers_of(const std::vector<std::string>& folders) {
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    remove_stale_spools(folder);
    for (std::string& file : recording_leftovers(folder)) files.push_back(std::move(file));
  }
  return files;
}
}  // namespace

LeftoverRepair::LeftoverRepair(const std::vector<std::string>& folders,
                               std::function<void(const RecordingRepair&)> on_result)
    : files_(leftovers_of(folders)), on_result_(std::move(on_result)) {
  if (files_.empty()) return;
  thread_ = std::thread([this] {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLeastPriority);
    for (const std::string& file : files_) {
      if (stop_.load(std::memory_order_relaxed)) return;
      on_result_(repair_recording(file));
    }
  });
}

LeftoverRepair::~LeftoverRepair() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

}  // namespace tandem::server
