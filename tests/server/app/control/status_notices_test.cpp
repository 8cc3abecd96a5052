// Events and reasons in the status of a session.
#include "server/app/control/status_notices.h"

#include <gtest/gtest.h>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/report/audit_event.h"

namespace tandem::server {
namespace {

SceneSpec lesson() { return *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto"); }

TEST(StatusNotices, KeepTheNewestEventsNumberedAndCut) {
  StatusNotices notices;
  for (std::size_t i = 1; i <= rpc::kStatusEventsMax + 1; ++i) notices.add(std::to_string(i));
  notices.add(std::string(rpc::kTextMax + 1, 'x'));
  const auto& events = notices.events();
  ASSERT_EQ(events.size(), rpc::kStatusEventsMax);
  EXPECT_EQ(events.front().text, "3");
  EXPECT_EQ(events.front().number, 3U);
  EXPECT_EQ(events.back().text, std::string(rpc::kTextMax, 'x'));
  EXPECT_EQ(events.back().number, rpc::kStatusEventsMax + 2);
}

TEST(StatusNotices, ReportEachResumeOnceWithItsOrigin) {
  const SceneSpec scene = lesson();
  StatusNotices notices;
  StopLatch latch;
  notices.update(latch, scene);
  EXPECT_TRUE(notices.events().empty());
  const auto stop_and_resume = [&](std::uint8_t by, std::uint32_t number) {
    static_cast<void>(latch.request(Time{}, AccessRole::kInstructor, by));
    ASSERT_EQ(latch.resume(AccessRole::kInstructor, by, number, ~0U), CommandResult::kDone);
  };
  stop_and_resume(0, 1);
  notices.update(latch, scene, "ann");
  notices.update(latch, scene);
  stop_and_resume(AuditEvent::kControlPlane, 2);
  notices.update(latch, scene);
  stop_and_resume(AuditEvent::kControlPlane, 3);
  notices.set_resume(3, "office (operator)");
  notices.update(latch, scene);
  const auto& events = notices.events();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].text,
            "stop 1 is over: RESUMED by ann at " + scene.seats[0].name + " (instructor); force returns over 0.5 s");
  EXPECT_EQ(events[1].text, "stop 2 is over: RESUMED by a console; force returns over 0.5 s");
  EXPECT_EQ(events[2].text, "stop 3 is over: RESUMED by office (operator); force returns over 0.5 s");
}

}  // namespace
}  // namespace tandem::server
