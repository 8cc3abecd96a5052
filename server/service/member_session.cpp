#include "server/service/member_session.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

using directory::Condition;
using directory::Erase;
using directory::Outcome;
using directory::Put;
using directory::Read;
using directory::Reply;
using directory::Request;
using directory::Transaction;

namespace {

constexpr Duration kAgain = std::chrono::milliseconds(50);

const std::string* found_text(const Reply& reply, std::size_t n) {
  return n < reply.found.size() && !reply.found[n].empty() ? &reply.found[n][0].value : nullptr;
}

}  // namespace

std::optional<MemberSession::Run> MemberSession::take_run() {
  if (!served_) return std::nullopt;
  Run run{std::move(*served_), snapshot_, consoles_};
  served_.reset();
  return run;
}

void MemberSession::enter(Phase phase) noexcept {
  phase_ = phase;
  operation_ = 0;
  next_attempt_ = {};
}

void MemberSession::on_owned(directory::Revision revision) {
  revision_ = revision;
  has_newest_ = false;
  enter(origin_ == Origin::kCreated ? Phase::kWriting : Phase::kLoading);
}

void MemberSession::abandon() {
  phase_ = Phase::kLoading;
  abandoned_ = true;
  operation_ = 0;
}

void MemberSession::open_again() {
  has_newest_ = true;
  enter(Phase::kLoading);
}

void MemberSession::replace(ServiceSession spec) {
  served_ = spec;  // if the directory is lost now, this run begins, not the one before
  spec_ = std::move(spec);
  snapshot_.clear();
  consoles_.clear();
  enter(Phase::kWriting);
}

void MemberSession::end() {
  served_.reset();
  enter(Phase::kEnding);
}

Transaction MemberSession::write(Condition owned, const ServiceDirectory& directory) const {
  const ServiceKeys& keys = directory.keys;
  const std::string spec = keys.spec(name_);
  Transaction write{{std::move(owned)},
                    {Put{spec, to_text(*spec_), 0}, Erase{keys.listed(name_)}},
                    {Read{spec}, Read{directory.names.owner(name_)}}};
  const auto put = [&](const std::string& key, const std::string& value) {
    write.then.push_back(value.empty() ? directory::Step{Erase{key}} : Put{key, value, 0});
  };
  put(keys.snapshot(name_), snapshot_);
  put(keys.consoles(name_), consoles_);
  if (origin_ == Origin::kCreated) write.conditions.push_back({spec, Condition::Of::kCreated, 0});
  return write;
}

std::optional<Request> MemberSession::request(const ServiceDirectory& directory) const {
  const ServiceKeys& keys = directory.keys;
  const Condition owned{directory.names.owner(name_), Condition::Of::kCreated, revision_};
  switch (phase_) {
    case Phase::kLoading:
      return Transaction{{owned}, {Read{keys.spec(name_)}, Read{keys.snapshot(name_)}, Read{keys.consoles(name_)}}, {}};
    case Phase::kWriting:
      return write(owned, directory);
    case Phase::kEnding:
      return Transaction{{owned},
                         {Erase{keys.spec(name_)}, Erase{keys.listed(name_)}, Erase{keys.move(name_)},
                          Erase{keys.home(name_)}, Erase{keys.snapshot(name_)}, Erase{keys.consoles(name_)}},
                         {}};
    default:
      return std::nullopt;
  }
}

std::optional<Request> MemberSession::poll_request(Time now, Duration retry_after, const ServiceDirectory& directory) {
  if (operation_ != 0 && now - sent_ >= retry_after) operation_ = 0;
  if (operation_ != 0 || now < next_attempt_) return std::nullopt;
  return request(directory);
}

void MemberSession::begun(Time now, directory::OperationId operation) noexcept {
  operation_ = operation;
  sent_ = now;
}

MemberSession::Next MemberSession::on_reply(Time now, const Reply& reply, EpochBase& base) {
  operation_ = 0;
  if (reply.outcome != Outcome::kDone) {
    next_attempt_ = now + kAgain;
    return Next::kNothing;
  }
  switch (phase_) {
    case Phase::kLoading:
      if (reply.held) return on_loaded(reply, base);
      next_attempt_ = now + kAgain;  // not ours any more: the ownership reports it
      return Next::kNothing;
    case Phase::kWriting:
      return on_written(now, reply, base);
    case Phase::kEnding:
      if (reply.held) return Next::kRelease;
      next_attempt_ = now + kAgain;
      return Next::kNothing;
    default:
      return Next::kNothing;
  }
}

MemberSession::Next MemberSession::on_loaded(const Reply& reply, EpochBase& base) {
  const std::string* const spec_text = found_text(reply, 0);
  if (abandoned_) {
    // The write whose answer is missing made the spec, or found one that belongs to the session without owner.
    const bool ours = spec_text != nullptr && *spec_text == to_text(*spec_);
    if (!ours) return Next::kRelease;
    phase_ = Phase::kEnding;
    return Next::kNothing;
  }
  if (origin_ == Origin::kKept) {
    phase_ = Phase::kWriting;
    return Next::kNothing;
  }
  const std::string *const snapshot = found_text(reply, 1), *const consoles = found_text(reply, 2);
  auto spec = spec_text != nullptr ? parse_service_session(*spec_text) : std::nullopt;
  const bool changed = origin_ == Origin::kConfigured && spec && spec_ &&
                       (spec->scene != spec_->scene || spec->duration_s != spec_->duration_s ||
                        spec->tickets_only != spec_->tickets_only || spec->restart != spec_->restart);
  if (spec && !changed) {
    ServiceSession wanted = base.on(*spec);
    if (!std::exchange(has_newest_, false)) {
      snapshot_ = snapshot != nullptr ? *snapshot : "";
      consoles_ = consoles != nullptr ? *consoles : "";
    }
    if (wanted == *spec) return open(std::move(*spec), base);
    spec_ = std::move(wanted);
    phase_ = Phase::kWriting;
    return Next::kNothing;
  }
  if (spec_text != nullptr && !spec) return Next::kUnreadable;
  if (spec && spec_) spec_->epoch_base = std::max(spec_->epoch_base, spec->epoch_base);
  // A configured session without owner begins; any other without a spec has ended.
  phase_ = spec_ ? Phase::kWriting : Phase::kEnding;
  return Next::kNothing;
}

MemberSession::Next MemberSession::on_written(Time now, const Reply& reply, EpochBase& base) {
  const std::string* const written = found_text(reply, 0);
  const bool before = written != nullptr && spec_ && *written == to_text(*spec_);  // by a write whose answer was lost
  if (reply.held || before) return open(std::move(*spec_), base);
  if (written != nullptr && origin_ == Origin::kCreated) return Next::kTaken;
  next_attempt_ = now + kAgain;
  return Next::kNothing;
}

MemberSession::Next MemberSession::open(ServiceSession spec, EpochBase& base) {
  phase_ = Phase::kOpening;
  base.take(spec.epoch_base);
  served_ = std::move(spec);
  spec_.reset();
  origin_ = Origin::kDirectory;
  return Next::kOpen;
}

}  // namespace tandem::server
