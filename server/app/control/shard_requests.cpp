#include "server/app/control/shard_requests.h"

#include <unistd.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace tandem::server {
namespace {

/// Whether a request changes nothing, so that its sender can ask again.
bool asks_only(const ShardRequest& request) noexcept {
  return request.what == ShardRequest::What::kQuerySeat || request.what == ShardRequest::What::kQueryPeers ||
         (request.what == ShardRequest::What::kCommand &&
          std::holds_alternative<rpc::StatusRequest>(request.command.body));
}

}  // namespace

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
  if (kept.session == moving_) return hold(kept);
  begin(shard, kept);
}

void ShardRequests::begin(Shard& shard, ShardRequest& kept) {
  const bool asks = asks_only(kept);
  if ((asks || retried_.empty()) && shard.post(kept)) return;
  if (asks) return reject(kept);
  retried_.push_back({&shard, &kept});
  if (retried_.size() == 1) retry();
}

void ShardRequests::move(Shard& from, ShardRequest request) {
  ShardRequest& kept = requests_.emplace_back(std::move(request));
  kept.result = JoinResult::kSessionOver;
  if (moving_ != nullptr || !retried_.empty()) return complete(kept);
  if (!from.post(kept)) return complete(kept);
  moving_ = kept.session;
  moves_from_ = &from;
}

void ShardRequests::hold(ShardRequest& request) {
  if (held_.size() >= kHeldMax && asks_only(request)) return reject(request);
  held_.push_back(&request);
}

void ShardRequests::reject(ShardRequest& question) {
  question.result = JoinResult::kBusy;
  complete(question);
}

void ShardRequests::end_move(Shard& serving) {
  moving_ = nullptr;
  for (ShardRequest* const held : std::exchange(held_, {})) begin(serving, *held);
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
  for (ShardRequest* const held : std::exchange(held_, {})) {
    held->result = JoinResult::kSessionOver;
    complete(*held);
  }
}

void ShardRequests::complete(ShardRequest& request) {
  request.done(request);
  const LiveSession& session = *request.session;
  Shard* serving = nullptr;  // after a move
  if (request.what == ShardRequest::What::kMoveSession && &session == moving_)
    serving = request.result == JoinResult::kAccepted ? request.target : moves_from_;
  requests_.remove_if([&](const ShardRequest& r) { return &r == &request; });
  if (serving != nullptr) end_move(*serving);
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
