#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "common/io/output_file.h"
#include "common/io/spsc_queue.h"
#include "netsim/engine/decision_log.h"

namespace tandem::netsim {

/// Writer of the option --log of `proxy`. A bounded queue carries decisions from the packet thread to a writer thread,
/// in the order in which they became final. A slow disk loses rows, which are counted, and never delays packets.
class DecisionWriter final : public DecisionSink {
 public:
  DecisionWriter() : queue_(kRoom) {}
  ~DecisionWriter() override { stop(); }

  /// Opens the log file.
  /// @param name  empty: no log
  /// @return error, or empty on success
  [[nodiscard]] std::string open(const std::string& name);
  [[nodiscard]] bool wanted() const noexcept { return file_.is_open(); }

  void decided(const Decision& decision) noexcept override {
    if (!direct_) {
      queue_.push(decision);
    } else {
      write(decision);
    }
  }

  /// Call after the packet thread has ended: writes all queued decisions. Later decisions are written directly.
  void stop();
  /// Closes the file.
  /// @return error, or empty if every row was written
  [[nodiscard]] std::string close();
  [[nodiscard]] std::uint64_t written() const noexcept { return written_; }
  [[nodiscard]] std::uint64_t missed() const noexcept { return queue_.dropped(); }

 private:
  static constexpr std::size_t kRoom = 1 << 17;  ///< decisions of 20 clients in two seconds, 7 MB
  void write(const Decision& decision) noexcept;
  void drain() noexcept;
  void flush() noexcept;

  io::OutputFile file_;
  io::SpscQueue<Decision> queue_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  bool direct_ = false;
  std::string text_;
  std::uint64_t written_ = 0;
};

}  // namespace tandem::netsim
