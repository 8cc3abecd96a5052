#include "netsim/profiles/profile_preview.h"

#include <algorithm>
#include <memory>

#include "netsim/engine/network.h"
#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(1);
constexpr std::size_t kBytes = 128;
constexpr std::uint64_t kTellEvery = 20'000;

}  // namespace

Duration ProfilePreviewDirection::quantile(double q) const noexcept {
  if (delays.empty()) return Duration::zero();
  return delays[static_cast<std::size_t>(std::clamp(q, 0.0, 1.0) * static_cast<double>(delays.size() - 1))];
}

ProfilePreview preview_profile(const ProfilePreviewOptions& setup, const std::function<bool(double)>& progress) {
  ProfilePreview preview;
  preview.length = setup.length;
  preview.shown = std::min(setup.shown, setup.length);
  const auto count = static_cast<std::uint64_t>(setup.length / kPeriod);
  const auto shown = static_cast<std::size_t>(preview.shown / kPeriod);

  Network network{setup.seed};
  network.add_link(setup.link);
  const auto monitor = std::make_unique<LinkMonitor>();
  network.attach_monitor(0, monitor.get());
  std::array<std::vector<bool>, kDirections> came{std::vector<bool>(count), std::vector<bool>(count)};
  for (ProfilePreviewDirection& way : preview.ways) {
    way.delays.reserve(count);
    way.shown.assign(shown, ProfilePreviewDirection::kLost);
  }
  std::array<std::byte, kSlotBytes> buffer;
  const auto empty = [&](Time now, Direction direction) {
    const auto d = static_cast<std::size_t>(direction);
    while (const auto delivery = network.poll(now, 0, direction, buffer)) {
      if (delivery->index >= count || came[d][delivery->index]) continue;  // duplicate
      came[d][delivery->index] = true;
      const Duration delay = delivery->at - delivery->sent;
      preview.ways[d].delays.push_back(delay);
      if (delivery->index < shown) {
        preview.ways[d].shown[delivery->index] =
            static_cast<std::int32_t>(std::min<std::int64_t>(delay.count() / 1000, INT32_MAX));
      }
    }
  };
  const std::array<std::byte, kBytes> datagram{};
  for (std::uint64_t i = 0; i < count; ++i) {
    const Time now{kPeriod * static_cast<std::int64_t>(i)};
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      network.send(now, 0, direction, datagram);
      empty(now, direction);
    }
    if (!progress || i % kTellEvery != 0 || progress(static_cast<double>(i) / static_cast<double>(count))) continue;
    preview.length = kPeriod * static_cast<std::int64_t>(i + 1);
    preview.shown = std::min(preview.shown, preview.length);
    for (ProfilePreviewDirection& way : preview.ways) way.shown.resize(std::min<std::size_t>(shown, i + 1));
    break;
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    empty(Time{setup.length + std::chrono::hours(24)}, direction);  // datagrams still in flight
    ProfilePreviewDirection& way = preview.ways[static_cast<std::size_t>(direction)];
    way.fates = network.counters(0, direction).by_outcome;
    std::sort(way.delays.begin(), way.delays.end());
  }
  preview.quality = monitor->summary();
  return preview;
}

}  // namespace tandem::netsim
