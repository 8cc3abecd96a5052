#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "common/io/output_file.h"
#include "common/io/spsc_queue.h"
#include "netsim/decision_log.h"

namespace tandem::netsim {

/// Option --log of `proxy`: decisions go from the packet thread through a bounded queue to a thread that writes them,
/// in the order in which they became final. A disk that is slow costs rows, which are counted, never packets.
class DecisionWriter final : public DecisionSink {
 public:
  DecisionWriter() : queue_(kRoom) {}
  ~DecisionWriter() override { stop(); }

  /// @param name  empty: nothing is wanted
  /// @return what is wrong, empty if nothing
  [[nodiscard]] std::string open(const std::string& name);
  [[nodiscard]] bool wanted() const noexcept { return file_.wanted(); }

  void decided(const Decision& decision) noexcept override {
    if (!direct_) {
      queue_.push(decision);
    } else {
      write(decision);
    }
  }

  /// The packet thread has ended: all that is queued is written, and what is decided from now on at once.
  void stop();
  /// @return what is wrong, empty if every row was written
  [[nodiscard]] std::string close();
  [[nodiscard]] std::uint64_t written() const noexcept { return written_; }
  [[nodiscard]] std::uint64_t missed() const noexcept { return queue_.dropped(); }

 private:
  static constexpr std::size_t kRoom = 1 << 17;  ///< two seconds of 20 clients, 7 MB
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
