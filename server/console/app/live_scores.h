#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "common/base/time.h"
#include "server/console/app/mailbox.h"
#include "server/console/live_lesson.h"

namespace tandem::console {

/// Scores of running sessions so far, by the code of `tandem-netsim score`. For the web thread; a thread with the
/// lowest priority computes them every kPeriod, or less often so that it takes at most 5 % of a core.
class LiveScores {
 public:
  static constexpr Duration kPeriod = std::chrono::seconds{5};
  static constexpr Duration kSilence = std::chrono::minutes{10};  ///< a session ends that is not heard for as long
  static constexpr std::size_t kSessionsMax = 8;

  /// @param news  called in the web thread after new scores
  LiveScores(std::shared_ptr<Mailbox> mailbox, std::function<void()> news);
  LiveScores(const LiveScores&) = delete;
  LiveScores& operator=(const LiveScores&) = delete;

  /// Hears a picture of any session. Call it for each new one.
  void hear(const LivePicture& picture, Time now);
  /// Returns the newest message `scores` of a session; null: none yet.
  [[nodiscard]] std::shared_ptr<const std::string> of(const rpc::Id& session) const;

 private:
  struct Session {
    LiveLesson lesson;
    Time heard{}, due{};
    std::shared_ptr<const std::string> message;
  };
  struct Job {
    rpc::Id session{};
    Lesson lesson;
  };
  void work(const std::stop_token& stop);
  void finish(const rpc::Id& session, std::string message, Duration taken);

  std::shared_ptr<Mailbox> mailbox_;
  std::function<void()> news_;
  std::map<rpc::Id, Session> sessions_;
  bool busy_ = false;  ///< the thread has a job
  std::mutex lock_;
  std::condition_variable_any wake_;
  std::optional<Job> job_;
  std::jthread thread_;
};

}  // namespace tandem::console
