#include "server/directory/lease_keeper.h"

#include <algorithm>
#include <utility>

namespace tandem::directory {

LeaseKeeper::LeaseKeeper(std::string server, std::string text, LeaseTimes times, DirectoryKeys keys)
    : server_(std::move(server)),
      text_(std::move(text)),
      times_(times),
      keys_(std::move(keys)),
      counted_from_(Time::min() + std::chrono::hours(1) + times.ttl) {}

std::optional<Request> LeaseKeeper::poll_request(Time now, OperationId operation) {
  if (stage_ != Stage::kIdle && stage_ != Stage::kToConfirm) {
    if (now - stage_began_ < times_.answer_limit) return std::nullopt;
    stage_ = Stage::kIdle;  // a later answer is ignored
  }
  const auto begin = [&](Stage stage) {
    stage_ = stage;
    operation_ = operation;
    stage_began_ = now;
  };
  if (lease_ == 0) {
    if (now < next_attempt_) return std::nullopt;
    begin(Stage::kGranting);
    renewal_sent_ = now;
    return Grant{times_.ttl};
  }
  if (stage_ == Stage::kToConfirm) {
    begin(Stage::kConfirming);
    return Transaction{{}, {Read{keys_.server(server_)}}, {}};
  }
  if (now >= next_renewal_) {
    begin(Stage::kRenewing);
    renewal_sent_ = now;
    next_renewal_ = now + times_.renew_every;
    return Renew{lease_};
  }
  if ((!registered_ || written_text_ != text_) && now >= next_attempt_) {
    begin(Stage::kRegistering);
    sent_text_ = text_;
    // A key that does not exist has lease 0.
    return Transaction{{{keys_.server(server_), Condition::Of::kLease, registered_ ? lease_ : 0}},
                       {Put{keys_.server(server_), text_, lease_}},
                       {Read{keys_.server(server_)}}};
  }
  return std::nullopt;
}

bool LeaseKeeper::on_reply(Time now, const Reply& reply) {
  if (reply.operation != operation_ || stage_ == Stage::kIdle || stage_ == Stage::kToConfirm) return false;
  const Stage stage = std::exchange(stage_, Stage::kIdle);
  if (reply.outcome == Outcome::kNoLease) {
    lose();
  } else if (reply.outcome != Outcome::kDone) {
    next_attempt_ = now + times_.renew_every;
  } else if (stage == Stage::kGranting) {
    lease_ = reply.lease;
    registered_ = false;
    counted_from_ = renewal_sent_;
    next_renewal_ = renewal_sent_ + times_.renew_every;
    next_event_ = Event::kGranted;
  } else if (stage == Stage::kRenewing) {
    term_ = reply.term;
    stage_ = Stage::kToConfirm;
  } else if (stage == Stage::kConfirming) {
    on_confirmed(reply);
  } else {
    on_registration(now, reply);
  }
  return true;
}

void LeaseKeeper::on_confirmed(const Reply& reply) {
  if (reply.term == term_)
    counted_from_ = std::max(counted_from_, renewal_sent_);
  else
    ++doubtful_;
  const bool found = !reply.found.empty() && !reply.found[0].empty() && reply.found[0][0].lease == lease_;
  if (!found) registered_ = false;
}

void LeaseKeeper::on_registration(Time now, const Reply& reply) {
  if (reply.held) {
    registered_ = true;
    written_text_ = sent_text_;
    return;
  }
  // The key of an attempt whose answer was lost has our lease.
  registered_ = !reply.found.empty() && !reply.found[0].empty() && reply.found[0][0].lease == lease_;
  if (registered_) {
    written_text_ = reply.found[0][0].value;
  } else if (!reply.found.empty() && !reply.found[0].empty()) {
    next_event_ = Event::kNameTaken;
    next_attempt_ = now + times_.renew_every;
  }
}

void LeaseKeeper::on_no_lease(LeaseId lease) {
  if (lease == lease_) lose();
}

void LeaseKeeper::lose() {
  if (lease_ == 0) return;
  lease_ = 0;
  registered_ = false;
  stage_ = Stage::kIdle;
  counted_from_ = Time::min() + std::chrono::hours(1) + times_.ttl;
  event_ = Event::kLost;
  next_event_.reset();
}

std::optional<LeaseKeeper::Event> LeaseKeeper::poll_event() {
  if (event_) return std::exchange(event_, std::nullopt);
  return std::exchange(next_event_, std::nullopt);
}

}  // namespace tandem::directory
