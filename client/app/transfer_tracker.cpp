#include "client/app/transfer_tracker.h"

#include <algorithm>
#include <cmath>

namespace tandem::client {
namespace {

constexpr std::uint64_t kShown = 1000;   // smallest number of ticks for which a transfer is shown
constexpr std::uint64_t kSettled = 100;  // ticks without a change after which it is done; longer than usual gaps
constexpr double kAlphaChange = 1e-6;

}  // namespace

void TransferTracker::update(const wire::ForceMessage& f) noexcept {
  ++tick_;
  const bool announced =
      f.transfer != wire::TransferNotice::kNone && (f.transfer != notice_ || f.authority_version != version_);
  notice_ = f.transfer;
  version_ = f.authority_version;
  if (announced) {
    status_.notice = f.transfer;
    status_.parties = f.transfer_parties;
    status_.from = f.alpha;
    ++status_.count;
    announced_ = tick_;
    begin_ = last_change_ = tick_ + f.transfer_ticks;
  }
  if (std::abs(f.alpha - alpha_) > kAlphaChange) last_change_ = std::max(begin_, tick_);
  alpha_ = f.alpha;
  status_.begins_s = (static_cast<double>(begin_) - static_cast<double>(tick_)) / tick_hz_;
  status_.done = tick_ > last_change_ + kSettled;
  const bool shown = f.session == wire::SessionState::kRunning || f.session == wire::SessionState::kStopped ||
                     f.session == wire::SessionState::kPaused;
  if (!announced && (!shown || (tick_ - announced_ > kShown && status_.done)))
    status_.notice = wire::TransferNotice::kNone;
}

}  // namespace tandem::client
