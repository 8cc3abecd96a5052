#include "tests/server/service/service_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/common/base/counts.h"
#include "tests/server/directory/model_seeds.h"

namespace tandem::server::test {
namespace {

using directory::test::Schedule;
using directory::test::Verdict;

/// Runs schedules until one fails, and prints how hard they were.
void expect_no_violation(Schedule (*draw)(std::uint64_t), bool losses, std::uint64_t count) {
  const std::uint64_t first = directory::test::first_seed();
  Verdict sum;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Schedule schedule = draw(seed);
    const Verdict verdict = run_service_schedule(schedule);
    ASSERT_TRUE(verdict.violation.empty())
        << verdict.violation << "\nshortened " << to_text(shrink(schedule, run_service_schedule))
        << directory::test::again(seed, "service_model_test");
    sum.recovered = std::max(sum.recovered, verdict.recovered);
    sum.events += verdict.events;
    sum.tickets += verdict.tickets;
    sum.owners += verdict.owners;
    sum.losses += verdict.losses;
    sum.rejected += verdict.rejected;
  }
  const auto per_schedule = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(count); };
  std::printf(
      "[ schedules] %llu; per schedule %.0f events, %.1f openings, %.1f tickets; %llu losses noticed, %llu old "
      "datagrams "
      "rejected; longest recovery %.2f s\n",
      static_cast<unsigned long long>(count), per_schedule(sum.events), per_schedule(sum.owners),
      per_schedule(sum.tickets), static_cast<unsigned long long>(sum.losses),
      static_cast<unsigned long long>(sum.rejected), seconds(sum.recovered));
  EXPECT_GT(sum.owners, count);
  EXPECT_GT(sum.tickets, count);
  if (losses)
    EXPECT_GT(sum.losses, count);
  else
    EXPECT_EQ(sum.losses, 0u) << "a store that has lost nothing was taken for another one";
}

TEST(ServiceModel, HasOneActingServerAndRecoversInAllSchedules) {
  expect_no_violation(directory::test::draw_schedule, false, tandem::test::seeds(1000));
}

TEST(ServiceModel, HasOneActingServerAndRecoversWhenTheStoreLosesItsData) {
  expect_no_violation(directory::test::draw_schedule_with_losses, true, tandem::test::seeds(1000));
}

}  // namespace
}  // namespace tandem::server::test
