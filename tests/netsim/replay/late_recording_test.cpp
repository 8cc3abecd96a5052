// A recording that begins in the midst of its session replays bit for bit from the session's begin, in virtual time:
// random sessions with faults, begins at random ticks, one file or several.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/raw_bytes.h"
#include "netsim/replay/recording_replay.h"
#include "netsim/system/swarm.h"
#include "proto/recording/recording_format.h"
#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/recording/kept_inputs.h"
#include "server/recording/recording_writer.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/replay/recorded_session.h"

namespace tandem::netsim {
namespace {

using server::KeptInputs;

/// Keeps the inputs of a simulated session as a server does, and records it from some tick on.
class LateRecorder {
 public:
  /// @param begin  tick of the server at which the recording begins
  /// @param parts  ticks of the server after which the next file begins; 0: one file
  LateRecorder(const SceneSpec& scene, std::uint64_t begin, std::uint64_t parts, bool round)
      : scene_(&scene), begin_(begin), parts_(parts) {
    info_.session = "lesson";
    info_.scene_text = scene_file_text(scene);
    info_.metadata = {{"session_id", "5"}, {"epoch", "1"}, {rec::kRecordingKey, "lesson"}};
    info_.round_tools = round;
  }
  [[nodiscard]] server::InputJournal& journal() { return inputs_->journal(); }
  [[nodiscard]] const KeptInputs& inputs() const { return *inputs_; }

  /// Call it after every tick.
  void take(const server::Session& session) {
    if (++ticks_ == begin_) {
      auto reader = inputs_->read();
      ASSERT_TRUE(reader) << reader.error();
      reader_ = std::move(*reader);
      late_ = reader_->late();
      begin_file();
    }
    if (ticks_ % 10 == 0) inputs_->drain();
    static_cast<void>(inputs_->keep(blocks_));
    if (!writer_) {
      // The replay compares a tick when it is first there. In a live session no tick is repeated.
      if (session.recorded() && session.record().running)
        last_row_ = std::max(last_row_.value_or(0), session.record().tick);
      return;
    }
    if (parts_ > 0 && fed_ && (ticks_ - begin_) % parts_ == parts_ - 1) {
      end_file(false);
      begin_file();
    }
    if (session.recorded()) add_row(session.record());
    if (rows_ && ticks_ % 20 == 0) add_inputs();
    files_.back() += writer_->take();
  }
  [[nodiscard]] std::vector<std::string> finish() {
    while (writer_ && add_inputs()) {
    }
    if (writer_) end_file(true);
    return files_;
  }
  [[nodiscard]] bool late() const { return late_; }
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  [[nodiscard]] std::size_t blocks() const { return read_; }
  [[nodiscard]] std::uint64_t repeated() const { return repeated_; }

 private:
  void begin_file() {
    info_.metadata[rec::kPartKey] = std::to_string(files_.size() + 1);
    writer_ = std::make_unique<server::RecordingWriter>(*scene_, info_);
    files_.emplace_back();
  }
  void end_file(bool last) {
    writer_->finish(last);
    files_.back() += writer_->take();
  }
  /// As RecordingFiles: no file has a tick that is in a file before. A restarted server repeats ticks.
  void add_row(const server::TickRecord& record) {
    if (last_row_ && record.tick <= *last_row_) {
      repeated_ += record.tick < *last_row_ ? 1 : 0;
      return;
    }
    writer_->add(record);
    rows_ = rows_ || writer_->has_content();
    if (rows_) last_row_ = record.tick;
  }
  bool add_inputs() {
    const KeptInputs::Reader::Item item = reader_->next();
    EXPECT_NE(item.kind, KeptInputs::Reader::Kind::kLost) << item.bytes;
    fed_ = fed_ || item.kind != KeptInputs::Reader::Kind::kNothing;
    if (item.kind == KeptInputs::Reader::Kind::kPiece) writer_->add_inputs(bytes_of(item.bytes));
    if (item.kind != KeptInputs::Reader::Kind::kBlock) return false;
    writer_->add_input_block(item.bytes);
    ++read_;
    return true;
  }

  const SceneSpec* scene_;
  std::uint64_t begin_, parts_;
  server::RecordingInfo info_;
  std::shared_ptr<KeptInputs> inputs_ =
      KeptInputs::make(std::make_unique<server::InputJournal>(test::kAddressKey),
                       std::filesystem::temp_directory_path().string(), std::uint64_t{1} << 30U);
  server::KeptBlockWriter blocks_;
  std::unique_ptr<KeptInputs::Reader> reader_;
  std::unique_ptr<server::RecordingWriter> writer_;
  std::vector<std::string> files_;
  std::optional<std::uint32_t> last_row_;  ///< session tick
  std::uint64_t ticks_ = 0, repeated_ = 0;
  std::size_t read_ = 0;
  bool rows_ = false, fed_ = false, late_ = false;
};

std::string problem_of(const RecordingReplay& replay) {
  if (const auto& d = replay.difference)
    return "tick " + std::to_string(d->session_tick) + ", " + d->channel + ": recorded " + d->recorded + ", replayed " +
           d->replayed;
  return replay.error;
}

RecordingReplay replay_all(const std::vector<std::string>& files) {
  RecordingReplayer replayer;
  for (const std::string& file : files) {
    const auto added = replayer.add(bytes_of(file));
    EXPECT_TRUE(added) << added.error();
  }
  return replayer.finish();
}

TEST(LateRecording, ReplaysRandomSessionsBitForBitFromAnyTickOn) {
  const std::uint64_t count = tandem::test::seeds(8);
  std::uint64_t equal = 0, rows = 0, unseen = 0, blocks = 0, recorded = 0, spooled = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SwarmCase which = generate_swarm_case(seed, 20, seed % 2 == 0 ? LawKind::kReplica : LawKind::kSetPosition);
    const bool restarts = std::ranges::any_of(
        which.setup.faults, [](const Fault& fault) { return fault.kind == Fault::Kind::kServerRestart; });
    RandomStream random{RandomKey{seed}};
    // A restart repeats ticks of the checkpoint; the digest of their chunk is then of another choice of rows.
    const auto second = static_cast<std::uint64_t>(which.setup.scene.tick_hz);
    // A session whose hands make no ordinary motion ends soon after its fault phase, which lasts at least a second.
    const auto faulty = static_cast<std::uint64_t>(seconds(which.recovery_start) * static_cast<double>(second));
    const std::uint64_t begin = std::min(second / 5 + random.below(3 * second / 2), faulty - second / 4);
    LateRecorder recorder{which.setup.scene, begin, seed % 3 == 0 ? 1500 : 0U, !restarts};
    which.setup.journal = &recorder.journal();
    static_cast<void>(run_swarm_case(which, [&](Simulation& simulation) { recorder.take(simulation.session()); }));
    EXPECT_EQ(recorder.journal().dropped(), 0u);
    const auto files = recorder.finish();
    ASSERT_FALSE(files.empty()) << "it ended after " << recorder.ticks() << " ticks at " << second << " Hz";
    const RecordingReplay replay = replay_all(files);
    EXPECT_EQ(problem_of(replay), "");
    EXPECT_TRUE(replay.equal() && replay.complete);
    equal += replay.equal() ? 1 : 0;
    rows += replay.rows;
    unseen += replay.unseen;
    blocks += recorder.blocks();
    recorded += recorder.late() ? 1 : 0;
    spooled += recorder.inputs().spooled();
  }
  std::printf(
      "[  figures ] %llu of %llu recordings that began later are equal: %llu rows compared, %llu ticks unseen before "
      "them; %llu blocks from spools of %llu bytes\n",
      static_cast<unsigned long long>(equal), static_cast<unsigned long long>(count),
      static_cast<unsigned long long>(rows), static_cast<unsigned long long>(unseen),
      static_cast<unsigned long long>(blocks), static_cast<unsigned long long>(spooled));
  EXPECT_EQ(recorded, count);
  EXPECT_GT(blocks, count);
  EXPECT_GT(unseen, 200 * count);
}

// A file has 20 ticks, so that several of them begin while a restarted server repeats ticks of its checkpoint.
TEST(LateRecording, ReplaysFilesThatBeginAtRepeatedTicks) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("contact")->text, "contact.textproto");
  LateRecorder recorder{scene, 1000, 20, false};
  SimulationConfig setup{
      .scene = scene,
      .faults = {{Fault::Kind::kServerRestart, "", std::chrono::milliseconds(2190), std::chrono::milliseconds(300)}},
      .journal = &recorder.journal()};
  const auto simulation = *Simulation::make(setup);
  for (int k = 0; k < 5000 && simulation->step(); ++k) recorder.take(simulation->session());
  const auto files = recorder.finish();
  EXPECT_GT(recorder.repeated(), 40u);
  EXPECT_GT(files.size(), 100u);
  const RecordingReplay replay = replay_all(files);
  EXPECT_EQ(problem_of(replay), "");
  EXPECT_TRUE(replay.equal() && replay.complete);
  EXPECT_GT(replay.rows, 2000u);
}

// The rows before the first one cannot predict inputs, so they take more bytes; the recorded rows are the same.
TEST(LateRecording, HasTheRowsOfARecordingFromTheBegin) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("contact")->text, "contact.textproto");
  std::vector<std::size_t> sizes;
  std::vector<std::uint64_t> sums;
  for (const std::uint64_t begin : {std::uint64_t{1}, std::uint64_t{4001}}) {
    LateRecorder recorder{scene, begin, 0, true};
    SimulationConfig setup{.scene = scene, .journal = &recorder.journal()};
    const auto simulation = *Simulation::make(setup);
    for (int k = 0; k < 8000 && simulation->step(); ++k) recorder.take(simulation->session());
    const auto files = recorder.finish();
    ASSERT_EQ(files.size(), 1u);
    const RecordingReplay replay = replay_all(files);
    EXPECT_EQ(problem_of(replay), "");
    EXPECT_EQ(replay.counts.ticks, 8000u);
    // Every tick of the session has a row or precedes the first one.
    sums.push_back(replay.rows + replay.unseen);
    EXPECT_EQ(replay.unseen > 0, begin > 1) << replay.unseen;
    EXPECT_EQ(recorder.late(), begin > 1);
    sizes.push_back(files[0].size());
  }
  EXPECT_EQ(sums[0], sums[1]);
  std::printf(
      "[  figures ] 8 s of contact recorded from the begin: %zu bytes; its last 4 s with all inputs: %zu bytes\n",
      sizes[0], sizes[1]);
}

}  // namespace
}  // namespace tandem::netsim
