#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "client/app/telemetry_feed.h"
#include "common/io/event_fd.h"
#include "server/console/session_picture.h"

namespace tandem::console {

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
