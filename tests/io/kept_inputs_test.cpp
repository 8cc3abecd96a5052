// The inputs of a session that no recording has taken yet: every way of reading gives the journal back byte for byte,
// and a full, failing or slow disk costs later recordings their inputs only, with the reason.
#include <gtest/gtest.h>

#include "tests/common/base/counts.h"
#include "tests/io/kept_session.h"
#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

using namespace server::test;
using tandem::test::FileFault;
using tandem::test::Folder;

TEST(KeptInputs, GiveTheJournalBackByteForByteFromAnyTimeOn) {
  const std::uint64_t count = tandem::test::seeds(20);
  std::size_t raw = 0, spooled = 0, blocks = 0, late = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const Folder folder;
    KeptSession session{folder.file(""), 64 * kMib, seed};
    struct Recording {
      std::unique_ptr<KeptInputs::Reader> reader;
      Taken taken;
    };
    std::vector<Recording> recordings;
    for (int round = 0; round < 60; ++round) {
      session.run(static_cast<int>(session.random().below(400)));
      if (session.random().below(2) == 0) session.inputs().drain();
      if (session.random().below(3) > 0) session.keep();
      if (session.random().below(10) == 0) {
        auto reader = session.inputs().read();
        ASSERT_TRUE(reader) << reader.error();
        late += (*reader)->late() ? 1 : 0;
        recordings.push_back({std::move(*reader), {}});
      }
      for (Recording& r : recordings) take(*r.reader, r.taken, static_cast<int>(session.random().below(4)));
    }
    for (Recording& r : recordings) {
      take(*r.reader, r.taken);
      EXPECT_EQ(r.taken.why, "");
      EXPECT_TRUE(r.taken.bytes == session.all()) << r.taken.bytes.size() << " of " << session.all().size();
      blocks += r.taken.blocks;
    }
    EXPECT_EQ(session.inputs().problem(), "");
    raw += session.all().size();
    spooled += session.inputs().spooled();
  }
  std::printf("[  figures ] journals of %zu bytes, %zu in spools; %zu late recordings read %zu blocks\n", raw, spooled,
              late, blocks);
  EXPECT_GT(late, count);
  EXPECT_GT(blocks, 10 * count);
  EXPECT_LT(spooled, raw / 2);
}

TEST(KeptInputs, AreInAFileWithoutANameThatEndsWithThem) {
  const Folder folder;
  KeptSession session{folder.file(""), 64 * kMib, 1};
  session.run_kept(3000);
  EXPECT_GT(session.inputs().spooled(), 50'000u);
  EXPECT_EQ(files_in(folder), 0u);
  ASSERT_GE(spool_of(folder), 0);
  session.release();
  EXPECT_EQ(spool_of(folder), -1);
}

TEST(KeptInputs, EndAtTheirLimitAndSayWhy) {
  const Folder folder;
  KeptSession session{folder.file(""), 100'000, 1};
  auto early = session.inputs().read();
  ASSERT_TRUE(early);
  session.run_kept(6000);
  EXPECT_NE(session.inputs().problem().find("had run longer than the inputs kept"), std::string::npos);
  EXPECT_LE(session.inputs().spooled(), 100'000u);
  EXPECT_EQ(session.inputs().take_problem(), session.inputs().problem());
  EXPECT_EQ(session.inputs().take_problem(), "") << "the operator gets one warning";
  const auto late = session.inputs().read();
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error(), session.inputs().problem());
  Taken taken;
  take(**early, taken);
  session.run_kept(500);
  take(**early, taken);
  EXPECT_TRUE(taken.bytes == session.all()) << "the recording that ran loses nothing";
  early->reset();
  session.run(30'000);
  session.inputs().drain();
  EXPECT_GT(session.inputs().journal().dropped(), 0u) << "nothing drains the journal any more";
}

TEST(KeptInputs, MayGrowToTwiceTheirLimitWhileARecordingReadsThem) {
  const Folder folder;
  KeptSession session{folder.file(""), 300'000, 1};
  session.run_kept(2000);
  auto reader = session.inputs().read();
  ASSERT_TRUE(reader && (*reader)->late() && (*reader)->behind());
  Taken taken;
  take(**reader, taken, 1);
  session.run_kept(4000);
  EXPECT_GT(session.inputs().spooled(), 300'000u);
  EXPECT_EQ(session.inputs().problem(), "");
  session.run_kept(9000);
  EXPECT_LE(session.inputs().spooled(), 600'000u);
  EXPECT_NE(session.inputs().problem(), "");
  take(**reader, taken);
  session.run_kept(2000);
  take(**reader, taken);
  EXPECT_TRUE(taken.bytes == session.all());
}

TEST(KeptInputs, AreNoneButThoseOfTheFirstRecordingIfTheLimitIsZero) {
  const Folder folder;
  KeptSession session{folder.file(""), 0, 1};
  session.run(100);
  auto first = session.inputs().read();
  ASSERT_TRUE(first) << first.error();
  EXPECT_FALSE((*first)->late());
  session.run_kept(3000);
  Taken taken;
  take(**first, taken);
  EXPECT_TRUE(taken.bytes == session.all());
  EXPECT_EQ(spool_of(folder), -1);
  EXPECT_EQ(session.inputs().take_problem(), "") << "that is how the operator configured it";
  const auto second = session.inputs().read();
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("inputs_mib: 0"), std::string::npos) << second.error();
}

/// A disk that fails while the inputs are kept: recordings that read already lose nothing, later ones have a reason.
void expect_reason_of_disk_failure(FileFault::Kind kind, const std::string& reason) {
  const Folder folder;
  KeptSession session{folder.file(""), 64 * kMib, 1};
  auto live = session.inputs().read();
  session.run_kept(2000);
  auto behind = session.inputs().read();
  ASSERT_TRUE(live && behind && (*behind)->behind());
  Taken of_live, of_behind;
  take(**behind, of_behind, 1);
  tandem::test::inject(folder.file(""), {.kind = kind, .lasting = true});
  session.run_kept(2000);
  EXPECT_TRUE(tandem::test::fault_hit());
  tandem::test::no_faults();
  session.run_kept(2000);
  EXPECT_NE(session.inputs().problem().find(reason), std::string::npos) << session.inputs().problem();
  EXPECT_TRUE((*behind)->urgent());
  take(**live, of_live);
  take(**behind, of_behind);
  EXPECT_TRUE(of_live.bytes == session.all());
  EXPECT_TRUE(of_behind.bytes == session.all());
  const auto late = session.inputs().read();
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error(), session.inputs().problem());
}

TEST(KeptInputs, SayWhyOnAFullDisk) { expect_reason_of_disk_failure(FileFault::Kind::kNoSpace, "the disk is full"); }
TEST(KeptInputs, SayWhyOnAFailingDisk) { expect_reason_of_disk_failure(FileFault::Kind::kInputOutput, "error"); }
TEST(KeptInputs, SayWhyIfHalfOfABlockWasWritten) {
  expect_reason_of_disk_failure(FileFault::Kind::kHalf, "the disk is full");
}

TEST(KeptInputs, SayWhyIfNoFileCanBeMade) {
  const Folder folder;
  KeptSession session{folder.file("absent"), 64 * kMib, 1};
  session.run_kept(1000);
  EXPECT_NE(session.inputs().problem().find("no file can be made for them"), std::string::npos)
      << session.inputs().problem();
}

TEST(KeptInputs, EndIfTheDiskIsTooSlow) {
  const Folder folder;
  KeptSession session{folder.file(""), 64 * kMib, 1};
  for (std::size_t k = 0; k < 3000 && session.inputs().problem().empty(); ++k) {
    session.run(50);
    session.inputs().drain();  // the thread that writes waits for the disk
  }
  EXPECT_EQ(session.inputs().problem(), "the disk is too slow");
  EXPECT_LT(session.all().size(), KeptInputs::kPendingMax + kMib);
}

TEST(KeptInputs, EndIfNothingDrainedTheJournalInTime) {
  const Folder folder;
  KeptSession session{folder.file(""), 64 * kMib, 1};
  session.run_kept(100);
  session.run(8000);
  session.keep();
  EXPECT_EQ(session.inputs().problem(), "the computer was too slow to keep them");
}

}  // namespace
}  // namespace tandem::server
