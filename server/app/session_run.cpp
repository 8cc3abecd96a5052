#include "server/app/session_run.h"

#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/trust/base32.h"
#include "server/app/house.h"

namespace tandem::server {
namespace {

constexpr int kFailed = 1, kTrouble = 1, kWrong = 2;
/// Two seconds of ticks at 1 kHz: how long the recorder may be kept from running before ticks are dropped and counted.
constexpr std::size_t kQueueTicks = 2048;

const char* to_text(End end) {
  constexpr const char* kNames[] = {"scene", "signal", "nobody_came", "peers_lost", "people_left"};
  return kNames[static_cast<std::size_t>(end)];
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto s = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return s(used.ru_utime) + s(used.ru_stime);
}

/// The report of every run, and what only a live one knows.
std::string live_json(const RunReport& report, End end, std::uint64_t epoch, const KeptSession* kept, const MachineStatus& machine, const TickQueue& queue,
                      std::uint64_t spared, const std::string& waited_for) {
  auto json = nlohmann::ordered_json::parse(to_json(report));
  json["ended_by"] = to_text(end);
  json["began"] = report.duration_s > 0;
  json["waited_for"] = report.duration_s > 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(waited_for);
  json["epoch"] = epoch;
  json["resumed_at_tick"] = kept != nullptr ? nlohmann::ordered_json(kept->checkpoint.session_tick) : nlohmann::ordered_json(nullptr);
  json["machine"] = {{"late_ticks", machine.late_ticks},
                     {"missed_ticks", machine.missed_ticks},
                     {"recorder_dropped", queue.dropped()},
                     {"recorder_spared", spared},
                     {"realtime", machine.realtime}};
  return json.dump(2) + "\n";
}

/// `contact-20261121T190000Z-0f3a9c11.json`: sorted by time, never twice the same.
std::string report_name(const std::string& session, const trust::Id16& id) {
  const std::time_t now = trust::wall_seconds();
  std::tm utc{};
  gmtime_r(&now, &utc);
  char when[32];
  std::strftime(when, sizeof when, "%Y%m%dT%H%M%SZ", &utc);
  return session + "-" + when + "-" + trust::to_hex(id).substr(0, 8) + ".json";
}

}  // namespace

SessionRun::SessionRun(const SessionPlan& plan, Slaves slaves, std::uint8_t slot, const KeptSession* kept)
    : plan_(&plan),
      id_(kept != nullptr ? kept->id : trust::random_bytes<trust::Id16>()),
      queue_(kQueueTicks),
      recorder_(plan.scene, queue_, trace_),
      hosted_(std::make_unique<HostedSession>(plan.scene, std::move(slaves), slot, queue_, kept != nullptr ? &kept->checkpoint : nullptr)) {}

std::expected<std::unique_ptr<SessionRun>, SessionRun::Trouble> SessionRun::open(const SessionPlan& plan, std::uint8_t slot, std::uint64_t epoch, bool with_code,
                                                                               const KeptSession* kept) {
  const Time now = io::monotonic_now();
  auto slaves = make_slaves(plan.scene, now, kept != nullptr ? &kept->checkpoint : nullptr);
  if (!slaves) return std::unexpected(Trouble{kWrong, slaves.error()});
  std::unique_ptr<SessionRun> run{new SessionRun(plan, std::move(*slaves), slot, kept)};
  run->epoch_ = kept != nullptr ? kept->checkpoint.epoch + 1 : epoch;
  if (kept != nullptr) {
    run->kept_ = *kept;
    const std::int64_t age_s = std::clamp<std::int64_t>(trust::wall_seconds() - kept->written_s, 0, kResumeLifeS);
    run->back_until_ = now + kResumeLife - std::chrono::seconds(age_s);
  }
  if (with_code) run->code_ = kept != nullptr && !kept->code.empty() ? kept->code : draw_session_code();  // people have it on paper
  if (const auto problem = run->json_.open(plan.json, true); !problem.empty()) return std::unexpected(Trouble{kWrong, {"--json: " + problem}});
  if (const auto problem = run->trace_.open(plan.trace, false); !problem.empty()) return std::unexpected(Trouble{kWrong, {"--trace: " + problem}});
  return run;
}

std::string SessionRun::how_it_went(const RunReport& report) const {
  if (report.duration_s > 0) return format("%s, %.1f s", report.verdict_words(), report.duration_s);
  return std::string(kept_ ? "never went on after the restart" : "never began") + (waited_for.empty() ? "" : ": it waited for " + waited_for);
}

SessionRun::Verdict SessionRun::finish() {
  recorder_.finish();
  const SessionStatus& last = hosted_->final_status();
  std::vector<LinkReport> links;
  for (std::size_t i = 0; i < plan_->scene.seats.size(); ++i) links.push_back(last.seats[i].link);
  Verdict verdict{recorder_.builder().build(links), {}, 0};
  RunReport& report = verdict.report;
  report.seed = plan_->seed;
  report.violations = hosted_->violations().list();
  report.passed = hosted_->violations().passed();
  report.trace_hash = recorder_.trace_hash();
  report.cpu_s = cpu_seconds();
  for (std::size_t i = 0; i < report.seats.size(); ++i) report.seats[i].gate_trips = last.seats[i].gate_trips, report.seats[i].taken = last.seats[i].ever_taken;

  const End why = end.value_or(End::kScene);
  const std::string text = live_json(report, why, epoch_, kept(), last.machine, queue_, hosted_->spared(), waited_for);
  json_.write(text);
  io::OutputFile kept;
  if (!plan_->reports.empty()) {
    verdict.problem = kept.open(plan_->reports + "/" + report_name(plan_->name, id_), false);
    if (verdict.problem.empty()) kept.write(text);
  }
  for (io::OutputFile* file : {&json_, &trace_, &kept})
    if (const auto problem = file->close(); !problem.empty() && verdict.problem.empty()) verdict.problem = problem;
  if (!verdict.problem.empty()) {
    verdict.code = kTrouble;
  } else if (why == End::kScene || why == End::kPeopleLeft) {
    verdict.code = report.passed ? 0 : kFailed;
  } else {
    verdict.code = why == End::kSignal ? 0 : kTrouble;
  }
  return verdict;
}

}  // namespace tandem::server
