#include "client/diagnostics/link_test.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tandem::client {

namespace {

double s(std::int64_t ns) { return seconds(Duration{ns}); }

}  // namespace

LinkTest::LinkTest(const SeatSetup& setup, const transport::SecureChannel::Params& link)
    : setup_(setup), tick_length_(from_seconds(1.0 / setup.tick_hz)), channel_(link, wire::Codec{body_layout(setup)}) {}

void LinkTest::on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept {
  transport::SecureChannel& link = channel_.link();
  const auto opened = link.open(arrived, bytes);
  if (!opened) return;
  if (opened->type == wire::Type::kClose) {
    if (!channel_.codec().decode_close(opened->plaintext)) return link.drop_body();
    closed_ = true;
    return link.accept_other();
  }
  if (opened->type == wire::Type::kPathChallenge) return channel_.on_path_challenge(opened->plaintext);
  if (opened->type != wire::Type::kLinkReport) return link.drop_body();
  const auto decoded = channel_.codec().decode_link_report(opened->plaintext);
  if (!decoded) return link.drop_body();
  down_size_ = bytes.size();
  if (!opened->newer) return;
  const std::uint64_t known = link.timing().rtt_samples();
  link.accept(arrived, *opened, decoded->preamble);
  if (link.timing().rtt_samples() > known) rtt_min_ = std::min(rtt_min_, link.timing().rtt());
  report_ = decoded->message;
  echo_newest_ = decoded->preamble.echo_counter;
  transit_.add(arrived, decoded->preamble.tick * tick_length_);
  const std::optional<Time> before = newest_;
  newest_ = arrived;
  if (stopped_) return;  // without LINK_PROBE from this client, gaps and pauses have no meaning
  // The echo age is the time for which the server had received nothing when it sent this LINK_REPORT. Its maximum is
  // the longest gap towards the server.
  echo_age_max_ = std::max<Duration>(echo_age_max_, std::chrono::microseconds(decoded->preamble.echo_age_us));
  if (before && arrived - *before > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::on_tick(Time now, Duration late, std::uint32_t missed, Duration wall_offset) noexcept {
  if (!began_) began_ = now;
  tick_ = static_cast<std::uint32_t>((now - *began_) / tick_length_);
  channel_.link().tick(now);
  if (stopped_) return;
  ticks_.add(late, missed, wall_offset);
  probe_due_ = !closed_;
}

std::optional<std::size_t> LinkTest::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize) return std::nullopt;
  if (channel_.answer_due()) {
    ++path_answers_;
    return channel_.seal_answer(now, tick_, buffer);
  }
  if (std::exchange(probe_due_, false)) {
    const auto size = channel_.seal(now, tick_, wire::Type::kLinkProbe, wire::LinkProbe{}, buffer);
    up_size_ = size.value_or(up_size_);
    return size;
  }
  if (close_due_ == 0) return std::nullopt;
  --close_due_;
  return channel_.seal(now, tick_, wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kLeaving}, buffer);
}

void LinkTest::stop_sending(Time now) noexcept {
  if (stopped_) return;
  stopped_ = now;
  probe_due_ = false;
  gap_until_stop_ = channel_.link().longest_gap(now);
  if (newest_ && now - *newest_ > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::leave() noexcept {
  if (leaving_) return;
  leaving_ = true;
  probe_due_ = false;
  close_due_ = closed_ ? 0 : ClientChannel::kCloseRepeats;
}

Duration LinkTest::silence(Time now) const noexcept {
  if (newest_) return std::max(now - *newest_, Duration{0});
  return began_ ? now - *began_ : Duration{0};
}

LinkTestResult LinkTest::findings(Time now) const {
  const transport::SecureChannelStats& l = channel_.link().stats();
  const std::uint64_t duplicates = l.dropped[static_cast<std::size_t>(transport::DropReason::kDuplicate)];
  LinkTestResult f{.seconds = began_ ? seconds(stopped_.value_or(now) - *began_) : 0,
                   .tick_hz = setup_.tick_hz,
                   .datagram_up = up_size_,
                   .datagram_down = down_size_,
                   .duplicates = duplicates,
                   .refused = std::accumulate(l.dropped.begin(), l.dropped.end(), std::uint64_t{0}) - duplicates,
                   .pauses = pauses_,
                   .silent_at_end = seconds(silence(stopped_.value_or(now))),
                   .silence_limit = setup_.gate.silence_limit,
                   .loop_age_max = setup_.gate.loop_age_max,
                   .clock_step = ticks_.clock_step(),
                   .transit_step = transit_.largest_step(),
                   .ticks = ticks_.ticks(),
                   .late_ticks = ticks_.late_ticks(),
                   .missed_ticks = ticks_.missed_ticks(),
                   .wake_p99 = s(ticks_.lateness().quantile(0.99)),
                   .wake_max = s(ticks_.lateness().max())};
  if (newest_) {
    f.down = {.sent = l.newest - l.first + 1,
              .lost = l.lost(),
              .reordered = l.late,
              .longest_gap = seconds(stopped_ ? gap_until_stop_ : channel_.link().longest_gap(now))};
    if (report_ && report_->used > 0) {
      // Counters also count PATH_RESPONSE datagrams.
      const std::uint64_t sent = echo_newest_ + 1 - std::min(path_answers_, echo_newest_);
      const std::uint64_t arrived = std::uint64_t{report_->used} + report_->late;
      f.up = {.sent = sent,
              .lost = sent > arrived ? sent - arrived : 0,
              .reordered = report_->late,
              .longest_gap = seconds(echo_age_max_)};
    }
    f.jitter = transit_.jitter();
  }
  if (const LinkHistogram& rtts = channel_.link().timing().rtts(); rtts.count() > 0) {
    f.rtt_min = seconds(rtt_min_);
    f.rtt_p50 = s(rtts.quantile(0.50));
    f.rtt_p99 = s(rtts.quantile(0.99));
    f.rtt_max = s(rtts.max());
  }
  return f;
}

}  // namespace tandem::client
