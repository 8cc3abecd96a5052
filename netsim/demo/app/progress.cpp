#include "netsim/demo/app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "common/base/format.h"
#include "common/io/print.h"
#include "common/io/text_layout.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {
constexpr std::size_t kTitle = 50, kBar = 24;  // columns
constexpr double kEvery = 0.2;                 // [s] between two updates of the line
constexpr double kOverhead = 2.5;              // [s] to start and end a run in real time
}  // namespace

double monotonic_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole < 60) return std::to_string(whole) + " s";
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + " min " + (rest.size() < 2 ? "0" : "") + rest + " s";
}

Progress::Progress(std::vector<const RunPlan*> plans, double rate)
    : plans_(std::move(plans)), rate_(rate), terminal_(isatty(STDOUT_FILENO) != 0), begun_(monotonic_seconds()) {}

void Progress::begin(std::size_t run) {
  run_ = run;
  session_s_ = 0;
  run_begun_ = monotonic_seconds();
  shown_ = -1;
  at(0);
}

std::string Progress::remaining() const {
  double session = -session_s_, runs = 0;
  for (std::size_t k = run_; k < plans_.size(); ++k) session += plans_[k]->duration_s, ++runs;
  return duration_text(session / rate_ + (rate_ <= 1 ? kOverhead * (runs - 1) : 0));
}

void Progress::at(double session_s) {
  const double now = monotonic_seconds();
  if (!terminal_ || now - shown_ < kEvery) {
    session_s_ = std::max(session_s_, session_s);
    return;
  }
  session_s_ = std::max(session_s_, session_s);
  shown_ = now;
  const RunPlan& plan = *plans_[run_];
  const std::size_t columns = io::text_width(stdout).value_or(kTitle);
  const std::size_t full = static_cast<std::size_t>(std::clamp(session_s_ / plan.duration_s, 0.0, 1.0) * kBar);
  std::string bar = " ";
  for (std::size_t k = 0; k < kBar; ++k) bar += k < full ? "━" : "╌";
  const std::string title = title_of(plan), number = format("[%zu/%zu] ", run_ + 1, plans_.size());
  const std::string padding(kTitle - std::min(kTitle, io::display_width(title)), ' ');
  const std::string done = format(" %4.1f / %.0f s", session_s_, plan.duration_s), left = ", " + remaining() + " left";
  // The longest form that fits: a line that reaches the margin could not be cleared.
  for (const std::string& line : {number + title + padding + bar + done + left, number + title + done + left,
                                  number + title + done, number + done}) {
    if (io::display_width(line) > columns) continue;
    std::printf("\r\x1b[K%s", line.c_str());
    break;
  }
  std::fflush(stdout);
}

void Progress::end() {
  const double now = monotonic_seconds();
  done_s_ += plans_[run_]->duration_s;
  if (rate_ > 1) rate_ = done_s_ / std::max(1e-3, now - begun_);  // in virtual time: the measured rate
  session_s_ = plans_[run_]->duration_s;
  clear();
  const std::string left = run_ + 1 < plans_.size() ? ", " + remaining() + " left" : "";
  io::print_formatted(stdout, "[%zu/%zu] %s: done in %s s%s\n", run_ + 1, plans_.size(),
                      title_of(*plans_[run_]).c_str(), number_text(now - run_begun_, 1).c_str(), left.c_str());
  std::fflush(stdout);
}

void Progress::clear() const {
  if (!terminal_) return;
  std::printf("\r\x1b[K");
  std::fflush(stdout);
}

}  // namespace tandem::netsim::demo
