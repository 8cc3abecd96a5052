// Workstations of servers whose directory loses its data, in virtual time.
#include <functional>

#include "tests/common/base/counts.h"
#include "tests/server/service/registry_desks.h"

namespace tandem::server {
namespace {

/// Runs a case once per seed, with draws of its own.
/// @param reduced  number of seeds
void for_each_seed(std::uint64_t reduced, const std::function<void(RandomStream)>& run) {
  const std::uint64_t count = tandem::test::seeds(reduced);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    run(RandomStream{RandomKey{seed}});
  }
}

// The server that had written the mark of the lost directory wrote the same mark into the new one: the other servers
// took the missing rows for revocations.
TEST(SharedRegistry, LosesNothingWhenTheDirectoryIsLostWhileServersRun) {
  for_each_seed(100, [](RandomStream draws) {
    LostDesks desks(2 + draws.below(2));
    desks.enroll({"a", "b"});
    for (int loss = 0; loss < 4; ++loss) {
      desks.lose(draws);
      if (draws.below(2) == 0) desks.pass(1s);  // else it is lost again before all have written
    }
    desks.pass(2s);
    desks.expect_all_have({"a", "b"});
    // A revocation is one again.
    desks[draws.below(desks.desk.size())].revoke("a");
    desks.pass(1s);
    for (const auto& d : desks.desk) EXPECT_EQ(d->key_of("a"), 0);
    desks.expect_all_have({"b"});
  });
}

// The new directory has as many revisions as the lost one before a server sees it.
TEST(SharedRegistry, LosesNothingWhenTheNewDirectoryHasMoreRevisionsThanTheLostOne) {
  for_each_seed(50, [](RandomStream draws) {
    LostDesks desks(3);
    desks.enroll({"a"});
    directory::ModelStore next;
    for (std::uint64_t n = draws.below(20); n > 0; --n)
      static_cast<void>(next.execute(1, directory::Transaction{{}, {directory::Put{"/t/other", "x", 0}}, {}}));
    desks.lose(draws, std::move(next));
    desks.pass(2s);
    desks.expect_all_have({"a"});
  });
}

// A server of an older version writes the mark of the lost directory again, at the same revision even.
TEST(SharedRegistry, LosesNothingToAnOlderServerThatWritesTheOldMark) {
  for_each_seed(50, [](RandomStream draws) {
    LostDesks desks(2);
    desks.enroll({"a", "b"});
    const directory::KeyValue mark = desks.store.entries().at("/t/registry/.mark");
    directory::ModelStore next;
    while (next.revision() + 1 < mark.created)
      static_cast<void>(next.execute(1, directory::Transaction{{}, {directory::Put{"/t/other", "x", 0}}, {}}));
    static_cast<void>(next.execute(1, directory::Transaction{{}, {directory::Put{mark.key, mark.value, 0}}, {}}));
    if (draws.below(2) == 0)  // as many revisions as before: only the revision of the mark tells them apart
      for (next = {}; next.revision() < desks.store.revision();)
        static_cast<void>(next.execute(1, directory::Transaction{{}, {directory::Put{mark.key, mark.value, 0}}, {}}));
    const directory::KeyValue again = next.entries().at(mark.key);
    if (again.created == mark.created && next.revision() >= desks.store.revision()) return;
    desks.lose(draws, std::move(next));
    desks.pass(2s);
    desks.expect_all_have({"a", "b"});
  });
}

// A backup that is restored while servers run, against the manual: nothing that came after it is lost.
TEST(SharedRegistry, KeepsWhatCameAfterABackupThatIsRestoredWhileServersRun) {
  for_each_seed(50, [](RandomStream draws) {
    LostDesks desks(2);
    desks.enroll({"a"});
    directory::ModelStore backup = desks.store;
    desks[1].enroll("b", 2);
    desks.pass(1s);
    desks.lose(draws, std::move(backup));
    desks.pass(2s);
    desks.expect_all_have({"a", "b"});
  });
}

// The codes of the backup enrolled a second time, instead of the workstation that had used one, and of one that was
// revoked.
TEST(SharedRegistry, KeepsCodesSpentThatABackupStillHas) {
  for_each_seed(50, [](RandomStream draws) {
    LostDesks desks(2);
    for (const auto& [name, hash] : {std::pair{"used", 9}, {"revoked", 8}, {"unused", 7}}) desks[0].issue(name, hash);
    desks.pass(1s);
    directory::ModelStore backup = desks.store;
    for (const auto& [name, key] : {std::pair{"used", 1}, {"revoked", 2}}) desks[1].enroll(name, key);
    desks.pass(1s);
    desks[0].revoke("revoked");
    desks.pass(1s);
    if (draws.below(2) == 0) {  // a server that was started again meanwhile
      const auth::RegistryLists lists = desks[0].lists;
      const auto agreed = parse_registry_agreement(to_text(desks[0].registry.agreed()));
      ASSERT_TRUE(agreed);
      desks.desk[0] = std::make_unique<Desk>(desks.store, "again", *agreed);
      desks[0].lists = lists;
      desks.pass(100ms);
    }
    desks.lose(draws, std::move(backup));
    desks.pass(2s);
    for (const auto& d : desks.desk) {
      EXPECT_EQ(d->key_of("used"), 1);
      EXPECT_EQ(d->key_of("revoked"), 0);
      ASSERT_EQ(d->lists.codes.size(), 1U);
      EXPECT_EQ(d->lists.codes[0], code("unused", 7));
    }
    EXPECT_FALSE(desks.store.entries().contains("/t/registry/revoked"));
  });
}

TEST(SpentCodes, AreForgottenWhenTheyWouldHaveExpiredOrAreTooMany) {
  SpentCodes spent;
  const auto text = [](const CodeRow& row) { return entries_of({{}, {row}}).begin()->second; };
  const std::string first = text(code("a", 1)), second = text(code("a", 2));
  spent.note("a", first, first);
  spent.note("a", "", first);
  EXPECT_EQ(spent.codes().size(), 0U);
  spent.note("a", first, second);
  EXPECT_EQ(spent.without("a", first), "");
  EXPECT_EQ(spent.without("a", second), second);
  spent.forget_expired(2001);
  EXPECT_EQ(spent.without("a", first), "") << "valid in its last second";
  spent.forget_expired(2002);
  EXPECT_EQ(spent.without("a", first), first);
  for (std::int64_t i = 0; i <= std::int64_t{SpentCodes::kMax}; ++i) {
    CodeRow row{{}, "a", 5000 - i};
    row.hash[0] = std::byte(i % 256);
    row.hash[1] = std::byte(i / 256);
    spent.note("a", text(row), "");
  }
  EXPECT_EQ(spent.codes().size(), SpentCodes::kMax);
  EXPECT_TRUE(std::ranges::none_of(spent.codes(), [](const auto& c) { return c.second == 4000; }));
}

TEST(SharedRegistry, KeepsARevocationThatWasMadeBetweenTheLossOfTheDirectoryAndTheNextOne) {
  for_each_seed(50, [](RandomStream draws) {
    LostDesks desks(2);
    desks.enroll({"a", "b"});
    for (const auto& d : desks.desk) d->directory.cut = true;
    desks.pass(100ms);
    desks[draws.below(2)].revoke("a");
    desks.lose(draws);
    desks.pass(2s);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(desks[i].key_of("a"), 0);
    desks.expect_all_have({"b"});
    desks[draws.below(2)].enroll("a", 7);
    desks.pass(1s);
    desks.expect_all_have({"a", "b"});
  });
}

// A server that starts may hear from the directory before it has read its files.
TEST(SharedRegistry, RevokesNothingBeforeTheFilesWereRead) {
  Desks desks(1);
  desks[0].enroll("a", 1);
  desks.pass(1s);
  for (const bool lost : {false, true}) {
    directory::ModelStore store = lost ? directory::ModelStore{} : desks.store;
    Desk again(store, "two", desks[0].registry.agreed());
    for (int i = 0; i < 100; ++i) {
      desks.now += 20ms;
      while (auto request = again.registry.poll_request(desks.now, again.operation + 1, 1s))
        again.directory.begin(++again.operation, *request);
      while (const auto reply = again.directory.poll()) again.registry.on_reply(*reply);
      EXPECT_FALSE(again.registry.wanted());
    }
    EXPECT_EQ(store.entries().contains("/t/registry/a"), !lost);
    again.lists = desks[0].lists;
    for (int i = 0; i < 100; ++i) again.step(desks.now += 20ms);
    EXPECT_EQ(again.key_of("a"), 1);
    EXPECT_TRUE(store.entries().contains("/t/registry/a"));
  }
}

// `etcdctl del --prefix`.
TEST(SharedRegistry, LosesNothingWhenAllKeysAreErased) {
  Desks desks(2);
  desks[0].enroll("a", 1);
  desks.pass(1s);
  const std::string mark = desks.store.entries().at("/t/registry/.mark").value;
  static_cast<void>(desks.store.execute(
      1, directory::Transaction{{}, {directory::Erase{"/t/registry/.mark"}, directory::Erase{"/t/registry/a"}}, {}}));
  desks.pass(2s);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(desks[i].key_of("a"), 1);
  EXPECT_TRUE(desks.store.entries().contains("/t/registry/a"));
  EXPECT_NE(desks.store.entries().at("/t/registry/.mark").value, mark);
}

}  // namespace
}  // namespace tandem::server
