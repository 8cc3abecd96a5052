#include "client/diagnostics/link_test.h"

#include <algorithm>
#include <utility>

namespace tandem::client {

namespace {

constexpr unsigned kCloseRepeats = 3;  // a CLOSE can be lost

double s(std::int64_t ns) { return seconds(Duration{ns}); }

}  // namespace

LinkTest::LinkTest(const SeatSetup& setup, const transport::SecureChannel::Params& link)
    : setup_(setup), tick_length_(from_seconds(1.0 / setup.tick_hz)), link_(link), codec_(setup.dof, setup.port) {}

void LinkTest::on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept {
  const auto opened = link_.open(arrived, bytes);
  if (!opened) return;
  if (opened->type == wire::Type::kClose) {
    if (codec_.decode_close(opened->plaintext)) {
      link_.accept_other();
      closed_ = true;
    } else {
      link_.drop_body();
    }
    return;
  }
  if (opened->type == wire::Type::kPathChallenge) {
    const auto challenge = codec_.decode_path(opened->plaintext);
    if (!challenge) return link_.drop_body();
    link_.accept_other();
    path_answer_ = challenge->message;
    return;
  }
  const auto decoded = opened->type == wire::Type::kForce
                           ? codec_.decode_force(opened->plaintext)
                           : wire::Decoded<wire::ForceMessage>{std::unexpect, wire::DecodeError::kMalformed};
  if (!decoded) return link_.drop_body();
  down_size_ = bytes.size();
  if (!opened->newer) return;
  const std::uint64_t known = link_.timing().rtt_samples();
  link_.accept(arrived, *opened, decoded->preamble);
  if (link_.timing().rtt_samples() > known) rtt_min_ = std::min(rtt_min_, link_.timing().rtt());
  report_ = wire::link_test_report_of(decoded->message);
  echo_newest_ = decoded->preamble.echo_counter;
  transit_.add(arrived, decoded->preamble.tick * tick_length_);
  const std::optional<Time> before = newest_;
  newest_ = arrived;
  if (stopped_) return;  // without STATE from this client, gaps and pauses have no meaning
  // The echo age is the time for which the server had received nothing when it sent this FORCE. Its maximum is the
  // longest gap towards the server.
  echo_age_max_ = std::max<Duration>(echo_age_max_, std::chrono::microseconds(decoded->preamble.echo_age_us));
  if (before && arrived - *before > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::on_tick(Time now, Duration late, std::uint32_t missed, Duration wall_offset) noexcept {
  if (!began_) began_ = now;
  tick_ = static_cast<std::uint32_t>((now - *began_) / tick_length_);
  link_.tick(now);
  if (stopped_) return;
  ticks_.add(late, missed, wall_offset);
  state_due_ = !closed_;
}

std::optional<std::size_t> LinkTest::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize) return std::nullopt;
  const auto seal = [&](wire::Type type, const auto& message) -> std::optional<std::size_t> {
    const std::size_t plain =
        codec_.encode(link_.preamble(now, tick_), message, buffer.subspan(transport::kHeaderSize));
    const std::size_t size = plain == 0 ? 0 : link_.seal(now, type, buffer, plain);
    return size == 0 ? std::nullopt : std::optional{size};
  };
  if (path_answer_) {
    ++path_answers_;
    return seal(wire::Type::kPathResponse, *std::exchange(path_answer_, std::nullopt));
  }
  if (std::exchange(state_due_, false)) {
    const auto size = seal(wire::Type::kState, state_);
    up_size_ = size.value_or(up_size_);
    return size;
  }
  if (close_due_ == 0) return std::nullopt;
  --close_due_;
  return seal(wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kLeaving});
}

void LinkTest::stop_sending(Time now) noexcept {
  if (stopped_) return;
  stopped_ = now;
  state_due_ = false;
  gap_until_stop_ = link_.longest_gap(now);
  if (newest_ && now - *newest_ > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::leave() noexcept {
  if (leaving_) return;
  leaving_ = true;
  state_due_ = false;
  close_due_ = closed_ ? 0 : kCloseRepeats;
}

Duration LinkTest::silence(Time now) const noexcept {
  if (newest_) return std::max(now - *newest_, Duration{0});
  return began_ ? now - *began_ : Duration{0};
}

LinkTestResult LinkTest::findings(Time now) const {
  LinkTestResult f;
  f.seconds = began_ ? seconds(stopped_.value_or(now) - *began_) : 0;
  f.tick_hz = setup_.tick_hz;
  f.datagram_up = up_size_;
  f.datagram_down = down_size_;
  f.silence_limit = setup_.gate.silence_limit;
  f.loop_age_max = setup_.gate.loop_age_max;
  const transport::SecureChannelStats& l = link_.stats();
  f.duplicates = l.dropped[static_cast<std::size_t>(transport::DropReason::kDuplicate)];
  for (const auto refused : l.dropped) f.refused += refused;
  f.refused -= f.duplicates;
  f.pauses = pauses_;
  f.silent_at_end = seconds(silence(stopped_.value_or(now)));
  if (newest_) {
    f.down = LinkTestResult::Direction{l.newest - l.first + 1, l.lost(), l.late,
                                       seconds(stopped_ ? gap_until_stop_ : link_.longest_gap(now))};
    if (report_ && report_->acted > 0) {
      LinkTestResult::Direction up;
      up.sent =
          echo_newest_ + 1 - std::min(path_answers_, echo_newest_);  // counters also count PATH_RESPONSE datagrams
      up.reordered = report_->late;
      const std::uint64_t arrived = std::uint64_t{report_->acted} + report_->late;
      up.lost = up.sent > arrived ? up.sent - arrived : 0;
      up.longest_gap = seconds(echo_age_max_);
      f.up = up;
    }
    f.jitter = transit_.jitter();
  }
  if (const Histogram& rtts = link_.timing().rtts(); rtts.count() > 0) {
    f.rtt_min = seconds(rtt_min_);
    f.rtt_p50 = s(rtts.quantile(0.50));
    f.rtt_p99 = s(rtts.quantile(0.99));
    f.rtt_max = s(rtts.max());
  }
  f.clock_step = ticks_.clock_step();
  f.transit_step = transit_.largest_step();
  f.ticks = ticks_.ticks();
  f.late_ticks = ticks_.late_ticks();
  f.missed_ticks = ticks_.missed_ticks();
  f.wake_p99 = s(ticks_.lateness().quantile(0.99));
  f.wake_max = s(ticks_.lateness().max());
  return f;
}

}  // namespace tandem::client
