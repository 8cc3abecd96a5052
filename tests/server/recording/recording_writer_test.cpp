#include "server/recording/recording_writer.h"

#include <gtest/gtest.h>

#include <set>

#include "common/mcap/mcap_repair.h"
#include "common/mcap/message_cursor.h"
#include "proto/recording/recording_format.h"
#include "tests/common/base/counts.h"
#include "tests/server/recording/recording_sample.h"

namespace tandem::server {
namespace {

using namespace server::test;
using tandem::test::seeds;

TEST(RecordingWriter, GivesEveryRecordBackBitForBit) {
  const std::uint64_t count = seeds(20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    const SceneSpec scene = shipped_scene(seed % 2 == 0 ? "contact" : "two_by_two");
    std::vector<TickRecord> records;
    std::uint32_t tick = static_cast<std::uint32_t>(random.below(5));
    for (int n = 0; n < 300; ++n, tick += 1 + (random.below(20) == 0 ? static_cast<std::uint32_t>(random.below(9)) : 0))
      records.push_back(any_record(scene, tick, random));
    records.front().running = true;
    const auto lesson = read_lesson(bytes_of(recording_of(scene, records)));
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_TRUE(lesson->complete);
    ASSERT_EQ(lesson->rows(), records.size());
    for (std::size_t row = 0; row < records.size(); ++row) {
      TickRecord read;
      fill_record(*lesson, row, read);
      ASSERT_TRUE(same_bits(read, records[row])) << "row " << row;
    }
  }
}

TEST(RecordingWriter, LetsAReaderLeaveOutSeats) {
  const SceneSpec scene = shipped_scene("contact");
  std::vector<TickRecord> records;
  for (std::uint32_t tick = 1; tick < 200; ++tick) records.push_back(smooth_record(scene, tick));
  const std::string file = recording_of(scene, records);
  const auto all = read_lesson(bytes_of(file)), part = read_lesson(bytes_of(file), LessonSeatSet{0b01});
  ASSERT_TRUE(all && part);
  EXPECT_TRUE(part->complete);
  EXPECT_EQ(part->tick, all->tick);
  EXPECT_TRUE(part->seats[0].x.empty() && part->seats[0].fresh.empty() && part->seats[0].sample_tick.empty());
  EXPECT_EQ(part->seats[1].x, all->seats[1].x);
  EXPECT_EQ(part->seats[1].fresh, all->seats[1].fresh);
  EXPECT_EQ(part->tools[0].x, all->tools[0].x);
}

TEST(RecordingWriter, StatesTheSession) {
  const SceneSpec scene = shipped_scene("contact");
  const auto lesson = read_lesson(bytes_of(recording_of(scene, {smooth_record(scene, 1)})));
  ASSERT_TRUE(lesson);
  EXPECT_EQ(lesson->session, "lesson 1");
  EXPECT_EQ(lesson->start_unix_ns, 1'700'000'000'000'000'000);
  EXPECT_EQ(lesson->metadata.at("seed"), "7");
  EXPECT_FALSE(lesson->metadata.at("version").empty());
  EXPECT_FALSE(lesson->metadata.at("commit").empty());
  EXPECT_NE(lesson->metadata.at("clock").find("monotonic"), std::string::npos);
  EXPECT_EQ(lesson->seats[0].person, "Ada");
  EXPECT_EQ(lesson->seats[1].person, "Bo");
  EXPECT_EQ(lesson->time_ns[0], 1'000'000);
}

TEST(RecordingWriter, StatesWhichNamesAreOfWorkstations) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingInfo info = sample_info(scene);
  info.persons = {"desk-1", ""};
  info.workstations = {true, false};
  const auto read = [&](const RecordingInfo& facts, const std::vector<bool>& later) {
    RecordingWriter writer(scene, facts);
    if (!later.empty()) writer.set_persons({"desk-1", "desk-1"}, later);
    TickRecord record = smooth_record(scene, 1);
    record.running = true;
    writer.add(record);
    writer.finish();
    const std::string bytes = writer.take();
    return read_lesson(bytes_of(bytes)).value();
  };
  Lesson lesson = read(info, {});
  EXPECT_TRUE(lesson.seats[0].workstation);
  EXPECT_FALSE(lesson.seats[1].workstation);
  lesson = read(info, {false, true});
  EXPECT_FALSE(lesson.seats[0].workstation) << "the last record is the present one";
  EXPECT_TRUE(lesson.seats[1].workstation);
  info.workstations = {};
  EXPECT_FALSE(read(info, {}).seats[0].workstation);
  info.persons = {"local", "Ada"};  // a file of before the record
  lesson = read(info, {});
  EXPECT_TRUE(lesson.seats[0].workstation) << "the workstation of all clients on loopback";
  EXPECT_FALSE(lesson.seats[1].workstation);
}

TEST(RecordingWriter, KeepsEveryParticipantOfASeat) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingInfo info = sample_info(scene);
  info.persons = {"", ""};
  RecordingWriter writer(scene, info);
  TickRecord record = smooth_record(scene, 1);
  record.running = true;
  writer.add(record);
  writer.set_persons({"ann", ""});
  writer.set_persons({"tim", "eva"});
  writer.finish();
  const std::string bytes = writer.take();
  const auto lesson = read_lesson(bytes_of(bytes));
  ASSERT_TRUE(lesson) << lesson.error();
  EXPECT_EQ(lesson->seats[0].person, "tim");
  EXPECT_EQ(lesson->seats[1].person, "eva");
  const auto reader = mcap::Reader::open(bytes_of(bytes));
  ASSERT_TRUE(reader);
  std::set<std::string> all;
  for (const mcap::Metadata& metadata : reader->metadata())
    if (metadata.name == rec::kParticipantsRecord)
      for (const auto& [seat, person] : metadata.values) all.insert(person);
  EXPECT_EQ(all, (std::set<std::string>{"", "ann", "eva", "tim"})) << "all of them are named for a deletion";
}

TEST(RecordingWriter, HoldsEveryShippedScene) {
  for (const EmbeddedFile& file : shipped_scenes()) {
    SCOPED_TRACE(std::string(file.name));
    const SceneSpec scene = shipped_scene(std::string(file.name));
    const auto lesson = read_lesson(bytes_of(recording_of(scene, {smooth_record(scene, 1)})));
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_EQ(effective_scene_text(lesson->scene), effective_scene_text(scene));
    EXPECT_EQ(lesson->scene.name, scene.name);
    EXPECT_EQ(lesson->seats.size(), scene.seats.size());
    EXPECT_EQ(lesson->tools.size(), scene.tools.size());
  }
}

TEST(RecordingWriter, HoldsEveryShippedSceneOfAShorterSession) {
  for (const EmbeddedFile& file : shipped_scenes()) {
    SCOPED_TRACE(std::string(file.name));
    SceneSpec scene = shipped_scene(std::string(file.name));
    scene.duration = 1.5;
    const auto lesson = read_lesson(bytes_of(recording_of(scene, {smooth_record(scene, 1)})));
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_EQ(lesson->scene.duration, 1.5);
    EXPECT_EQ(effective_scene_text(lesson->scene), effective_scene_text(scene));
  }
}

TEST(RecordingWriter, AccountsForEveryTickOfEveryChannel) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingWriter writer{scene, sample_info(scene)};
  TickRecord waiting = smooth_record(scene, 0);
  waiting.running = false;
  writer.add(waiting);  // before the session runs
  for (std::uint32_t tick = 1; tick <= 100; ++tick) {
    if (tick == 40) writer.count_dropped(3);
    if (tick >= 37 && tick < 40) continue;  // dropped by a queue
    if (tick >= 60 && tick < 65) continue;  // never recorded by the session
    TickRecord record = smooth_record(scene, tick);
    if (tick > 90) {  // seat 1 sends nothing any more
      record.seats[1] = smooth_record(scene, 90).seats[1];
    }
    writer.add(record);
    writer.add(record);  // the session clock stands still
  }
  writer.count_dropped(2);  // behind the last record
  writer.finish();
  const std::string file = writer.take();
  const auto lesson = read_lesson(bytes_of(file));
  ASSERT_TRUE(lesson);
  EXPECT_EQ(lesson->rows(), 92u);
  const auto check = [&](const std::string& topic, std::uint64_t recorded, std::uint64_t never) {
    SCOPED_TRACE(topic);
    const LessonCount& count = lesson->counts.at(topic);
    EXPECT_EQ(count.recorded, recorded);
    EXPECT_EQ(count.dropped, 5u);
    EXPECT_EQ(count.never_received, never);
    EXPECT_EQ(count.recorded + count.dropped + count.never_received, 102u);
  };
  check("/authority", 1, 96);  // it does not change
  check("/" + scene.seats[0].name, 92, 5);
  check("/" + scene.seats[1].name, 82, 15);
  check("/" + scene.tools[0].name, 92, 5);
  const auto reader = mcap::Reader::open(bytes_of(file));
  EXPECT_EQ(reader->metadata("counts")->at("ticks"), "102");
  EXPECT_EQ(reader->metadata("counts")->at("/" + scene.tools[0].name), "recorded 92 dropped 5 never_received 5");
  for (const mcap::Channel& channel : reader->channels()) {
    const auto count = lesson->counts.find(channel.topic);
    if (count == lesson->counts.end()) continue;
    EXPECT_EQ(reader->statistics()->channel_messages.at(channel.id), count->second.recorded) << channel.topic;
  }
  const LessonSeat& silent = lesson->seats[1];
  EXPECT_EQ(silent.fresh.back(), 0);
  EXPECT_EQ(silent.sample_tick.back(), 90u);
  EXPECT_EQ(silent.x.back(), (LessonTriple{0.09, 0, 0.1}));
  EXPECT_EQ(lesson->seats[0].fresh.back(), 1);
}

TEST(RecordingWriter, EndsAChunkEvery500Milliseconds) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingWriter writer{scene, sample_info(scene)};
  std::string file;
  for (std::uint32_t tick = 0; tick < 2000; ++tick) {
    writer.add(smooth_record(scene, tick));
    const std::string more = writer.take();
    if (tick > 0) {
      ASSERT_EQ(!more.empty(), tick % 500 == 0);
    }
    file += more;
    if (more.empty()) continue;
    const auto lesson = read_lesson(bytes_of(file));
    ASSERT_TRUE(lesson);
    ASSERT_EQ(lesson->rows(), tick) << "at most half a second is missing";
    ASSERT_FALSE(lesson->complete);
  }
}

TEST(RecordingWriter, BoundsAChunkWhileTheSessionClockStands) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingWriter writer{scene, sample_info(scene)};
  writer.add(smooth_record(scene, 1));
  RandomStream random{RandomKey{1}};
  std::string inputs(64 * 1024, '\0');
  for (char& c : inputs) c = static_cast<char>(random.bits());
  std::string file;
  for (std::uint64_t n = 0; n < 400; ++n) {
    const std::uint64_t position = n * (inputs.size() - sizeof n);
    std::memcpy(inputs.data(), &position, sizeof position);
    writer.add_inputs(bytes_of(inputs));
    file += writer.take();
  }
  writer.flush();
  const auto reader = mcap::Reader::open(bytes_of(file));
  EXPECT_GE(reader->parts().size(), 3u) << "chunks end by their size";
}

TEST(RecordingWriter, KeepsNotesWithTheirTimes) {
  const SceneSpec scene = shipped_scene("contact");
  RecordingWriter writer{scene, sample_info(scene)};
  writer.add_event(
      {.tick = 0, .time_ns = 5, .what = "join", .seat = scene.seats[0].name, .text = "joined", .person = "Ada"});
  writer.add(smooth_record(scene, 10));
  writer.add_mark({.t_s = 0.01, .by = "Ada", .text = "look"});
  writer.add_sheet({.sheet = "OSATS", .of = scene.seats[1].name, .by = "Eva", .scores = {{"flow", 4}}, .closed = true});
  LessonLink link;
  link.tick = 10;
  link.seat = 1;
  link.rtt_p50_ms = 40;
  writer.add_link(link);
  writer.finish();
  const auto lesson = read_lesson(bytes_of(writer.take()));
  ASSERT_TRUE(lesson);
  ASSERT_EQ(lesson->events.size(), 1u);
  EXPECT_EQ(lesson->events[0].what, "join");
  EXPECT_EQ(lesson->events[0].person, "Ada");
  EXPECT_EQ(lesson->events[0].time_ns, 5);
  ASSERT_EQ(lesson->marks.size(), 1u);
  EXPECT_EQ(lesson->marks[0].text, "look");
  ASSERT_EQ(lesson->sheets.size(), 1u);
  EXPECT_EQ(lesson->sheets[0].scores.at("flow"), 4);
  ASSERT_EQ(lesson->links.size(), 1u);
  EXPECT_EQ(lesson->links[0].seat, 1u);
  EXPECT_EQ(lesson->links[0].rtt_p50_ms, 40);
}

TEST(RecordingWriter, GivesTheSameBytesAgain) {
  const SceneSpec scene = shipped_scene("contact");
  std::vector<TickRecord> records;
  for (std::uint32_t tick = 0; tick < 600; ++tick) records.push_back(smooth_record(scene, tick));
  EXPECT_EQ(recording_of(scene, records), recording_of(scene, records));
}

}  // namespace
}  // namespace tandem::server
