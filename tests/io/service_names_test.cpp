// Clients of a service whose servers have names, while the DNS server does not answer.
#include <gtest/gtest.h>

#include "client/app/run_seat.h"
#include "client/app/seat_observer.h"
#include "tests/io/blocked_lookup.h"
#include "tests/io/service_join_fixture.h"

namespace tandem::client {
namespace {

TEST_F(ServiceJoin, TriesAddressesThatItKnowsBeforeItLooksUpNames) {
  const auto a = member("desk-a");
  know(*a);
  a->serve(5);
  a->on_thread([&] { a->directory.addresses = {"lab-b:7000", a->at()}; });
  tandem::test::BlockedLookup dns;
  JoinOptions asking = options({a.get()}, 3s);
  asking.names = dns.resolver();
  const auto joined = join_seat(asking);
  ASSERT_TRUE(joined) << joined.error().reason;
  const auto list = list_sessions(asking);  // knows the names from the join
  EXPECT_TRUE(list) << list.error().reason;
  ResumeState own_state = resume_state(*joined);
  own_state.members = joined->welcome.members;
  EXPECT_EQ(own_state.members.front(), "lab-b:7000");
  const auto back = resume_seat(asking, own_state, [] { return true; });
  EXPECT_TRUE(back) << back.error().reason;
  EXPECT_TRUE(dns.names().empty());
}

TEST_F(ServiceJoin, AsksAgainWhileTheNameOfTheOwnerIsLookedUp) {
  const auto a = member("desk-a"), b = member("desk-b");
  know(*a);
  b->serve(5);
  ServerLocation named = b->location(5);
  named.address = "lab-b:7000";
  point(*a, named);
  tandem::test::BlockedLookup dns;
  JoinOptions asking = options({a.get()}, 500ms);
  asking.names = dns.resolver();
  const std::string why = reason(asking);
  EXPECT_TRUE(dns.blocks());
  EXPECT_NE(why.find("no answer of the DNS server yet"), std::string::npos) << why;
  dns.answer(io::NameResolver::Addresses{b->address});
  asking.timeout = 5s;
  EXPECT_EQ(reason(asking), "joined");
}

/// Leaves the seat when the client looks up a name.
struct LeaveAtLookup final : SeatObserver {
  explicit LeaveAtLookup(const tandem::test::BlockedLookup& server) : dns(&server) {}
  void on_joined(const SeatSetup&) override {}
  void on_key(const std::string&) override {}
  std::vector<std::string> messages(double, const ClientStatus&) override { return {}; }
  std::string leave_reason() override { return dns->names().empty() ? "" : "the test is over"; }
  const tandem::test::BlockedLookup* dns;
};

TEST_F(ServiceJoin, LeavesTheSeatWhileAReconnectLooksUpAName) {
  auto a = member("desk-a");
  know(*a);
  a->serve(5);
  a->on_thread([&] { a->directory.addresses = {"lab-b:7000", a->at()}; });
  tandem::test::BlockedLookup dns;
  LeaveAtLookup observer{dns};
  SeatOptions plan;
  plan.join = options({a.get()}, 5s);
  plan.join.names = dns.resolver();
  plan.device = "sim";
  plan.duration_s = 60;
  plan.quiet = true;
  plan.observer = &observer;
  std::thread person([&] {
    static_cast<void>(run_seat(plan));
    EXPECT_TRUE(dns.blocks());
  });
  while (!a->hears_trainee()) std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(dns.names().empty());
  a->silence();
  a.reset();
  person.join();
}

}  // namespace
}  // namespace tandem::client
