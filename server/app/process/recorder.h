#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/io/output_file.h"
#include "common/transport/digest.h"
#include "server/app/process/shard.h"
#include "server/app/process/tick_feed.h"
#include "server/report/report.h"
#include "server/report/trace_csv.h"

namespace tandem::server {

/// Writes the trace and builds the report from a session's tick records, on an ordinary thread. It may lag; the shard
/// never waits for it.
class Recorder {
 public:
  /// @param trace  opened; rows are written only if a trace was requested, and always hashed
  Recorder(const SceneSpec& scene, TickQueue& records, io::OutputFile& trace);
  ~Recorder() { finish(); }

  /// Copies further records to a recording, from the first tick on of which the session makes a record for it; null: to
  /// none. From the thread that made this. Waits while the
  /// recorder works on its queue.
  void copy_to(std::shared_ptr<TickFeed> recording);
  /// Processes the rest of the queue and ends the thread. Call it when the session is over.
  void finish();
  /// Call it after `finish`.
  [[nodiscard]] const ReportBuilder& builder() const noexcept { return builder_; }
  [[nodiscard]] const std::string& trace_hash() const noexcept { return hash_; }

 private:
  void run();
  void drain();
  void flush();

  TickQueue* records_;
  std::mutex lock_;
  std::shared_ptr<TickFeed> recording_;
  io::OutputFile* trace_;
  ReportBuilder builder_;
  TraceCsv csv_;
  transport::Digest digest_;
  std::string rows_, hash_;
  std::atomic<bool> finish_{false};
  std::thread thread_;
};

}  // namespace tandem::server
