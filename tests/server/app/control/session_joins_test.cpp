// Joins of seats, consoles and link tests, from the request to the Welcome or its error.
#include "server/app/control/session_joins.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "server/policy/shard_plan.h"
#include "tests/server/app/control/joining.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

/// Clients that come at once are not measured yet. The limit is one and a half times what a client is expected to take.
TEST(SessionJoins, RejectTheClientThatWouldPassTheLimitTogetherWithTheNewestOnes) {
  Joining j;
  const std::array codes{kCode, "ABCDE12346", "ABCDE12347"};
  for (const unsigned id : {2U, 3U}) j.add("lesson" + std::to_string(id), id, codes[id - 1]);
  j.serve();
  SessionJoins joins{j.registry, j.commands, j.keys, LoadLimits{1.5 * expected_seat_cost(j.scene.tick_hz)}};
  std::vector<std::optional<JoinReply>> replies;
  for (const char* code : codes) {
    JoinRequest request = Joining::request("trainee", rpc::CodeCredential{code});
    request.hello.session = std::string(code);
    const std::size_t n = replies.size();
    replies.emplace_back();
    joins.admit(request, [&replies, n](JoinReply decided) { replies[n] = std::move(decided); });
  }
  j.wait_until([&] { return std::ranges::all_of(replies, [](const auto& r) { return r.has_value(); }); });
  const auto welcomed = [](const auto& r) { return std::holds_alternative<rpc::Welcome>(*r); };
  EXPECT_LE(std::ranges::count_if(replies, welcomed), 2) << "all three have asked before the first was admitted";
  for (const auto& reply : replies) {
    if (welcomed(reply)) continue;
    EXPECT_EQ(error_of(*reply).code, ErrorCode::kFull);
    EXPECT_NE(error_of(*reply).text.find("rejects new joins"), std::string::npos) << error_of(*reply).text;
  }
}

/// As under CPUAffinity of a systemd unit. The second session's own thread is idle.
TEST(SessionJoins, CountOnlyTheProcessorsThatTheServerMayUse) {
  Shard other{std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), 1000};
  Joining j;
  LiveSession exam(j.scene, *make_local_slaves(j.scene, Time{}), 1, j.records());
  j.registry.requests().watch(other);
  j.registry.add({"exam", id_of(2), "ABCDE12346", 3, &exam, &other});
  j.serve();
  cpu_set_t before, one;
  CPU_ZERO(&one);
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  for (std::size_t cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  SessionJoins joins{j.registry, j.commands, j.keys, LoadLimits{0.75 * expected_seat_cost(j.scene.tick_hz)}};
  std::array<std::optional<JoinReply>, 2> replies;
  const auto ask = [&](const char* code, std::optional<JoinReply>& reply) {
    JoinRequest request = Joining::request("trainee", rpc::CodeCredential{code});
    request.hello.session = std::string(code);
    joins.admit(request, [&reply](JoinReply decided) { reply = std::move(decided); });
  };
  ask(kCode, replies[0]);
  j.wait_until([&] { return replies[0].has_value(); });
  ask("ABCDE12346", replies[1]);
  EXPECT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  ASSERT_TRUE(replies[1]);
  EXPECT_NE(error_of(*replies[1]).text.find("keep the 1 processors busy"), std::string::npos)
      << error_of(*replies[1]).text;
}

TEST(SessionJoins, RejectTicketsOfBeforeTheEnrolmentOfTheWorkstationAndUseThemUpNot) {
  Joining j;
  JoinRequest request = Joining::request("");
  request.hello.credential = j.operators_ticket({std::byte{1}});
  request.workstation.enrolled_at = auth::wall_seconds() + 60;  // again, after a revocation
  const rpc::ErrorReply refused = error_of(j.join(request));
  EXPECT_EQ(refused.code, ErrorCode::kTicket);
  EXPECT_NE(refused.text.find("its revocation has voided"), std::string::npos) << refused.text;
  request.workstation.enrolled_at = auth::wall_seconds() - 60;
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(j.join(request)));
}

TEST(SessionJoins, RejectSeatsWhileTheServerDrainsButCheckConsolesFurther) {
  Joining j;
  j.registry.drain().begin();
  EXPECT_EQ(error_of(j.join(Joining::request("trainee", rpc::CodeCredential{kCode}))).code, ErrorCode::kDraining);
  const rpc::ErrorReply console = error_of(j.join(Joining::request("")));
  EXPECT_EQ(console.code, ErrorCode::kNoSeat);
  EXPECT_EQ(console.text,
            "a join without a seat needs a ticket, such as from `tandem-server ticket --session lesson --role operator "
            "--workstation touch-07`; seats: trainer trainee");
}

TEST(SessionJoins, ProposeTheLeastTicketThatWatches) {
  Joining j;
  JoinRequest request = Joining::request("");
  request.hello.watch = true;
  EXPECT_EQ(error_of(j.join(request)).text,
            "a join without a seat needs a ticket, such as from `tandem-server ticket --session lesson --role observer "
            "--workstation touch-07`; seats: trainer trainee");
}

TEST(SessionJoins, RejectUnknownSeatsAndDevicesWithTooFewAxes) {
  Joining j;
  EXPECT_EQ(error_of(j.join(Joining::request("pilot", rpc::CodeCredential{kCode}))),
            (rpc::ErrorReply{ErrorCode::kNoSeat, "no seat of this name; seats: trainer trainee", 0}));
  JoinRequest flat = Joining::request("trainee", rpc::CodeCredential{kCode});
  flat.hello.device.tip_axes = 2;
  EXPECT_EQ(error_of(j.join(flat)),
            (rpc::ErrorReply{ErrorCode::kDeviceUnfit, "the scene needs 3 axes, the device has 2", 0}));
  EXPECT_FALSE(j.lesson.seats[1].joining());
}

TEST(SessionJoins, AdmitASeatByTheSessionsCode) {
  Joining j;
  j.serve();
  const JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  const JoinReply reply = j.join(request);
  const auto* const welcome = std::get_if<rpc::Welcome>(&reply);
  ASSERT_NE(welcome, nullptr) << error_of(reply).text;
  EXPECT_EQ(welcome->session_id, id_of(1));
  EXPECT_EQ(welcome->session_name, "lesson");
  EXPECT_EQ(welcome->epoch, 3U);
  EXPECT_EQ(welcome->seat, "trainee");
  EXPECT_EQ(welcome->role, AccessRole::kTrainee);
  EXPECT_EQ(welcome->cipher, rpc::Cipher::kChaCha20Poly1305) << "the client has no AES";
  EXPECT_EQ(welcome->udp_port, j.shard.address().port());
  EXPECT_FALSE(welcome->setup.empty());
  EXPECT_EQ(error_of(j.join(request)), (rpc::ErrorReply{ErrorCode::kSeatTaken, "seat trainee is taken already", 2}));
  EXPECT_FALSE(j.joins.is_current(*welcome)) << "the Welcome is not sent yet";

  j.joins.on_joined(request, *welcome, {});
  EXPECT_TRUE(j.joins.is_current(*welcome));
  EXPECT_EQ(j.lesson.seats[1].owner()->name, "touch-07");
  j.wait_until([&] { return !j.lesson.seats[1].joining(); });
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kSeatTaken) << "its client is in the session now";

  JoinRequest again = Joining::request("trainee", rpc::ResumeCredential{welcome->resume_secret});
  const JoinReply resumed = j.join(again);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(resumed)) << error_of(resumed).text;
  again.hello.credential = rpc::ResumeCredential{};
  EXPECT_EQ(error_of(j.join(again)).code, ErrorCode::kResume) << "a wrong secret";
  EXPECT_NE(error_of(j.join(again)).text.find("failed before it had stored this seat"), std::string::npos);
}

/// Its owner would wait for the seat in vain. A ticket that is wrong tells nothing about its use.
TEST(SessionJoins, SayThatATicketIsUsedBeforeThatItsSeatIsTaken) {
  Joining j;
  j.serve();
  const rpc::Credential ticket = j.ticket_for({std::byte{4}}, "trainee", AccessRole::kTrainee);
  const JoinRequest request = Joining::request("trainee", ticket);
  const JoinReply first = j.join(request);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(first)) << error_of(first).text;
  const auto expect_refused = [&] {
    EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket);
    EXPECT_NE(error_of(j.join(request)).text.find("used"), std::string::npos) << error_of(j.join(request)).text;
    JoinRequest other = request;
    other.hello.credential = j.ticket_for({std::byte{5}}, "trainee", AccessRole::kTrainee);
    EXPECT_EQ(error_of(j.join(other)).code, ErrorCode::kSeatTaken) << "its ticket is valid once the seat is free";
    JoinRequest thief = request;
    thief.workstation = {"touch-08", {std::byte{8}}, 0};
    EXPECT_EQ(error_of(j.join(thief)).code, ErrorCode::kSeatTaken) << "a ticket of another workstation";
    JoinRequest forger = request;
    auto& bytes = std::get<rpc::TicketCredential>(forger.hello.credential).bytes;
    bytes.back() ^= std::byte{1};
    EXPECT_EQ(error_of(j.join(forger)).code, ErrorCode::kSeatTaken) << "a wrong signature";
  };
  expect_refused();
  j.joins.on_joined(request, std::get<rpc::Welcome>(first), {});
  j.wait_until([&] { return !j.lesson.seats[1].joining(); });
  expect_refused();
}

TEST(SessionJoins, FreeASeatWhoseWelcomeCouldNotBeSent) {
  Joining j;
  j.serve();
  const JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  const JoinReply first = j.join(request);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(first)) << error_of(first).text;
  j.joins.on_join_failed(std::get<rpc::Welcome>(first));
  EXPECT_FALSE(j.lesson.seats[1].joining());
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(j.join(request)));
}

TEST(SessionJoins, RejectWrongCredentialsWithoutReservingTheSeat) {
  Joining j;
  j.serve();
  EXPECT_EQ(error_of(j.join(Joining::request("trainee", rpc::CodeCredential{"ZZZZZ00000"}))).code, ErrorCode::kCode);
  EXPECT_EQ(error_of(j.join(Joining::request("trainee"))).code, ErrorCode::kTicket);
  EXPECT_EQ(error_of(j.join(Joining::request("trainer", rpc::CodeCredential{kCode}))),
            (rpc::ErrorReply{ErrorCode::kNotAllowed,
                             "the instructor's seat needs a ticket: on the server, `tandem-server ticket --session "
                             "lesson --seat trainer --workstation touch-07`",
                             0}));
  j.lesson.removed.add({std::byte{7}});
  EXPECT_EQ(error_of(j.join(Joining::request("trainee", rpc::CodeCredential{kCode}))).code, ErrorCode::kNotAllowed)
      << "its participant was removed";
  EXPECT_FALSE(j.lesson.seats[0].joining());
  EXPECT_FALSE(j.lesson.seats[1].joining());
}

/// The former owner of the session has died; this server had the session, and the ticket, before that.
TEST(SessionJoins, AdmitAConsoleOfADeadOwnerAgainByItsTicketAndOnlyThatOne) {
  Joining j;
  const auth::Id16 ticket{std::byte{5}}, other{std::byte{6}};
  std::vector<std::vector<auth::Id16>> stored;
  j.lesson.registration.on_consoles = [&](std::vector<auth::Id16> tickets) { stored.push_back(std::move(tickets)); };
  const JoinRequest request = Joining::request("", j.operators_ticket(ticket));
  const JoinReply before = j.join(request);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(before)) << error_of(before).text;
  EXPECT_TRUE(stored.empty()) << "the Welcome is not sent";
  j.joins.on_joined(request, std::get<rpc::Welcome>(before), {});
  EXPECT_EQ(stored.back(), std::vector{ticket});
  j.joins.on_disconnected(std::get<rpc::Welcome>(before), false);
  EXPECT_TRUE(stored.back().empty());
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket) << "its console has left";

  j.lesson.consoles = ConsoleTickets({ticket, other}, Time::max());
  JoinRequest thief = request;
  thief.workstation = {"touch-08", {std::byte{8}}, 0};
  EXPECT_EQ(error_of(j.join(thief)).code, ErrorCode::kTicket) << "another key";
  const JoinReply again = j.join(request);
  const auto* const welcome = std::get_if<rpc::Welcome>(&again);
  ASSERT_NE(welcome, nullptr) << error_of(again).text;
  EXPECT_EQ(welcome->role, AccessRole::kOperator);
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket) << "a second console, before the first has joined";
  j.joins.on_join_failed(*welcome);
  const JoinReply third = j.join(request);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(third)) << "its Welcome could not be sent";
  j.joins.on_joined(request, std::get<rpc::Welcome>(third), {});
  EXPECT_EQ(stored.back(), (std::vector{ticket, other})) << "for the owner after this one";
  EXPECT_TRUE(j.joins.is_current(std::get<rpc::Welcome>(third)));
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket);
}

/// A gap of the network ends a connection at its client first; the server may notice it a minute later.
TEST(SessionJoins, AdmitAConsoleAgainByItsSecretAndItsOldConnectionNoMore) {
  Joining j;
  const JoinRequest request = Joining::request("", j.operators_ticket({std::byte{5}}));
  const JoinReply first = j.join(request);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(first)) << error_of(first).text;
  const rpc::Welcome before = std::get<rpc::Welcome>(first);
  JoinRequest again = Joining::request("", rpc::ResumeCredential{before.resume_secret});
  EXPECT_EQ(error_of(j.join(again)).code, ErrorCode::kResume) << "its Welcome is not sent yet";
  j.joins.on_joined(request, before, {});
  JoinRequest thief = again;
  thief.workstation = {"touch-08", {std::byte{8}}, 0};
  EXPECT_EQ(error_of(j.join(thief)).code, ErrorCode::kResume) << "another key";
  const JoinReply lost = j.join(again);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(lost)) << error_of(lost).text;
  j.joins.on_join_failed(std::get<rpc::Welcome>(lost));
  EXPECT_TRUE(j.joins.is_current(before)) << "nothing has replaced it yet";
  const JoinReply second = j.join(again);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(second)) << error_of(second).text;
  const rpc::Welcome after = std::get<rpc::Welcome>(second);
  EXPECT_EQ(after.role, AccessRole::kOperator);
  j.joins.on_joined(again, after, {});
  EXPECT_TRUE(j.joins.is_current(after));
  EXPECT_FALSE(j.joins.is_current(before)) << "one console by one ticket";
  std::optional<rpc::Body> reply;
  j.joins.command(before, request.workstation, rpc::StopSession{id_of(1), ""}, [&](rpc::Body b) { reply = b; });
  ASSERT_TRUE(reply);
  EXPECT_EQ(error_of(*reply).code, ErrorCode::kNotAllowed);
  j.joins.on_disconnected(before, false);
  EXPECT_TRUE(j.joins.is_current(after));
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket);
  j.joins.on_disconnected(after, true);
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kTicket) << "its first connection may have used it";
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(j.join(again))) << "its connection has just ended";
}

TEST(SessionJoins, ReplyThatASessionIsEndingThatTheShardDoesNotServe) {
  Joining j;
  const SessionEntry& over = j.add("over", 2, kCode, false);
  j.serve();
  JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  request.hello.session = id_of(2);
  EXPECT_EQ(error_of(j.join(request)), (rpc::ErrorReply{ErrorCode::kSessionOver, "the session is ending", 0}));
  EXPECT_FALSE(over.seats[1].joining());
}

/// A client that asks while its session moves to another server of the service asks again; it does not leave.
TEST(SessionJoins, ReplyNotNowForASessionThatAnotherServerGoesOnWith) {
  Joining j;
  const SessionEntry& moves = j.add("moves", 2, kCode, false);
  j.serve();
  j.registry.end(id_of(2), wire::CloseReason::kServerReturns);
  JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  request.hello.session = id_of(2);
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kNotNow);
  EXPECT_FALSE(moves.seats[1].joining());
}

/// The directory of a service, which answers when the test says so.
struct LateUses final : TicketUses {
  void use(const std::string&, const auth::Id16&, std::int64_t, bool, std::function<void(Outcome)> done) override {
    answer = std::move(done);
  }
  void restore(const std::string&, const auth::Id16& ticket) override { restored.push_back(ticket); }
  std::function<void(Outcome)> answer;
  std::vector<auth::Id16> restored;
};

/// The next owner would not know the seat: the last snapshot is made before the client is admitted.
TEST(SessionJoins, AdmitNoClientAndUseNoTicketOnceTheSessionIsHandedOver) {
  for (const auto outcome :
       {TicketUses::Outcome::kAccepted, TicketUses::Outcome::kUsed, TicketUses::Outcome::kNoAnswer}) {
    Joining j;
    LateUses uses;
    j.joins.set_ticket_uses(&uses);
    j.serve();
    const JoinRequest request =
        Joining::request("trainee", j.ticket_for({std::byte{3}}, "trainee", AccessRole::kTrainee));
    std::optional<JoinReply> reply;
    j.joins.admit(request, [&](JoinReply decided) { reply = std::move(decided); });
    j.wait_until([&] { return static_cast<bool>(uses.answer); });
    EXPECT_FALSE(reply) << "the Welcome waits for the use of its ticket";
    j.registry.end(id_of(1), wire::CloseReason::kServerReturns);
    uses.answer(outcome);
    ASSERT_TRUE(reply);
    EXPECT_EQ(error_of(*reply), being_taken_over());
    EXPECT_EQ(uses.restored.size(), 1U);
    EXPECT_FALSE(j.lesson.seats[1].joining());
    EXPECT_FALSE(j.lesson.seats[1].owner());
    j.lesson.given_up = false;  // as at the next owner
    uses.answer = nullptr;
    j.joins.set_ticket_uses(nullptr);
    const auto again = j.keys.tickets().redeem(
        std::get<rpc::TicketCredential>(request.hello.credential).bytes,
        {id_of(1), 3, "trainee", AccessRole::kTrainee, auth::KeyFingerprint{{std::byte{7}}}, auth::wall_seconds(), 0});
    EXPECT_TRUE(again) << again.error().text;
  }
}

/// The directory answers so late that the session has left this server.
TEST(SessionJoins, AdmitNoClientAndUseNoTicketOfASessionThatIsNotHereAnyMore) {
  for (const auto outcome :
       {TicketUses::Outcome::kAccepted, TicketUses::Outcome::kUsed, TicketUses::Outcome::kNoAnswer}) {
    Joining j;
    LateUses uses;
    j.joins.set_ticket_uses(&uses);
    j.serve();
    const auth::Id16 id{std::byte{3}};
    const rpc::Credential ticket = j.ticket_for(id, "trainee", AccessRole::kTrainee);
    std::optional<JoinReply> reply;
    j.joins.admit(Joining::request("trainee", ticket), [&](JoinReply decided) { reply = std::move(decided); });
    j.wait_until([&] { return static_cast<bool>(uses.answer); });
    j.registry.end(id_of(1), wire::CloseReason::kServerReturns);
    j.registry.remove(id_of(1), [] {});
    uses.answer(outcome);
    ASSERT_TRUE(reply);
    EXPECT_EQ(error_of(*reply).code, outcome == TicketUses::Outcome::kUsed ? ErrorCode::kTicket : ErrorCode::kNotNow);
    EXPECT_EQ(uses.restored, std::vector{id});
    const auto again = j.keys.tickets().redeem(
        std::get<rpc::TicketCredential>(ticket).bytes,
        {id_of(1), 3, "trainee", AccessRole::kTrainee, auth::KeyFingerprint{{std::byte{7}}}, auth::wall_seconds(), 0});
    EXPECT_TRUE(again) << again.error().text;
  }
}

TEST(SessionJoins, ServeNoMoreLinkTestsThanThereAreSlots) {
  Joining j;
  JoinRequest request = Joining::request("");
  request.hello.link_test = true;
  std::vector<JoinReply> replies;
  const auto add = [&](JoinReply reply) { replies.push_back(std::move(reply)); };
  for (std::size_t i = 0; i < LinkTestSlots::kMax; ++i) j.joins.admit(request, add);
  EXPECT_TRUE(replies.empty()) << "the shard has not replied";
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kFull);
  j.serve();
  j.wait_until([&] { return replies.size() == LinkTestSlots::kMax; });
  for (const JoinReply& reply : replies) {
    const auto* const welcome = std::get_if<rpc::Welcome>(&reply);
    ASSERT_NE(welcome, nullptr) << error_of(reply).text;
    EXPECT_EQ(welcome->seat, "");
    EXPECT_EQ(welcome->role, AccessRole::kObserver);
    EXPECT_FALSE(welcome->setup.empty());
  }
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kFull);
  j.joins.on_join_failed(std::get<rpc::Welcome>(replies[0]));
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(j.join(request))) << "one slot is free again";
}

}  // namespace
}  // namespace tandem::server
