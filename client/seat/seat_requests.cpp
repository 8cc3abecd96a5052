#include "client/seat/seat_requests.h"

#include <algorithm>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kAuthorityRepeat = 20ms;
constexpr Duration kAuthorityTimeout = 1s;  // a request without effect by then is dropped

}  // namespace

SeatRequests::SeatRequests(const SeatSetup& setup) noexcept
    : may_stop_all_(setup.seat.role != Role::kObserver && setup.seat.kind == SeatKind::kMaster),
      ends_stops_(setup.seat.role == Role::kInstructor && setup.seat.kind == SeatKind::kMaster),
      ends_pauses_(setup.may_end_pauses),
      // Trainees may only return their own authority.
      may_change_authority_(setup.seat.role == Role::kInstructor || setup.seat.role == Role::kTrainee),
      own_tool_(static_cast<std::uint32_t>(setup.seat.tool)),
      masters_(setup.masters.size()) {
  if (setup.seat.kind == SeatKind::kMaster) own_number_ = static_cast<std::uint32_t>(setup.own_master) + 1;
}

bool SeatRequests::stop_all() noexcept {
  if (!may_stop_all_) return false;
  if (!stop_all_) stops_at_request_ = heard_ ? std::optional{stops_} : std::nullopt;
  stop_all_ = true;
  return true;
}

void SeatRequests::resume() noexcept {
  local_stop_ = false;
  if (ends_stops_ || (ends_pauses_ && session_ == wire::SessionState::kPaused)) resume_stop_ = stops_;
  clear_settled();
}

bool SeatRequests::change_authority(std::uint32_t tool, std::span<const double> alpha) noexcept {
  if (!may_change_authority_ || alpha.size() > kMastersMax) return false;
  wire::AuthorityMessage m;
  m.version = authority_version_;
  m.tool = tool;
  m.masters = static_cast<std::uint32_t>(alpha.size());
  std::ranges::copy(alpha, m.alpha.begin());
  authority_ = PendingAuthority{.message = m, .follows = authority_ && (authority_->follows || authority_->sent)};
  return true;
}

void SeatRequests::on_force(const wire::ForceMessage& force) noexcept {
  heard_ = true;
  session_ = force.session;
  stops_ = force.stops;
  authority_version_ = force.authority_version;
  if (authority_ && authority_version_ != authority_->message.version) renew_authority(force);
  clear_settled();
}

void SeatRequests::on_reconnect() noexcept {
  heard_ = false;
  session_ = wire::SessionState::kWaiting;
  stops_ = authority_version_ = 0;
  authority_.reset();
  stops_at_request_.reset();
  resume_stop_ = 0;
}

/// Clears stop and resume requests as soon as the server's FORCE shows their effect; until then they are repeated.
void SeatRequests::clear_settled() noexcept {
  if (stop_all_ && !stops_at_request_) {  // requested before the first FORCE of this server
    stop_all_ = session_ != wire::SessionState::kStopped;
    stops_at_request_ = stops_;
  }
  if (stop_all_ && stops_ != stops_at_request_) stop_all_ = false;
  const bool goes_on = session_ == wire::SessionState::kRunning || session_ == wire::SessionState::kHeld;
  if (resume_stop_ != stops_ || goes_on) resume_stop_ = 0;
}

/// Drops or renews the pending authority request after another authority decision. The user did not see that decision,
/// so the request may no longer be intended. Exception: if the decision granted this seat's previous request, the
/// pending one already builds on it and is sent against the new version.
void SeatRequests::renew_authority(const wire::ForceMessage& force) noexcept {
  const bool own = authority_version_ == authority_->message.version + 1 &&
                   force.transfer != wire::TransferNotice::kCancelled && own_number_ == force.transfer_parties.by;
  if (!authority_->follows || !own) return authority_.reset();
  authority_->message.version = authority_version_;
  authority_->sent.reset();
  authority_->follows = false;
}

void SeatRequests::fill(wire::StateMessage& out) const noexcept {
  out.stop = local_stop_;
  out.stop_all = stop_all_;
  out.resume_stop = resume_stop_;
}

std::optional<wire::AuthorityMessage> SeatRequests::take_authority(Time now) noexcept {
  if (authority_ && authority_->sent && now - authority_->first_sent > kAuthorityTimeout) authority_.reset();
  if (!authority_ || (authority_->sent && now - *authority_->sent < kAuthorityRepeat)) return std::nullopt;
  if (!authority_->sent) authority_->first_sent = now;
  authority_->sent = now;
  return authority_->message;
}

}  // namespace tandem::client
