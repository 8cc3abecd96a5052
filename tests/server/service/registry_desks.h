#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/base/rng.h"
#include "proto/text/registry_text.h"
#include "server/service/shared_registry.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server {

using namespace std::chrono_literals;

inline WorkstationRow workstation(const std::string& name, int key) { return {name, {std::byte(key)}, 1000 + key}; }
inline CodeRow code(const std::string& name, int hash) { return {{std::byte(hash)}, name, 2000 + hash}; }

/// A server with its two lists, as its files have them.
struct Desk {
  Desk(directory::ModelStore& store, std::string drawn, RegistryAgreement agreed = {})
      : directory(store),
        mark(SharedRegistry::mark_key("/t/"), {agreed.mark, agreed.created}, std::move(drawn)),
        registry("/t/", std::move(agreed.entries), std::move(agreed.spent), mark) {}

  void step(Time now) {
    registry.set_local(entries_of(lists));
    while (auto request = registry.poll_request(now, operation + 1, 1s)) directory.begin(++operation, *request);
    while (const auto reply = directory.poll()) registry.on_reply(*reply);
    if (const auto wanted = registry.wanted()) {
      lists = lists_of(*wanted);
      expect_files_hold(lists);
    }
  }
  /// The server's files hold these lists: they are read as they were printed.
  static void expect_files_hold(const auth::RegistryLists& lists) {
    const auto workstations = parse_workstations(print_workstations(lists.workstations), "workstations");
    const auto codes = parse_codes(print_codes(lists.codes), "codes");
    ASSERT_TRUE(workstations) << tandem::to_text(workstations.error());
    ASSERT_TRUE(codes) << tandem::to_text(codes.error());
    EXPECT_EQ((auth::RegistryLists{*workstations, *codes}), lists);
  }
  /// Enrols a key as auth::enroll does: not a key that has another name.
  void enroll(const std::string& name, int key) {
    if (std::ranges::any_of(lists.workstations, [&](const WorkstationRow& row) {
          return row.name != name && row.spki == workstation(name, key).spki;
        }))
      return;
    std::erase_if(lists.workstations, [&](const WorkstationRow& row) { return row.name == name; });
    std::erase_if(lists.codes, [&](const CodeRow& row) { return row.workstation == name; });
    lists.workstations.push_back(workstation(name, key));
  }
  /// Issues a code that no other name has.
  void issue(const std::string& name, int hash) {
    if (std::ranges::any_of(lists.codes, [&](const CodeRow& row) {
          return row.workstation != name && row.hash == code(name, hash).hash;
        }))
      return;
    std::erase_if(lists.codes, [&](const CodeRow& row) { return row.workstation == name; });
    lists.codes.push_back(code(name, hash));
  }
  void revoke(const std::string& name) {
    std::erase_if(lists.workstations, [&](const WorkstationRow& row) { return row.name == name; });
    std::erase_if(lists.codes, [&](const CodeRow& row) { return row.workstation == name; });
  }
  [[nodiscard]] int key_of(const std::string& name) const {
    for (const WorkstationRow& row : lists.workstations)
      if (row.name == name) return std::to_integer<int>(row.spki[0]);
    return 0;
  }

  auth::RegistryLists lists;
  test::CuttableDirectory directory;
  directory::DirectoryMark mark;
  SharedRegistry registry;
  directory::OperationId operation = 0;
};

struct Desks {
  explicit Desks(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) desk.push_back(std::make_unique<Desk>(store, "mark" + std::to_string(i)));
  }
  void pass(Duration time) {
    for (const Time end = now + time; now < end; now += 20ms) {
      store.advance(now);
      for (const auto& d : desk) d->step(now);
    }
  }
  Desk& operator[](std::size_t i) { return *desk[i]; }
  directory::ModelStore store;
  std::vector<std::unique_ptr<Desk>> desk;
  Time now{1s};
};

/// Servers whose directory is lost while they run: it comes back with nothing, or as it was before, and each server
/// reaches it again at a moment of its own.
struct LostDesks : Desks {
  using Desks::Desks;
  /// One name at each of the first servers, on which all have agreed then.
  void enroll(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) (*this)[i].enroll(names[i], static_cast<int>(i) + 1);
    pass(1s);
  }
  void lose(RandomStream& draws, directory::ModelStore next = directory::ModelStore{}) {
    for (const auto& d : desk) d->directory.cut = true;
    pass(100ms);
    store = std::move(next);
    std::vector<Time> back;
    for (std::size_t i = 0; i < desk.size(); ++i)
      back.push_back(now + Duration{static_cast<std::int64_t>(draws.below(500'000'000))});
    for (int n = 0; n < 26; ++n) {
      for (std::size_t i = 0; i < desk.size(); ++i) desk[i]->directory.cut = now < back[i];
      pass(20ms);
    }
    for (const auto& d : desk) d->directory.cut = false;
  }
  void expect_all_have(const std::vector<std::string>& names) {
    for (const auto& d : desk)
      for (const std::string& name : names) EXPECT_NE(d->key_of(name), 0) << name;
    for (const std::string& name : names) EXPECT_TRUE(store.entries().contains("/t/registry/" + name)) << name;
  }
};

}  // namespace tandem::server
