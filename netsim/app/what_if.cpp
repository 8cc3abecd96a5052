#include "netsim/app/what_if.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "hal/sim/hand.h"
#include "hal/sim/lesson_motion.h"
#include "netsim/app/law_options.h"
#include "netsim/feel/observed_feel.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/simulation.h"
#include "server/recording/lesson_record.h"

namespace tandem::netsim {
namespace {

constexpr double kDelayMaxMs = 60'000;

/// Feel of a session, and the RMS distance between a hand that leads and its tool.
class SessionMeasures {
 public:
  explicit SessionMeasures(const SceneSpec& scene) : scene_(&scene), feel_(scene) {}
  void add(const server::TickRecord& record) {
    if (!record.running) return;
    feel_.add(record);
    for (std::size_t i = 0; i < scene_->masters(); ++i) {
      const server::SeatRecord& seat = record.seats[i];
      if (!seat.engaged || seat.alpha <= 0.5) continue;
      const server::ToolRecord& tool = record.tools[scene_->seats[i].tool];
      for (std::size_t k = 0; k < 3; ++k) square_ += (seat.x[k] - tool.x_tool[k]) * (seat.x[k] - tool.x_tool[k]);
      ++ticks_;
    }
  }
  [[nodiscard]] std::vector<std::pair<std::string, double>> values(const std::vector<std::uint32_t>& trips) const {
    auto values = feel_.values(trips);
    const double rms =
        ticks_ > 0 ? std::sqrt(square_ / static_cast<double>(ticks_)) : std::numeric_limits<double>::quiet_NaN();
    values.insert(values.begin(), {"leader_tool_rms_m", rms});
    return values;
  }

 private:
  const SceneSpec* scene_;
  ObservedFeel feel_;
  double square_ = 0;
  std::uint64_t ticks_ = 0;
};

std::optional<double> number_in(std::string_view text, double most) {
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() || !(value >= 0 && value <= most))
    return std::nullopt;
  return value;
}

SessionMeasures measured(const Lesson& lesson) {
  SessionMeasures measures{lesson.scene};
  server::TickRecord record;
  for (std::size_t row = 0; row < lesson.rows(); ++row) {
    server::fill_record(lesson, row, record);
    measures.add(record);
  }
  return measures;
}

}  // namespace

std::string what_if_help() {
  std::string text = "plays the recorded hands under another law or network, and shows both sessions: law=";
  for (const std::string& law : law_names()) text += (text.back() == '=' ? "" : "|") + law;
  return text +
         ",delay=MS,jitter=MS,loss=PERCENT (one way each; without law= the law of the recording, without a number 0)";
}

std::expected<WhatIf, std::string> parse_what_if(const std::string& text) {
  WhatIf out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t cut = part.find('=');
    const std::string key = part.substr(0, cut), value = cut == std::string::npos ? "" : part.substr(cut + 1);
    const auto number = [&](std::optional<double>& into, double most, const char* unit) -> std::string {
      into = number_in(value, most);
      return into ? "" : part + ": must be a number from 0 to " + std::to_string(static_cast<int>(most)) + unit;
    };
    std::string problem;
    if (key == "law") {
      const auto laws = law_names();
      out.law = value;
      if (std::ranges::find(laws, value) == laws.end()) {
        problem = part + ": must be one of:";
        for (const std::string& law : laws) problem += " " + law;
      }
    } else if (key == "delay") {
      problem = number(out.network.delay_ms, kDelayMaxMs, " ms");
    } else if (key == "jitter") {
      problem = number(out.network.jitter_ms, kDelayMaxMs, " ms");
    } else if (key == "loss") {
      problem = number(out.network.loss_percent, 100, " %");
    } else {
      problem = part + ": must be law=NAME, delay=MS, jitter=MS or loss=PERCENT";
    }
    if (!problem.empty()) return std::unexpected(std::move(problem));
  }
  return out;
}

std::expected<WhatIfResult, std::string> play_what_if(const Lesson& lesson, const WhatIf& other) {
  if (lesson.rows() < 2) return std::unexpected("the recording has no session time");
  SimulationConfig setup;
  setup.scene = lesson.scene;
  set_law(setup.scene, other.law, "");
  if (std::string problem = law_conflict(setup.scene, lesson.session); !problem.empty())
    return std::unexpected(std::move(problem));
  setup.scene.duration = lesson.tick.back() / lesson.scene.tick_hz;
  other.network.apply(setup.network);
  for (const SeatSpec& seat : setup.scene.seats) {
    if (seat.kind != SeatKind::kMaster) continue;
    if (!seat.required && hal::sim::seat_was_free(lesson, seat.name)) {
      setup.free_seats.insert(seat.name);
      continue;
    }
    auto motion = hal::sim::motion_of_seat(lesson, seat.name, seat.hand.trajectory.center,
                                           hal::sim::impedance_of(HandModel::kRecorded).k);
    if (!motion) return std::unexpected(motion.error());
    setup.motions[seat.name] = std::move(*motion);
  }
  SessionMeasures played{setup.scene};
  const SimulationResult run =
      run_simulation(setup, {.tick = [&](Simulation& simulation) { played.add(simulation.record()); }});
  if (!run.trouble.empty()) return std::unexpected(run.trouble);
  std::vector<std::uint32_t> trips, recorded_trips(lesson.scene.seats.size());
  for (const server::SeatReport& seat : run.report.seats) trips.push_back(seat.gate_trips);
  for (const LessonLink& link : lesson.links)
    recorded_trips[link.seat] = std::max(recorded_trips[link.seat], link.gate_trips);
  const auto before = measured(lesson).values(recorded_trips), now = played.values(trips);
  WhatIfResult out;
  out.words = "law " + (other.law.empty() ? std::string("of the recording") : other.law) + ", network " +
              (other.network.any() ? other.network.text() : std::string("without delay and loss"));
  for (std::size_t k = 0; k < before.size(); ++k)
    out.numbers.push_back({before[k].first, before[k].second, now[k].second});
  return out;
}

}  // namespace tandem::netsim
