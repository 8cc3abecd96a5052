#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include "client/app/telemetry_feed.h"
#include "common/io/event_fd.h"
#include "server/console/session_picture.h"

namespace tandem::console {

/// End of the warning of a page that has the control connection, but no datagrams.
inline constexpr std::string_view kStatusOnly = "; the page shows the status five times per second";

/// Receives the TELEMETRY of one session on a thread of its own, so that no reply of the server delays it.
class FeedThread {
 public:
  /// Called by the thread with the newest values, at most 70 per second. Null: no datagrams arrive; `why` says why.
  using Sink = std::function<void(std::shared_ptr<const LiveValues> values, std::string why)>;

  FeedThread(client::TelemetryFeed feed, Sink sink);
  /// Ends the watch, so that the server frees the slot at once.
  ~FeedThread();
  FeedThread(const FeedThread&) = delete;
  FeedThread& operator=(const FeedThread&) = delete;

 private:
  void work();

  client::TelemetryFeed feed_;
  Sink sink_;
  io::EventFd over_;
  std::thread thread_;
};

}  // namespace tandem::console
