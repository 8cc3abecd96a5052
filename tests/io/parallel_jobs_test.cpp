#include "common/io/parallel_jobs.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include "common/io/fd.h"

namespace tandem::io {
namespace {

using State = JobResult::State;

/// Work of very different lengths, so that jobs end in another order than they began.
std::string uneven(std::size_t index) {
  double sum = 0;
  for (std::size_t i = 0; i < (index % 3 == 0 ? 2'000'000u : 10u); ++i) sum += std::sin(static_cast<double>(i + index));
  return std::to_string(index) + ":" + std::to_string(sum);
}

TEST(ParallelJobs, GiveTheSameResultsHoweverManyRunAtOnce) {
  std::vector<std::string> one;
  for (const std::size_t jobs : {1u, 2u, 7u, 0u}) {
    std::vector<std::string> texts;
    for (const JobResult& r :
         run_jobs(20, [](std::size_t i, JobProgressReporter) { return uneven(i); }, {.jobs = jobs})) {
      EXPECT_EQ(r.state, State::kDone);
      texts.push_back(r.text);
    }
    ASSERT_EQ(texts.size(), 20u);
    if (one.empty()) one = texts;
    EXPECT_EQ(texts, one) << jobs;
  }
  EXPECT_EQ(one[7], uneven(7));
  EXPECT_TRUE(run_jobs(0, [](std::size_t, JobProgressReporter) { return std::string(); }).empty());
}

TEST(ParallelJobs, KeepOtherResultsWhenAJobCrashes) {
  const auto results = run_jobs(6,
                                [](std::size_t i, JobProgressReporter) -> std::string {
                                  if (i == 1) throw std::runtime_error("no way out");
                                  if (i == 2) {
                                    std::fputs("the last words\n", stderr);
                                    std::abort();
                                  }
                                  if (i == 3) raise(SIGKILL);
                                  if (i == 4) _exit(9);
                                  return std::string(300'000, static_cast<char>('a' + i));  // more than a pipe can hold
                                },
                                {.jobs = 3});
  EXPECT_EQ(results[0].text, std::string(300'000, 'a'));
  EXPECT_EQ(results[5].text, std::string(300'000, 'f'));
  EXPECT_EQ(results[1].state, State::kCrashed);
  EXPECT_EQ(results[1].reason, "threw: no way out");
  EXPECT_EQ(results[2].reason, "ended by signal 6 (Aborted): the last words");
  EXPECT_EQ(results[3].reason, "ended by signal 9 (Killed)");
  EXPECT_EQ(results[4].reason, "ended with code 9");
}

TEST(ParallelJobs, KeepTheSameResultsAfterAFailureForAnyNumberOfJobs) {
  for (const std::size_t jobs : {1u, 2u, 5u}) {
    const auto results = run_jobs(
        30, [](std::size_t i, JobProgressReporter) { return uneven(i); },
        {.jobs = jobs, .keep_going = [](std::size_t index, const JobResult&) { return index != 6 && index != 9; }});
    for (std::size_t i = 0; i < 30; ++i)
      EXPECT_EQ(results[i].state, i <= 6 ? State::kDone : State::kNotRun) << i << " of " << jobs;
  }
}

TEST(ParallelJobs, EndAtOnceOnRequestAndMarkJobsThatWereNotRun) {
  const Fd stop{eventfd(0, EFD_NONBLOCK)};
  const auto results = run_jobs(50,
                                [&](std::size_t i, JobProgressReporter) {
                                  if (i == 3) {
                                    const std::uint64_t one = 1;
                                    if (::write(stop.get(), &one, sizeof one) != sizeof one) std::abort();
                                    pause();  // would never end
                                  }
                                  return uneven(i);
                                },
                                {.jobs = 2, .stop_fd = stop.get()});
  EXPECT_EQ(results[1].state, State::kDone);
  EXPECT_EQ(results[3].state, State::kNotRun);
  EXPECT_EQ(results[49].state, State::kNotRun);
}

TEST(ParallelJobs, ReportProgressUpToTheTotal) {
  std::vector<JobProgress> seen;
  const auto results = run_jobs(4,
                                [](std::size_t i, JobProgressReporter share) {
                                  share.set(0.5);
                                  return uneven(i);
                                },
                                {.jobs = 2, .watch = [&](const JobProgress& p) { seen.push_back(p); }});
  EXPECT_EQ(results.size(), 4u);
  ASSERT_FALSE(seen.empty());
  for (const JobProgress& p : seen) {
    EXPECT_EQ(p.count, 4u);
    EXPECT_LE(p.running, 2u);
    EXPECT_GE(p.share, 0);
  }
  EXPECT_EQ(seen.back().done, 4u);
  EXPECT_EQ(seen.back().share, 1);
  EXPECT_EQ(seen.back().left_s, 0);
}

}  // namespace
}  // namespace tandem::io
