#include "tests/support/lesson_run.h"

#include <stdexcept>

#include "netsim/system/run_simulation.h"
#include "netsim/system/simulation.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {

Lesson empty_lesson(const SceneSpec& scene) {
  Lesson lesson;
  lesson.session = "lesson of " + scene.name;
  lesson.scene = scene;
  lesson.scene_text = "name: \"" + scene.name + "\"\n";
  lesson.metadata = {{"version", "0.1.0"}, {"seed", "1"}};
  lesson.start_unix_ns = 1'700'000'000'000'000'000;
  lesson.seats.resize(scene.seats.size());
  lesson.tools.resize(scene.tools.size());
  return lesson;
}

void append_record(Lesson& lesson, const server::TickRecord& record) {
  lesson.tick.push_back(record.tick);
  lesson.time_ns.push_back(record.time_ns);
  lesson.running.push_back(record.running ? 1 : 0);
  lesson.stopped_ticks.push_back(record.stopped_ticks);
  lesson.dropped_ticks.push_back(record.dropped_ticks);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    const server::SeatRecord& from = record.seats[i];
    LessonSeat& to = lesson.seats[i];
    to.fresh.push_back(to.sample_tick.empty() || to.sample_tick.back() != from.sample_tick ? 1 : 0);
    to.sample_tick.push_back(from.sample_tick);
    to.q.push_back(from.q);
    to.x.push_back(from.x);
    to.v.push_back(from.v);
    to.f.push_back(from.f_out);
    to.f_cmd.push_back(from.f_cmd);
    to.alpha.push_back(from.alpha);
    to.engaged.push_back(from.engaged ? 1 : 0);
    to.gate.push_back(static_cast<std::uint8_t>(from.gate));
    to.leader.push_back(from.leader);
    to.ghost.push_back(from.ghost);
    to.e_in.push_back(from.e_in);
    to.e_out.push_back(from.e_out);
    to.dissipated_j.push_back(from.dissipated_j);
    to.refused_j.push_back(from.refused_j);
    to.margin_min_j.push_back(from.margin_min_j);
    to.delivered_j.push_back(from.delivered_j);
  }
  for (std::size_t j = 0; j < lesson.tools.size(); ++j) {
    const server::ToolRecord& from = record.tools[j];
    LessonTool& to = lesson.tools[j];
    to.q.push_back(from.q);
    to.x.push_back(from.x);
    to.x_tool.push_back(from.x_tool);
    to.f_cmd.push_back(from.f_cmd);
    to.f_env.push_back(from.f_env);
    to.penetration.push_back(from.penetration);
    to.held.push_back(from.held ? 1 : 0);
    to.alpha.push_back(from.alpha);
    to.mfs_j.push_back(from.mfs_j);
    to.e_p_j.push_back(from.e_p_j);
    to.e_p_axis_j.push_back(from.e_p_axis_j);
    to.sample_tick.push_back(from.sample_tick);
  }
}

LessonRun lesson_of(const std::string& scene, double duration_s, std::uint64_t seed) {
  SceneSpec spec = shipped(scene);
  spec.duration = duration_s;
  LessonRun run;
  run.lesson = empty_lesson(spec);
  netsim::SimulationObserver observer;
  observer.trace = [&run](std::string_view rows) { run.trace += rows; };
  observer.tick = [&run](netsim::Simulation& simulation) {
    if (simulation.record().running) append_record(run.lesson, simulation.record());
  };
  const netsim::SimulationResult result = netsim::run_simulation({spec, {}, seed}, observer);
  if (!result.trouble.empty()) throw std::runtime_error(result.trouble);
  return run;
}

}  // namespace tandem::test
