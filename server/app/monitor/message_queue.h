#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/io/log.h"

namespace tandem::server {

/// Terminal messages from other threads. The thread that owns the terminal prints them above the status line. If the
/// queue is full, new messages are dropped and counted.
class MessageQueue {
 public:
  static constexpr std::size_t kMax = 256;
  struct Line {
    io::Level level = io::Level::kInfo;
    std::string text;
  };

  void add(io::Level level, std::string text) {
    const std::lock_guard lock{lock_};
    if (lines_.size() < kMax) {
      lines_.push_back({level, std::move(text)});
    } else {
      ++dropped_;
    }
  }
  [[nodiscard]] std::vector<Line> take() {
    const std::lock_guard lock{lock_};
    if (const std::size_t dropped = std::exchange(dropped_, 0); dropped > 0)
      lines_.push_back({io::Level::kWarn, std::to_string(dropped) + " more lines arrived at once and are omitted"});
    return std::exchange(lines_, {});
  }

 private:
  std::mutex lock_;
  std::vector<Line> lines_;
  std::size_t dropped_ = 0;
};

}  // namespace tandem::server
