// Persons named in tickets, in the file of a server that records already when they join. Real programs on loopback.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tandem::test
