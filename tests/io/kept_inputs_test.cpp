// The inputs of a session that no recording has taken yet: every way of reading gives the journal back byte for byte,
// and a full, failing or damaged spool costs later recordings their inputs only, with the reason.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "server/app/recording/input_keeper.h"
#include "server/app/recording/kept_inputs.h"
#include "server/recording/input_unpacker.h"
#include "tests/common/base/counts.h"
#include "tests/io/programs.h"
#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using tandem::test::FileFault;
using tandem::test::Folder;
using Kind = KeptInputs::Reader::Kind;

constexpr std::uint64_t kMib = std::uint64_t{1} << 20U;

/// A session's journal that a test writes, and the journal of a twin that nothing keeps.
class Writer {
 public:
  Writer(std::string folder, std::uint64_t limit, std::uint64_t seed)
      : random_(RandomKey{seed}),
        inputs_(KeptInputs::make(std::make_unique<InputJournal>(kKey, kMib), std::move(folder), limit)) {}
  ~Writer() { release(); }

  [[nodiscard]] KeptInputs& inputs() { return *inputs_; }
  [[nodiscard]] const std::shared_ptr<KeptInputs>& shared() { return inputs_; }
  void release() { inputs_.reset(); }

  /// Writes ticks of two seats whose numbers change slowly, with noise and rare other records.
  void run(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      now_ += 1ms;
      for (std::size_t seat = 0; seat < 2; ++seat) {
        std::array<std::byte, 96> plaintext{};
        const auto put = [&plaintext](std::size_t at, auto value) { std::memcpy(&plaintext[at], &value, sizeof value); };
        put(0, ++counter_);
        put(8, static_cast<float>(counter_) * 1e-5F);
        put(16, random_.bits() % 1000);
        for (const std::size_t noise : {32, 40, 48}) put(noise, random_.bits());
        const auto sent = std::span{plaintext}.first(90 + random_.below(2) * 6);
        for (InputJournal* const to : {&inputs_->journal(), &twin_})
          to->datagram(now_, seat, {}, {.counter = counter_}, sent, nullptr);
      }
      const bool removed = random_.below(300) == 0;
      for (InputJournal* const to : {&inputs_->journal(), &twin_}) {
        if (removed) to->remove(1, wire::CloseReason::kLeaving);
        to->tick(now_, 0, {});
        to->end_tick();
      }
      drain_twin();
    }
  }
  /// Writes ticks, and lets the keeper's threads do their work meanwhile.
  void run_kept(int ticks) {
    for (int k = 0; k < ticks; k += 20) {
      run(20);
      inputs_->drain();
      while (inputs_->keep(blocks_)) {
      }
    }
  }
  void keep() {
    inputs_->drain();
    while (inputs_->keep(blocks_)) {
    }
  }
  /// All bytes of the journal so far.
  [[nodiscard]] const std::string& all() const { return all_; }
  [[nodiscard]] RandomStream& random() { return random_; }

 private:
  static constexpr transport::HashKey kKey{std::byte{7}};
  void drain_twin() {
    std::array<std::byte, 4096> piece;
    while (const std::size_t size = twin_.drain(piece))
      all_ += text_of(std::span{piece}.first(size)).substr(InputJournal::kPieceHeader);
  }

  RandomStream random_;
  std::shared_ptr<KeptInputs> inputs_;
  InputJournal twin_{kKey, kMib};
  KeptBlockWriter blocks_;
  std::string all_;
  std::uint64_t counter_ = 0;
  Time now_{};
};

/// What a recording gets from a reader.
struct Taken {
  std::string bytes{};     ///< of the journal; ends before the first gap
  std::string why{};       ///< inputs were lost
  std::size_t blocks = 0, stored = 0;
};

/// Takes at most `count` items.
void take(KeptInputs::Reader& reader, Taken& out, int count = 1'000'000) {
  const Lesson no_rows;
  InputUnpacker unpacker{no_rows};
  for (int k = 0; k < count; ++k) {
    const KeptInputs::Reader::Item item = reader.next();
    if (item.kind == Kind::kNothing) return;
    if (item.kind == Kind::kLost) {
      out.why = item.bytes;
      return;
    }
    std::span<const std::byte> piece = bytes_of(item.bytes);
    if (item.kind == Kind::kBlock) {
      const auto unpacked = unpacker.unpack(piece);
      ASSERT_TRUE(unpacked);
      piece = *unpacked;
      ++out.blocks;
      out.stored += item.stored;
    }
    std::uint64_t position = 0;
    std::memcpy(&position, piece.data(), sizeof position);
    ASSERT_EQ(position, out.bytes.size()) << "a gap";
    out.bytes += text_of(piece.subspan(sizeof position));
  }
}

/// Files in a folder, hidden ones too.
std::size_t files_in(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.file("")), fs::directory_iterator{}));
}

/// Descriptor of the spool that this process has open below a folder.
int spool_of(const Folder& folder) {
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const std::string target = fs::read_symlink(entry.path(), error).string();
    if (target.starts_with(folder.file("")) && target.ends_with("(deleted)"))
      return std::stoi(entry.path().filename().string());
  }
  return -1;
}

TEST(KeptInputs, GiveTheJournalBackByteForByteFromAnyTimeOn) {
  const std::uint64_t count = tandem::test::seeds(20);
  std::size_t raw = 0, spooled = 0, blocks = 0, late = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const Folder folder;
    Writer session{folder.file(""), 64 * kMib, seed};
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
  Writer session{folder.file(""), 64 * kMib, 1};
  session.run_kept(3000);
  EXPECT_GT(session.inputs().spooled(), 50'000u);
  EXPECT_EQ(files_in(folder), 0u);
  ASSERT_GE(spool_of(folder), 0);
  session.release();
  EXPECT_EQ(spool_of(folder), -1);
}

TEST(KeptInputs, EndAtTheirLimitAndSayWhy) {
  const Folder folder;
  Writer session{folder.file(""), 100'000, 1};
  auto early = session.inputs().read();
  ASSERT_TRUE(early);
  session.run_kept(6000);
  EXPECT_NE(session.inputs().problem().find("had run longer than the inputs kept"), std::string::npos);
  EXPECT_LE(session.inputs().spooled(), 100'000u);
  EXPECT_EQ(session.inputs().take_problem(), session.inputs().problem());
  EXPECT_EQ(session.inputs().take_problem(), "") << "the operator is told once";
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

TEST(KeptInputs, MayExceedTheirLimitWhileARecordingReadsThem) {
  const Folder folder;
  Writer session{folder.file(""), 300'000, 1};
  session.run_kept(2000);
  auto reader = session.inputs().read();
  ASSERT_TRUE(reader && (*reader)->late() && (*reader)->behind());
  Taken taken;
  take(**reader, taken, 1);
  session.run_kept(9000);
  EXPECT_GT(session.inputs().spooled(), 300'000u);
  take(**reader, taken);
  EXPECT_TRUE(taken.bytes == session.all());
  session.run_kept(2000);
  EXPECT_NE(session.inputs().problem(), "");
  take(**reader, taken);
  EXPECT_TRUE(taken.bytes == session.all());
}

TEST(KeptInputs, AreNoneButThoseOfTheFirstRecordingIfTheLimitIsZero) {
  const Folder folder;
  Writer session{folder.file(""), 0, 1};
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
void expect_disk_failure_is_told(FileFault::Kind kind, const std::string& reason) {
  const Folder folder;
  Writer session{folder.file(""), 64 * kMib, 1};
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

TEST(KeptInputs, SayWhyOnAFullDisk) { expect_disk_failure_is_told(FileFault::Kind::kNoSpace, "the disk is full"); }
TEST(KeptInputs, SayWhyOnAFailingDisk) { expect_disk_failure_is_told(FileFault::Kind::kInputOutput, "error"); }
TEST(KeptInputs, SayWhyIfHalfOfABlockWasWritten) {
  expect_disk_failure_is_told(FileFault::Kind::kHalf, "the disk is full");
}

TEST(KeptInputs, SayWhyIfNoFileCanBeMade) {
  const Folder folder;
  Writer session{folder.file("absent"), 64 * kMib, 1};
  session.run_kept(1000);
  EXPECT_NE(session.inputs().problem().find("no file can be made for them"), std::string::npos)
      << session.inputs().problem();
}

TEST(KeptInputs, EndIfTheDiskIsTooSlow) {
  const Folder folder;
  Writer session{folder.file(""), 64 * kMib, 1};
  for (std::size_t k = 0; k < 3000 && session.inputs().problem().empty(); ++k) {
    session.run(50);
    session.inputs().drain();  // the thread that writes waits for the disk
  }
  EXPECT_EQ(session.inputs().problem(), "the disk is too slow");
  EXPECT_LT(session.all().size(), KeptInputs::kPendingMax + kMib);
}

TEST(KeptInputs, EndIfNothingDrainedTheJournalInTime) {
  const Folder folder;
  Writer session{folder.file(""), 64 * kMib, 1};
  session.run_kept(100);
  session.run(8000);
  session.keep();
  EXPECT_EQ(session.inputs().problem(), "the computer was too slow to keep them");
}

// A reader of any bytes gets blocks, or the reason why there are none.
TEST(KeptInputs, AreSafeToReadFromADamagedOrCutSpool) {
  const std::uint64_t count = tandem::test::seeds(200);
  std::size_t lost = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const Folder folder;
    Writer session{folder.file(""), 64 * kMib, seed};
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
    EXPECT_TRUE(session.all().starts_with(taken.bytes)) << "what precedes it is right";
    lost += taken.why.empty() ? 0 : 1;
    EXPECT_EQ((*reader)->next().kind, Kind::kLost) << "nothing follows a gap";
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
  std::vector<std::unique_ptr<Writer>> sessions;
  for (std::uint64_t k = 1; k <= 8; ++k) {
    sessions.push_back(std::make_unique<Writer>(folder.file(""), 64 * kMib, k));
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
