// Everything that enters a session is in its journal, and nothing else is: commands, removals, peers without a seat,
// addresses, datagrams that do not authenticate, secrets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "client/diagnostics/link_test.h"
#include "client/diagnostics/session_watch.h"
#include "netsim/system/simulated_handshake.h"
#include "server/session/session_command.h"
#include "tests/netsim/replay/recorded_session.h"
#include "tests/server/session/session_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;
using netsim::test::RecordedSession;

void endless_scene(SceneSpec& scene) { scene.duration = 3600; }

/// A recorded session of all seats of a scene.
struct RecordedFixture {
  explicit RecordedFixture(const std::string& scene = "contact", bool with_journal = true)
      : s(scene, 3, {}, 0, endless_scene, true, with_journal ? &recorded.journal : nullptr) {}

  template <class Between>
  void tick(Between between) {
    s.tick(between);
    recorded.take(*s.session);
  }
  void run(int ticks) {
    for (int n = 0; n < ticks; ++n) tick([] {});
  }
  /// Expects that the recording replays to its end.
  void expect_equal() const {
    const auto outcome = recorded.replay(s.scene);
    EXPECT_EQ(outcome.words(), "");
    EXPECT_EQ(outcome.compared, recorded.ticks());
    EXPECT_GT(outcome.counts.outputs, 0u);
  }
  CommandOutcome::Result command(rpc::Body body, std::size_t seat = AuditEvent::kNoSeat) {
    SessionCommand command{std::move(body), AccessRole::kOperator, static_cast<std::uint8_t>(seat), 0};
    if (seat != AuditEvent::kNoSeat) {
      command.role = s.session->seat(seat).role();
      command.cid = s.session->seat(seat).link()->own_cid();
    }
    return execute_command(*s.session, s.now, command).result;
  }

  RecordedSession recorded;
  SessionFixture s;
};

TEST(SessionInputs, OfCommandsReplay) {
  using Result = CommandOutcome::Result;
  RecordedFixture r;
  r.run(600);
  ASSERT_EQ(r.s.session->state(), wire::SessionState::kRunning);
  rpc::SetAuthority wanted;
  wanted.version = r.s.session->authority().version();
  wanted.alpha = {0.25, 0.75};
  EXPECT_EQ(r.command(wanted, 0), Result::kDone);
  r.run(200);
  EXPECT_EQ(r.command(rpc::PauseSession{}), Result::kDone);
  r.run(300);
  EXPECT_EQ(r.s.session->state(), wire::SessionState::kPaused);
  rpc::ResumeSession resume;
  resume.stop = r.s.session->stop_control().latch().stops();
  EXPECT_EQ(r.command(resume), Result::kDone);
  r.run(300);
  EXPECT_EQ(r.command(rpc::StopSession{}, 0), Result::kDone);
  r.run(100);
  EXPECT_EQ(r.command(rpc::StatusRequest{}), Result::kDone);
  resume.stop = r.s.session->stop_control().latch().stops();
  EXPECT_EQ(r.command(resume, 0), Result::kDone);
  r.run(300);
  rpc::RemoveParticipant remove;
  remove.seat = r.s.scene.seats[1].name;
  EXPECT_EQ(r.command(remove), Result::kDone);
  r.run(300);
  EXPECT_FALSE(r.s.session->seat(1).taken());
  EXPECT_EQ(remove_client(*r.s.session, 0, 0, wire::CloseReason::kRevoked), Result::kDone);
  r.run(300);
  r.s.session->end(wire::CloseReason::kServerStops);
  r.s.session->end(wire::CloseReason::kDone);
  r.run(400);
  EXPECT_TRUE(r.s.session->over());
  r.expect_equal();
}

TEST(SessionInputs, OfLoadAndSettingsReplay) {
  RecordedFixture r{"eight_evaluators"};
  r.run(400);
  r.s.session->set_telemetry_every_tick(false);
  r.s.session->set_record_interval(17);
  r.run(300);
  r.s.session->lifecycle().set_load_state({ShedLevel::kEvaluatorsEvery3rd, false});
  r.run(300);
  r.s.session->lifecycle().set_load_state({ShedLevel::kNone, true});
  r.run(100);
  r.s.session->lifecycle().set_load_state({});
  r.s.session->set_record_interval(1);
  r.run(100);
  r.s.session->lifecycle().set_may_act(false);
  r.run(300);
  r.s.session->lifecycle().set_may_act(true);
  r.run(300);
  r.expect_equal();
}

TEST(SessionInputs, OfLateAndMissedTicksReplay) {
  RecordedFixture r{"cooperative_slave"};
  r.run(500);
  for (const std::uint32_t missed : {1u, 7u, 49u, 50u, 51u, 400u}) {
    r.s.now += missed * 1ms;
    for (std::size_t i = 0; i < r.s.seats.size(); ++i)
      for (const Bytes& d : r.s.client_tick(i)) r.s.session->on_datagram(r.s.now, address(r.s.seats[i].at), d);
    r.s.session->on_tick(r.s.now, missed);
    r.s.to_clients(r.s.server_sends());
    r.recorded.take(*r.s.session);
    r.s.now += 1ms;
    r.run(100);
  }
  r.expect_equal();
}

// Watchers and link tests take tokens from the same store and may ask for telemetry at every tick; the journal has
// nothing of them, and the replay without them is equal.
TEST(SessionInputs, OfPeersWithoutASeatAreNotNeeded) {
  RecordedFixture r;
  r.s.session->set_telemetry_every_tick(false);
  r.run(300);
  const auto bytes_before = r.recorded.bytes().size();
  std::vector<std::unique_ptr<client::SessionWatch>> watches;
  for (std::uint64_t n = 0; n < 4; ++n) {
    const auto joined = netsim::simulate_watch_join(*r.s.session, r.s.now, RandomKey{77}, n + 1, n % 2 == 1);
    ASSERT_TRUE(joined);
    watches.push_back(std::make_unique<client::SessionWatch>(
        telemetry_layout(r.s.scene), r.s.session->seat_catalogue().tick(), joined->channel_params));
  }
  const auto visitor = netsim::simulate_link_test_join(*r.s.session, r.s.now, RandomKey{5}, 9);
  ASSERT_TRUE(visitor);
  client::LinkTest link_test{visitor->setup, visitor->channel_params};
  EXPECT_EQ(r.recorded.bytes().size(), bytes_before);
  int heard = 0;
  std::array<std::byte, transport::kDatagramMax> buffer;
  for (int n = 0; n < 1500; ++n) {
    if (n % 100 == 50)  // their addresses change, so that they take tokens while a seat takes one too
      for (auto& seat : r.s.seats) seat.at = static_cast<std::uint8_t>(seat.at ^ 0x40);
    r.tick([&] {
      for (std::size_t w = 0; w < watches.size(); ++w)
        while (const auto size = watches[w]->poll_transmit(r.s.now, buffer))
          r.s.session->on_datagram(r.s.now, address(static_cast<std::uint8_t>(200 + w + (n / 100) % 2 * 10)),
                                   std::span{buffer}.first(*size));
      link_test.on_tick(r.s.now, Duration{}, 0, Duration{});
      while (const auto size = link_test.poll_transmit(r.s.now, buffer))
        r.s.session->on_datagram(r.s.now, address(199), std::span{buffer}.first(*size));
    });
    for (const auto& [to, bytes] : r.s.others) {
      if (to == 199) link_test.on_datagram(r.s.now, bytes);
      for (std::size_t w = 0; w < watches.size(); ++w)
        if (to % 10 == static_cast<int>(w) && to >= 200 && watches[w]->on_datagram(r.s.now, bytes)) ++heard;
    }
    netsim::fill_path_tokens(*r.s.session, RandomKey{1}, 64 * static_cast<std::uint64_t>(n));
  }
  EXPECT_GT(heard, 1500) << "no watcher saw the session";
  r.expect_equal();
}

TEST(SessionInputs, LeaveOutWhatDoesNotAuthenticate) {
  RecordedFixture quiet, attacked;
  std::array<std::byte, 200> junk;
  RandomStream random{5};
  std::vector<Bytes> old;
  for (int n = 0; n < 800; ++n) {
    quiet.run(1);
    attacked.tick([&] {
      for (std::byte& b : junk) b = static_cast<std::byte>(random.below(256));
      attacked.s.session->on_datagram(attacked.s.now, address(1), junk);
      transport::write_header({wire::Type::kState, 0, attacked.s.seats[0].params.peer_cid, random.below(2000)},
                              std::span{junk}.first<transport::kHeaderSize>());
      attacked.s.session->on_datagram(attacked.s.now, address(1), junk);
    });
  }
  EXPECT_GT(attacked.s.refused(transport::DropReason::kTag), 700u);
  EXPECT_EQ(quiet.recorded.bytes(), attacked.recorded.bytes());
  attacked.expect_equal();
}

TEST(SessionInputs, HaveNoSecretAndNoAddress) {
  RecordedFixture r;
  for (FixtureSeat& seat : r.s.seats) seat.at = static_cast<std::uint8_t>(seat.at + 100);
  std::array<std::byte, 28> home;
  home.fill(std::byte{0xa5});
  r.run(300);
  const auto has = [&](std::span<const std::byte> wanted) {
    const auto bytes = r.recorded.bytes();
    return !std::ranges::search(bytes, wanted).empty();
  };
  for (std::size_t i = 0; i < r.s.seats.size(); ++i) {
    const transport::ConnectionSecrets& secrets = r.s.seats[i].params.secrets;
    for (const transport::Secret* secret : {&secrets.to_server, &secrets.to_client}) {
      EXPECT_FALSE(has(std::span{secret->bytes}.first(8)));
      const transport::Key key = transport::key_of(*secret, secrets.cipher);
      EXPECT_FALSE(has(std::span{key.key.bytes}.first(8)));
      EXPECT_FALSE(has(std::span{key.iv.bytes}.first(8)));
    }
  }
  PeerAddress sender;
  sender.size = 28;
  sender.bytes = home;
  for (const Bytes& d : r.s.client_tick(0)) r.s.session->on_datagram(r.s.now, sender, d);
  r.run(10);
  EXPECT_FALSE(has(std::span{home}.first(8)));
  const std::uint64_t alias = transport::keyed_hash(netsim::test::kAddressKey, home);
  EXPECT_TRUE(has(std::as_bytes(std::span{&alias, 1}))) << "the datagram was not recorded";
}

// A restored session begins from a checkpoint without the hashes of resume secrets.
TEST(SessionInputs, OfARestoredSessionReplayWithoutResumeHashes) {
  RecordedFixture r;
  r.run(700);
  Checkpoint checkpoint = r.s.session->checkpoint();
  for (Checkpoint::Seat& seat : checkpoint.seats) seat.resume.fill(std::byte{0xc3});
  auto slaves =
      *hal::sim::make_local_slaves(r.s.scene, r.s.now, [&](std::size_t tool) { return &checkpoint.tools[tool].slave; });
  AxisArray scale;
  scale.fill(1);
  Session restored{r.s.scene, std::move(slaves), scale, checkpoint};
  RecordedSession again;
  ASSERT_TRUE(restored.attach_journal(again.journal, r.s.now, build_text(), &checkpoint));
  std::array<std::byte, transport::kDatagramMax> buffer;
  for (int n = 0; n < 50; ++n) {
    restored.on_tick(r.s.now, 0);
    while (restored.poll_transmit(r.s.now, buffer)) {
    }
    again.take(restored);
    r.s.now += 1ms;
  }
  const std::array<std::byte, 8> hash{std::byte{0xc3}, std::byte{0xc3}, std::byte{0xc3}, std::byte{0xc3},
                                      std::byte{0xc3}, std::byte{0xc3}, std::byte{0xc3}, std::byte{0xc3}};
  const auto bytes = again.bytes();
  EXPECT_TRUE(std::ranges::search(bytes, hash).empty());
  const auto outcome = again.replay(r.s.scene);
  EXPECT_EQ(outcome.words(), "");
  EXPECT_EQ(outcome.compared, 50u);
}

TEST(SessionInputs, AreRefusedOnceASessionHasBegunWithoutThem) {
  RecordedFixture r{"one_axis", false};
  EXPECT_FALSE(r.s.session->attach_journal(r.recorded.journal, Time{}, build_text()));
  r.run(10);
  EXPECT_FALSE(r.s.session->attach_journal(r.recorded.journal, Time{}, build_text()));
  EXPECT_TRUE(r.recorded.pieces.empty());
}

TEST(SessionInputs, ChangeNothingInTheSessionAndTakeNoHeap) {
  RecordedFixture with, without{"contact", false};
  with.run(100);
  without.run(100);
  for (int n = 0; n < 900; ++n) {
    std::vector<std::vector<Bytes>> sent;
    for (std::size_t i = 0; i < with.s.seats.size(); ++i) sent.push_back(with.s.client_tick(i));
    {
      const tandem::test::AllocGuard guard;
      for (std::size_t i = 0; i < sent.size(); ++i)
        for (const Bytes& d : sent[i]) with.s.session->on_datagram(with.s.now, address(with.s.seats[i].at), d);
      with.s.session->on_tick(with.s.now, 0);
      EXPECT_EQ(guard.count(), 0u);
    }
    with.s.to_clients(with.s.server_sends());
    with.s.now += 1ms;
    with.recorded.drain();
    without.run(1);
  }
  EXPECT_EQ(with.s.told.value, without.s.told.value) << "other bytes were sent";
  EXPECT_EQ(with.s.state_hash(), without.s.state_hash());
}

// The thread that drains may be late by a quarter of a second before a journal ends.
TEST(SessionInputs, OfAQuarterOfASecondFitInTheJournalOfTheirScene) {
  for (const char* scene : {"free_motion", "contact", "contact_remote", "two_by_two", "eight_seats", "guidance"}) {
    RecordedFixture r{scene};
    const auto bytes = [&] {
      std::size_t sum = 0;
      for (const auto& piece : r.recorded.pieces) sum += piece.size();
      return sum;
    };
    r.run(600);
    ASSERT_EQ(r.s.session->state(), wire::SessionState::kRunning) << scene;
    const std::size_t before = bytes();
    r.run(200);
    const std::size_t quarter = (bytes() - before) * 5 / 4;
    const std::size_t capacity = InputJournal::capacity_for(r.s.scene.seats.size(), r.s.scene.tools.size());
    EXPECT_GE(capacity, quarter) << scene;
    EXPECT_LE(capacity, 16 * quarter) << scene << ": memory that no session needs";
  }
}

}  // namespace
}  // namespace tandem::server
