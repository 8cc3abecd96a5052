#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace tandem::server {

/// Event of the control plane. Each is counted; some are also reported.
enum class ControlEvent : std::uint8_t {
  kAccepted,
  kTooFast,
  kHandshakeFailed,
  kDeadline,
  kTooMuchInput,
  kBadFrame,
  kNotEnrolled,
  kBlocked,
  kEnrolled,
  kCodeRefused,
  kWelcomed,
  kRefused,
  kCommand,
  kCommandTooFast,
  kTrouble,
  kForbidden,
  kEvicted,    ///< closed before it proved an enrolled key, to admit another connection
  kIdle,       ///< closed because it had not joined and was idle for too long
  kTooMany,    ///< closed because it had not joined, and its key, its source or the server had too many
  kElsewhere,  ///< was sent to the server of the service that has its session
};
inline constexpr std::size_t kControlEvents = 20;
/// Name of the event, for logs and metrics.
[[nodiscard]] std::string_view to_text(ControlEvent event) noexcept;
/// Clause for messages; its subject is the peer.
[[nodiscard]] std::string_view control_event_text(ControlEvent event) noexcept;

/// Record for logs and audit. It never contains a secret.
struct ControlEventRecord {
  ControlEvent event = ControlEvent::kAccepted;
  std::string address, workstation, detail;
  std::string person{};  ///< name in the ticket; empty: not named
};

/// Counters of the events, and their receiver. One thread records, any thread reads the counters.
class ControlEvents {
 public:
  explicit ControlEvents(std::function<void(const ControlEventRecord&)> on_event = {})
      : on_event_(std::move(on_event)) {}

  void record(ControlEvent event, std::string address, std::string workstation = {}, std::string detail = {},
              std::string person = {}) {
    counts_[static_cast<std::size_t>(event)].fetch_add(1, std::memory_order_relaxed);
    if (on_event_) on_event_({event, std::move(address), std::move(workstation), std::move(detail), std::move(person)});
  }
  /// Number of events so far.
  [[nodiscard]] std::uint64_t count(ControlEvent event) const noexcept {
    return counts_[static_cast<std::size_t>(event)].load(std::memory_order_relaxed);
  }

 private:
  std::function<void(const ControlEventRecord&)> on_event_;
  std::array<std::atomic<std::uint64_t>, kControlEvents> counts_{};
};

}  // namespace tandem::server
