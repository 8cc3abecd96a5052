#include "client/app/authority_transfer_text.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::client {
namespace {

using Words = std::optional<rpc::Status>;

/// Returns name number `n` of the list, counted from 1; empty if there is none.
std::string name_of(const std::vector<std::string>& names, std::uint32_t n) {
  return n >= 1 && n <= names.size() ? names[n - 1] : "";
}

std::string giver(std::uint32_t by, const SeatSetup& setup) {
  if (by == wire::TransferParties::kScene) return "the scene";
  const std::string name = by == wire::TransferParties::kOperator ? "" : name_of(setup.masters, by);
  return name.empty() ? "an operator" : name;
}

/// True if only this seat and master number `to` have authority over the tool.
bool only_two(std::uint32_t to, std::size_t tool, const SeatSetup& setup, const Words& words) {
  if (setup.masters.size() <= 2) return true;
  if (!words || tool >= words->tools.size()) return false;
  const std::vector<double>& alpha = words->tools[tool].alpha;
  for (std::size_t k = 0; k < alpha.size(); ++k)
    if (k != setup.own_master && k + 1 != to && alpha[k] > 0) return false;
  return true;
}

/// Returns the authority before the transfer of the master that gains, or of this seat if several gain; nullopt if not
/// known. FORCE contains only the authority of this seat over the tool that it follows.
std::optional<double> part_before(const ClientStatus& s, const SeatSetup& setup, const Words& words) {
  const wire::TransferParties& p = s.transfer.parties;
  const bool master = setup.seat.kind == SeatKind::kMaster;
  if (!master || s.session != wire::SessionState::kRunning || p.tool != setup.seat.tool) return std::nullopt;
  if (name_of(setup.masters, p.to).empty() || p.to == setup.own_master + 1) return s.transfer.from;
  return only_two(p.to, p.tool, setup, words) ? std::optional(1 - s.transfer.from) : std::nullopt;
}

bool waits_for_the_end_of_a_stop(const ClientStatus& s) {
  return s.session == wire::SessionState::kStopped || s.session == wire::SessionState::kPaused;
}

std::string seconds_text(double s) { return format(s < 0.095 ? "%.2f s" : "%.1f s", s); }

/// Returns when the transfer begins and how long it takes, or that it is done.
std::string progress_text(const ClientStatus& s, const SeatSetup& setup, std::optional<double> before) {
  if (waits_for_the_end_of_a_stop(s)) return "when the session resumes";
  if (s.transfer.done) return "done";
  const std::string ms = format("in %.0f ms", 10 * std::ceil(1e2 * s.transfer.begins_s - 0.5));
  const bool begun = s.transfer.begins_s <= 0;
  if (!std::isfinite(setup.alpha_slew)) return begun ? "done" : "in one step " + ms;
  const double to = s.transfer.parties.percent / 100.0;
  const bool several = name_of(setup.masters, s.transfer.parties.to).empty();
  const std::string lasts = before && !several
                                ? "takes about " + seconds_text(std::abs(to - *before) / setup.alpha_slew)
                                : "takes up to " + seconds_text((several ? 1 : to) / setup.alpha_slew);
  return (begun ? "under way, " : "begins " + ms + ", ") + lasts;
}

}  // namespace

std::string authority_transfer_brief(const ClientStatus& s) {
  const bool comes = s.transfer.notice == wire::TransferNotice::kGaining;
  if (!comes && s.transfer.notice != wire::TransferNotice::kLosing) return "";
  const std::string what = comes ? "more authority" : "less authority";
  if (waits_for_the_end_of_a_stop(s)) return what + " when the session resumes";
  if (s.transfer.done) return what + ": done";
  return what + (s.transfer.begins_s > 0 ? format(" in %.0f ms", 10 * std::ceil(1e2 * s.transfer.begins_s - 0.5))
                                         : " under way");
}

std::string authority_transfer_text(const ClientStatus& s, const SeatSetup& setup, const Words& words) {
  if (s.transfer.notice == wire::TransferNotice::kNone) return "";
  if (s.transfer.notice == wire::TransferNotice::kCancelled)
    return "transfer canceled: a seat that it concerns has left, or has a stale link";
  const wire::TransferParties& p = s.transfer.parties;
  const std::string tool_name = name_of(setup.tools, p.tool + 1),
                    tool = tool_name.empty() ? "the tool" : "the tool " + tool_name;
  const std::string by = giver(p.by, setup), to = name_of(setup.masters, p.to);
  const std::optional<double> before = part_before(s, setup, words);
  const std::string parts = (before ? format("%.0f %% ", 100 * *before) : "") + format("to %u %%", p.percent),
                    progress = ": " + progress_text(s, setup, before);
  if (to.empty()) return by + " sets new authorities over " + tool + " (your authority " + parts + ")" + progress;
  const std::string more = p.percent >= 100 ? "" : "more of ";
  if (by == to) return by + " takes " + more + tool + " (" + parts + ")" + progress;
  return by + " gives " + more + tool + " to " + to + " (" + parts + ")" + progress;
}

std::string AuthorityTransferNotices::message(double now_s, const ClientStatus& s, const SeatSetup& setup,
                                              const Words& words) {
  const auto is_one_series = [&](const ClientStatus& a) {
    return a.transfer.notice == s.transfer.notice && a.transfer.parties.to == s.transfer.parties.to &&
           a.transfer.parties.tool == s.transfer.parties.tool;
  };
  if (s.transfer.notice != wire::TransferNotice::kNone && s.transfer.count != seen_) {
    const std::optional<double> from =
        pending_ && is_one_series(*pending_) ? std::optional(pending_->transfer.from) : std::nullopt;
    pending_ = s;
    pending_->transfer.from = from.value_or(s.transfer.from);
  } else if (pending_ && s.transfer.notice != wire::TransferNotice::kNone) {
    pending_->transfer.begins_s = s.transfer.begins_s;
    pending_->transfer.done = s.transfer.done;
  } else if (pending_) {
    pending_->transfer.done = true;  // FORCE no longer contains the transfer
  }
  seen_ = s.transfer.count;
  if (!pending_ || (shown_at_s_ && now_s - *shown_at_s_ < kBetween)) return "";
  shown_at_s_ = now_s;
  const std::string text = authority_transfer_text(*pending_, setup, words);
  pending_.reset();
  return text;
}

}  // namespace tandem::client
