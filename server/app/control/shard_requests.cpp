#include "server/app/control/shard_requests.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

namespace tandem::server {

void ShardRequests::watch(Shard& shard) {
  watched_.push_back({&shard, asio::posix::stream_descriptor{context_, ::dup(shard.completion_fd())}});
  await_completions(watched_.back());
}

std::vector<const Shard*> ShardRequests::shards() const {
  std::vector<const Shard*> all;
  for (const Watched& w : watched_) all.push_back(w.shard);
  return all;
}

void ShardRequests::await_completions(Watched& watched) {
  watched.completions.async_wait(asio::posix::stream_descriptor::wait_read, [this, &watched](asio::error_code error) {
    if (error) return;
    watched.shard->clear_completions();
    while (ShardRequest* const request = watched.shard->next_completed()) complete(*request);
    await_completions(watched);
  });
}

void ShardRequests::post(Shard& shard, ShardRequest request) {
  ShardRequest& kept = requests_.emplace_back(std::move(request));
  if (shard.post(kept)) return;
  kept.result = JoinResult::kSessionOver;
  complete(kept);
}

void ShardRequests::post_when_possible(Shard& shard, ShardRequest request) {
  ShardRequest& kept = requests_.emplace_back(std::move(request));
  if (retried_.empty() && shard.post(kept)) return;
  if (retried_.size() >= kRetriedMax) {
    kept.result = JoinResult::kSessionOver;
    return complete(kept);
  }
  retried_.push_back({&shard, &kept});
  if (retried_.size() == 1) retry();
}

void ShardRequests::retry() {
  retry_timer_.expires_after(kRetry);
  retry_timer_.async_wait([this](asio::error_code error) {
    if (error) return;
    std::erase_if(retried_, [](const Retried& r) { return r.shard->post(*r.request); });
    if (!retried_.empty()) retry();
  });
}

void ShardRequests::stop_watching() {
  watched_.clear();
  retry_timer_.cancel();
  for (const Retried& r : std::exchange(retried_, {})) {
    r.request->result = JoinResult::kSessionOver;
    complete(*r.request);
  }
}

void ShardRequests::complete(ShardRequest& request) {
  request.done(request);
  const LiveSession& session = *request.session;
  requests_.remove_if([&](const ShardRequest& r) { return &r == &request; });
  const auto waits = std::ranges::find(waiting_, &session, &Waiting::session);
  if (waits == waiting_.end() || !idle(session)) return;
  const auto then = std::move(waits->then);
  waiting_.erase(waits);
  then();
}

void ShardRequests::when_idle(const LiveSession& session, std::function<void()> then) {
  if (idle(session)) return then();
  waiting_.push_back({&session, std::move(then)});
}

bool ShardRequests::idle(const LiveSession& session) const {
  return std::ranges::none_of(requests_, [&](const ShardRequest& r) { return r.session == &session; });
}

}  // namespace tandem::server
