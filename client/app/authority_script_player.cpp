#include "client/app/authority_script_player.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kToolSilenceMax = 200ms;
constexpr Duration kRetryAfter = 200ms;
constexpr Duration kRejectionMax = 1500ms;  // a rejection later than this belongs to another participant's request

}  // namespace

const control::MasterArray* AuthorityScriptPlayer::due(Time now, Duration silence, wire::TransferNotice transfer,
                                                       const std::optional<double>& time) noexcept {
  if (silence > kToolSilenceMax) return nullptr;
  // A user sees a rejected request and can repeat it. A script request is repeated here.
  bool request = requested_ && transfer == wire::TransferNotice::kCancelled && now - *requested_ > kRetryAfter &&
                 now - *requested_ < kRejectionMax;
  for (; time && next_ < changes_.size() && changes_[next_].at <= *time + lead_; ++next_) request = true;
  if (!request) return nullptr;
  requested_ = now;
  return &changes_[next_ - 1].alpha;
}

}  // namespace tandem::client
