// Recordings of whole sessions: their size, and that reading gives back what the session recorded.
#include <gtest/gtest.h>

#include <cstdio>

#include "common/transport/datagram.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_codec.h"
#include "tests/server/recording/recording_sample.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using namespace server::test;

/// Largest size with inputs at 1 kHz, over 20 s. In two_by_two every seat has a tool of its own to record; in guidance
/// both hands move all the time.
struct SizeLimit {
  const char* scene;
  double bytes_per_seat_minute;
};
constexpr SizeLimit kSizeLimits[] = {
    {"lesson", 8e6}, {"eight_seats", 8e6}, {"contact", 8.5e6}, {"two_by_two", 11e6}, {"guidance", 14e6}};

/// Plaintexts of the newest datagram of every seat. They are the inputs of the session if no datagram is lost.
std::string inputs_of(const Session& session, const std::vector<wire::Codec>& codecs, std::uint32_t tick) {
  std::string inputs;
  RandomStream random{RandomKey{tick}};
  for (std::size_t i = 0; i < codecs.size(); ++i) {
    std::array<std::byte, transport::kDatagramMax> plaintext{};
    const wire::Preamble preamble{tick, static_cast<std::uint32_t>(random.below(1000)), tick};
    const std::size_t size = codecs[i].encode(preamble, session.seat(i).last_state(), plaintext);
    inputs += text_of(std::span{plaintext}.first(size));
  }
  return inputs;
}

/// A session, recorded as a server does it: values of the newest datagrams.
struct Recorded {
  std::string file;
  std::vector<TickRecord> records;
  double seat_minutes = 0;
};

Recorded record_session(const SceneSpec& scene, double delay_ms) {
  Recorded out;
  RecordingWriter writer{scene, sample_info(scene)};
  std::vector<wire::Codec> codecs;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) codecs.emplace_back(body_layout(seat_setup(scene, i)));
  std::uint32_t ticks = 0;
  const auto run = tandem::test::run(scene, tandem::test::delayed(delay_ms), 1, [&](netsim::Simulation& simulation) {
    const TickRecord& record = simulation.session().record();
    writer.add(record);
    const std::string inputs = inputs_of(simulation.session(), codecs, ++ticks);
    writer.add_inputs(record.tick, bytes_of(inputs));
    out.file += writer.take();
    if (out.records.empty() ? record.running : record.tick > out.records.back().tick) out.records.push_back(record);
  });
  EXPECT_EQ(run.trouble, "");
  writer.finish();
  out.file += writer.take();
  out.seat_minutes =
      static_cast<double>(out.records.size()) / scene.tick_hz / 60 * static_cast<double>(scene.seats.size());
  return out;
}

TEST(RecordingSession, GivesBackWhatTheServerRecorded) {
  SceneSpec scene = tandem::test::shipped("two_by_two");
  scene.duration = 5;
  const Recorded recorded = record_session(scene, 20);
  const auto lesson = read_lesson(bytes_of(recorded.file));
  ASSERT_TRUE(lesson) << lesson.error();
  ASSERT_EQ(lesson->rows(), recorded.records.size());
  for (std::size_t row = 0; row < lesson->rows(); ++row) {
    TickRecord read;
    fill_record(*lesson, row, read);
    ASSERT_TRUE(same_bits(read, recorded.records[row])) << "row " << row;
  }
}

TEST(RecordingSession, StatesTheAuthorityOfEveryMasterAndTheVelocityOfEverySeat) {
  SceneSpec scene = tandem::test::shipped("contact");
  scene.duration = 5;
  const auto lesson = read_lesson(bytes_of(record_session(scene, 0).file));
  ASSERT_TRUE(lesson);
  double fastest = 0, error = 0;
  for (std::size_t row = 1; row < lesson->rows(); ++row) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.masters(); ++i) sum += lesson->tools[0].alpha[row][i];
    if (lesson->tools[0].held[row] == 0) error = std::max(error, std::abs(sum - 1));
    EXPECT_GT(lesson->time_ns[row], lesson->time_ns[row - 1]);
    fastest = std::max(fastest, std::abs(lesson->seats[0].v[row][0]));
  }
  EXPECT_LT(error, 1e-9);
  EXPECT_GT(fastest, 0.005);
  EXPECT_LT(fastest, 5);
}

TEST(RecordingSession, TakesNoMoreThanTheStatedMegabytesPerSeatAndMinute) {
  for (const auto& [name, limit] : kSizeLimits) {
    SceneSpec scene = tandem::test::shipped(name);
    scene.duration = 20;
    const Recorded recorded = record_session(scene, 20);
    const double size = static_cast<double>(recorded.file.size()) / recorded.seat_minutes;
    std::printf("[  size    ] %s: %.2f MB per seat and minute (%zu seats, %zu tools)\n", name, size / 1e6,
                scene.seats.size(), scene.tools.size());
    EXPECT_LE(size, limit) << name;
  }
}

}  // namespace
}  // namespace tandem::server
