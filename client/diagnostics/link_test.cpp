#include "client/diagnostics/link_test.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace tandem::client {

namespace {

using namespace std::chrono_literals;

constexpr Duration kLate = 1ms;
constexpr unsigned kCloseRepeats = 3;      // a CLOSE can be lost
constexpr std::size_t kSecondsMax = 4096;  // bound of second_floors_; later seconds are not recorded
constexpr Duration kWindow = 1s;

double s(std::int64_t ns) { return seconds(Duration{ns}); }

}  // namespace

LinkTest::LinkTest(const SeatSetup& setup, const transport::SecureChannel::Params& link)
    : setup_(setup), tick_length_(from_seconds(1.0 / setup.tick_hz)), link_(link), codec_(setup.dof, setup.port) {
  second_floors_.reserve(kSecondsMax);
}

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
    const auto asked = codec_.decode_path(opened->plaintext);
    if (!asked) return link_.drop_body();
    link_.accept_other();
    path_answer_ = asked->message;
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
  take_transit(arrived, decoded->preamble.tick);
  const std::optional<Time> before = news_;
  news_ = arrived;
  if (stopped_) return;  // without STATE from this client, gaps and pauses have no meaning
  // The echo age is the time for which the server had received nothing when it sent this FORCE. Its maximum is the
  // longest gap towards the server.
  echo_age_max_ = std::max<Duration>(echo_age_max_, std::chrono::microseconds(decoded->preamble.echo_age_us));
  if (before && arrived - *before > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::take_transit(Time arrived, std::uint32_t server_tick) noexcept {
  const std::int64_t transit =
      arrived.time_since_epoch().count() - static_cast<std::int64_t>(server_tick) * tick_length_.count();
  if (!second_began_) {
    second_began_ = arrived;
    transit_floor_ = second_floor_ = transit;
  }
  if (arrived - *second_began_ >= kWindow) {
    if (second_floors_.size() < kSecondsMax) second_floors_.push_back(second_floor_);
    second_floor_ = transit;
    *second_began_ = arrived;
  }
  second_floor_ = std::min(second_floor_, transit);
  transit_floor_ = std::min(transit_floor_, transit);
  transit_.add(transit - transit_floor_);
}

void LinkTest::on_tick(Time now, Duration late, std::uint32_t missed, Duration wall_offset) noexcept {
  if (!began_) began_ = now;
  tick_ = static_cast<std::uint32_t>((now - *began_) / tick_length_);
  link_.tick(now);
  if (stopped_) return;
  ++ticks_;
  late_ticks_ += late > kLate ? 1 : 0;
  missed_ticks_ += missed;
  wakes_.add(late.count());
  if (wall_offset_) {
    const Duration step = wall_offset - *wall_offset_;
    if (std::abs(step.count()) > std::abs(wall_step_.count())) wall_step_ = step;
  }
  wall_offset_ = wall_offset;
  state_due_ = !closed_;
}

std::optional<std::size_t> LinkTest::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize || !(path_answer_ || state_due_ || close_due_ > 0)) return std::nullopt;
  const auto body = buffer.subspan(transport::kHeaderSize);
  if (path_answer_) {
    const std::size_t plain =
        codec_.encode(link_.preamble(now, tick_), *std::exchange(path_answer_, std::nullopt), body);
    const std::size_t size = plain == 0 ? 0 : link_.seal(now, wire::Type::kPathResponse, buffer, plain);
    ++path_answers_;
    return size == 0 ? std::nullopt : std::optional{size};
  }
  const bool closing = !state_due_;
  if (closing) {
    --close_due_;
  } else {
    state_due_ = false;
  }
  const std::size_t plain =
      closing ? codec_.encode(link_.preamble(now, tick_), wire::CloseMessage{wire::CloseReason::kLeaving}, body)
              : codec_.encode(link_.preamble(now, tick_), state_, body);
  const std::size_t size =
      plain == 0 ? 0 : link_.seal(now, closing ? wire::Type::kClose : wire::Type::kState, buffer, plain);
  if (size == 0) return std::nullopt;
  if (!closing) up_size_ = size;
  return size;
}

void LinkTest::stop_sending(Time now) noexcept {
  if (stopped_) return;
  stopped_ = now;
  state_due_ = false;
  gap_until_stop_ = link_.longest_gap(now);
  if (news_ && now - *news_ > from_seconds(setup_.gate.silence_limit)) ++pauses_;
}

void LinkTest::leave() noexcept {
  if (leaving_) return;
  leaving_ = true;
  state_due_ = false;
  close_due_ = closed_ ? 0 : kCloseRepeats;
}

Duration LinkTest::silence(Time now) const noexcept {
  if (news_) return std::max(now - *news_, Duration{0});
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
  if (news_) {
    f.down = LinkTestResult::Direction{l.newest - l.first + 1, l.lost(), l.late,
                                       seconds(stopped_ ? gap_until_stop_ : link_.longest_gap(now))};
    if (report_ && report_->acted > 0) {
      LinkTestResult::Direction& up = f.up.emplace();
      up.sent =
          echo_newest_ + 1 - std::min(path_answers_, echo_newest_);  // counters also count PATH_RESPONSE datagrams
      up.reordered = report_->late;
      const std::uint64_t came = std::uint64_t{report_->acted} + report_->late;
      up.lost = up.sent > came ? up.sent - came : 0;
      up.longest_gap = seconds(echo_age_max_);
    }
    f.jitter = s(transit_.quantile(0.99));
  }
  if (const Histogram& rtts = link_.timing().rtts(); rtts.count() > 0) {
    f.rtt_min = seconds(rtt_min_);
    f.rtt_p50 = s(rtts.quantile(0.50));
    f.rtt_p99 = s(rtts.quantile(0.99));
    f.rtt_max = s(rtts.max());
  }
  if (ticks_ > 1) f.clock_step = seconds(wall_step_);
  if (second_floors_.size() > 1) {
    std::int64_t step = 0;
    for (std::size_t i = 1; i < second_floors_.size(); ++i) {
      const std::int64_t change = second_floors_[i] - second_floors_[i - 1];
      if (std::abs(change) > std::abs(step)) step = change;
    }
    f.transit_step = s(step);
  }
  f.ticks = ticks_;
  f.late_ticks = late_ticks_;
  f.missed_ticks = missed_ticks_;
  f.wake_p99 = s(wakes_.quantile(0.99));
  f.wake_max = s(wakes_.max());
  return f;
}

}  // namespace tandem::client
