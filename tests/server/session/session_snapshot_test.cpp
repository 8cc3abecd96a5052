// A restart reads the snapshot exactly as it was written, or gets an error that an operator understands.
#include "server/session/session_snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "server/session/stop_entries.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

SessionSnapshot sample(const SceneSpec& scene) {
  SessionSnapshot kept;
  Checkpoint& c = kept.checkpoint;
  c.scene = scene_hash(scene);
  c.epoch = 7;
  c.session_tick = 12345;
  c.begun = true;
  c.seats_n = static_cast<std::uint8_t>(scene.seats.size());
  c.masters_n = static_cast<std::uint8_t>(scene.masters());
  c.tools_n = static_cast<std::uint8_t>(scene.tools.size());
  c.dof = static_cast<std::uint8_t>(scene.dof);
  c.tools[0].alpha[0] = 1;
  c.seats[1].taken = true;
  c.seats[1].resume[31] = std::byte{9};
  c.seats[1].force_scale = 0.5;
  kept.id[3] = std::byte{42};
  kept.name = "lab";
  kept.code = "ABCDEFGHJK";
  kept.written_s = 1'800'000'000;
  kept.removed_workstations = {{std::byte{1}}, {std::byte{2}, std::byte{3}}};
  kept.persons = {"ann", "", std::string(32, 'x')};
  return kept;
}

TEST(SessionSnapshot, SurvivesEncodingAndDecoding) {
  const SceneSpec scene = test::shipped("contact");
  const SessionSnapshot kept = sample(scene);
  const auto bytes = encode_snapshot(kept);
  ASSERT_FALSE(bytes.empty());
  EXPECT_LE(bytes.size(), kSnapshotMax);
  const auto back = decode_snapshot(bytes);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->id, kept.id);
  EXPECT_EQ(back->name, "lab");
  EXPECT_EQ(back->code, "ABCDEFGHJK");
  EXPECT_EQ(back->removed_workstations, kept.removed_workstations);
  EXPECT_EQ(back->persons, kept.persons);
  EXPECT_EQ(back->written_s, kept.written_s);
  EXPECT_EQ(back->checkpoint.epoch, 7u);
  EXPECT_EQ(back->checkpoint.seats[1].resume, kept.checkpoint.seats[1].resume);
  EXPECT_EQ(back->checkpoint.seats[1].force_scale, 0.5);
  EXPECT_EQ(encode_snapshot(*back), bytes);
}

TEST(SessionSnapshot, KeepsCountsOfRestoresThroughReleasesThatDoNotKnowThem) {
  SessionSnapshot kept = sample(test::shipped("contact"));
  kept.checkpoint.stops = 9;
  kept.checkpoint.restores = RestoreCounts{2, 3, 6};
  kept.checkpoint.handed_over = true;
  const auto back = decode_snapshot(encode_snapshot(kept));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->checkpoint.restores, kept.checkpoint.restores);
  EXPECT_TRUE(back->checkpoint.handed_over);
  EXPECT_EQ(back->removed_workstations, kept.removed_workstations);

  // An older release has the entry as one more removed workstation, and writes it again.
  SessionSnapshot older = kept;
  older.checkpoint.restores.reset();
  std::vector<std::byte> bytes = encode_snapshot(kept);
  constexpr std::string_view kLabel = "tandem-runs";
  const auto at = std::ranges::search(bytes, std::as_bytes(std::span{kLabel})).begin();
  ASSERT_NE(at, bytes.end());
  std::copy_n(at, 32, older.removed_workstations.emplace_back().begin());
  const auto same_owner = decode_snapshot(encode_snapshot(older));
  ASSERT_TRUE(same_owner);
  EXPECT_EQ(same_owner->checkpoint.restores, kept.checkpoint.restores);
  older.checkpoint.epoch = 8;
  older.checkpoint.stops = 10;
  const auto restored = decode_snapshot(encode_snapshot(older));
  ASSERT_TRUE(restored) << restored.error();
  EXPECT_EQ(restored->checkpoint.restores, std::nullopt) << "the older release has restored it, and not counted that";
  EXPECT_EQ(restored->removed_workstations, kept.removed_workstations);
  kept.removed_workstations.resize(kRemovedWorkstationsMax);
  const auto full = decode_snapshot(encode_snapshot(kept));
  ASSERT_TRUE(full) << full.error();
  EXPECT_EQ(full->removed_workstations.size(), kRemovedWorkstationsMax) << "no workstation is left out for the counts";
}

TEST(SessionSnapshot, KeepsTheRestOfTheSessionsTimeOfItsOwnEpochOnly) {
  SessionSnapshot kept = sample(test::shipped("contact"));
  kept.checkpoint.restores = RestoreCounts{};
  kept.life_left_s = 5400;
  const auto back = decode_snapshot(encode_snapshot(kept));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->life_left_s, 5400);
  EXPECT_EQ(back->checkpoint.restores, kept.checkpoint.restores);
  EXPECT_EQ(back->removed_workstations, kept.removed_workstations);
  SessionSnapshot older = kept;  // of a release that has the entry as a workstation, after it restored the session
  older.life_left_s.reset();
  const std::vector<std::byte> bytes = encode_snapshot(kept);
  constexpr std::string_view kLabel = "tandem-life";
  const auto at = std::ranges::search(bytes, std::as_bytes(std::span{kLabel})).begin();
  ASSERT_NE(at, bytes.end());
  std::copy_n(at, 32, older.removed_workstations.emplace_back().begin());
  ++older.checkpoint.epoch;
  const auto restored = decode_snapshot(encode_snapshot(older));
  ASSERT_TRUE(restored) << restored.error();
  EXPECT_EQ(restored->life_left_s, std::nullopt);
  EXPECT_EQ(restored->removed_workstations, kept.removed_workstations);
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{rpc::kLifeMaxS} + 1}) {
    kept.life_left_s = wrong;
    const auto refused = decode_snapshot(encode_snapshot(kept));
    ASSERT_TRUE(refused) << refused.error();
    EXPECT_EQ(refused->life_left_s, std::nullopt) << wrong;
  }
}

TEST(SessionSnapshot, KeepsAStopThroughReleasesThatDoNotKnowIt) {
  SessionSnapshot kept = sample(test::shipped("contact"));
  kept.checkpoint.restores = RestoreCounts{};
  StopLatch::Latest& stop = kept.checkpoint.latest_stop;
  stop.level = StopLatch::Level::kStopped;
  stop.by = 1;
  stop.words.why = FixedText<rpc::kTextMax>{std::string(rpc::kTextMax, 'y')};
  const auto bytes = encode_snapshot(kept);
  EXPECT_LE(bytes.size(), kSnapshotMax);
  const auto back = decode_snapshot(bytes);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->checkpoint.latest_stop.by, 1);
  EXPECT_EQ(back->checkpoint.latest_stop.words.why.view(), stop.words.why.view());
  EXPECT_EQ(back->removed_workstations, kept.removed_workstations);
  EXPECT_EQ(back->checkpoint.restores, kept.checkpoint.restores);

  // An older release has the entries as removed workstations, restores the session, and writes them again.
  SessionSnapshot older = kept;
  older.checkpoint.restores.reset();
  for (const SnapshotEntry& entry : stop_entries(stop, kept.checkpoint.epoch))
    older.removed_workstations.push_back(entry);
  stop = {};
  older.checkpoint.latest_stop = {};
  ++older.checkpoint.epoch;
  const auto restored = decode_snapshot(encode_snapshot(older));
  ASSERT_TRUE(restored) << restored.error();
  EXPECT_EQ(restored->checkpoint.latest_stop.level, StopLatch::Level::kNone) << "the older release may have another";
  EXPECT_EQ(restored->removed_workstations, kept.removed_workstations);

  older = kept;
  older.removed_workstations.resize(kRemovedWorkstationsMax - 5);
  older.checkpoint.latest_stop = back->checkpoint.latest_stop;
  const auto full = decode_snapshot(encode_snapshot(older));
  ASSERT_TRUE(full) << full.error();
  EXPECT_EQ(full->checkpoint.latest_stop.level, StopLatch::Level::kNone) << "there is no room for all of it";
  EXPECT_EQ(full->removed_workstations.size(), kRemovedWorkstationsMax - 5);
}

// A program that can write to the directory of a service can compute the digests too.
TEST(SessionSnapshot, RejectsNamesThatNoTicketHas) {
  for (const char* name : {"a\nb", "\xff", "a b", "a\"b"}) {
    SessionSnapshot kept = sample(test::shipped("contact"));
    kept.persons[0] = name;
    const auto back = decode_snapshot(encode_snapshot(kept));
    ASSERT_FALSE(back) << name;
    EXPECT_EQ(back.error(), "the name of a person in it is not valid");
  }
}

TEST(SessionSnapshot, RejectsEveryTruncationAndEveryFlippedBit) {
  const auto bytes = encode_snapshot(sample(test::shipped("contact")));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(decode_snapshot(std::span{bytes}.first(size))) << size;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto bad = bytes;
    bad[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    ASSERT_FALSE(decode_snapshot(bad)) << bit;
  }
}

TEST(SessionSnapshot, RandomBytesAreAnError) {
  RandomStream random{5};
  std::vector<std::byte> bytes(kSnapshotMax + 8);
  for (int n = 0; n < 2000; ++n) {
    for (auto& b : bytes) b = static_cast<std::byte>(random.below(256));
    ASSERT_FALSE(decode_snapshot(std::span{bytes}.first(random.below(bytes.size() + 1))));
  }
}

TEST(SessionSnapshot, IsCompatibleWithItsSceneAndNameForTenMinutes) {
  SceneSpec scene = test::shipped("contact");
  const SessionSnapshot kept = sample(scene);
  const auto why = [&](std::string_view name, std::int64_t later) {
    return incompatibility(kept, name, scene, kept.written_s + later);
  };
  EXPECT_EQ(why("lab", 0), "");
  EXPECT_EQ(why("lab", 600), "");
  EXPECT_NE(why("lab", 601).find("10 min old"), std::string::npos) << why("lab", 601);
  EXPECT_EQ(why("lab", -600), "") << "a clock that was set a little";
  EXPECT_NE(why("lab", -601).find("in the future"), std::string::npos);
  EXPECT_NE(why("other", 0), "");
  scene.channel.k *= 2;
  EXPECT_NE(why("lab", 0).find("another scene"), std::string::npos);
}

TEST(SessionSnapshot, NamesThatAreTooLongAreNotWritten) {
  SessionSnapshot kept = sample(test::shipped("contact"));
  kept.name = std::string(256, 'x');
  EXPECT_TRUE(encode_snapshot(kept).empty());
  kept.name = std::string(255, 'x');
  kept.removed_workstations.resize(kRemovedWorkstationsMax + 1);
  EXPECT_TRUE(encode_snapshot(kept).empty());
  kept.removed_workstations.resize(kRemovedWorkstationsMax);
  kept.persons.assign(kSeatsMax + 1, "ann");
  EXPECT_TRUE(encode_snapshot(kept).empty());
  kept.persons.assign(kSeatsMax, std::string(33, 'x'));
  EXPECT_TRUE(encode_snapshot(kept).empty());
  kept.persons.assign(kSeatsMax, std::string(32, 'x'));
  kept.code = std::string(255, 'y');
  const auto back = decode_snapshot(encode_snapshot(kept));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, kept.name);
  EXPECT_EQ(back->removed_workstations.size(), kRemovedWorkstationsMax);
  EXPECT_EQ(back->persons, kept.persons);
  EXPECT_LE(encode_snapshot(kept).size(), kSnapshotMax);
}

}  // namespace
}  // namespace tandem::server
