// A stop that was stored as entries of a list is read as it was written, or not at all.
#include "server/session/stop_entries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "common/base/rng.h"
#include "server/report/audit_event.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using Level = StopLatch::Level;

constexpr std::uint64_t kEpoch = 7;
constexpr std::size_t kSeats = 2;

StopLatch::Latest sample(std::string_view workstation = "office", std::string_view person = "ann",
                         std::string_view why = "fire drill: änder") {
  return {Level::kStopped,
          AuditEvent::kControlPlane,
          AccessRole::kOperator,
          Time{} - 90s,
          {FixedText<rpc::kNameMax>{workstation}, FixedText<rpc::kNameMax>{person}, FixedText<rpc::kTextMax>{why}}};
}

Level level_of(const StopLatch::Latest& stop) { return stop_of(stop_entries(stop, kEpoch), kEpoch, kSeats).level; }

TEST(StopEntries, AreReadAsTheyWereWrittenInAnyOrderAmongOthers) {
  const std::string longest(rpc::kTextMax, 'y');
  for (const std::string_view why : {std::string_view{}, std::string_view{"fire drill"}, std::string_view{longest}}) {
    const StopLatch::Latest stop = sample("office", "", why);
    auto entries = stop_entries(stop, kEpoch);
    entries.insert(entries.begin() + 1, SnapshotEntry{std::byte{42}});
    const StopLatch::Latest back = stop_of(entries, kEpoch, kSeats);
    EXPECT_EQ(back.level, stop.level);
    EXPECT_EQ(back.by, stop.by);
    EXPECT_EQ(back.role, stop.role);
    EXPECT_EQ(back.at, stop.at);
    EXPECT_EQ(back.words.workstation.view(), "office");
    EXPECT_EQ(back.words.person.view(), "");
    EXPECT_EQ(back.words.why.view(), why);
    EXPECT_EQ(stop_of(entries, kEpoch + 1, kSeats).level, Level::kNone) << "of an older release's restore";
    entries.pop_back();
    EXPECT_EQ(stop_of(entries, kEpoch, kSeats).level, Level::kNone) << "incomplete";
  }
  EXPECT_TRUE(stop_entries({}, kEpoch).empty());
}

// A program that can write to the directory of a service can write any of these.
TEST(StopEntries, WithAnInvalidValueAreIgnored) {
  ASSERT_EQ(level_of(sample()), Level::kStopped);
  for (const char* name : {"a b", "a\nb", "\xff", "a\"b"}) {
    EXPECT_EQ(level_of(sample(name)), Level::kNone) << name;
    EXPECT_EQ(level_of(sample("office", name)), Level::kNone) << name;
  }
  for (const char* why : {"\x1b[2J", "\xff", "\xc3", "a\nb"})
    EXPECT_EQ(level_of(sample("office", "ann", why)), Level::kNone) << why;
  StopLatch::Latest stop = sample();
  stop.by = kSeats;
  EXPECT_EQ(level_of(stop), Level::kNone) << "no seat of the scene";
  stop.by = kSeats - 1;
  EXPECT_EQ(level_of(stop), Level::kStopped);
  stop.role = static_cast<AccessRole>(kAccessRoles);
  EXPECT_EQ(level_of(stop), Level::kNone);
  stop = sample();
  stop.level = static_cast<Level>(3);
  EXPECT_EQ(level_of(stop), Level::kNone);
}

TEST(StopEntries, OfAnyBytesGiveAValidStopOrNone) {
  RandomStream random{5};
  for (int n = 0; n < 20000; ++n) {
    auto entries = stop_entries(sample(), kEpoch);
    for (std::uint64_t flips = 1 + random.below(4); flips > 0; --flips)
      entries[random.below(entries.size())][kStopLabel.size() + random.below(21)] ^=
          static_cast<std::byte>(1U << random.below(8));
    const StopLatch::Latest stop = stop_of(entries, kEpoch, kSeats);
    ASSERT_LE(stop.level, Level::kStopped);
    ASSERT_TRUE(stop.by < kSeats || stop.by >= AuditEvent::kControlPlane) << int{stop.by};
    ASSERT_LT(static_cast<std::uint8_t>(stop.role), kAccessRoles);
    ASSERT_LE(stop.at, Time{});
  }
}

}  // namespace
}  // namespace tandem::server
