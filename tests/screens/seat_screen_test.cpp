// The screen of a seat at every width.
#include "client/app/seat_screen.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tandem::client {
namespace {

SeatSetup setup(Role role = Role::kTrainee, const std::string& name = "trainee") {
  SeatSetup s;
  s.seat.name = name;
  s.seat.role = role;
  s.seat.tool = 0;
  s.gate.force_max = 4;
  return s;
}

ClientStatus running() {
  ClientStatus s;
  s.heard = true;
  s.session = wire::SessionState::kRunning;
  s.session_time = 123.4;
  s.gate = wire::GateState::kActive;
  s.alpha = 0.25;
  s.force_n = 1.2;
  s.distance_m = 0.012;
  s.touching = true;
  s.link.rtt_ms = 4.1;
  return s;
}

rpc::Status words(const std::string& leader = "trainer", const std::string& follower = "trainee") {
  rpc::Status w;
  w.name = "lab";
  w.seats = {{leader, AccessRole::kInstructor, true, true, true}, {follower, AccessRole::kTrainee, true, true, true}};
  w.tools = {{"tool", {0.75, 0.25}}};
  return w;
}

std::vector<std::string> at(std::size_t columns, const ClientStatus& s, const SeatSetup& of = setup(),
                            const std::optional<rpc::Status>& w = words()) {
  return io::lay_out_items(seat_screen(s, of, w), 2, columns - 1);
}

TEST(SeatScreen, FitsTheKeyValuesInTwoLinesOf80Columns) {
  const auto lines = at(80, running());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "trainee 123.4 s | trainer leads, you 25 % | force [###.......] 1.2 N");
  EXPECT_EQ(lines[1], "tool 12 mm away, touching | with trainer | force on | rtt 4.1 ms, loss 0.0 %");
}

/// The authority of the last FORCE says nothing about now.
TEST(SeatScreen, KnowsNoAuthorityWhileTheServerIsAway) {
  ClientStatus s = running();
  s.alpha = 1;
  s.gate = wire::GateState::kZero;
  EXPECT_NE(at(160, s)[0].find("you lead 100 %"), std::string::npos);
  const auto expect_unknown = [](const ClientStatus& now, const char* state) {
    const std::string text = at(160, now)[0] + at(160, now)[1];
    EXPECT_NE(text.find(state), std::string::npos) << text;
    EXPECT_NE(text.find("authority unknown"), std::string::npos) << text;
    EXPECT_EQ(text.find("lead"), std::string::npos) << text;
    EXPECT_NE(text.find("force off"), std::string::npos) << text;
  };
  s.silence_s = 19;
  expect_unknown(s, "SERVER SILENT for 19 s");
  s.reconnecting = true;
  expect_unknown(s, "SERVER SILENT for 19 s: reconnecting");
  s.silence_s = 0;
  s.closed = true;
  expect_unknown(s, "the server ended or gave the session away: reconnecting");
}

TEST(SeatScreen, ShowsTheDistanceToTheLeadersHandToFollowersOnly) {
  ClientStatus s = running();
  EXPECT_EQ(at(160, s)[1].find("leader's hand"), std::string::npos);
  s.offset_from_leader_m = 0.0032;
  EXPECT_NE(at(160, s)[1].find("| 3.2 mm beside the leader's hand |"), std::string::npos) << at(160, s)[1];
}

TEST(SeatScreen, ShowsTheLeaderAndThePresentSeats) {
  ClientStatus s = running();
  s.alpha = 0.8;
  rpc::Status w = words();
  w.tools[0].alpha = {0.2, 0.8};
  EXPECT_NE(at(80, s, setup(), w)[0].find("you lead 80 %"), std::string::npos);
  s.alpha = 0;
  EXPECT_NE(at(80, s)[0].find("trainer leads |"), std::string::npos);
  EXPECT_NE(at(80, s, setup(), std::nullopt)[0].find("you do not lead"), std::string::npos)
      << "the status names no leader";
  w.seats[0].heard = false;
  EXPECT_NE(at(80, s, setup(), w)[1].find("no partner here; SILENT: trainer"), std::string::npos)
      << at(80, s, setup(), w)[1];
  w.seats[0].taken = false;
  EXPECT_NE(at(80, s, setup(), w)[1].find("no partner here"), std::string::npos);
}

/// While all seats are released, no seat leads, independent of the authority after the resume. Every seat shows this.
TEST(SeatScreen, ShowsNoLeaderWhileStoppedPausedBrakedOrOverloaded) {
  using enum wire::SessionState;
  for (const wire::SessionState state : {kStopped, kPaused, kHeld, kOverloaded})
    for (const bool leader : {false, true}) {
      ClientStatus s = running();
      s.session = state;
      s.alpha = 0;  // as in FORCE at every seat
      const auto lines = leader ? at(120, s, setup(Role::kInstructor, "trainer")) : at(120, s);
      EXPECT_NE(lines[0].find("| no leader |"), std::string::npos) << lines[0];
      EXPECT_EQ(lines[0].find("you do not lead"), std::string::npos);
    }
}

/// The status contains the requested authority, FORCE the present own authority.
TEST(SeatScreen, ShowsTheSameLeaderAtEverySeatDuringATransfer) {
  rpc::Status w = words();
  w.tools[0].alpha = {0, 1};  // requested: all for the trainee
  const auto line = [&](double own, Role role, const std::string& name) {
    ClientStatus s = running();
    s.alpha = own;
    return at(120, s, setup(role, name), w)[0];
  };
  EXPECT_NE(line(0.7, Role::kInstructor, "trainer").find("| you lead 70 % |"), std::string::npos);
  EXPECT_NE(line(0.3, Role::kTrainee, "trainee").find("| you 30 %, not leading |"), std::string::npos)
      << line(0.3, Role::kTrainee, "trainee");
  EXPECT_NE(line(0.3, Role::kInstructor, "trainer").find("| trainee leads, you 30 % |"), std::string::npos);
  EXPECT_NE(line(0.7, Role::kTrainee, "trainee").find("| you lead 70 % |"), std::string::npos);
}

TEST(SeatScreen, DistinguishesForceOffFromForceNotYetOn) {
  ClientStatus s = running();
  s.gate = wire::GateState::kOff;
  EXPECT_EQ(gate_text(s), "force off");
  s.session_time = -1;
  EXPECT_EQ(gate_text(s), "no force before the session runs");
}

/// Only where the key has an effect: this seat may change authority, the seat that left had some, and no slave is
/// missing.
TEST(SeatScreen, NamesTheKeyThatTakesABrakedTool) {
  ClientStatus s = running();
  s.session = wire::SessionState::kHeld;
  SeatSetup trainer = setup(Role::kInstructor, "trainer");
  trainer.masters = {"trainer", "trainee"};
  trainer.driver_mask = 3;
  rpc::Status w = words();
  w.held = "trainee left";
  w.tools[0].alpha = {0, 1};
  w.seats[1].taken = w.seats[1].heard = false;
  const auto hint = [&] {
    return at(80, s, trainer, w)[0].find("BRAKED: trainee left; 1 takes the tool |") != std::string::npos;
  };
  EXPECT_TRUE(hint()) << at(80, s, trainer, w)[0];
  w.tools[0].alpha = {1, 0};
  EXPECT_FALSE(hint()) << "the tool is here already";
  w.tools[0].alpha = {0, 1};
  w.seats.push_back({"arm", AccessRole::kObserver, false, false, false});
  EXPECT_FALSE(hint()) << "without its slave no tool moves";
  w.seats.pop_back();
  trainer.driver_mask = 0;
  EXPECT_FALSE(hint()) << "this seat moves no authority";
  EXPECT_EQ(at(80, s, trainer, w)[0].find("trainer 123.4 s BRAKED: trainee left |"), 0u) << at(80, s, trainer, w)[0];
}

TEST(SeatScreen, ExplainsABrakedToolInOneSentence) {
  ClientStatus s = running();
  s.session = wire::SessionState::kHeld;
  rpc::Status w = words();
  w.held = "trainer left";
  EXPECT_EQ(at(80, s, setup(), w)[0].find("trainee 123.4 s BRAKED: trainer left |"), 0u) << at(80, s, setup(), w)[0];
  w.held = "stopped by trainer: key r there resumes";
  EXPECT_NE(at(80, s, setup(), w)[0].find("BRAKED: stopped by trainer: key r there resumes"), std::string::npos);
  s.local_stop = true;
  EXPECT_NE(at(80, s, setup(), w)[0].find("BRAKED: you stopped your hand: r resumes"), std::string::npos)
      << "the reason known to the client comes first";
}

TEST(SeatScreen, NamesTheAuthorOfAStopAndTheKey) {
  ClientStatus s = running();
  s.session = wire::SessionState::kStopped;
  rpc::Status w = words();
  w.stop = rpc::StatusStop{
      .number = 1, .seat = "trainer", .workstation = "", .role = AccessRole::kInstructor, .why = "", .ends = "x"};
  EXPECT_NE(at(80, s, setup(Role::kInstructor, "trainer"), w)[0].find("STOPPED by trainer: r resumes"),
            std::string::npos);
  EXPECT_NE(at(80, s, setup(), w)[0].find("STOPPED by trainer: an instructor or operator resumes"), std::string::npos)
      << at(80, s, setup(), w)[0];
  s.stops = 2;  // a newer stop, not yet in the status
  EXPECT_NE(at(80, s, setup(), w)[0].find("STOPPED: an instructor or operator resumes"), std::string::npos)
      << at(80, s, setup(), w)[0];
  w.stop->number = 2;
  s.session = wire::SessionState::kPaused;
  SeatSetup own = setup();
  own.may_end_pauses = true;
  EXPECT_NE(at(100, s, own, w)[0].find("PAUSED by trainer: r ends your own pause"), std::string::npos)
      << at(100, s, own, w)[0];
  s = running();
  s.local_stop = true;
  EXPECT_NE(at(80, s)[0].find("YOUR HAND IS STOPPED: r resumes"), std::string::npos);
}

TEST(SeatScreen, ShowsALatchedForceAndADrainBeforeTheNumbers) {
  ClientStatus s = running();
  s.gate = wire::GateState::kLatched;
  rpc::Status w = words();
  w.drain = rpc::StatusDrain{27, 1, 2};
  const auto lines = at(80, s, setup(), w);
  EXPECT_EQ(lines[0].find("trainee 123.4 s | DRAINING: 27 s left | FORCE LATCHED OFF: press b"), 0u) << lines[0];
  w.drain = rpc::StatusDrain{0, 1, 2};
  EXPECT_EQ(at(80, s, setup(), w)[0].find("DRAINING"), std::string::npos) << "there is nothing left to wait for";
  s.gate = wire::GateState::kActive;
  s.motors.hot = true;
  EXPECT_NE(at(80, s)[0].find("MOTORS TOO HOT"), std::string::npos);
}

/// Also while another seat leads and the tool does not follow.
TEST(SeatScreen, ShowsTheKeyboardPositionOfTheHand) {
  ClientStatus s = running();
  EXPECT_EQ(at(80, s)[1].find("keys"), std::string::npos) << "no keys move it";
  s.keys_m = {0, 0, 0};
  EXPECT_NE(at(80, s)[1].find("| keys: at the start |"), std::string::npos) << at(80, s)[1];
  s.keys_m = {0.015, 0, 0};
  EXPECT_NE(at(80, s)[1].find("| keys: 15 mm right |"), std::string::npos) << at(80, s)[1];
  s.keys_m = {-0.015, -0.005, 0.02};
  EXPECT_NE(at(120, s)[1].find("| keys: 15 mm left, 5 mm near, 20 mm up |"), std::string::npos) << at(120, s)[1];
}

TEST(SeatScreen, DrawsTheForceBarAsAShareOfTheLargestForce) {
  EXPECT_EQ(force_bar(0, 4), "[..........] 0.0 N");
  EXPECT_EQ(force_bar(2, 4), "[#####.....] 2.0 N");
  EXPECT_EQ(force_bar(9, 4), "[##########] 9.0 N");
  EXPECT_EQ(force_bar(1, 0), "[..........] 1.0 N");
}

/// Every part of a line is a complete item of the screen.
TEST(SeatScreen, CutsNoWordAtAnyWidthInAnyState) {
  const std::string longest(32, 'n');
  for (const std::string& name : {std::string("trainee"), longest}) {
    for (int state = 0; state <= static_cast<int>(wire::SessionState::kOverloaded); ++state) {
      for (int gate = 0; gate <= static_cast<int>(wire::GateState::kFault); ++gate) {
        ClientStatus s = running();
        s.session = static_cast<wire::SessionState>(state);
        s.gate = static_cast<wire::GateState>(gate);
        s.transfer.notice = wire::TransferNotice::kGaining;
        s.gate_trips = 3;
        s.reconnects = 1;
        rpc::Status w = words("trainer", name);
        w.held = "trainer left; " + longest + " is silent: its link is lost";
        w.stop = rpc::StatusStop{
            .number = 1, .seat = longest, .workstation = "", .role = AccessRole::kInstructor, .why = "", .ends = "x"};
        const auto items = seat_screen(s, setup(Role::kTrainee, name), w);
        for (const std::size_t columns : {40u, 60u, 80u, 100u, 120u, 200u}) {
          const auto lines = io::lay_out_items(items, 2, columns - 1);
          ASSERT_LE(lines.size(), 2u);
          for (const std::string& line : lines) {
            EXPECT_LT(io::display_width(line), columns) << line;
            for (std::size_t begin = 0; begin <= line.size();) {
              const std::size_t end = std::min(line.find(" | ", begin), line.size());
              std::string piece = line.substr(begin, end - begin);
              const bool cut = piece.ends_with(" ...");
              if (cut) piece.resize(piece.size() - 4);
              const bool known = std::ranges::any_of(items, [&](const io::ScreenItem& i) {
                const auto whole = [&](const std::string& text) {
                  return cut ? text.starts_with(piece + " ") : text == piece;
                };
                return whole(i.text) || whole(i.brief);
              });
              EXPECT_TRUE(known) << columns << ": " << piece;
              begin = end + 3;
            }
          }
          if (columns < 100) continue;
          const std::string all = io::join_items(items), shown = lines[0] + (lines.size() > 1 ? " | " + lines[1] : "");
          EXPECT_NE(shown.find("lead"), std::string::npos) << shown;
          EXPECT_NE(shown.find("force"), std::string::npos) << shown;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tandem::client
