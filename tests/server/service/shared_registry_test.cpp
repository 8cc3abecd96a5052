// Workstations and codes of several servers, kept equal through a directory in memory, in virtual time.
#include "server/service/shared_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/server/service/registry_desks.h"

namespace tandem::server {
namespace {

TEST(RegistryEntries, HaveOneTextPerNameAndReadBack) {
  const auth::RegistryLists lists{{workstation("a", 1), workstation("b", 2)}, {code("b", 3), code("c", 4)}};
  const RegistryEntries entries = entries_of(lists);
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries.at("a"), "{\"workstation\":{\"enrolled_at\":1001,\"spki\":\"01" + std::string(62, '0') + "\"}}");
  EXPECT_EQ(lists_of(entries), lists);
  for (const char* bad : {"", "{", "[]", "{\"workstation\":1}", "{\"workstation\":{\"spki\":\"0\",\"enrolled_at\":1}}",
                          "{\"code\":{\"hash\":7,\"not_after\":1}}"})
    EXPECT_FALSE(readable_entry(bad)) << bad;
  EXPECT_FALSE(readable_entry(std::string(5000, ' ') + "{}"));
  EXPECT_TRUE(readable_entry("{\"key of a later version\":1}"));
}

TEST(RegistryEntries, OfAnAgreementReadBackFromAFile) {
  RegistryAgreement agreed{"mark", entries_of({{workstation("a", 1)}, {code("b", 2)}})};
  agreed.spent["b/00"] = 2001;
  EXPECT_EQ(parse_registry_agreement(to_text(agreed)), agreed);
  for (const char* bad : {"", "{}", "{\"mark\":1,\"entries\":{}}", "{\"mark\":\"m\",\"entries\":{\"a\":\"x\"}}",
                          "{\"mark\":\"m\",\"entries\":{},\"spent_codes\":[]}",
                          "{\"mark\":\"m\",\"entries\":{},\"spent_codes\":{\"b/00\":\"x\"}}"})
    EXPECT_FALSE(parse_registry_agreement(bad)) << bad;
}

TEST(SharedRegistry, BringsAnEnrolmentACodeAndARevocationToAllServers) {
  Desks desks(3);
  desks[0].enroll("a", 1);
  desks[1].issue("b", 7);
  desks.pass(1s);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(desks[i].key_of("a"), 1);
    EXPECT_EQ(desks[i].lists.codes, std::vector{code("b", 7)});
  }
  desks[2].enroll("b", 2);  // with the code that another server issued, which is used up everywhere
  desks[1].revoke("a");
  desks.pass(1s);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(desks[i].key_of("a"), 0);
    EXPECT_EQ(desks[i].key_of("b"), 2);
    EXPECT_TRUE(desks[i].lists.codes.empty());
  }
}

TEST(SharedRegistry, GivesOneKeyToACodeThatTwoServersAcceptedAtOnce) {
  Desks desks(2);
  desks[0].issue("a", 7);
  desks.pass(1s);
  desks[0].enroll("a", 1);
  desks[1].enroll("a", 2);
  desks.pass(1s);
  EXPECT_EQ(desks[0].key_of("a"), desks[1].key_of("a"));
  EXPECT_NE(desks[0].key_of("a"), 0);
}

TEST(RegistryEntries, OfTwoChangesLoseNothingThatWasAdded) {
  const auto text = [](int key, int hash) {
    auth::RegistryLists lists;
    if (key != 0) lists.workstations.push_back(workstation("a", key));
    if (hash != 0) lists.codes.push_back(code("a", hash));
    const RegistryEntries entries = entries_of(lists);
    return entries.empty() ? std::string{} : entries.at("a");
  };
  struct Case {
    std::string before, local, stored, merged;
  };
  for (const Case& c : {
           Case{"", text(1, 0), text(0, 7), text(1, 7)},          // enrolled here, a code there
           Case{"", text(0, 7), text(1, 0), text(1, 7)},          // the other way round
           Case{text(0, 7), text(1, 0), text(2, 0), text(2, 0)},  // one code, used twice: the directory
           Case{text(0, 7), text(1, 0), text(0, 8), text(1, 8)},  // used here, replaced there
           Case{text(1, 0), text(0, 7), text(1, 8), text(0, 8)},  // revoked here, with codes of both since
           Case{text(1, 7), text(1, 0), text(2, 7), text(2, 0)},  // another key there, the code used here
           Case{"", text(1, 0), text(2, 0), text(2, 0)},          // two keys for one name: the directory
       })
    EXPECT_EQ(merged_entry(c.before, c.local, c.stored), c.merged) << c.before << " " << c.local << " " << c.stored;
}

// The files take what the directory has, and change before they are looked at again.
TEST(SharedRegistry, SendsAnEnrolmentWithACodeThatHasJustArrived) {
  Desks desks(1);
  desks.pass(1s);
  test::CuttableDirectory other(desks.store);
  const RegistryEntries arrives = entries_of({{}, {code("a", 7)}});
  other.begin(1, directory::Transaction{{}, {directory::Put{"/t/registry/a", arrives.at("a")}}, {}});
  SharedRegistry& registry = desks[0].registry;
  desks[0].registry.set_local({});
  while (const auto reply = desks[0].directory.poll()) registry.on_reply(*reply);
  ASSERT_EQ(registry.wanted(), arrives);
  registry.set_local(arrives);
  desks[0].lists = {};
  desks[0].enroll("a", 2);
  desks.pass(1s);
  EXPECT_EQ(desks[0].key_of("a"), 2);
  EXPECT_EQ(desks.store.entries().at("/t/registry/a").value, entries_of(desks[0].lists).at("a"));
}

TEST(SharedRegistry, KeepsARevocationThatWasMadeWhileAServerWasCutOff) {
  Desks desks(2);
  desks[0].enroll("a", 1);
  desks[0].enroll("b", 2);
  desks.pass(1s);
  desks[1].directory.cut = true;
  desks.pass(5s);
  desks[0].revoke("a");
  desks[1].enroll("a", 3);  // the server that was cut off does not know of it
  desks[1].revoke("b");
  desks[0].enroll("b", 4);
  desks.pass(1s);
  EXPECT_EQ(desks[1].key_of("a"), 3) << "its files hold while it is cut off";
  desks[1].directory.cut = false;
  desks.pass(3s);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(desks[i].key_of("b"), 0) << "a revocation wins, on whichever side it was made";
    EXPECT_EQ(desks[i].key_of("a"), desks[0].key_of("a"));
  }
}

TEST(SharedRegistry, KnowsAfterARestartWhatWasRevokedMeanwhile) {
  Desks desks(2);
  desks[0].enroll("a", 1);
  desks[0].enroll("b", 2);
  desks.pass(1s);
  const RegistryAgreement agreed = desks[1].registry.agreed();
  const auth::RegistryLists files = desks[1].lists;
  desks.desk.pop_back();
  desks[0].revoke("a");
  desks.pass(1s);
  desks.desk.push_back(std::make_unique<Desk>(desks.store, "other", agreed));
  desks[1].lists = files;
  desks[1].enroll("c", 3);  // while the server did not run
  desks.pass(1s);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(desks[i].key_of("a"), 0);
    EXPECT_EQ(desks[i].key_of("b"), 2);
    EXPECT_EQ(desks[i].key_of("c"), 3);
  }
}

TEST(SharedRegistry, LosesNothingWhenTheDirectoryIsBegunFromNothing) {
  directory::ModelStore first, second;
  Time now{1s};
  const auto run = [&](directory::ModelStore& store, Desk& desk) {
    for (int i = 0; i < 100; ++i) {
      store.advance(now += 20ms);
      desk.step(now);
    }
  };
  Desk desk(first, "one");
  desk.enroll("a", 1);
  run(first, desk);
  ASSERT_EQ(desk.registry.agreed().entries.size(), 1U);
  Desk again(second, "two", desk.registry.agreed());
  again.lists = desk.lists;
  run(second, again);
  EXPECT_EQ(again.key_of("a"), 1);
  EXPECT_EQ(again.registry.agreed().mark, "two");
  EXPECT_EQ(again.mark.losses(), 1U);
}

TEST(SharedRegistry, LeavesAloneWhatItCannotRead) {
  Desks desks(2);
  desks[0].enroll("a", 1);
  desks.pass(1s);
  test::CuttableDirectory by_hand(desks.store);
  by_hand.begin(1, directory::Transaction{{}, {directory::Put{"/t/registry/a", "newer form", 0}}, {}});
  desks.pass(1s);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(desks[i].key_of("a"), 1);
    EXPECT_EQ(desks[i].registry.rejected(), 1U);
  }
  EXPECT_EQ(desks.store.entries().at("/t/registry/a").value, "newer form");
}

// Otherwise a workstation that one server has just accepted would be gone when another server issues a code for it.
TEST(SharedRegistry, KeepsAnEnrolmentBesideACodeThatAnotherServerIssuesAtOnce) {
  Desks desks(2);
  desks[0].issue("a", 7);
  desks.pass(1s);
  desks[1].directory.cut = true;
  desks[0].enroll("a", 1);  // uses the code
  desks[1].issue("a", 8);
  desks.pass(1s);
  desks[1].directory.cut = false;
  desks.pass(3s);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(desks[i].key_of("a"), 1);
    EXPECT_EQ(desks[i].lists.codes, std::vector{code("a", 8)});
  }
}

// Servers that are cut off enrol one workstation under two names; the files of a server cannot hold its key twice.
TEST(SharedRegistry, KeepsTheFirstNameOfAKeyThatTwoServersEnrolledUnderTwoNames) {
  Desks desks(3);
  desks[1].directory.cut = true;
  desks[0].enroll("late", 1);
  desks[0].lists.workstations.front().enrolled_at = 5000;
  desks.pass(1s);
  desks[1].enroll("early", 1);
  desks[1].directory.cut = false;
  desks.pass(3s);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(desks[i].key_of("early"), 1);
    EXPECT_EQ(desks[i].key_of("late"), 0);
  }
  EXPECT_FALSE(desks.store.entries().contains("/t/registry/late"));
}

TEST(SharedRegistry, KeepsTheFirstOfTwoNamesWithOneCode) {
  Desks desks(2);
  desks[1].directory.cut = true;
  desks[0].issue("b", 7);
  desks[1].issue("a", 7);
  desks[1].directory.cut = false;
  desks.pass(3s);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(desks[i].lists.codes, std::vector{code("a", 7)});
}

TEST(SharedRegistry, TakesNoEntryThatTheFilesCannotHold) {
  Desks desks(1);
  desks[0].enroll("own", 1);
  desks.pass(1s);
  test::CuttableDirectory by_hand(desks.store);
  const std::string row = entries_of({{workstation("x", 2)}, {}}).at("x");
  const std::string before_1970 = entries_of({{{"x", {std::byte{3}}, -1}}, {}}).at("x");
  const std::string too_late = entries_of({{}, {{{std::byte{4}}, "x", 2'000'000'000'000}}}).at("x");
  directory::Transaction change;
  for (const std::string& name :
       {std::string("a\"b"), std::string("a\nb"), std::string("\xff"), std::string(33, 'x'), std::string()})
    change.then.push_back(directory::Put{"/t/registry/" + name, row, 0});
  change.then.push_back(directory::Put{"/t/registry/early", before_1970, 0});
  change.then.push_back(directory::Put{"/t/registry/late", too_late, 0});
  by_hand.begin(1, change);
  desks.pass(1s);
  EXPECT_EQ(desks[0].lists.workstations, std::vector{workstation("own", 1)});
  EXPECT_TRUE(desks[0].lists.codes.empty());
  EXPECT_EQ(desks[0].registry.rejected(), change.then.size());
}

TEST(SharedRegistry, KeepsItsOwnWorkstationsWhenTheDirectoryHasMoreThanTheFilesHold) {
  Desks desks(1);
  desks[0].enroll("zz", 255);
  desks.pass(1s);
  test::CuttableDirectory by_hand(desks.store);
  directory::Transaction change;
  for (int i = 0; i < 4200; ++i) {
    const std::string name = "w" + std::to_string(i);
    const Sha256 key{std::byte(i % 251), std::byte(i / 251), std::byte{1}};
    change.then.push_back(directory::Put{"/t/registry/" + name, entries_of({{{name, key, 1}}, {}}).at(name), 0});
  }
  by_hand.begin(1, change);
  desks.pass(100ms);
  EXPECT_EQ(desks[0].lists.workstations.size(), auth::kRegistryRowsMax);
  EXPECT_EQ(desks[0].key_of("zz"), 255);
}

// A mark is text of another server; the file with the agreement must hold it.
TEST(SharedRegistry, ReplacesAMarkThatItCannotRead) {
  for (const std::string& bad : {std::string("\xff\xfe"), std::string(100, 'm'), std::string("a\nb")}) {
    Desks desks(1);
    desks[0].enroll("a", 1);
    test::CuttableDirectory by_hand(desks.store);
    by_hand.begin(1, directory::Transaction{{}, {directory::Put{"/t/registry/.mark", bad, 0}}, {}});
    desks.pass(1s);
    EXPECT_EQ(parse_registry_agreement(to_text(desks[0].registry.agreed())), desks[0].registry.agreed());
    EXPECT_EQ(desks[0].registry.agreed().mark, "mark0");
    EXPECT_EQ(desks[0].key_of("a"), 1);
    EXPECT_EQ(desks.store.entries().at("/t/registry/.mark").value, "mark0");
  }
}

// Random changes at random servers, of which each is cut off now and then: in the end all have the same lists.
TEST(SharedRegistry, AgreesAfterRandomChanges) {
  const std::uint64_t count = tandem::test::seeds(20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream draws{RandomKey{seed}};
    Desks desks(3);
    for (int i = 0; i < 200; ++i) {
      Desk& desk = desks[draws.below(3)];
      const std::string name = "w" + std::to_string(draws.below(5));
      const int number = 1 + static_cast<int>(draws.below(200));
      switch (draws.below(5)) {
        case 0:
          desk.revoke(name);
          break;
        case 1:
          desk.issue(name, i + 1);  // no code is drawn twice
          break;
        case 2:
          desk.directory.cut = !desk.directory.cut;
          break;
        default:
          desk.enroll(name, number);
      }
      desks.pass(Duration{static_cast<std::int64_t>(draws.below(300'000'000))});
    }
    for (const auto& desk : desks.desk) desk->directory.cut = false;
    desks.pass(5s);
    for (const auto& desk : desks.desk) {
      EXPECT_EQ(entries_of(desk->lists), entries_of(desks[0].lists));
      EXPECT_EQ(desk->registry.agreed().entries, desks[0].registry.agreed().entries);
    }
  }
}

}  // namespace
}  // namespace tandem::server
