// Recordings of whole sessions: their size, and that reading gives back what the session recorded.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/netsim/replay/recorded_file.h"
#include "tests/server/recording/recording_sample.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using namespace server::test;

/// Largest size with inputs at 1 kHz, over the first 20 s, in which the hands move most. Asked: 8 MB. In the last two
/// scenes all hands move all the time, with noise in every digit. The last one sends numbers in double precision, which
/// inputs repeat bit for bit.
struct SizeLimit {
  const char* scene;
  double bytes_per_seat_minute;
};
constexpr double kAsked = 8e6;
constexpr SizeLimit kSizeLimits[] = {
    {"eight_seats", kAsked},   {"lesson", kAsked},         {"contact", kAsked},        {"cooperative_slave", kAsked},
    {"evaluation", kAsked},    {"two_by_two", kAsked},     {"guidance", kAsked},       {"eight_evaluators", kAsked},
    {"demonstration", kAsked}, {"seven_trainees", kAsked}, {"devices", kAsked},        {"one_axis", kAsked},
    {"seed_contact", kAsked},  {"free_motion", kAsked},    {"seed_free_motion", 8.9e6}};

/// A session, recorded as a server does it: values of the newest datagrams.
struct Recorded {
  std::string file;
  std::vector<TickRecord> records;
  double seat_minutes = 0;
};

Recorded record_session(const SceneSpec& scene, double delay_ms) {
  Recorded out;
  RecordingWriter writer{scene, sample_info(scene)};
  const auto run = tandem::test::run(scene, tandem::test::delayed(delay_ms), 1, [&](netsim::Simulation& simulation) {
    const TickRecord& record = simulation.session().record();
    writer.add(record);
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
    netsim::SimulationConfig setup;
    setup.scene = tandem::test::shipped(name);
    setup.scene.duration = 20;
    setup.network = netsim::link_from(tandem::test::delayed(20));
    const std::string file = netsim::test::record_file(setup, 25);
    const auto lesson = read_lesson(bytes_of(file));
    ASSERT_TRUE(lesson && lesson->rows() > 19'000) << name;
    const auto seats = static_cast<double>(setup.scene.seats.size());
    const double minutes = static_cast<double>(lesson->rows()) / setup.scene.tick_hz / 60;
    const double size = static_cast<double>(file.size()) / minutes / seats;
    std::printf("[  size    ] %s: %.2f MB per seat and minute (%zu seats, %zu tools)\n", name, size / 1e6,
                setup.scene.seats.size(), setup.scene.tools.size());
    EXPECT_LE(size, limit) << name;
  }
}

}  // namespace
}  // namespace tandem::server
