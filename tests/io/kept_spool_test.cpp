// Spools of inputs: damaged and cut ones, those of a killed server, and the threads that write and free them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "server/app/recording/input_keeper.h"
#include "tests/common/base/counts.h"
#include "tests/io/kept_session.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using namespace server::test;
using tandem::test::Folder;

// A reader of any bytes gets blocks, or the reason why there are none.
TEST(KeptInputs, AreSafeToReadFromADamagedOrCutSpool) {
  const std::uint64_t count = tandem::test::seeds(200);
  std::size_t lost = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const Folder folder;
    KeptSession session{folder.file(""), 64 * kMib, seed};
    session.run_kept(1500);
    const int file = spool_of(folder);
    ASSERT_GE(file, 0);
    const auto size = static_cast<off_t>(session.inputs().spooled());
    if (seed % 4 == 0) {
      ASSERT_EQ(::ftruncate(file, static_cast<off_t>(session.random().below(static_cast<std::uint64_t>(size)))), 0);
    } else {
      // The first bytes are a head, whose numbers are sizes.
      const auto at = session.random().below(seed % 4 == 1 ? KeptBlockHead::kSize : static_cast<std::uint64_t>(size));
      const auto value = static_cast<std::uint8_t>(1 + session.random().below(255));
      std::uint8_t byte = 0;
      ASSERT_EQ(::pread(file, &byte, 1, static_cast<off_t>(at)), 1);
      byte ^= value;
      ASSERT_EQ(::pwrite(file, &byte, 1, static_cast<off_t>(at)), 1);
    }
    auto reader = session.inputs().read();
    ASSERT_TRUE(reader);
    Taken taken;
    take(**reader, taken);
    EXPECT_FALSE(taken.why.empty()) << "a changed byte is seen";
    EXPECT_TRUE(session.all().starts_with(taken.bytes)) << "the bytes before it are right";
    lost += taken.why.empty() ? 0 : 1;
    EXPECT_EQ((*reader)->next().kind, KeptInputs::Reader::Kind::kLost) << "nothing follows a gap";
  }
  EXPECT_EQ(lost, count);
}

TEST(KeptBlockReader, IsSafeForAnyBytes) {
  RandomStream random{RandomKey{5}};
  KeptBlockReader reader;
  for (int k = 0; k < 20'000; ++k) {
    std::array<std::byte, KeptBlockHead::kSize> head{};
    for (std::byte& b : head) b = static_cast<std::byte>(random.below(3) == 0 ? random.bits() & 0xff : 0);
    const auto parsed = KeptBlockReader::read_head(head);
    if (!parsed) continue;
    EXPECT_LE(parsed->packed, std::uint32_t{64} << 20U);
    EXPECT_LE(parsed->size, std::uint32_t{64} << 20U);
    std::vector<std::byte> bytes(std::min<std::size_t>(parsed->packed, 300));
    for (std::byte& b : bytes) b = static_cast<std::byte>(random.bits() & 0xff);
    EXPECT_FALSE(reader.read(*parsed, bytes));
  }
}

TEST(InputSpool, OfAKilledServerIsRemoved) {
  const Folder folder;
  folder.write(".tandem-inputs-a1b2c3", "left by a file system that makes no files without a name");
  folder.write("lesson.mcap", "x");
  remove_stale_spools(folder.file(""));
  EXPECT_EQ(files_in(folder), 1u);
  EXPECT_EQ(folder.read("lesson.mcap"), "x");
  remove_stale_spools(folder.file("absent"));
}

// The threads of a server: journals are drained in time, and spools are freed once nothing refers to them.
TEST(InputKeeper, KeepsTheInputsOfManySessionsAndReleasesThem) {
  const Folder folder;
  InputKeeper keeper;
  std::vector<std::unique_ptr<KeptSession>> sessions;
  for (std::uint64_t k = 1; k <= 8; ++k) {
    sessions.push_back(std::make_unique<KeptSession>(folder.file(""), 64 * kMib, k));
    keeper.add(sessions.back()->shared());
  }
  for (int k = 0; k < 50; ++k) {
    for (const auto& session : sessions) session->run(50);
    std::this_thread::sleep_for(10ms);
  }
  for (const auto& session : sessions) {
    auto reader = session->inputs().read();
    ASSERT_TRUE(reader) << reader.error();
    Taken taken;
    take(**reader, taken);
    EXPECT_GT(taken.blocks, 0u);
    EXPECT_TRUE(taken.bytes == session->all());
  }
  EXPECT_GT(keeper.cpu().count(), 0);
  sessions.clear();
  for (int k = 0; k < 3000 && spool_of(folder) >= 0; ++k) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(spool_of(folder), -1);
}

}  // namespace
}  // namespace tandem::server
