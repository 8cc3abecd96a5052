#pragma once

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/metrics_page.h"
#include "tests/io/pressing_hands.h"

namespace tandem::test {

/// Watches which servers of a service engage hands, through the metrics of each some 40 times a second. A hand is
/// engaged as its client reported last.
class OwnersWitness {
 public:
  /// State of a server's seats, as it showed it between two moments.
  struct Seen {
    std::chrono::steady_clock::time_point asked{}, answered{};
    bool answers = false;
    std::size_t engaged = 0;  ///< taken seats whose gate is active or ramps in, as a fresh report says
    std::size_t active = 0;   ///< those whose gate is wholly active
    [[nodiscard]] bool acts() const { return engaged > 0; }
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
  /// Name of the server that engages hands now; empty: none.
  [[nodiscard]] std::string owner() const {
    const std::lock_guard lock(lock_);
    for (const auto& [server, all] : seen_)
      if (!all.empty() && all.back().acts()) return server;
    return "";
  }
  /// Number of times at which a server engaged hands while another one did, as far as the pace of the samples shows.
  [[nodiscard]] std::size_t overlaps() const {
    const std::lock_guard lock(lock_);
    return overlaps(seen_);
  }
  /// The same for given samples of each server, the oldest first.
  [[nodiscard]] static std::size_t overlaps(const std::map<std::string, std::deque<Seen>>& of) {
    std::size_t count = 0;
    for (const auto& [server, own] : of)
      for (std::size_t i = 1; i < own.size(); ++i) {
        const Seen &before = own[i - 1], &after = own[i];
        if (!before.acts() || !after.acts() || after.answered - before.asked > kContinuous) continue;
        for (const auto& [other, theirs] : of)
          if (other != server)
            for (const Seen& their : theirs)
              if (their.acts() && their.asked > before.answered && their.answered < after.asked) ++count;
      }
    return count;
  }
  /// Reads a page of metrics.
  [[nodiscard]] static Seen read(const std::string& text) {
    Seen seen;
    seen.answers = !text.empty();
    const std::string name = "\ntandem_gate_state";
    for (auto at = text.find(name + "{"); at != std::string::npos; at = text.find(name + "{", at + 1)) {
      const std::string labels = text.substr(at + name.size(), text.find('}', at) - at - name.size());
      if (text.find("\ntandem_seat_taken" + labels + "} 1\n") == std::string::npos) continue;
      // The page keeps the last state of a silent client, whose own gate has released the hand long ago.
      const std::string age = "\ntandem_loop_age_seconds" + labels + "} ";
      if (const auto found = text.find(age);
          found != std::string::npos && std::strtod(text.c_str() + found + age.size(), nullptr) > kFreshMax)
        continue;
      const auto gate = static_cast<Gate>(text[text.find("} ", at) + 2] - '0');
      seen.engaged += gate == kRampIn || gate == kActive ? 1 : 0;
      seen.active += gate == kActive ? 1 : 0;
    }
    return seen;
  }

 private:
  static constexpr std::chrono::milliseconds kPause{25}, kContinuous{200};
  static constexpr double kFreshMax = 0.5;  // [s] the gates of the clients release after 20 ms of silence

  static Seen look(const std::string& metrics) {
    const auto asked = std::chrono::steady_clock::now();
    Seen seen = read(page(metrics));
    seen.asked = asked;
    seen.answered = std::chrono::steady_clock::now();
    return seen;
  }

  mutable std::mutex lock_;
  std::map<std::string, std::deque<Seen>> seen_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

}  // namespace tandem::test
