// What a restart finds of a session is what was written, or an error that a person understands.
#include <gtest/gtest.h>

#include <vector>

#include "common/base/rng.h"
#include "server/kept_session.h"
#include "tests/support/world_run.h"

namespace tandem::server {
namespace {

KeptSession sample(const SceneSpec& scene) {
  KeptSession kept;
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
  kept.sent_away = {{std::byte{1}}, {std::byte{2}, std::byte{3}}};
  return kept;
}

TEST(KeptSession, IsTheSameAfterBytes) {
  const SceneSpec scene = test::shipped("contact");
  const KeptSession kept = sample(scene);
  const auto bytes = encode_kept(kept);
  ASSERT_FALSE(bytes.empty());
  EXPECT_LE(bytes.size(), kKeptMax);
  const auto back = decode_kept(bytes);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->id, kept.id);
  EXPECT_EQ(back->name, "lab");
  EXPECT_EQ(back->code, "ABCDEFGHJK");
  EXPECT_EQ(back->sent_away, kept.sent_away);
  EXPECT_EQ(back->written_s, kept.written_s);
  EXPECT_EQ(back->checkpoint.epoch, 7u);
  EXPECT_EQ(back->checkpoint.seats[1].resume, kept.checkpoint.seats[1].resume);
  EXPECT_EQ(back->checkpoint.seats[1].force_scale, 0.5);
  EXPECT_EQ(encode_kept(*back), bytes);
}

TEST(KeptSession, EveryCutAndEveryFlippedBitIsAnError) {
  const auto bytes = encode_kept(sample(test::shipped("contact")));
  for (std::size_t size = 0; size < bytes.size(); ++size) ASSERT_FALSE(decode_kept(std::span{bytes}.first(size))) << size;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto bad = bytes;
    bad[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    ASSERT_FALSE(decode_kept(bad)) << bit;
  }
}

TEST(KeptSession, RandomBytesAreAnError) {
  RandomStream random{5};
  std::vector<std::byte> bytes(kKeptMax + 8);
  for (int n = 0; n < 2000; ++n) {
    for (auto& b : bytes) b = static_cast<std::byte>(random.below(256));
    ASSERT_FALSE(decode_kept(std::span{bytes}.first(random.below(bytes.size() + 1))));
  }
}

TEST(KeptSession, FitsItsSceneItsNameAndTenMinutes) {
  SceneSpec scene = test::shipped("contact");
  const KeptSession kept = sample(scene);
  const auto why = [&](std::string_view name, std::int64_t later) { return unfit(kept, name, scene, kept.written_s + later); };
  EXPECT_EQ(why("lab", 0), "");
  EXPECT_EQ(why("lab", 600), "");
  EXPECT_NE(why("lab", 601).find("10 min old"), std::string::npos) << why("lab", 601);
  EXPECT_EQ(why("lab", -600), "") << "a clock that was set a little";
  EXPECT_NE(why("lab", -601).find("in the future"), std::string::npos);
  EXPECT_NE(why("other", 0), "");
  scene.channel.k *= 2;
  EXPECT_NE(why("lab", 0).find("another scene"), std::string::npos);
}

TEST(KeptSession, NamesThatAreTooLongAreNotWritten) {
  KeptSession kept = sample(test::shipped("contact"));
  kept.name = std::string(256, 'x');
  EXPECT_TRUE(encode_kept(kept).empty());
  kept.name = std::string(255, 'x');
  kept.sent_away.resize(kSentAwayMax + 1);
  EXPECT_TRUE(encode_kept(kept).empty());
  kept.sent_away.resize(kSentAwayMax);
  kept.code = std::string(255, 'y');
  const auto back = decode_kept(encode_kept(kept));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, kept.name);
  EXPECT_EQ(back->sent_away.size(), kSentAwayMax);
  EXPECT_LE(encode_kept(kept).size(), kKeptMax);
}

}  // namespace
}  // namespace tandem::server
