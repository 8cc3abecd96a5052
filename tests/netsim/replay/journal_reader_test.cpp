// The reader of input journals: pieces, gaps, cuts, and any bytes.
#include "netsim/replay/journal_reader.h"

#include <gtest/gtest.h>

#include "netsim/system/simulation.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/replay/recorded_session.h"

namespace tandem::netsim {
namespace {

using test::Piece;
using test::RecordedSession;

SceneSpec one_axis_scene() { return *parse_scene(find_shipped_scene("one_axis")->text, "one_axis.textproto"); }

/// Journal of 0.4 s of scene one_axis.
std::vector<std::byte> short_journal(const SceneSpec& scene) {
  RecordedSession recorded;
  SimulationConfig setup{.scene = scene, .journal = &recorded.journal};
  const auto simulation = *Simulation::make(setup);
  for (int n = 0; n < 400 && simulation->step(); ++n) recorded.take(simulation->session());
  return recorded.bytes();
}

Piece piece_of(std::span<const std::byte> bytes, std::uint64_t position) {
  Piece piece(sizeof position + bytes.size());
  std::memcpy(piece.data(), &position, sizeof position);
  std::ranges::copy(bytes, piece.begin() + sizeof position);
  return piece;
}

/// Reads and replays any bytes.
SessionReplay::Counts replay_any(const SceneSpec& scene, std::span<const std::byte> bytes, std::string& error) {
  SessionReplay replay{scene};
  JournalReader reader;
  EXPECT_TRUE(bytes.empty() || reader.add(piece_of(bytes, 0)));
  while (const auto event = reader.next())
    if (!replay.apply(*event)) break;
  error = reader.error() + replay.error();
  return replay.counts();
}

TEST(JournalReader, GivesTheSameEventsForPiecesOfAnySize) {
  const auto bytes = short_journal(one_axis_scene());
  std::vector<std::size_t> kinds;
  std::vector<Time> times;
  for (const std::size_t size : {bytes.size(), std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    JournalReader reader;
    std::vector<std::size_t> now;
    std::vector<Time> at;
    const auto read = [&] {
      while (const auto event = reader.next()) {
        now.push_back(event->index());
        if (const auto* tick = std::get_if<JournalTick>(&*event)) at.push_back(tick->at);
      }
    };
    for (std::size_t begin = 0; begin < bytes.size(); begin += size) {
      ASSERT_TRUE(reader.add(piece_of(std::span{bytes}.subspan(begin, std::min(size, bytes.size() - begin)), begin)));
      read();
    }
    read();
    EXPECT_EQ(reader.error(), "");
    EXPECT_EQ(reader.rest(), 0u);
    EXPECT_EQ(at.size(), 400u);
    if (kinds.empty()) kinds = now, times = at;
    EXPECT_EQ(now, kinds);
    EXPECT_EQ(at, times);
  }
}

TEST(JournalReader, RefusesAGapAndAPieceWithoutBytes) {
  const auto bytes = short_journal(one_axis_scene());
  JournalReader gap;
  ASSERT_TRUE(gap.add(piece_of(std::span{bytes}.first(500), 0)));
  EXPECT_FALSE(gap.add(piece_of(std::span{bytes}.subspan(501, 10), 501)));
  EXPECT_EQ(gap.error(), "bytes 500 to 501 of the inputs are missing");
  EXPECT_FALSE(gap.add(piece_of(std::span{bytes}.subspan(500, 10), 500))) << "after an error nothing is read";
  EXPECT_FALSE(gap.next());
  JournalReader empty;
  EXPECT_FALSE(empty.add(Piece(8)));
  EXPECT_NE(empty.error(), "");
}

TEST(JournalReader, EndsAnyCutAtTheLastWholeRecord) {
  const SceneSpec scene = one_axis_scene();
  const auto bytes = short_journal(scene);
  std::uint64_t last = 0;
  for (std::size_t size = 0; size < bytes.size(); size += size < 2000 ? 1 : 211) {
    std::string error;
    const auto counts = replay_any(scene, std::span{bytes}.first(size), error);
    EXPECT_EQ(error, "") << size;
    EXPECT_GE(counts.ticks, last);
    last = counts.ticks;
  }
  EXPECT_GT(last, 300u);
}

TEST(JournalReader, TakesAnyBytes) {
  const SceneSpec scene = one_axis_scene();
  const auto bytes = short_journal(scene);
  RandomStream random{11};
  const std::uint64_t count = tandem::test::seeds(300);
  std::uint64_t refused = 0;
  for (std::uint64_t n = 0; n < count; ++n) {
    auto damaged = bytes;
    for (std::uint64_t k = 1 + random.below(4); k > 0; --k)
      damaged[random.below(random.below(2) == 0 ? 600 : damaged.size())] = static_cast<std::byte>(random.below(256));
    std::string error;
    static_cast<void>(replay_any(scene, damaged, error));
    refused += error.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, count / 10);
  for (std::size_t n = 0; n < 200; ++n) {
    std::vector<std::byte> noise(1 + random.below(3000));
    for (std::byte& b : noise) b = static_cast<std::byte>(random.below(256));
    std::string error;
    EXPECT_EQ(replay_any(scene, noise, error).ticks, 0u);
  }
}

TEST(JournalReader, NamesAVersionThatItDoesNotRead) {
  auto bytes = short_journal(one_axis_scene());
  bytes[3] = std::byte{9};
  JournalReader reader;
  ASSERT_TRUE(reader.add(piece_of(bytes, 0)));
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.error(), "byte 0 of the inputs: version 9 of the journal; this program reads version 2");
}

}  // namespace
}  // namespace tandem::netsim
