#include "server/session/stop_entries.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <type_traits>

#include "common/base/raw_bytes.h"
#include "proto/rpc/rpc_texts.h"
#include "server/report/audit_event.h"

namespace tandem::server {
namespace {

using Milliseconds = std::chrono::duration<std::uint32_t, std::milli>;

constexpr std::size_t kPlaceAt = kStopLabel.size(), kPartAt = kPlaceAt + 1, kPart = sizeof(SnapshotEntry) - kPartAt;

/// Numbers of a stop, in the order of their bytes.
struct Numbers {
  std::uint64_t epoch = 0;
  std::uint32_t age_ms = 0;
  std::uint16_t why = 0;                     ///< [bytes]
  std::uint8_t workstation = 0, person = 0;  ///< the same
  StopLatch::Level level{};
  std::uint8_t by = 0;
  AccessRole role{};
  std::array<std::uint8_t, 5> reserved{};
};
static_assert(std::has_unique_object_representations_v<Numbers>);

}  // namespace

std::vector<SnapshotEntry> stop_entries(const StopLatch::Latest& stop, std::uint64_t epoch) {
  if (stop.level == StopLatch::Level::kNone) return {};
  const std::string_view workstation = stop.words.workstation.view(), person = stop.words.person.view(),
                         why = stop.words.why.view();
  const auto age_ms = std::chrono::floor<std::chrono::milliseconds>(Time{} - stop.at).count();
  const Numbers numbers{.epoch = epoch,
                        .age_ms = static_cast<std::uint32_t>(
                            std::clamp<std::int64_t>(age_ms, 0, std::numeric_limits<std::uint32_t>::max())),
                        .why = static_cast<std::uint16_t>(why.size()),
                        .workstation = static_cast<std::uint8_t>(workstation.size()),
                        .person = static_cast<std::uint8_t>(person.size()),
                        .level = stop.level,
                        .by = stop.by,
                        .role = stop.role};
  std::vector<std::byte> bytes(sizeof numbers);
  std::memcpy(bytes.data(), &numbers, sizeof numbers);
  for (const std::string_view text : {workstation, person, why})
    bytes.insert(bytes.end(), bytes_of(text).begin(), bytes_of(text).end());
  std::vector<SnapshotEntry> entries;
  for (std::span<const std::byte> rest = bytes; !rest.empty(); rest = rest.subspan(std::min(kPart, rest.size()))) {
    SnapshotEntry& entry = entries.emplace_back();
    std::ranges::copy(bytes_of(kStopLabel), entry.begin());
    entry[kPlaceAt] = static_cast<std::byte>(entries.size() - 1);
    std::ranges::copy(rest.first(std::min(kPart, rest.size())), entry.begin() + kPartAt);
  }
  return entries;
}

StopLatch::Latest stop_of(std::span<const SnapshotEntry> entries, std::uint64_t epoch, std::size_t seats) {
  std::vector<std::byte> bytes;
  for (const SnapshotEntry& entry : entries)
    if (std::ranges::equal(std::span{entry}.first(kPlaceAt), bytes_of(kStopLabel)) &&
        std::to_integer<std::size_t>(entry[kPlaceAt]) * kPart == bytes.size())
      bytes.insert(bytes.end(), entry.begin() + kPartAt, entry.end());
  Numbers numbers;
  if (bytes.size() < sizeof numbers) return {};
  std::memcpy(&numbers, bytes.data(), sizeof numbers);
  const std::string_view texts = text_of(std::span{bytes}.subspan(sizeof numbers));
  if (texts.size() < std::size_t{numbers.workstation} + numbers.person + numbers.why) return {};
  const std::string_view workstation = texts.substr(0, numbers.workstation),
                         person = texts.substr(numbers.workstation, numbers.person),
                         why = texts.substr(std::size_t{numbers.workstation} + numbers.person, numbers.why);
  const auto name_or_none = [](std::string_view text) { return text.empty() || rpc::is_name(text); };
  const bool valid =
      numbers.epoch == epoch && numbers.level >= StopLatch::Level::kPaused &&
      numbers.level <= StopLatch::Level::kStopped &&
      (numbers.by < seats || numbers.by == AuditEvent::kControlPlane || numbers.by == StopLatch::kNoSeat) &&
      static_cast<std::uint8_t>(numbers.role) < kAccessRoles && name_or_none(workstation) && name_or_none(person) &&
      rpc::is_text(why);
  if (!valid) return {};
  return {numbers.level,
          numbers.by,
          numbers.role,
          Time{} - Milliseconds{numbers.age_ms},
          {FixedText<rpc::kNameMax>{workstation}, FixedText<rpc::kNameMax>{person}, FixedText<rpc::kTextMax>{why}}};
}

}  // namespace tandem::server
