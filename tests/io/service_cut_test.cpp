// A server of a service that is cut off from its clients, or from its clients and etcd, while hands press in its
// session.
#include "tests/io/cut_path.h"
#include "tests/io/pressing_service.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

class ServiceCut : public PressingServiceTest {};

TEST_F(ServiceCut, OwnerWithoutItsClientsKeepsTheSessionAndTakesThemBackWithoutANewTicket) {
  PressingService pressed;
  LiveService& service = pressed.service();
  CutPath clients(service.address("a"));
  service.set("a", {.address = clients.address()});
  pressed.start({"a", "b"});
  pressed.join(clients.address());
  clients.cut();
  ASSERT_TRUE(pressed.hand(0).wait_for("your hand is free")) << pressed.hand(0).err();
  ASSERT_TRUE(pressed.hand(1).wait_for("your hand is free")) << pressed.hand(1).err();
  std::this_thread::sleep_for(milliseconds(5000));  // longer than the lease, and than the first attempts to come back
  EXPECT_EQ(service.sessions("a").size(), 1U) << "etcd knows that the owner is well";
  EXPECT_EQ(service.sessions("b").size(), 0U);
  EXPECT_TRUE(service.of("a").wait_for("trainer is silent: its link is lost")) << service.of("a").err();
  clients.heal();
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_TRUE(pressed.hand(n).wait_for("the server is back after")) << pressed.hand(n).err();
  std::this_thread::sleep_for(milliseconds(3000));  // until the force is up
  const std::vector<Absence> all = pressed.expect_safe(std::nullopt);
  EXPECT_EQ(all.size(), 2U);
  for (const Absence& absence : all) EXPECT_GE(absence.back_s, 5) << "a hand was engaged without its server";
  EXPECT_EQ(service.of("a").err().find("HELD"), std::string::npos) << service.of("a").err();
  if (!all.empty()) print("cut off from the clients: release to active [s]", values(all, &Absence::back_s));
}

TEST_F(ServiceCut, OwnerWithoutClientsAndEtcdIsReplacedAndGivesTheSessionUp) {
  PressingService pressed;
  LiveService& service = pressed.service();
  CutPath clients(service.address("a")), etcd(service.etcd().endpoint());
  service.set("a", {.address = clients.address(), .endpoints = {etcd.address()}});
  pressed.start({"a", "b"});
  pressed.join(clients.address());
  clients.cut();
  etcd.cut();
  pressed.wait_until_active("b");
  ASSERT_TRUE(service.of("a").wait_for("1 session HELD")) << service.of("a").err();
  std::this_thread::sleep_for(milliseconds(2000));
  clients.heal();
  etcd.heal();
  ASSERT_TRUE(service.of("a").wait_for("lab: GIVEN UP")) << service.of("a").err();
  ASSERT_TRUE(service.of("a").wait_for("answers again")) << service.of("a").err();
  std::this_thread::sleep_for(milliseconds(2000));
  EXPECT_EQ(pressed.witness().newest("b").active, 2U);
  const std::vector<Absence> all = pressed.expect_safe(1);
  EXPECT_EQ(all.size(), 2U);
  for (const Absence& absence : all) EXPECT_LE(absence.back_s, 7);
  if (!all.empty()) print("cut off from all: release to active [s], asked <= 7", values(all, &Absence::back_s));
}

}  // namespace
}  // namespace tandem::test
