#pragma once

#include <chrono>
#include <condition_variable>
#include <expected>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/name_resolver.h"

namespace tandem::test {

/// A DNS server that does not answer before the test lets it. A test that waits for it goes on after 20 s, and fails.
class BlockedLookup {
 public:
  using Answer = std::expected<io::NameResolver::Addresses, std::string>;

  BlockedLookup() = default;
  BlockedLookup(const BlockedLookup&) = delete;
  BlockedLookup& operator=(const BlockedLookup&) = delete;
  ~BlockedLookup() { answer(std::unexpected(std::string("the test is over"))); }

  /// Returns a resolver that asks this server.
  [[nodiscard]] io::NameResolver resolver() const {
    return io::NameResolver([state = state_](const std::string& name) { return state->look_up(name); });
  }
  /// Answers all lookups, and those to come.
  void answer(Answer answer) {
    const std::lock_guard lock(state_->mutex);
    state_->answer = std::move(answer);
    state_->changed.notify_all();
  }
  /// Waits until that many lookups have begun.
  void wait_for(std::size_t lookups) {
    std::unique_lock lock(state_->mutex);
    state_->changed.wait_for(lock, kPatience, [&] { return state_->names.size() >= lookups; });
  }
  /// Names of the lookups so far.
  [[nodiscard]] std::vector<std::string> names() const {
    const std::lock_guard lock(state_->mutex);
    return state_->names;
  }
  /// Whether a lookup waits for the answer.
  [[nodiscard]] bool blocks() const {
    const std::lock_guard lock(state_->mutex);
    return state_->waiting > 0;
  }

 private:
  static constexpr std::chrono::seconds kPatience{20};

  /// A lookup may begin after the end of the test.
  struct State {
    Answer look_up(const std::string& name) {
      std::unique_lock lock(mutex);
      names.push_back(name);
      ++waiting;
      changed.notify_all();
      changed.wait_for(lock, kPatience, [this] { return answer.has_value(); });
      --waiting;
      return answer.value_or(std::unexpected(std::string("the test gave no answer")));
    }
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::string> names;
    int waiting = 0;
    std::optional<Answer> answer;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace tandem::test
