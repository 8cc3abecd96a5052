#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "common/io/output_file.h"
#include "common/link/digest.h"
#include "server/app/shard.h"
#include "server/report.h"
#include "server/trace_csv.h"

namespace tandem::server {

/// An ordinary thread that judges and writes what the shard lived through. It may be late; the shard never waits for
/// it.
class Recorder {
 public:
  /// @param trace  opened; rows are written if wanted, and hashed always
  Recorder(const SceneSpec& scene, TickQueue& records, io::OutputFile& trace);
  ~Recorder() { finish(); }

  /// Once the shard is over: takes what is left in the queue and ends the thread.
  void finish();
  /// After `finish`.
  [[nodiscard]] const ReportBuilder& builder() const noexcept { return builder_; }
  [[nodiscard]] const std::string& trace_hash() const noexcept { return hash_; }

 private:
  void work();
  void drain();
  void flush();

  TickQueue* records_;
  io::OutputFile* trace_;
  ReportBuilder builder_;
  TraceCsv csv_;
  link::Digest digest_;
  std::string rows_, hash_;
  std::atomic<bool> finish_{false};
  std::thread thread_;
};

}  // namespace tandem::server
