#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/metrics_page.h"

namespace tandem::test {

/// Watches which servers of a service run sessions, and their seats, through the metrics of each some 40 times a
/// second. A server engages hands only in a session that runs.
class OwnersWitness {
 public:
  /// What a server showed about its sessions between two moments.
  struct Seen {
    std::chrono::steady_clock::time_point asked, answered;
    bool answers = false;
    bool runs = false;       ///< at least one session runs
    std::size_t active = 0;  ///< seats whose gate is wholly active, in a server whose sessions run
  };

  OwnersWitness() = default;
  ~OwnersWitness() { stop(); }
  OwnersWitness(const OwnersWitness&) = delete;
  OwnersWitness& operator=(const OwnersWitness&) = delete;

  /// Watches a server from now on, also while it does not run.
  /// @param metrics  its address of metrics
  void watch(const std::string& server, const std::string& metrics) {
    threads_.emplace_back([this, server, metrics] {
      while (!stopping_) {
        const Seen seen = look(metrics);
        {
          const std::lock_guard lock(lock_);
          seen_[server].push_back(seen);
        }
        std::this_thread::sleep_for(kPause);
      }
    });
  }
  void stop() {
    stopping_ = true;
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  /// The newest answer of a server.
  [[nodiscard]] Seen newest(const std::string& server) const {
    const std::lock_guard lock(lock_);
    const auto found = seen_.find(server);
    return found == seen_.end() || found->second.empty() ? Seen{} : found->second.back();
  }
  /// Name of the server that runs sessions now; empty: none.
  [[nodiscard]] std::string owner() const {
    const std::lock_guard lock(lock_);
    for (const auto& [server, all] : seen_)
      if (!all.empty() && all.back().runs) return server;
    return "";
  }
  /// Number of times at which a server ran a session while another one did, as far as the pace of the samples shows.
  [[nodiscard]] std::size_t overlaps() const {
    const std::lock_guard lock(lock_);
    std::size_t count = 0;
    for (const auto& [server, own] : seen_)
      for (std::size_t i = 1; i < own.size(); ++i) {
        const Seen &before = own[i - 1], &after = own[i];
        if (!before.runs || !after.runs || after.answered - before.asked > kContinuous) continue;
        for (const auto& [other, theirs] : seen_)
          if (other != server)
            for (const Seen& their : theirs)
              if (their.runs && their.asked > before.answered && their.answered < after.asked) ++count;
      }
    return count;
  }

 private:
  static constexpr std::chrono::milliseconds kPause{25}, kContinuous{200};

  static Seen look(const std::string& metrics) {
    Seen seen{.asked = std::chrono::steady_clock::now(), .answered = {}};
    const std::string text = page(metrics);
    seen.answered = std::chrono::steady_clock::now();
    seen.answers = !text.empty();
    const std::string running = "tandem_sessions{phase=\"running\"} ";
    const auto at = text.find(running);
    seen.runs = at != std::string::npos && text[at + running.size()] != '0';
    if (seen.runs)
      for (auto gate = text.find("\ntandem_gate_state{"); gate != std::string::npos;
           gate = text.find("\ntandem_gate_state{", gate + 1))
        if (text.compare(text.find("} ", gate), 4, "} 3\n") == 0) ++seen.active;
    return seen;
  }

  mutable std::mutex lock_;
  std::map<std::string, std::deque<Seen>> seen_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

}  // namespace tandem::test
