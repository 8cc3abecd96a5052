// Persons named in tickets, in the file of a server that records already when they join. Real programs on loopback.
#include <gtest/gtest.h>

#include <map>

#include "tests/io/multi_client_fixture.h"
#include "tests/io/recording_samples.h"

namespace tandem::test {
namespace {

std::string seat_ticket(const MultiClientFixture& fixture, const std::string& seat, const std::string& person) {
  Process made = server({"ticket", "--session", "lab", "--seat", seat, "--person", person, "--workstation", "desk",
                         "--state", fixture.state});
  EXPECT_EQ(made.wait(), 0) << made.err();
  return first_line(made.out());
}

TEST(LiveRecording, NamesAPersonThatJoinsWhileItRuns) {
  MultiClientFixture fixture{
      "session { name: \"lab\" scene: \"lesson\" duration_s: 6 restart: false record: \"a.mcap\" }"};
  const auto join = [&](const std::string& seat, const std::string& person) {
    return fixture.join(seat, {"--ticket", seat_ticket(fixture, seat, person)});
  };
  Process instructor = join("instructor", "ada"), trainee = join("trainee", "bob");
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << fixture.host.err();
  Process evaluator = join("evaluator1", "eve");  // the session needs no evaluator to run
  for (Process* person : {&instructor, &trainee, &evaluator}) EXPECT_EQ(person->wait(), 0) << person->err();
  EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
  const auto lesson = server::test::lesson_of(fixture.folder.read("a.mcap"));
  ASSERT_TRUE(lesson) << lesson.error() << fixture.host.err();
  std::vector<std::string> persons;
  for (const LessonSeat& seat : lesson->seats) persons.push_back(seat.person);
  EXPECT_EQ(persons, (std::vector<std::string>{"ada", "bob", "eve", "", ""}));
}

TEST(LiveRecording, NamesThePersonOfAnOrderAtAConsole) {
  MultiClientFixture fixture{
      "session { name: \"lab\" scene: \"one_axis\" duration_s: 4 restart: false record: \"a.mcap\" }"};
  Process made = server({"ticket", "--session", "lab", "--role", "operator", "--person", "olga", "--workstation",
                         "desk", "--state", fixture.state});
  ASSERT_EQ(made.wait(), 0) << made.err();
  Process trainer = fixture.join("trainer", {"--ticket", seat_ticket(fixture, "trainer", "ann")});
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << fixture.host.err();
  Process console({TANDEM_CLIENT, "control", "--server", fixture.address, "--state", fixture.own, "--ticket",
                   first_line(made.out()), "pause"});
  EXPECT_EQ(console.wait(), 0) << console.err();
  Process again = server({"ticket", "--session", "lab", "--role", "operator", "--person", "olga", "--workstation",
                          "desk", "--state", fixture.state});
  ASSERT_EQ(again.wait(), 0) << again.err();
  Process resume({TANDEM_CLIENT, "control", "--server", fixture.address, "--state", fixture.own, "--ticket",
                  first_line(again.out()), "resume"});
  EXPECT_EQ(resume.wait(), 0) << resume.err();
  static_cast<void>(trainer.wait());
  EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
  const auto lesson = server::test::lesson_of(fixture.folder.read("a.mcap"));
  ASSERT_TRUE(lesson) << lesson.error() << fixture.host.err();
  std::map<std::string, std::string> persons;
  for (const LessonEvent& event : lesson->events) persons[event.what] = event.person;
  EXPECT_EQ(persons.at("pause"), "olga");
  EXPECT_EQ(persons.at("resume"), "olga");
  EXPECT_EQ(persons.at("join"), "") << "of a seat, whose person the file names elsewhere";
}

}  // namespace
}  // namespace tandem::test
