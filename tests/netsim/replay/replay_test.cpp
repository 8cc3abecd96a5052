// A replay finds the first difference with its tick and channel, and judges nothing that the journal does not have.
#include <gtest/gtest.h>

#include <cstring>

#include "netsim/replay/session_replay.h"
#include "netsim/system/simulation.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/seat_setup.h"
#include "tests/netsim/replay/recorded_session.h"

namespace tandem::netsim {
namespace {

using test::RecordedSession;

SceneSpec shipped(const std::string& name) { return *parse_scene(find_shipped_scene(name)->text, name + ".textproto"); }

/// Runs a scene for some seconds and records it. @return records of all ticks, as numbers
std::vector<std::vector<double>> record(const SimulationConfig& config, double seconds, RecordedSession& recorded) {
  SimulationConfig setup = config;
  setup.journal = &recorded.journal;
  const auto simulation = *Simulation::make(setup);
  std::vector<std::vector<double>> rows;
  const Time end = simulation->now() + from_seconds(seconds);
  while (simulation->now() < end && simulation->step()) {
    recorded.take(simulation->session());
    RecordValues::read(setup.scene, simulation->session().record(), rows.emplace_back());
  }
  return rows;
}

/// Replays with the records themselves, to name the channel of a difference.
std::optional<ReplayDifference> first_difference(const SceneSpec& scene, const RecordedSession& recorded,
                                                 const std::vector<std::vector<double>>& rows,
                                                 const std::function<void(JournalEvent&)>& change) {
  const RecordValues values{scene};
  SessionReplay replay{scene};
  std::size_t row = 0;
  replay.compare = [&](const server::Session& session) {
    std::vector<double> replayed;
    RecordValues::read(scene, session.record(), replayed);
    return values.difference(rows[row++], replayed);
  };
  JournalReader reader;
  for (const auto& piece : recorded.pieces) EXPECT_TRUE(reader.add(piece)) << reader.error();
  while (auto event = reader.next()) {
    change(*event);
    if (!replay.apply(*event)) break;
  }
  EXPECT_EQ(replay.error(), "");
  return replay.difference();
}

TEST(SessionReplay, OfACalmSessionIsEqual) {
  for (const std::string name : {"contact", "eight_seats", "cooperative_slave", "contact_remote"}) {
    SCOPED_TRACE(name);
    const SceneSpec scene = shipped(name);
    RecordedSession recorded;
    const auto rows = record({.scene = scene}, 2, recorded);
    const auto outcome = recorded.replay(scene);
    EXPECT_EQ(outcome.words(), "");
    EXPECT_EQ(outcome.compared, rows.size());
    EXPECT_EQ(outcome.counts.ticks, rows.size());
    EXPECT_EQ(first_difference(scene, recorded, rows, [](JournalEvent&) {}), std::nullopt);
  }
}

// A bit of the trainer's position as the coupling gets it moves the tool in this tick; one of the position in telemetry
// shows in the record of the seat.
TEST(SessionReplay, FindsOneFlippedBitWithItsTickAndChannel) {
  const SceneSpec scene = shipped("contact");
  const wire::BodyLayout layout = body_layout(seat_setup(scene, 0));
  const std::size_t position = wire::kPreambleSize + 2 + 1;  // behind tag and length of the field
  const std::size_t tip = wire::telemetry_body(layout) - wire::detail::packed(layout.axes, 4) - 2 - 1;  // from the end
  RecordedSession recorded;
  const auto rows = record({.scene = scene}, 2, recorded);
  for (const std::uint64_t at : {300u, 1000u, 1500u})
    for (const bool telemetry : {false, true}) {
      SCOPED_TRACE(at);
      std::uint64_t ticks = 0;
      bool flipped = false;
      std::vector<std::byte> changed;
      const auto difference = first_difference(scene, recorded, rows, [&](JournalEvent& event) {
        if (std::holds_alternative<JournalTick>(event)) ++ticks;
        auto* const datagram = std::get_if<JournalDatagram>(&event);
        if (flipped || ticks < at || datagram == nullptr || datagram->seat != 0 ||
            datagram->plaintext.size() != wire::state_size(layout, true))
          return;
        flipped = true;
        changed.assign(datagram->plaintext.begin(), datagram->plaintext.end());
        changed[telemetry ? changed.size() - tip : position] ^= std::byte{1};
        datagram->plaintext = changed;
      });
      ASSERT_TRUE(flipped);
      ASSERT_TRUE(difference);
      EXPECT_EQ(difference->tick, at);
      EXPECT_EQ(difference->channel, telemetry ? "/trainer/measured_cp" : "/tool/measured_cp");
      EXPECT_NE(difference->recorded, difference->replayed);
    }
}

TEST(SessionReplay, FindsAChangedGainInTheTickInWhichItActs) {
  const SceneSpec scene = shipped("contact");
  RecordedSession recorded;
  const auto rows = record({.scene = scene}, 2, recorded);
  SceneSpec other = scene;
  other.coupling.k_c = 300;
  const auto difference = first_difference(other, recorded, rows, [](JournalEvent&) {});
  ASSERT_TRUE(difference);
  EXPECT_GT(difference->session_tick + difference->tick, 0u);
  EXPECT_FALSE(difference->channel.empty());
  SessionReplay replay{other};
  JournalReader reader;
  ASSERT_TRUE(reader.add(recorded.pieces.front()));
  ASSERT_TRUE(replay.apply(*reader.next()));
  EXPECT_FALSE(replay.same_scene());
}

TEST(SessionReplay, NamesAnotherBuild) {
  const SceneSpec scene = shipped("one_axis");
  SessionReplay replay{scene};
  JournalBegin begin;
  begin.build = "0.1 of yesterday";
  begin.scene = server::scene_hash(scene);
  begin.scale.fill(1);
  ASSERT_TRUE(replay.apply(begin));
  EXPECT_EQ(replay.other_builds(), std::vector<std::string>{"0.1 of yesterday"});
  EXPECT_TRUE(replay.same_scene());
}

TEST(SessionReplay, EndsWhereTheJournalLostRecords) {
  const SceneSpec scene = shipped("one_axis");
  RecordedSession whole;
  const auto rows = record({.scene = scene}, 1, whole);
  RecordedSession slow{20'000};
  SimulationConfig setup{.scene = scene, .journal = &slow.journal};
  const auto simulation = *Simulation::make(setup);
  std::vector<std::vector<double>> undisturbed;
  for (int n = 0; n < 1000 && simulation->step(); ++n) {
    if (n == 800) slow.drain();  // much too late
    RecordValues::read(scene, simulation->session().record(), undisturbed.emplace_back());
  }
  slow.drain();
  EXPECT_GT(slow.journal.dropped(), 100u);
  EXPECT_EQ(undisturbed, rows) << "the session noticed the slow reader";
  const auto outcome = slow.replay(scene);
  EXPECT_FALSE(outcome.difference);
  EXPECT_EQ(outcome.error, "the recording lost inputs after " + std::to_string(outcome.counts.ticks) +
                               " ticks: nothing behind them can be replayed");
  EXPECT_GT(outcome.counts.ticks, 20u);
  EXPECT_LT(outcome.counts.ticks, 800u);
}

TEST(SessionReplay, RefusesSurfacesThatTheJournalDoesNotHave) {
  const SceneSpec scene = shipped("contact");
  SessionReplay replay{scene};
  JournalBegin begin;
  begin.scale.fill(1);
  ASSERT_TRUE(replay.apply(begin));
  EXPECT_FALSE(replay.apply(JournalContacts{0}));
  EXPECT_NE(replay.error().find("tool 1"), std::string::npos) << replay.error();
}

}  // namespace
}  // namespace tandem::netsim
