// What people type after `tandem-client control`, and what they read.
#include "client/app/control_words.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using Words = std::vector<std::string>;

std::string problem(const Words& words) {
  const auto wish = understand(words);
  return wish ? "" : wish.error();
}

control::Status lesson() {
  control::Status s;
  s.session_id[0] = std::byte{0xab};
  s.name = "lesson";
  s.phase = control::SessionPhase::kStopped;
  s.stops = 3;
  s.authority_version = 7;
  s.time_s = 12.34;
  s.seats = {{"trainer", AccessRole::kInstructor, true, true, true}, {"trainee", AccessRole::kTrainee, true, false, true}, {"arm", AccessRole::kObserver, false, false, false}};
  s.tools = {{"drill", {0.25, 0.75}}};
  s.stop = {3, control::StopKind::kStop, "", "desk", AccessRole::kOperator, "fire drill", 2.5, "an operator", true};
  return s;
}

TEST(ControlWords, EveryOrderIsUnderstood) {
  EXPECT_EQ(understand(Words{"status"})->what, Wish::What::kStatus);
  EXPECT_EQ(understand(Words{"stop", "in", "the", "way"})->why, "in the way");
  EXPECT_EQ(understand(Words{"pause"})->what, Wish::What::kPause);
  EXPECT_EQ(understand(Words{"pause", "my", "hand"})->why, "my hand");
  EXPECT_FALSE(understand(Words{"resume"})->stop);
  EXPECT_EQ(understand(Words{"resume", "4"})->stop, 4U);
  const auto authority = understand(Words{"authority", "a=0.25,b=0.75", "version=3", "tool=drill"});
  ASSERT_TRUE(authority) << authority.error();
  EXPECT_EQ(authority->weights, (std::vector<std::pair<std::string, double>>{{"a", 0.25}, {"b", 0.75}}));
  EXPECT_EQ(authority->version, 3U);
  EXPECT_EQ(authority->tool, "drill");
  EXPECT_EQ(understand(Words{"remove", "trainee", "rude"})->seat, "trainee");
  EXPECT_EQ(understand(Words{"remove", "trainee", "rude"})->why, "rude");
  EXPECT_EQ(understand(Words{"drain"})->grace_s, 0U);
  EXPECT_EQ(understand(Words{"drain", "3600"})->grace_s, 3600U);
  EXPECT_EQ(understand(Words{"quit"})->what, Wish::What::kQuit);
}

TEST(ControlWords, MistakesSayWhatShouldBe) {
  for (const Words& words : {Words{}, {""}, {"halt"}, {"Stop"}, {"status", "now"}, {"resume", "0"}, {"resume", "-1"}, {"resume", "1", "2"}, {"resume", "4294967296"},
                             {"authority"}, {"authority", "a"}, {"authority", "=1"}, {"authority", "a=0.5"}, {"authority", "a=0.5,b=0.6"}, {"authority", "a=nan"},
                             {"authority", "a=-0.5,b=1.5"}, {"authority", "a=0.5,a=0.5"}, {"authority", "a=1,"  "b"}, {"authority", "a=1", "tools=x"}, {"authority", "a=1", "tool="},
                             {"authority", "a=1", "version=x"}, {"remove"}, {"drain", "3601"}, {"drain", "soon"}, {"drain", "1", "2"}, {"stop", std::string(481, 'x')}})
    EXPECT_FALSE(problem(words).empty()) << testing::PrintToString(words);
  EXPECT_NE(problem({"authority", "a=0.5,b=0.6"}).find("together 1.1; they must be 1"), std::string::npos);
}

TEST(ControlWords, TheLeastRoleIsAskedFor) {
  for (const auto what : {Wish::What::kStatus, Wish::What::kStop, Wish::What::kPause, Wish::What::kResume, Wish::What::kRemove, Wish::What::kDrain})
    EXPECT_EQ(role_for(what), AccessRole::kOperator);
  EXPECT_EQ(role_for(Wish::What::kAuthority), AccessRole::kInstructor);
}

TEST(ControlWords, WeightsAreSetAgainstWhatIsSeen) {
  const control::Status now = lesson();
  const auto frame = authority_frame(*understand(Words{"authority", "trainee=1"}), now);
  ASSERT_TRUE(frame) << frame.error();
  EXPECT_EQ(*frame, (control::SetAuthority{now.session_id, 0, 7, {0, 1}})) << "in the order of the seats, who is not named gets nothing";
  EXPECT_EQ(authority_frame(*understand(Words{"authority", "trainee=1", "version=5", "tool=drill"}), now)->version, 5U);
  EXPECT_NE(authority_frame(*understand(Words{"authority", "nobody=1"}), now).error().find("seats: trainer, trainee"), std::string::npos);
  EXPECT_FALSE(authority_frame(*understand(Words{"authority", "arm=1"}), now)) << "leads nothing";
  EXPECT_NE(authority_frame(*understand(Words{"authority", "trainer=1", "tool=saw"}), now).error().find("tools: drill"), std::string::npos);
  control::Status two = now;
  two.tools.push_back({"saw", {1, 0}});
  EXPECT_NE(authority_frame(*understand(Words{"authority", "trainer=1"}), two).error().find("which tool"), std::string::npos);
  EXPECT_EQ(authority_frame(*understand(Words{"authority", "trainer=1", "tool=saw"}), two)->tool, 1U);
}

TEST(ControlWords, AStatusIsReadByPeopleAndMachines) {
  EXPECT_EQ(status_text(lesson()),
            "lesson: stopped, 12.3 s; `resume 3` ends it; authority version 7\n"
            "  STOPPED by desk (operator at a console): fire drill. Who may end it: an operator. You may\n"
            "  seat trainer          instructor here\n"
            "  seat trainee          trainee    SILENT\n"
            "  seat arm              observer   free\n"
            "  tool drill            trainer 0.25, trainee 0.75\n");
  EXPECT_EQ(status_json(lesson()),
            "{\"session\": \"lesson\", \"id\": \"ab000000000000000000000000000000\", \"phase\": \"stopped\", \"time_s\": 12.340, \"stops\": 3, \"authority_version\": 7, "
            "\"draining\": false, \"shed\": 0, \"seats\": [{\"name\": \"trainer\", \"role\": \"instructor\", \"taken\": true, \"heard\": true}, {\"name\": \"trainee\", \"role\": \"trainee\", "
            "\"taken\": true, \"heard\": false}, {\"name\": \"arm\", \"role\": \"observer\", \"taken\": false, \"heard\": false}], \"tools\": [{\"name\": \"drill\", "
            "\"alpha\": {\"trainer\": 0.25, \"trainee\": 0.75}}], \"stop\": {\"number\": 3, \"kind\": \"stop\", \"seat\": \"\", \"workstation\": \"desk\", \"role\": \"operator\", "
            "\"why\": \"fire drill\", \"ago_s\": 2.500, \"ends\": \"an operator\", \"yours\": true}, \"drain\": null, \"held\": null}\n");
}

TEST(ControlWords, NewsAreToldOnceAndOnlyThoseSinceTheFirstLook) {
  control::Status first = lesson();
  first.news = {{1, "stop 2 is over: RESUMED by trainer"}};
  EXPECT_EQ(news_text(control::Status{}, first).find("RESUMED"), std::string::npos) << "of the time before";
  control::Status next = first;
  next.phase = control::SessionPhase::kRunning;
  next.news.push_back({2, "stop 3 is over: RESUMED by desk; force returns over 0.5 s"});
  next.news.push_back({3, "trainee is REMOVED by desk\x1b[2J"});
  EXPECT_EQ(news_text(first, next), "stop 3 is over: RESUMED by desk; force returns over 0.5 s\ntrainee is REMOVED by desk\\x1b[2J\n");
  EXPECT_EQ(news_text(next, next), "");
  control::Status nameless = next;
  nameless.news = first.news;
  EXPECT_EQ(news_text(first, nameless), "stop 3 is over: the session is running\n") << "a server that does not know by whom";
  next.held = "trainer left";
  EXPECT_NE(status_text(next).find("HELD: trainer left"), std::string::npos);
}

// What somebody typed at another console, or a server that is no friend sent, steers no terminal and stands for nothing else.
TEST(ControlWords, WordsOfOthersAreShownAndNothingMore) {
  control::Status s = lesson();
  s.stop->why = "\x1b[2Jgone\r\n\x07 \xe2\x80\xae" "evil \xc2\x9b \xff \xc3\xa4";
  EXPECT_EQ(stop_text(s), "STOPPED by desk (operator at a console): \\x1b[2Jgone\\x0d\\x0a\\x07 \\u202eevil \\u009b \\xff \xc3\xa4. Who may end it: an operator. You may");
  s.stop->why = std::string(600, 'x');
  EXPECT_NE(stop_text(s).find(std::string(480, 'x') + ".... Who"), std::string::npos) << stop_text(s);
  s.stop->why = "a \"b\" \\";
  EXPECT_NE(status_json(s).find("\"why\": \"a \\\"b\\\" \\\\\""), std::string::npos) << status_json(s);
  s.stop->kind = control::StopKind::kFault;
  s.stop->workstation = s.stop->why = "";
  s.stop->yours = false;
  EXPECT_EQ(stop_text(s), "STOPPED by the session itself: its numbers could not be trusted. Who may end it: an operator");
}

TEST(ControlWords, AnEndResumesNothing) {
  control::Status before = lesson(), now = lesson();
  now.phase = control::SessionPhase::kEnding;
  EXPECT_EQ(news_text(before, now), "");
}

/// A server that is ended at once has no seconds left to announce: its farewell says it.
TEST(ControlWords, ADrainWithoutTimeIsNoNews) {
  control::Status before = lesson(), now = lesson();
  now.drain = control::StatusDrain{0, 1, 1};
  EXPECT_EQ(news_text(before, now), "");
  now.drain = control::StatusDrain{3, 1, 1};
  EXPECT_EQ(news_text(before, now), "DRAINING: 3 s left, 1 session, 1 person on a seat\n");
}

TEST(ControlWords, NewsAreToldOnce) {
  control::Status before = lesson(), now = lesson();
  EXPECT_EQ(news_text(before, now), "");
  now.stops = now.stop->number = 4;
  EXPECT_EQ(news_text(before, now), stop_text(now) + "\n");
  EXPECT_EQ(news_text({}, before), stop_text(before) + "\n") << "somebody who comes while it is stopped reads it too";
  control::Status over = now;
  over.phase = control::SessionPhase::kRunning;
  EXPECT_EQ(news_text(now, over), "stop 4 is over: the session is running\n");
  now = before = over;
  std::string told;
  for (std::uint32_t left = 33; left-- > 0; before = now) {
    now.drain = {left, 2, 3};
    told += news_text(before, now);
  }
  EXPECT_EQ(told,
            "DRAINING: 32 s left, 2 sessions, 3 people on their seats\nDRAINING: 29 s left, 2 sessions, 3 people on their seats\n"
            "DRAINING: 19 s left, 2 sessions, 3 people on their seats\nDRAINING: 9 s left, 2 sessions, 3 people on their seats\n"
            "DRAINING: 5 s left, 2 sessions, 3 people on their seats\nDRAINING: 4 s left, 2 sessions, 3 people on their seats\n"
            "DRAINING: 3 s left, 2 sessions, 3 people on their seats\nDRAINING: 2 s left, 2 sessions, 3 people on their seats\n"
            "DRAINING: 1 s left, 2 sessions, 3 people on their seats\nDRAINING: 0 s left, 2 sessions, 3 people on their seats\n");
}

}  // namespace
}  // namespace tandem::client
