// Real programs on a pseudo-terminal: two status lines in a fixed place, whole words, at every width and after a
// resize. The tests assert content, never durations.
#include "tests/support/terminal.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <regex>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// Widths for resizes in both directions, and below 80. A terminal that cuts lines needs fewer of them.
std::vector<std::size_t> widths(Terminal::Resize resize = Terminal::Resize::kReflows) {
  return resize == Terminal::Resize::kReflows ? std::vector<std::size_t>{80, 200, 100, 60, 120}
                                              : std::vector<std::size_t>{60, 120, 80};
}

std::vector<std::string> pieces(const std::string& line) {
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(" | ", begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    begin = end + 3;
  }
  return out;
}

/// True if `piece` is a complete item of a seat's screen.
bool is_whole(const std::string& piece) {
  static const std::vector<std::regex> kKnown{
      std::regex("(trainer|trainee) [0-9.]+ s( .*)?"),
      std::regex("(trainer|trainee) (engaging|waits for [0-9]+ seats?|waiting for the server|closed|ending).*"),
      std::regex("you lead [0-9]+ %|you do not lead|no leader|you [0-9]+ %, not leading|(trainer|trainee) leads(, you "
                 "[0-9]+ %)?"),
      std::regex("force (\\[[#.]{10}\\] )?[0-9.]+ N"),
      std::regex("tool [0-9]+ mm away(, touching)?"),
      std::regex("[0-9.]+ mm beside the leader's hand"),
      std::regex("with (trainer|trainee)|no partner here"),
      std::regex("force (on|off|rising)|no force before the session runs|force fades"),
      std::regex("rtt [0-9.]+ ms, loss [0-9.]+ %"),
      std::regex("(trips|reconnected|late ticks) [0-9]+"),
      std::regex("margin [-0-9]+ mJ"),
      std::regex("tip [-0-9]+ [-0-9]+ [-0-9]+ mm"),
      std::regex(
          "(more|less) authority(: done| under way| in [0-9]+ ms)|transfer .*|.* gives (more of )?the tool to .*")};
  return std::ranges::any_of(kKnown, [&](const std::regex& r) { return std::regex_match(piece, r); });
}

/// Returns the status rows of a screen, from the row that begins with the seat's name to the last one.
std::vector<std::string> status_of(const Terminal& t, const std::string& seat) {
  const auto rows = t.screen();
  const auto first = std::ranges::find_if(rows, [&](const std::string& row) { return row.starts_with(seat + " "); });
  return {first, rows.end()};
}

void expect_sound(TerminalProcess& p, const std::string& seat, std::size_t columns) {
  SCOPED_TRACE(std::to_string(columns) + " columns" + p.picture());
  const auto rows = status_of(p.terminal(), seat);
  ASSERT_EQ(rows.size(), 2u) << "two lines, nothing left over";
  for (const std::string& row : rows) {
    EXPECT_LT(row.size(), columns);
    for (const std::string& piece : pieces(row)) EXPECT_TRUE(is_whole(piece)) << piece;
  }
  EXPECT_TRUE(p.terminal().wraps().empty()) << "a line met the margin: " << p.terminal().wraps().front();
}

class Screens : public testing::TestWithParam<Terminal::Resize> {};

TEST_P(Screens, ShowTwoWholeSeatLinesAtEveryWidthAndResize) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer", {"--quiet"});
  TerminalProcess trainee({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainee", "--device", "sim"}, 80, 24,
                          GetParam());
  ASSERT_TRUE(trainee.wait_until([](const Terminal& t) {
    return flat(t.screen()).find("with trainer") != std::string::npos;
  })) << trainee.picture();
  ASSERT_TRUE(trainee.wait_until([](const Terminal& t) {
    return flat(t.screen()).find("force on") != std::string::npos;
  })) << trainee.picture();
  // The first lines, at 80 columns, are wrapped between words.
  EXPECT_NE(flat(trainee.terminal().all()).find("s stops your hand, S all hands (pause), r resumes"), std::string::npos)
      << trainee.picture();
  for (const std::size_t columns : widths(GetParam())) {
    trainee.resize(columns, 24);
    trainee.terminal().forget_wraps();
    const std::string wide = columns >= 200   ? "margin"
                             : columns >= 120 ? "rtt"
                                              : "";  // items that fit only at this width
    // The screen is drawn again at this width, so the force bar appears once more.
    trainee.watch(400ms);
    ASSERT_TRUE(trainee.wait_until([&](const Terminal& t) {
      const auto rows = status_of(t, "trainee");
      return rows.size() == 2 && rows[0].size() < columns && rows[1].size() < columns &&
             flat(rows).find("leads") != std::string::npos && flat(rows).find(wide) != std::string::npos;
    })) << columns
        << trainee.picture();
    expect_sound(trainee, "trainee", columns);
  }
  trainee.type("q");
  EXPECT_EQ(trainee.wait(), 0) << trainee.picture();
  EXPECT_TRUE(status_of(trainee.terminal(), "trainee").empty()) << "the status is gone in the end" << trainee.picture();
}

TEST_P(Screens, ShowTheWholeServerSessionAtEveryWidth) {
  TerminalProcess host({TANDEM_SERVER, "run", "free_motion", "--duration", "600"}, 80, 24, GetParam());
  ASSERT_TRUE(host.wait_until([](const Terminal& t) {
    return flat(t.screen()).find("waiting for trainer (not joined), trainee (not joined)") != std::string::npos;
  })) << host.picture();
  const std::string all = flat(host.terminal().all());
  const auto at = all.find("listening on ");
  ASSERT_NE(at, std::string::npos) << host.picture();
  const std::string address = all.substr(at + 13, all.find(' ', at + 13) - at - 13);
  std::string commands = all;  // a shell joins continued lines
  for (auto back = commands.find("\\ "); back != std::string::npos; back = commands.find("\\ "))
    commands.erase(back, 2);
  EXPECT_NE(commands.find("tandem-client join --server " + address + " --seat trainer --device sim"), std::string::npos)
      << host.picture();
  EXPECT_TRUE(host.terminal().wraps().empty()) << host.terminal().wraps().front();
  Process trainer = client(address, "trainer", {"--quiet"}), trainee = client(address, "trainee", {"--quiet"});
  ASSERT_TRUE(host.wait_until([](const Terminal& t) {
    return flat(t.screen()).find("trainer leads 100 %") != std::string::npos;
  })) << host.picture();
  for (const std::size_t columns : widths(GetParam())) {
    host.resize(columns, 24);
    host.terminal().forget_wraps();
    host.watch(400ms);
    // The screen is drawn once at this width, without remains of the previous one.
    ASSERT_TRUE(host.wait_until(
        [&](const Terminal& t) {
          const auto rows = t.screen();
          const auto count = [&](const auto& is) { return std::ranges::count_if(rows, is); };
          return t.wraps().empty() &&
                 count([](const std::string& row) { return row.find(" running | ") != std::string::npos; }) == 1 &&
                 count([](const std::string& row) {
                   return row.starts_with("trainer: ") && row.find("trainee: force on") != std::string::npos;
                 }) == 1 &&
                 count([](const std::string& row) { return row.find("trainee: force on") != std::string::npos; }) ==
                     1 &&
                 rows.back().starts_with("trainer: ") && rows.back().size() < columns;
        },
        10s))
        << columns << host.picture();
  }
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.picture();
}

// Text below which the status line was longer: a name with remains of that line behind it is another name.
TEST(ServerScreen, PrintsACreatedSessionWithoutRemainsOfTheStatusLine) {
  TerminalProcess host({TANDEM_SERVER, "run", "free_motion", "--duration", "600"}, 200, 60);
  ASSERT_TRUE(host.wait_for("waiting for trainer (not joined), trainee (not joined)")) << host.picture();
  const std::string all = flat(host.terminal().all());
  const auto at = all.find("listening on ");
  ASSERT_NE(at, std::string::npos) << host.picture();
  const std::string address = all.substr(at + 13, all.find(' ', at + 13) - at - 13);
  Process create({TANDEM_CLIENT, "control", "--server", address, "create", "m", "one_axis"});
  EXPECT_EQ(create.wait(), 0) << create.err();
  ASSERT_TRUE(host.wait_for("--session m")) << host.picture();
  host.watch(600ms);
  for (const std::string& row : host.terminal().all()) {
    const auto name = row.find(" --session ");
    if (name == std::string::npos || row.find("tandem-client join") == std::string::npos) continue;
    EXPECT_EQ(row.substr(name), " --session m") << host.picture();
  }
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.picture();
}

INSTANTIATE_TEST_SUITE_P(Terminals, Screens, testing::Values(Terminal::Resize::kReflows, Terminal::Resize::kCuts),
                         [](const auto& i) {
                           return i.param == Terminal::Resize::kReflows ? "ThatReflow" : "ThatCut";
                         });

TEST(Keys, ExplainWhyTheyHaveNoEffect) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer", {"--quiet"});
  TerminalProcess trainee({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainee", "--device", "sim"}, 100,
                          40);
  ASSERT_TRUE(trainee.wait_for("force on")) << trainee.picture();
  for (const auto& [key, why] : {std::pair{"r", "r: nothing is stopped, there is nothing to resume"},
                                 {"b", "b: nothing is latched off, there is nothing to clear"},
                                 {"0", "0: only an instructor moves authority"},
                                 {"x", "x: no such key. keys:"}}) {
    trainee.type(key);
    EXPECT_TRUE(trainee.wait_for(why)) << key << trainee.picture();
  }
  Process stop({TANDEM_CLIENT, "control", "--server", address, "stop"});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  ASSERT_TRUE(trainee.wait_for("STOPPED by local (console): an instructor or operator resumes")) << trainee.picture();
  trainee.type("r");
  EXPECT_TRUE(
      trainee.wait_for("r: you may not end this stop; it can be ended by: an instructor (key r) or an operator "
                       "(`tandem-client control --server " +
                       address))
      << trainee.picture();
  trainee.type("s");
  ASSERT_TRUE(trainee.wait_for("s stops")) << trainee.picture();
  trainee.watch(500ms);
  trainee.type("s");
  EXPECT_TRUE(trainee.wait_for("s: your hand is stopped already; r resumes")) << trainee.picture();
}

TEST(Announcements, ReachEverySeatForAResumeARemovalAndADrain) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  TerminalProcess trainer({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainer", "--device", "sim"}, 80, 30);
  Process trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  ASSERT_TRUE(trainer.wait_for("with trainee")) << trainer.picture();
  ASSERT_TRUE(trainee.wait_for("with trainer")) << trainee.err();
  trainer.type("S");
  ASSERT_TRUE(trainer.wait_for("STOPPED by trainer: r resumes")) << trainer.picture();
  ASSERT_TRUE(trainee.wait_for("STOPPED by trainer (instructor)")) << trainee.err();
  trainer.type("r");
  EXPECT_TRUE(trainer.wait_for("stop 1 is over: RESUMED by trainer (instructor); force returns over 0.5 s"))
      << trainer.picture();
  EXPECT_TRUE(trainee.wait_for("stop 1 is over: RESUMED by trainer (instructor); force returns over 0.5 s"))
      << trainee.err();
  Process remove({TANDEM_CLIENT, "control", "--server", address, "remove", "trainee", "pushes", "the", "others"});
  EXPECT_EQ(remove.wait(), 0) << remove.err();
  EXPECT_TRUE(
      trainer.wait_for("trainee is REMOVED by local (operator), the hand is released within 0.2 s: pushes the others"))
      << trainer.picture();
  EXPECT_EQ(trainee.wait(), 1);
  Process drain({TANDEM_CLIENT, "control", "--server", address, "drain", "2s"});
  EXPECT_TRUE(trainer.wait_for("the server DRAINS: all hands are released in 2 s; requested by local (operator)"))
      << trainer.picture();
  EXPECT_TRUE(trainer.wait_for("DRAINING: 1 s left")) << trainer.picture();
  EXPECT_EQ(drain.wait(), 0) << drain.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.picture();
  EXPECT_EQ(host.wait(), 0) << host.err();
}

/// A transfer requested during a stop acts only at the resume. The screen shows it at once, because otherwise the other
/// seat would lead without notice.
TEST(AuthorityTransfer, ShowsTransferRequestedDuringStopAndActsAtResume) {
  TerminalProcess trial({TANDEM_CLIENT, "try"}, 160, 40);
  ASSERT_TRUE(trial.wait_for("you hold the seat instructor")) << trial.picture();
  ASSERT_TRUE(trial.wait_for("force on")) << trial.picture();
  trial.type("S");
  ASSERT_TRUE(trial.wait_for("STOPPED by instructor: r resumes")) << trial.picture();
  EXPECT_EQ(flat(trial.terminal().all()).find("gives the tool"), std::string::npos)
      << "no participant requested a change" << trial.picture();
  trial.type("0");
  EXPECT_TRUE(trial.wait_for("instructor gives the tool to trainee (")) << trial.picture();
  EXPECT_TRUE(trial.wait_until([](const Terminal& t) {
    return flat(status_of(t, "instructor")).find("when the session resumes") != std::string::npos;
  })) << trial.picture();
  trial.type("r");
  EXPECT_TRUE(trial.wait_until([](const Terminal& t) {
    return flat(status_of(t, "instructor")).find("trainee leads") != std::string::npos;
  })) << trial.picture();
  trial.type("q");
  EXPECT_EQ(trial.wait(), 0) << trial.picture();
}

TEST(Braked, ShowsTheReasonAtTheRemainingSeat) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  TerminalProcess trainee({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainee", "--device", "sim"}, 80, 24);
  TerminalProcess trainer({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainer", "--device", "sim"}, 80, 24);
  ASSERT_TRUE(trainee.wait_for("force on")) << trainee.picture();
  ASSERT_TRUE(trainer.wait_for("force on")) << trainer.picture();
  trainer.type("s");
  ASSERT_TRUE(trainer.wait_for("BRAKED: you stopped your hand: r resumes")) << trainer.picture();
  ASSERT_TRUE(trainee.wait_for("BRAKED: stopped by trainer: key r there resumes")) << trainee.picture();
  trainer.type("r");
  ASSERT_TRUE(trainer.wait_until([](const Terminal& t) {
    return flat(status_of(t, "trainer")).find("resumes") == std::string::npos;
  })) << trainer.picture();
  trainer.type("q");
  EXPECT_EQ(trainer.wait(), 0) << trainer.picture();
  ASSERT_TRUE(trainee.wait_for("BRAKED: trainer left")) << trainee.picture();
}

TEST(Braked, NamesTheKeyToASeatThatMayMoveAuthority) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainee = client(address, "trainee");
  TerminalProcess trainer({TANDEM_CLIENT, "join", "--server", address, "--seat", "trainer", "--device", "sim"}, 80, 24);
  ASSERT_TRUE(trainer.wait_for("force on")) << trainer.picture();
  trainer.type("0");
  ASSERT_TRUE(trainer.wait_for("trainee leads")) << trainer.picture();
  trainee.signal(SIGINT);
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  ASSERT_TRUE(trainer.wait_for("BRAKED: trainee left; 1 takes the tool")) << trainer.picture();
  trainer.type("1");
  EXPECT_TRUE(trainer.wait_until([](const Terminal& t) {
    return flat(status_of(t, "trainer")).find("you lead 100 %") != std::string::npos;
  })) << "the key does what is said"
      << trainer.picture();
}

TEST(Proxy, ShowsWholeColumnsAtEveryWidth) {
  TerminalProcess proxy({TANDEM_NETSIM, "proxy", "--to", "127.0.0.1:9", "--listen", "127.0.0.1:0"}, 80, 24);
  ASSERT_TRUE(proxy.wait_for("(a command; `help`)")) << proxy.picture();
  for (const std::size_t columns : {200u, 60u, 80u}) {
    proxy.resize(columns, 24);
    proxy.terminal().forget_wraps();
    proxy.watch(600ms);
    ASSERT_TRUE(proxy.wait_until(
        [&](const Terminal& t) {
          const auto rows = t.screen();
          const auto heading =
              std::ranges::find_if(rows, [](const std::string& row) { return row.starts_with("  n address"); });
          return t.wraps().empty() && heading != rows.end() &&
                 (heading->find("flight") != std::string::npos) == (columns >= 80) &&
                 std::ranges::count_if(
                     rows, [](const std::string& row) { return row.find("0 clients") != std::string::npos; }) == 1;
        },
        10s))
        << columns << proxy.picture();
  }
  proxy.type("help\n");
  ASSERT_TRUE(proxy.wait_for("ends the proxy")) << proxy.picture();
  EXPECT_TRUE(proxy.terminal().wraps().empty()) << proxy.terminal().wraps().front();
  proxy.signal(SIGINT);
  EXPECT_EQ(proxy.wait(), 0) << proxy.picture();
}

}  // namespace
}  // namespace tandem::test
