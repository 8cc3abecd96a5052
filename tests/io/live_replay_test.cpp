// Recordings of real sessions as inputs: replayed bit for bit, played under other conditions, and as hands of a new
// one.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <thread>

#include "common/base/raw_bytes.h"
#include "proto/recording/lesson_reader.h"
#include "tests/common/base/counts.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// A program that has ended.
struct Ended {
  int code = 0;
  std::string out, err;
};
Ended ended(const std::string& program, Words words) {
  words.insert(words.begin(), program);
  Process process(std::move(words));
  const int code = process.wait().value_or(-1000);
  return {code, process.out(), process.err()};
}
Ended netsim(Words words) { return ended(TANDEM_NETSIM, std::move(words)); }
Ended control(const std::string& address, Words words) {
  words.insert(words.begin(), {"control", "--server", address});
  return ended(TANDEM_CLIENT, std::move(words));
}

/// A network that loses, delays, doubles and reorders datagrams, in front of a server.
Process lossy(const std::string& address, std::uint64_t seed) {
  Process proxy({TANDEM_NETSIM, "proxy", "--to", address, "--listen", "127.0.0.1:0", "--delay", "5", "--jitter", "3",
                 "--loss", "8", "--duplicate", "2", "--reorder", "2", "--seed", std::to_string(seed)});
  proxy.wait_for("listening on ");
  return proxy;
}

/// Expects that a recording replays equal. @return the result
Json expect_equal(const std::string& file) {
  const Ended replay = netsim({"replay", file, "--json", "-"});
  EXPECT_EQ(replay.code, 0) << replay.out << replay.err;
  Json result = Json::parse(replay.out, nullptr, false);
  if (result.is_discarded()) {
    ADD_FAILURE() << "no JSON: " << replay.out << replay.err;
    return Json::object();
  }
  EXPECT_EQ(result["equal"], true) << result;
  EXPECT_EQ(result["complete"], true) << result;
  return result;
}

Lesson lesson_in(const Folder& folder, const std::string& name) {
  const std::string bytes = folder.read(name);
  auto lesson = read_lesson(bytes_of(bytes));
  EXPECT_TRUE(lesson) << name << ": " << lesson.error();
  return lesson ? std::move(*lesson) : Lesson{};
}

std::size_t events_of(const Lesson& lesson, const std::string& what) {
  return static_cast<std::size_t>(std::ranges::count(lesson.events, what, &LessonEvent::what));
}

// Timing of a live server is not repeatable: each recording is another sequence of arrivals, which the replay must hit.
TEST(LiveReplay, GivesALiveSessionOverALossyNetworkBitForBit) {
  const std::size_t seeds = draws(3, 8, 20);
  std::uint64_t ticks = 0, datagrams = 0, outputs = 0;
  double lost = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Folder folder;
    const std::string scene = seed % 3 == 0 ? "seed_contact" : seed % 3 == 1 ? "contact" : "two_by_two";
    Process host = hosting(scene, {"--duration", "4", "--record", folder.file("a.mcap")});
    Process proxy = lossy(address_of(host), seed);
    std::vector<Process> clients;
    for (const std::string& seat : Words{"trainer", "trainee"}) clients.push_back(client(address_of(proxy), seat));
    EXPECT_TRUE(host.wait()) << host.err();
    for (Process& process : clients) EXPECT_TRUE(process.wait()) << process.err();
    const Json result = expect_equal(folder.file("a.mcap"));
    EXPECT_GT(result.value("rows", 0), 200);
    ticks += result.value("ticks", 0U);
    datagrams += result.value("datagrams", 0U);
    outputs += result.value("outputs", 0U);
    for (const LessonLink& link : lesson_in(folder, "a.mcap").links)
      if (std::isfinite(link.loss_up_percent)) lost = std::max(lost, link.loss_up_percent);
  }
  std::printf(
      "[  figures ] %zu of %zu live sessions bit for bit: %llu ticks, %llu datagrams, %llu outputs; loss %.1f %%\n",
      seeds, seeds, static_cast<unsigned long long>(ticks), static_cast<unsigned long long>(datagrams),
      static_cast<unsigned long long>(outputs), lost);
  EXPECT_GT(lost, 2.0) << "the network lost datagrams";
}

TEST(LiveReplay, GivesStopPauseHandoverAndARejoinedSeatBitForBit) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "8", "--record", folder.file("a.mcap")});
  const std::string address = address_of(host);
  Process proxy = lossy(address, 7);
  Process trainer = client(address_of(proxy), "trainer");
  {
    Process trainee = client(address_of(proxy), "trainee");
    ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
    std::this_thread::sleep_for(500ms);
    EXPECT_EQ(control(address, {"authority", "trainer=0.3,trainee=0.7"}).code, 0);
    EXPECT_EQ(control(address, {"stop", "look", "here"}).code, 0);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(control(address, {"resume"}).code, 0);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(control(address, {"--role", "evaluator", "pause"}).code, 0);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(control(address, {"resume"}).code, 0);
    trainee.signal(SIGINT);
    EXPECT_TRUE(trainee.wait()) << trainee.err();
  }
  Process again = client(address_of(proxy), "trainee");
  EXPECT_TRUE(again.wait_for("the session runs")) << again.err();
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  EXPECT_TRUE(again.wait()) << again.err();
  const Lesson lesson = lesson_in(folder, "a.mcap");
  for (const auto& [what, least] : std::map<std::string, std::size_t>{
           {"join", 3}, {"leave", 1}, {"authority", 1}, {"stop", 1}, {"pause", 1}, {"resume", 2}})
    EXPECT_GE(events_of(lesson, what), least) << what;
  const Json result = expect_equal(folder.file("a.mcap"));
  // Of a session with late ticks the server spares nine rows in ten: a slow computer must show the same with fewer.
  EXPECT_GT(result.value("rows", 0), 400);
}

// A session that waits, runs, waits for its participants again, and goes on: in several files, replayed together.
TEST(LiveReplay, GivesTheFilesOfALongSessionBitForBit) {
  const Folder folder, films, others;
  const std::string config = folder.write(
      "s.textproto", "version: 1 listen: \"127.0.0.1:0\"\nrecord: \"" + films.file("") +
                         "\" recording { file_minutes: 0.1 }\n"
                         "session { name: \"lab\" scene: \"free_motion\" duration_s: 15 restart: false }\n"
                         "session { name: \"unused\" scene: \"one_axis\" duration_s: 15 restart: false }\n");
  Process host({TANDEM_SERVER, "serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  std::this_thread::sleep_for(7s);  // it waits for longer than a file is
  Process proxy = lossy(address_of(host), 3);
  const std::string address = address_of(proxy);
  Process trainer = client(address, "trainer", {"--session", "lab"});
  {
    Process trainee = client(address, "trainee", {"--session", "lab"});
    ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
    std::this_thread::sleep_for(2s);
    trainee.signal(SIGINT);
    EXPECT_TRUE(trainee.wait()) << trainee.err();
  }
  Process again = client(address, "trainee", {"--session", "lab"});
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  EXPECT_TRUE(again.wait()) << again.err();
  host.signal(SIGINT);
  EXPECT_TRUE(host.wait()) << host.err();
  std::vector<std::string> files;
  std::uint64_t rows = 0;
  for (const auto& entry : std::filesystem::directory_iterator(films.file(""))) {
    files.push_back(entry.path().string());
    rows += lesson_in(films, entry.path().filename().string()).rows();
  }
  std::ranges::sort(files);
  ASSERT_GE(files.size(), 3u) << "15 s in files of 6 s";
  for (const std::string& file : files) EXPECT_NE(file.find("/lab-"), std::string::npos) << "never ran: " << file;
  Json result = expect_equal(files[2]);
  EXPECT_EQ(result["files"], files.size());
  EXPECT_EQ(result["rows"], rows);
  EXPECT_GT(rows, 800u) << "14000, if none are spared";
  expect_equal(films.file(""));
  Words words{"replay", "--json", "-"};
  words.insert(words.end(), files.rbegin(), files.rend());
  const Ended named = netsim(words);
  EXPECT_EQ(named.code, 0) << named.out << named.err;
  EXPECT_EQ(Json::parse(named.out)["rows"], rows);
  // Any file gives the scores of the whole session, and so does the folder.
  const auto scores = [](const std::string& what) {
    return Json::parse(netsim({"score", "--quiet", "--json", "-", what}).out);
  };
  const Json scored = scores(files[1]);
  ASSERT_EQ(scored["lessons"].size(), 1u);
  const Json& lesson = scored["lessons"][0];
  EXPECT_GE(lesson["end_s"].get<double>() - lesson["begin_s"].get<double>(), 13) << lesson.dump().substr(0, 300);
  EXPECT_NE(lesson["notes"].dump().find("The lesson has " + std::to_string(files.size()) + " files"), std::string::npos)
      << lesson["notes"];
  EXPECT_EQ(scores(films.file(""))["lessons"], scored["lessons"]);
  for (std::size_t missing = 0; missing < files.size(); ++missing) {
    SCOPED_TRACE(missing);
    std::filesystem::rename(files[missing], others.file("away.mcap"));
    const Ended part = netsim({"replay", files[missing == 0 ? 1 : 0]});
    std::filesystem::rename(others.file("away.mcap"), files[missing]);
    EXPECT_EQ(part.code, 2) << part.out;
    const auto listed = part.err.find("part ");
    EXPECT_NE(listed, std::string::npos) << part.err;
    EXPECT_NE(part.err.find(" of the recording is missing"), std::string::npos) << part.err;
  }
  std::filesystem::copy_file(files[0], films.file("copy.mcap"));
  const Ended copied = netsim({"replay", files[1]});
  EXPECT_EQ(copied.code, 2);
  EXPECT_NE(copied.err.find("are both part "), std::string::npos) << copied.err;
  EXPECT_EQ(netsim({"replay", others.file("")}).code, 2) << "an empty folder";
  EXPECT_EQ(netsim({"replay", files[0], files[1], "--what-if", "delay=10"}).code, 2) << "one file is played";
}

TEST(LiveReplay, PlaysAWhatIfWithASeatThatWasNeverTaken) {
  const Folder folder;
  Process host = hosting("eight_seats", {"--duration", "4", "--record", folder.file("a.mcap")});
  Process trainee = client(address_of(host), "trainee"), evaluator = client(address_of(host), "evaluator3");
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainee.wait()) << trainee.err();
  EXPECT_TRUE(evaluator.wait()) << evaluator.err();
  const Ended played = netsim({"replay", folder.file("a.mcap"), "--what-if", "delay=20", "--json", "-"});
  ASSERT_EQ(played.code, 0) << played.err;
  const Json numbers = Json::parse(played.out)["numbers"];
  EXPECT_TRUE(numbers["leader_tool_rms_m"]["played"].is_number()) << numbers;
  expect_equal(folder.file("a.mcap"));
  const Ended none = netsim({"run", "eight_seats", "--hand", "trainee=" + folder.file("a.mcap") + ",seat=evaluator1"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("no participant took seat evaluator1; the recording has the hands: trainee evaluator3"),
            std::string::npos)
      << none.err;
}

// A recorder outside of the server has values only. The list names the begin of the recording, not of its session.
TEST(LiveReplay, SaysWhyARecordingHasNoInputs) {
  const Folder folder, films;
  Process host = hosting("one_axis", {"--duration", "5", "--record", films.file(""), "--record-on-order"});
  const std::string address = address_of(host);
  Process recorder({TANDEM_CLIENT, "record", "--server", address, "--out", folder.file("out.mcap"), "--quiet"});
  Process trainer = client(address, "trainer");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(1500ms);
  EXPECT_EQ(control(address, {"record", "start"}).code, 0);
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  EXPECT_TRUE(recorder.wait()) << recorder.err();
  const Ended list = ended(TANDEM_SERVER, {"recordings", "list", "--dir", films.file(""), "--json"});
  ASSERT_EQ(list.code, 0) << list.err;
  const Json rows = Json::parse(list.out);
  ASSERT_EQ(rows.size(), 1u) << rows;
  const std::string name = rows[0]["file"];
  const Lesson lesson = lesson_in(films, name);
  ASSERT_GT(lesson.tick.front(), 1000u);
  EXPECT_EQ(rows[0]["start_unix_ns"], lesson.start_unix_ns + lesson.time_ns.front())
      << "begin of the recording, not of its session";
  Ended replay = netsim({"replay", films.file(name)});
  EXPECT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(netsim({"score", films.file(name)}).code, 0);
  EXPECT_EQ(netsim({"replay", films.file(name), "--what-if", "delay=10"}).code, 0);
  replay = netsim({"replay", folder.file("out.mcap")});
  EXPECT_EQ(replay.code, 2);
  EXPECT_NE(replay.err.find("`tandem-client record` receives values"), std::string::npos) << replay.err;
}

TEST(LiveReplay, PutsMainScoresIntoTheReportOfTheServer) {
  const Folder folder;
  Process host = hosting(
      "one_axis", {"--duration", "6", "--record", folder.file("a.mcap"), "--scores", "--json", folder.file("a.json")});
  Process trainer = client(address_of(host), "trainer");
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  EXPECT_NE(host.out().find("Path length [mm]"), std::string::npos) << host.out() << host.err();
  const Json report = folder.json("a.json");
  EXPECT_TRUE(report.contains("seats")) << "the report is whole";
  const Ended scored = netsim({"score", folder.file("a.mcap"), "--json", "-", "--quiet"});
  ASSERT_EQ(scored.code, 0) << scored.err;
  const Json whole = Json::parse(scored.out)["lessons"][0]["seats"][0]["parts"][0];
  const Json part = report["scores"]["seats"][0]["parts"][0];
  const Json path = part["metrics"]["path_length"];
  if (part["quality"]["missing_share"] > 0.1) {  // limit of scores: of late ticks the server spares rows
    EXPECT_EQ(path["trust"], "withheld") << path;
    std::printf("[ NOT RUN  ] LiveReplay, a path in the report: this computer is too slow for whole recordings\n");
  } else {
    EXPECT_GT(path["value"], 0.05);
  }
  for (const auto& [key, metric] : part["metrics"].items()) EXPECT_EQ(metric, whole["metrics"][key]) << key;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.json.new")));
  for (const Words& wrong : {Words{"--scores"}, Words{"--scores", "--record", folder.file("")},
                             Words{"--scores", "--record", folder.file("b.mcap"), "--json", "-"}}) {
    Words words{"run", "one_axis"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    const Ended refused = ended(TANDEM_SERVER, words);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find("--scores"), std::string::npos) << refused.err;
  }
}

// A leave at the end is no fault: no score is flagged for it.
TEST(LiveReplay, ScoresALeaveWithoutAFlag) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "5", "--record", folder.file("a.mcap")});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(3s);
  trainee.signal(SIGINT);
  EXPECT_TRUE(trainee.wait()) << trainee.err();
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  const Lesson lesson = lesson_in(folder, "a.mcap");
  std::uint32_t losses = 0;
  for (const LessonLink& link : lesson.links) losses = std::max(losses, link.gate_trips);
  EXPECT_GT(std::ranges::count(lesson.seats[1].gate, std::uint8_t{4}), 0) << "the gate released the hand";
  const Ended scored = netsim({"score", folder.file("a.mcap"), "--json", "-", "--quiet"});
  ASSERT_EQ(scored.code, 0) << scored.err;
  const Json scores = Json::parse(scored.out);
  for (const Json& seat : scores["lessons"][0]["seats"])
    EXPECT_LE(seat["parts"][0]["quality"]["gate_trips"], losses) << seat["seat"];
}

// The hand's intention is the recorded tip, and the hand has a mass and a spring of 1000 N/m: it follows within 2 mm.
TEST(LiveReplay, ARecordedHandFollowsItsPathInANewLiveSession) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "6", "--record", folder.file("a.mcap")});
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  EXPECT_TRUE(host.wait()) << host.err();
  EXPECT_TRUE(trainer.wait()) << trainer.err();
  EXPECT_TRUE(trainee.wait()) << trainee.err();

  Process next = hosting("free_motion", {"--duration", "6", "--record", folder.file("b.mcap")});
  const std::string hand = "sim:motion=" + folder.file("a.mcap") + ",seat=trainer";
  Process leader = client(address_of(next), "trainer", {}, hand);
  Process other = client(address_of(next), "trainee", {}, "sim:hand=relaxed");
  EXPECT_TRUE(next.wait()) << next.err();
  EXPECT_EQ(leader.wait(), 0) << leader.err();
  EXPECT_TRUE(other.wait()) << other.err();

  const Lesson before = lesson_in(folder, "a.mcap"), now = lesson_in(folder, "b.mcap");
  std::map<std::uint32_t, std::size_t> rows;
  for (std::size_t k = 0; k < before.rows(); ++k) rows[before.seats[0].sample_tick[k]] = k;
  double sum = 0, worst = 0, reach = 0;
  std::size_t n = 0;
  for (std::size_t k = 0; k < now.rows(); ++k) {
    const auto at = rows.find(now.seats[0].sample_tick[k]);
    if (at == rows.end() || now.tick[k] < 2000) continue;  // hands are engaged, and have settled
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = now.seats[0].x[k][a] - before.seats[0].x[at->second][a];
      square += d * d;
      reach = std::max(reach, std::abs(before.seats[0].x[at->second][a]));
    }
    sum += square;
    worst = std::max(worst, std::sqrt(square));
    ++n;
  }
  ASSERT_GT(n, 0u);
  if (n < 200) GTEST_SKIP() << "too few rows are in both recordings: this computer is too slow for whole ones";
  const double rms = std::sqrt(sum / static_cast<double>(n));
  std::printf(
      "[  figures ] recorded hand in a new session beside its recording: RMS %.2f mm, worst %.2f mm, path of %.0f mm\n",
      1e3 * rms, 1e3 * worst, 1e3 * reach);
  EXPECT_GT(reach, 0.03);
  EXPECT_LT(rms, 2e-3);
  EXPECT_LT(worst, 5e-3);
}

TEST(LiveReplay, RejectsAHandThatTheRecordingHasNot) {
  const Folder folder;
  const Ended made = netsim({"run", "contact", "--duration", "2", "--quiet", "--record", folder.file("a.mcap")});
  ASSERT_LE(made.code, 1) << made.err;
  const auto refusal = [&](const std::string& device) {
    Process refused = client("127.0.0.1:1", "trainer", {}, device);
    EXPECT_EQ(refused.wait(), 2) << device << refused.err();
    return refused.err();
  };
  const std::string a = "sim:motion=" + folder.file("a.mcap");
  std::string words = refusal(a + ",seat=nurse");
  EXPECT_NE(
      words.find(folder.file("a.mcap") + ": seat=nurse: the recording has no hand nurse; it has: trainer trainee"),
      std::string::npos)
      << words;
  words = refusal(a + ",scale=2");
  EXPECT_NE(words.find("scale=2: a recording (" + folder.file("a.mcap") + ") takes seat=NAME only"), std::string::npos)
      << words;
  words = refusal("sim:motion=" + folder.write("a.csv", "t_s[s],x[m],y[m],z[m]\n0,0,0,0\n1,0,0,0\n") + ",seat=trainer");
  EXPECT_NE(words.find("seat=trainer: belongs to a recording (motion=FILE.mcap)"), std::string::npos) << words;
  words = refusal("sim:motion=" + folder.file("absent.mcap"));
  EXPECT_NE(words.find("absent.mcap"), std::string::npos) << words;
  words = refusal("sim:motion=" + folder.write("text.mcap", "no recording"));
  EXPECT_NE(words.find("text.mcap: "), std::string::npos) << words;
}

}  // namespace
}  // namespace tandem::test
