#include "netsim/profiles/schedule_loader.h"

#include <gtest/gtest.h>

#include "netsim/engine/schedule.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

LinkSpec delayed(Duration floor) { return link_from({.delay = floor}); }

TEST(Script, KeepsTheBaseLinkForAClientWithoutEvents) {
  const LinkSpec base = delayed(10ms);
  const NetworkEvent events[] = {{.at = 1s, .clients = {"trainee"}, .link = delayed(50ms)}};
  const LinkSchedule schedule = schedule_for(base, events, "trainer");
  EXPECT_EQ(schedule.initial, base);
  EXPECT_TRUE(schedule.changes.empty());
  EXPECT_TRUE(schedule.rebinds.empty());
}

TEST(Script, SortsChangesAndAppliesThemPerDirection) {
  const NetworkEvent events[] = {{.at = 20s, .link = delayed(50ms)},
                                 {.at = 10s, .direction = Direction::kUp, .link = delayed(30ms)},
                                 {.at = 20s, .direction = Direction::kDown, .link = delayed(70ms)},
                                 {.at = 5s, .rebind = Rebind{100ms}}};
  const LinkSchedule schedule = schedule_for(delayed(10ms), events, "client");
  ASSERT_EQ(schedule.changes.size(), 2U);
  EXPECT_EQ(schedule.changes[0].at, 10s);
  EXPECT_EQ(schedule.changes[0].link.up.floor, 30ms);
  EXPECT_EQ(schedule.changes[0].link.down.floor, 10ms);
  EXPECT_EQ(schedule.changes[1].at, 20s);
  EXPECT_EQ(schedule.changes[1].link.up.floor, 50ms);
  EXPECT_EQ(schedule.changes[1].link.down.floor, 70ms);  // equal times: the later one in the text
  ASSERT_EQ(schedule.rebinds.size(), 1U);
  EXPECT_EQ(schedule.rebinds[0].rebind.dead_after, 100ms);
}

TEST(Script, AddsOutagesToEveryLinkAndMergesAChangeAtZero) {
  LinkSpec base = delayed(10ms);
  base.up.outages = {{.start = 1s, .length = 10ms}};
  const NetworkEvent events[] = {{.at = 12s, .direction = Direction::kUp, .outage = OutageSpec{.length = 400ms}},
                                 {.at = 12s + 100ms, .link = delayed(20ms)},
                                 {.link = delayed(15ms)}};
  const LinkSchedule schedule = schedule_for(base, events, "1");
  EXPECT_EQ(schedule.initial.up.floor, 15ms);
  ASSERT_EQ(schedule.changes.size(), 1U);
  const OutageSpec expected{.start = 12s, .length = 400ms};
  // The base's own outage is replaced together with the base.
  EXPECT_EQ(schedule.initial.up.outages, std::vector{expected});
  EXPECT_EQ(schedule.changes[0].link.up.outages, std::vector{expected});
  EXPECT_TRUE(schedule.changes[0].link.down.outages.empty());
}

TEST(Script, RejectsImpossibleEventsWithTheirKey) {
  const auto keys = [](const NetworkEvent& event) {
    std::string all;
    for (const SpecError& problem : problems(event)) all += problem.key + " ";
    return all;
  };
  EXPECT_EQ(keys({.at = 1s, .rebind = Rebind{1s}}), "");
  EXPECT_EQ(keys({.at = 1s}), "event ");
  EXPECT_EQ(keys({.at = 1s, .outage = OutageSpec{.length = 1s}, .rebind = Rebind{}}), "event ");
  EXPECT_EQ(keys({.at = -1s, .rebind = Rebind{}}), "at ");
  EXPECT_EQ(keys({.at = 1s, .direction = Direction::kUp, .rebind = Rebind{2h}}), "rebind.dead_after direction ");
  EXPECT_EQ(keys({.at = 1s, .outage = OutageSpec{.length = 2h}}), "outage.length ");
  LinkSpec bad;
  bad.down.loss.probability = 2;
  EXPECT_EQ(keys({.at = 1s, .link = bad}), "link.down.loss.probability ");
}

TEST(Script, RejectsImpossibleSchedules) {
  LinkSchedule schedule{.initial = delayed(1ms)};
  EXPECT_TRUE(problems(schedule).empty());
  schedule.changes = {{2s, {}}, {2s, {}}};
  schedule.rebinds = {{2s, {}}, {1s, {-1s}}};
  schedule.initial.up.floor = 61s;
  std::string keys;
  for (const SpecError& problem : problems(schedule)) keys += problem.key + " ";
  EXPECT_EQ(keys, "up.floor changes[1].at rebinds[1].at rebinds[1].rebind.dead_after ");
}

// ---- Text form

const std::vector<std::string> kSeats{"trainer", "trainee"};

std::string mistakes(std::string_view text, std::span<const std::string> clients = kSeats) {
  const auto events = parse_script(text, "day.textproto", clients, find_shipped);
  return events ? "none" : to_text(events.error());
}

TEST(ScriptText, ParsesEveryDocumentedEvent) {
  const auto events = parse_script(R"(
      event { at_s: 12 client: "trainee" outage_ms: 400 }
      event { at_s: 20 profile: "4g" direction: DOWN }
      event { at_s: 21.5 outage_ms: 50.25 mode: HOLD hold_bytes: 3000 direction: UP }
      event { at_s: 30 rebind { dead_after_ms: 250 } })",
                                   "day.textproto", kSeats, find_shipped);
  ASSERT_TRUE(events) << to_text(events.error());
  ASSERT_EQ(events->size(), 4U);
  const auto& [outage, profile, hold, rebind] = std::tie((*events)[0], (*events)[1], (*events)[2], (*events)[3]);
  EXPECT_EQ(outage.at, 12s);
  EXPECT_EQ(outage.clients, std::vector<std::string>{"trainee"});
  EXPECT_FALSE(outage.direction);
  ASSERT_TRUE(outage.outage);
  EXPECT_EQ(outage.outage->length, 400ms);
  EXPECT_EQ(outage.outage->mode, OutageSpec::Mode::kDrop);
  ASSERT_TRUE(profile.link);
  EXPECT_EQ(profile.link->down.floor, 14ms);
  EXPECT_EQ(profile.direction, Direction::kDown);
  ASSERT_TRUE(hold.outage);
  EXPECT_EQ(hold.at, 21'500ms);
  EXPECT_EQ(hold.outage->length, 50'250us);
  EXPECT_EQ(hold.outage->mode, OutageSpec::Mode::kHold);
  EXPECT_EQ(hold.outage->hold_bytes, 3000U);
  EXPECT_EQ(hold.direction, Direction::kUp);
  ASSERT_TRUE(rebind.rebind);
  EXPECT_EQ(rebind.rebind->dead_after, 250ms);
}

TEST(ScriptText, ReportsMistakesWithPlaceAndNearestName) {
  EXPECT_EQ(mistakes("event { at_s: 1 outage_ms: 1 }"), "none");
  EXPECT_EQ(mistakes("event {\n at_s: 1\n client: \"trainees\"\n outage_ms: 400 }"),
            "day.textproto:3:10: event[0].client[0] = \"trainees\": no such client; did you mean trainee? known here: "
            "trainer, trainee\n");
  EXPECT_NE(mistakes("event { outage_ms: 400 }").find("event[0].at_s"), std::string::npos);
  EXPECT_NE(mistakes("event { at_s: -1 outage_ms: 4 }").find("day.textproto:1:15: event[0].at_s = -1"),
            std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 }").find("needs exactly one of outage_ms, profile, rebind"), std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 outage_ms: 1 profile: \"4g\" }").find("needs exactly one"), std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 profile: \"4g\" mode: HOLD }").find("mode = HOLD: belongs to outage_ms"),
            std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 outage_ms: 1 hold_bytes: 10 }").find("hold_bytes = 10: needs mode: HOLD"),
            std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 rebind { dead_after_ms: 1 } direction: UP }").find("not with rebind"),
            std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 rebind { } }").find("dead_after_ms"), std::string::npos);
  EXPECT_NE(mistakes("event { at_s: 1 outage: 1 }").find("outage"), std::string::npos);
  EXPECT_NE(mistakes(""), "none");
  const std::string unknown = mistakes("event { at_s: 1\n profile: \"wifi-bussy\" }");
  EXPECT_TRUE(unknown.starts_with("day.textproto:2:11: event[0].profile = \"wifi-bussy\": no profile is called"))
      << unknown;
  EXPECT_NE(unknown.find("did you mean wifi-busy?"), std::string::npos) << unknown;
}

TEST(ScriptText, ReportsMistakesOfAllKindsTogether) {
  const std::string all = mistakes(
      "event { at_s: 1 client: \"trainees\" outage_ms: 0 }\n"
      "event { at_s: -1 profile: \"wifi-bussy\" }\n"
      "event { at_s: 3 outagems: 1 }\n");
  for (const char* part :
       {"1:25: event[0].client[0] = \"trainees\": no such client", "1:47: event[0].outage_ms = 0: must be",
        "2:15: event[1].at_s = -1: must be", "2:27: event[1].profile = \"wifi-bussy\": no profile",
        "3:17: event[2].outagems: unknown key"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
  EXPECT_EQ(std::ranges::count(all, '\n'), 5) << all;
}

TEST(ScriptText, RequiresNumbersForProxyClients) {
  EXPECT_EQ(mistakes("event { at_s: 1 client: \"12\" outage_ms: 1 }", {}), "none");
  for (const char* name : {"0", "-1", "+1", "01", "1x", "", "trainee", "99999999999"}) {
    EXPECT_NE(mistakes("event { at_s: 1 client: \"" + std::string(name) + "\" outage_ms: 1 }", {})
                  .find("must be a whole number from 1"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(mistakes("event { at_s: 1 client: \"2\" client: \"2\" outage_ms: 1 }", {}).find("is named twice"),
            std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
