#pragma once

#include <functional>
#include <mutex>
#include <utility>

namespace tandem::console {

/// Way of other threads to the web thread. It outlives the web server: work for a server that is gone is dropped.
class Mailbox {
 public:
  using Work = std::function<void()>;

  /// @param post  gives work to the web thread; empty: the web thread is gone
  void connect(std::function<void(Work)> post) {
    const std::lock_guard hold{lock_};
    post_ = std::move(post);
  }
  void post(Work work) {
    const std::lock_guard hold{lock_};
    if (post_) post_(std::move(work));
  }

 private:
  std::mutex lock_;
  std::function<void(Work)> post_;
};

}  // namespace tandem::console
