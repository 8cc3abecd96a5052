#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/app/seat_observer.h"
#include "client/app/trial_programs.h"
#include "client/app/tutorial.h"
#include "proto/spec/scene_spec.h"

namespace tandem::client {

/// The child processes of a trial, and the tutorial for the user.
class TrySession final : public SeatObserver {
 public:
  /// Shortest session of a trial [s]: the tutorial, and time to continue by hand.
  static constexpr double kSessionMin = Tutorial::kLength + 40;

  /// Returns the session time that the trial asks of its server [s], so that the tutorial is not cut off; nothing: the
  /// scene's own is long enough, or has no end.
  [[nodiscard]] static std::optional<double> longer_duration(const SceneSpec& scene) noexcept {
    return !scene.endless() && scene.duration < kSessionMin ? std::optional(kSessionMin) : std::nullopt;
  }

  /// @param by_keys         the user moves the hand by keys
  /// @param ends_by_itself  a trial without keys ends after the tutorial
  /// @param partners        names of the simulated participants
  /// @param programs        server and partners, which run
  TrySession(bool by_keys, bool ends_by_itself, std::vector<std::string> partners, TrialPrograms programs)
      : by_keys_(by_keys),
        ends_by_itself_(ends_by_itself),
        partners_(std::move(partners)),
        programs_(std::move(programs)) {}
  TrySession(const TrySession&) = delete;
  TrySession& operator=(const TrySession&) = delete;
  ~TrySession() override = default;

  void stop() noexcept { programs_.stop(); }
  /// Returns why the trial ended early; empty: it did not.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }

  void on_joined(const SeatSetup& setup) override { tutorial_.emplace(setup, by_keys_, partners_); }
  void on_key(const std::string& key) override { tutorial_->on_key(key); }
  [[nodiscard]] std::vector<std::string> messages(double now_s, const ClientStatus& status) override {
    std::vector<std::string> lines = tutorial_->messages(now_s, status);
    if (tutorial_->finished() && !tutorial_over_since_) tutorial_over_since_ = now_s;
    over_ = !by_keys_ && ends_by_itself_ && tutorial_over_since_ && now_s - *tutorial_over_since_ > kAfterTutorial;
    return lines;
  }
  [[nodiscard]] std::string leave_reason() override {
    failure_ = programs_.failure();
    if (!failure_.empty()) return failure_;
    return over_ ? "the guidance is over: releasing the hand" : "";
  }

 private:
  static constexpr double kAfterTutorial = 2;  ///< [s] time after the tutorial until a trial without terminal ends

  bool by_keys_, ends_by_itself_, over_ = false;
  std::vector<std::string> partners_;
  TrialPrograms programs_;
  std::string failure_;
  std::optional<Tutorial> tutorial_;
  std::optional<double> tutorial_over_since_;
};

}  // namespace tandem::client
