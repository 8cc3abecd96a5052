#include "tests/server/directory/model_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/format.h"
#include "tests/common/base/counts.h"
#include "tests/server/directory/model_seeds.h"

namespace tandem::directory::test {
namespace {

using namespace std::chrono_literals;

TEST(OwnershipModel, HasOneOwnerUsesNoTicketTwiceAndRecoversInAllSchedules) {
  const std::uint64_t first = first_seed(), count = tandem::test::seeds(1000);
  Verdict sum;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Schedule schedule = draw_schedule(seed);
    const Verdict verdict = run_schedule(schedule);
    ASSERT_TRUE(verdict.violation.empty())
        << verdict.violation << "\nshortened "
        << to_text(shrink(schedule, [](const Schedule& s) { return run_schedule(s); }))
        << again(seed, "directory_model_test");
    sum.recovered = std::max(sum.recovered, verdict.recovered);
    sum.events += verdict.events;
    sum.tickets += verdict.tickets;
    sum.owners += verdict.owners;
    sum.rejected += verdict.rejected;
    sum.doubtful += verdict.doubtful;
  }
  std::printf(
      "[ schedules] %llu; per schedule %.0f events, %.1f owners, %.1f tickets; %llu old datagrams rejected, %llu "
      "renewals "
      "doubted; longest recovery %.2f s\n",
      static_cast<unsigned long long>(count), static_cast<double>(sum.events) / static_cast<double>(count),
      static_cast<double>(sum.owners) / static_cast<double>(count),
      static_cast<double>(sum.tickets) / static_cast<double>(count), static_cast<unsigned long long>(sum.rejected),
      static_cast<unsigned long long>(sum.doubtful), seconds(sum.recovered));
  // The faults reach what they are for.
  EXPECT_GT(sum.owners, count);
  EXPECT_GT(sum.tickets, count);
  EXPECT_GT(sum.rejected, 0U);
  EXPECT_GT(sum.doubtful, 0U);
}

TEST(OwnershipModel, RepeatsAScheduleExactly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Verdict one = run_schedule(draw_schedule(seed)), two = run_schedule(draw_schedule(seed));
    EXPECT_EQ(one.fingerprint, two.fingerprint) << "seed " << seed;
    EXPECT_EQ(one.events, two.events) << "seed " << seed;
  }
}

class WithoutGuard : public testing::TestWithParam<Guard> {};

TEST_P(WithoutGuard, AScheduleFails) {
  constexpr std::uint64_t kMost = 20'000;
  for (std::uint64_t seed = 1; seed <= kMost; ++seed) {
    const Schedule schedule = draw_schedule(seed);
    const Verdict verdict = run_schedule(schedule, GetParam());
    if (verdict.violation.empty()) continue;
    ASSERT_EQ(run_schedule(schedule).violation, "") << "seed " << seed << " fails with the guard, too";
    std::printf("[  found   ] without '%s': %s\nshortened %s\n", to_text(GetParam()), verdict.violation.c_str(),
                to_text(shrink(schedule, [](const Schedule& s) { return run_schedule(s, GetParam()); })).c_str());
    return;
  }
  FAIL() << "none of " << kMost << " schedules notices that this guard is missing: " << to_text(GetParam());
}

INSTANTIATE_TEST_SUITE_P(OwnershipModel, WithoutGuard, testing::ValuesIn(kGuards), [](const auto& one) {
  std::string name = to_text(one.param);
  std::ranges::replace(name, ' ', '_');
  return name;
});

}  // namespace
}  // namespace tandem::directory::test
