#include "netsim/proxy/client_table.h"

#include <gtest/gtest.h>

#include <set>

#include "netsim/proxy/link_factory.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Adds a client with a perfect link.
std::uint32_t add(ClientTable& table) {
  const std::uint32_t place = *table.add();
  for (const Direction d : {Direction::kUp, Direction::kDown})
    table[place].directions[static_cast<std::size_t>(d)].emplace(LinkSchedule{}, d, 1, table[place].number);
  return place;
}

TEST(ClientTable, ReusesPlacesAndNumbersClientsByArrival) {
  ClientTable table;
  for (std::uint32_t place = 0; place < ClientTable::kMax; ++place) ASSERT_EQ(add(table), place);
  EXPECT_EQ(table.size(), 64u);
  EXPECT_FALSE(table.add());
  EXPECT_FALSE(table.present(64));
  table.remove(7);
  EXPECT_EQ(table.size(), 63u);
  EXPECT_FALSE(table.present(7));
  EXPECT_FALSE(table.number(7));
  EXPECT_EQ(table.link(7, Direction::kUp), nullptr);
  EXPECT_EQ(add(table), 7u);
  EXPECT_EQ(table.number(7), 64u);
  EXPECT_EQ(table.seen(), 65u);
}

TEST(ClientTable, FindsNoClientByThePathIndexOfOneThatLeft) {
  ClientTable table;
  add(table);
  const std::uint32_t place = add(table);
  const std::uint32_t up = table.path_index(place, Direction::kUp), down = table.path_index(place, Direction::kDown);
  ASSERT_TRUE(table.find(down));
  EXPECT_EQ(table.find(down)->place, place);
  EXPECT_EQ(table.find(down)->direction, Direction::kDown);
  EXPECT_EQ(table.find(up)->direction, Direction::kUp);
  table.remove(place);
  EXPECT_FALSE(table.find(up)) << "free place";
  ASSERT_EQ(add(table), place);
  EXPECT_FALSE(table.find(up)) << "the successor has another generation";
  EXPECT_TRUE(table.find(table.path_index(place, Direction::kUp)));
}

TEST(ClientTable, KnowsDeadAddressesAndVisitsEveryLink) {
  ClientTable table;
  const std::uint32_t place = add(table);
  add(table);
  ASSERT_TRUE(table[place].addresses.change(Time{1s}, {10ms}));
  EXPECT_FALSE(table.dead(Time{1s + 9ms}, place, 0));
  EXPECT_TRUE(table.dead(Time{1s + 10ms}, place, 0));
  EXPECT_FALSE(table.dead(Time{1s + 10ms}, place, 1));
  EXPECT_FALSE(table.dead(Time{1s + 10ms}, 9, 0)) << "no such client";
  std::set<const LinkDirection*> links;
  table.for_each([&](LinkDirection& link) { links.insert(&link); });
  EXPECT_EQ(links.size(), 4u);
}

TEST(LinkFactory, PreparesLinksAndChangesByClientNumber) {
  const LinkSpec link = link_from({.delay = 1ms});
  const LinkFactory factory{link, 5, {{.at = 2s, .clients = {"3"}, .outage = OutageSpec{.length = 1s}}}};
  EXPECT_FALSE(factory.shared());
  const auto outcome = [&](std::uint64_t number) {
    PreparedLink prepared = factory.prepare_client(link, 4, number);
    EXPECT_EQ(prepared.version, 4u);
    EXPECT_EQ(prepared.number, number);
    return prepared.directions[0]->send(Time{2s}, 100).outcome;
  };
  EXPECT_EQ(outcome(1), Outcome::kDeliver);
  EXPECT_EQ(outcome(2), Outcome::kOutage) << "client \"3\" is the one with number 2";
  const std::uint64_t numbers[] = {1, 2};
  const LinkChange change = factory.prepare_change(link_from({.delay = 9ms}), numbers, true);
  ASSERT_EQ(change.clients.size(), 2u);
  EXPECT_EQ(change.clients[0].paths[0]->send(Time{2s}, 0, 100).at, Time{2s + 9ms});
  EXPECT_EQ(change.clients[1].paths[0]->send(Time{2s}, 0, 100).outcome, Outcome::kOutage) << "outages persist";
  EXPECT_TRUE(change.for_new);
  EXPECT_FALSE(factory.prepare_change(link, numbers, false).for_new);
}

TEST(LinkFactory, ChangesASharedLinkForAllClientsOnly) {
  LinkSpec link = link_from({.delay = 1ms});
  link.shared = true;
  const LinkFactory factory{link, 5, {}};
  EXPECT_TRUE(factory.shared());
  EXPECT_FALSE(factory.prepare_client(link, 0, 0).directions[0]);
  const LinkChange change = factory.prepare_change(link, {}, true);
  EXPECT_TRUE(change.clients.empty());
  EXPECT_NE(change.shared[1], nullptr);
  EXPECT_THROW(static_cast<void>(factory.prepare_change(link, {}, false)), std::invalid_argument);
  const auto timeline = factory.shared_link(link, Direction::kUp);
  timeline->join(0, 7);
  EXPECT_EQ(timeline->send(Time{}, 0, 100).at, Time{1ms});
}

}  // namespace
}  // namespace tandem::netsim
