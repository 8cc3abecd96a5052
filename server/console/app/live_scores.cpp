#include "server/console/app/live_scores.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "common/io/clock.h"
#include "netsim/score/lesson_scores.h"
#include "server/console/app/score_table.h"
#include "server/console/live_json.h"

namespace tandem::console {
namespace {

using netsim::score::Metric;
using netsim::score::Trust;

constexpr int kLiveScorePriority = 19;  // nice value
constexpr int kShare = 20;              // of the time: one in 20 at most

constexpr std::array kRateDoubts{
    RateDoubt{Metric::kLogJerk, Trust::kWithheld, "jerk needs every tick; here are 60 samples per second"},
    RateDoubt{Metric::kForcePeak, Trust::kFlagged, "a peak between two of the 60 samples per second is not seen"},
    RateDoubt{Metric::kContacts, Trust::kFlagged, "a contact below 17 ms may not be seen"},
    RateDoubt{Metric::kContactTimeMean, Trust::kFlagged, "a contact below 17 ms may not be seen"}};

std::string message_of(const rpc::Id& session, const Lesson& lesson) {
  auto scores = netsim::score::score_lesson(lesson);
  if (!scores) return {};
  scores->notes = {
      "The console hears 60 values per second. Whether a force was cut at its limit is stated by the recording only."};
  return "{\"type\":\"scores\",\"session\":\"" + session_hex(session) + "\"," + score_members(*scores, kRateDoubts) +
         "}";
}

}  // namespace

LiveScores::LiveScores(std::shared_ptr<Mailbox> mailbox, std::function<void()> news)
    : mailbox_(std::move(mailbox)),
      news_(std::move(news)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void LiveScores::hear(const LivePicture& picture, Time now) {
  if (!picture.live || !picture.scene) return;
  const rpc::Id& id = picture.status.session_id;
  auto found = sessions_.find(id);
  if (found == sessions_.end()) {
    std::erase_if(sessions_, [now](const auto& entry) { return now - entry.second.heard > kSilence; });
    if (sessions_.size() >= kSessionsMax) return;
    found = sessions_.emplace(id, Session{LiveLesson(*picture.scene), now, now + kPeriod, nullptr}).first;
  }
  Session& session = found->second;
  session.heard = now;
  session.lesson.add(picture);
  if (busy_ || now < session.due || session.lesson.lesson().rows() == 0) return;
  busy_ = true;
  {
    const std::lock_guard hold{lock_};
    job_ = Job{id, session.lesson.lesson()};
  }
  wake_.notify_one();
}

std::shared_ptr<const std::string> LiveScores::of(const rpc::Id& session) const {
  const auto found = sessions_.find(session);
  return found == sessions_.end() ? nullptr : found->second.message;
}

void LiveScores::work(const std::stop_token& stop) {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLiveScorePriority);
  for (;;) {
    std::unique_lock hold{lock_};
    if (!wake_.wait(hold, stop, [this] { return job_.has_value(); })) return;
    const Job job = std::move(*job_);
    job_.reset();
    hold.unlock();
    const Time begin = io::monotonic_now();
    std::string message = message_of(job.session, job.lesson);
    const Duration taken = io::monotonic_now() - begin;
    mailbox_->post([this, id = job.session, message = std::move(message), taken]() mutable {
      finish(id, std::move(message), taken);
    });
  }
}

void LiveScores::finish(const rpc::Id& session, std::string message, Duration taken) {
  busy_ = false;
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return;
  found->second.due = io::monotonic_now() + std::max(kPeriod, kShare * taken);
  if (!message.empty()) found->second.message = std::make_shared<const std::string>(std::move(message));
  news_();
}

}  // namespace tandem::console
