#include "netsim/replay/lesson_diff.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "common/base/format.h"
#include "netsim/replay/record_values.h"
#include "server/recording/lesson_record.h"

namespace tandem::netsim {
namespace {

constexpr std::string_view kRowsChannel = "/session/rows";

bool names(const DiffLimit& limit, std::string_view channel) noexcept {
  return limit.channel == channel || channel.substr(channel.rfind('/') + 1) == limit.channel;
}

/// Limit of a channel: the last that names it.
double limit_of(const std::vector<DiffLimit>& limits, std::string_view channel) noexcept {
  double most = 0;
  for (const DiffLimit& limit : limits)
    if (names(limit, channel)) most = limit.most;
  return most;
}

double distance(double a, double b) noexcept {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

/// Names of seats and tools, and axes, which decide the channels of a recording.
std::string shape_of(const Lesson& lesson) {
  std::string text = std::to_string(lesson.scene.dof) + " axes, seats";
  for (const SeatSpec& seat : lesson.scene.seats) text += " " + seat.name;
  text += ", tools";
  for (const ToolSpec& tool : lesson.scene.tools) text += " " + tool.name;
  return text;
}

}  // namespace

std::expected<DiffLimit, std::string> parse_diff_limit(std::string_view text) {
  const std::size_t cut = text.rfind('=');
  DiffLimit limit;
  if (cut != std::string_view::npos && cut > 0) {
    limit.channel = text.substr(0, cut);
    const std::string_view value = text.substr(cut + 1);
    const auto parsed = std::from_chars(value.data(), value.data() + value.size(), limit.most);
    if (parsed.ec == std::errc{} && parsed.ptr == value.data() + value.size() && limit.most >= 0) return limit;
  }
  return std::unexpected(std::string(text) +
                         ": must be CHANNEL=VALUE with a value of at least 0, such as measured_cp=0.0005 [m]");
}

bool LessonDiff::within() const noexcept {
  return std::ranges::none_of(channels, [](const ChannelDifference& channel) { return channel.beyond(); });
}

std::expected<LessonDiff, std::string> diff_lessons(const Lesson& a, const Lesson& b,
                                                    const std::vector<DiffLimit>& limits) {
  if (shape_of(a) != shape_of(b))
    return std::unexpected("the recordings have other channels: " + shape_of(a) + "; " + shape_of(b));
  const RecordValues values{a.scene};
  std::vector<ChannelDifference> channels;
  std::vector<std::size_t> channel_of;  // by number
  for (const RecordValue& value : values.names()) {
    if (channels.empty() || channels.back().channel != value.channel)
      channels.push_back({.channel = value.channel, .field = {}, .limit = limit_of(limits, value.channel)});
    channel_of.push_back(channels.size() - 1);
  }
  for (const DiffLimit& limit : limits) {
    if (limit.channel == kRowsChannel ||
        std::ranges::any_of(channels, [&](const ChannelDifference& c) { return names(limit, c.channel); }))
      continue;
    std::string known(kRowsChannel);
    std::set<std::string> told;
    for (const ChannelDifference& c : channels)
      if (told.insert(c.channel).second) known += " " + c.channel;
    return std::unexpected("there is no channel " + limit.channel + "; there are: " + known);
  }

  LessonDiff out;
  server::TickRecord left, right;
  std::vector<double> x, y;
  std::vector<bool> differs(channels.size());
  std::size_t i = 0, j = 0;
  while (i < a.rows() && j < b.rows()) {
    if (a.tick[i] != b.tick[j]) {
      ++(a.tick[i] < b.tick[j] ? out.only_a : out.only_b);
      ++(a.tick[i] < b.tick[j] ? i : j);
      continue;
    }
    server::fill_record(a, i++, left);
    server::fill_record(b, j++, right);
    RecordValues::read(a.scene, left, x);
    RecordValues::read(a.scene, right, y);
    ++out.rows;
    differs.assign(channels.size(), false);
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (std::bit_cast<std::uint64_t>(x[k]) == std::bit_cast<std::uint64_t>(y[k])) continue;
      ChannelDifference& channel = channels[channel_of[k]];
      differs[channel_of[k]] = true;
      const double d = distance(x[k], y[k]);
      if (d <= channel.largest && channel.rows > 0) continue;
      channel.largest = d;
      channel.field = values.names()[k].field;
      channel.tick = left.tick;
      channel.a = x[k];
      channel.b = y[k];
    }
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c].rows += differs[c] ? 1 : 0;
  }
  out.only_a += a.rows() - i;
  out.only_b += b.rows() - j;
  std::erase_if(channels, [](const ChannelDifference& channel) { return channel.rows == 0; });
  out.channels = std::move(channels);
  if (out.only_a + out.only_b > 0)
    out.channels.insert(out.channels.begin(), {.channel = std::string(kRowsChannel),
                                               .field = "rows",
                                               .largest = static_cast<double>(out.only_a + out.only_b),
                                               .a = static_cast<double>(a.rows()),
                                               .b = static_cast<double>(b.rows()),
                                               .limit = limit_of(limits, kRowsChannel)});
  return out;
}

}  // namespace tandem::netsim
