#include "server/app/process/session_instance.h"

#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "common/auth/base32.h"
#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/setup/channel_factory.h"
#include "proto/recording/recording_format.h"
#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "server/app/control/session_registry.h"
#include "server/session/build_text.h"
#include "server/session/checkpoint.h"

namespace tandem::server {
namespace {

const char* to_text(EndReason end) {
  constexpr const char* kNames[] = {"scene",       "signal",   "nobody_came", "peers_lost",
                                    "people_left", "operator", "time_limit",  "given_up"};
  return kNames[static_cast<std::size_t>(end)];
}

constexpr const char* kNoneKept = "this server keeps no inputs (recording { inputs_mib: 0 })";

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto s = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return s(used.ru_utime) + s(used.ru_stime);
}

/// Report of a run, with the values that only live sessions have.
std::string report_json(const RunReport& report, EndReason end, std::uint64_t epoch, const SessionSnapshot* kept,
                        const MachineStatus& machine, const TickQueue& queue, std::uint64_t spared,
                        const std::string& waited_for) {
  auto json = nlohmann::ordered_json::parse(to_json(report));
  json.update(nlohmann::ordered_json{
      {"ended_by", to_text(end)},
      {"began", report.duration_s > 0},
      {"waited_for", report.duration_s > 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(waited_for)},
      {"epoch", epoch},
      {"resumed_at_tick",
       kept != nullptr ? nlohmann::ordered_json(kept->checkpoint.session_tick) : nlohmann::ordered_json(nullptr)},
      {"machine",
       {{"late_ticks", machine.late_ticks},
        {"missed_ticks", machine.missed_ticks},
        {"recorder_dropped", queue.dropped()},
        {"recorder_spared", spared},
        {"realtime", machine.realtime}}}});
  return json.dump(2) + "\n";
}

/// Time at which a snapshot was written, by the monotonic clock; now for none.
Time saved_at(const SessionSnapshot* kept) {
  const std::int64_t age_s =
      kept == nullptr ? 0 : std::clamp<std::int64_t>(auth::wall_seconds() - kept->written_s, 0, kResumeLifeS);
  return io::monotonic_now() - std::chrono::seconds(age_s);
}

/// File name such as `contact-20261121T190000Z-0f3a9c11.json`: sorted by time, and unique.
std::string report_name(const std::string& session, const auth::Id16& id) {
  const std::time_t now = auth::wall_seconds();
  std::tm utc{};
  gmtime_r(&now, &utc);
  char when[32];
  std::strftime(when, sizeof when, "%Y%m%dT%H%M%SZ", &utc);
  return session + "-" + when + "-" + auth::to_hex(id).substr(0, 8) + ".json";
}

/// The scene as a file that can be read again. A session that was shortened may end before its scene's timeline, which
/// no file may have: the text then has the duration of the scene.
std::string readable_scene_text(const SessionOptions& options) {
  std::string text = scene_file_text(options.scene);
  if (options.scene_duration == 0 || parse_scene(text, options.scene.name)) return text;
  SceneSpec whole = options.scene;
  whole.duration = options.scene_duration;
  return scene_file_text(whole);
}

}  // namespace

SessionInstance::SessionInstance(const SessionOptions& plan, LocalSlaves slaves, const Opening& opening)
    : options_(&plan),
      id_(opening.kept != nullptr ? opening.kept->id
          : opening.id            ? *opening.id
                                  : auth::random_bytes<auth::Id16>()),
      queue_(TickQueue::capacity_for(plan.scene.seats.size(), plan.scene.tools.size()), plan.scene.seats.size(),
             plan.scene.tools.size()),
      recorder_(plan.scene, queue_, trace_),
      live_session_(std::make_unique<LiveSession>(plan.scene, std::move(slaves), opening.slot, queue_,
                                                  opening.kept != nullptr ? &opening.kept->checkpoint : nullptr,
                                                  saved_at(opening.kept))),
      desk_(std::make_shared<RecordingDesk>(plan.scene.seats.size(), plan.record.pseudonyms)) {
  live_session_->set_recorded(!plan.json.empty() || !plan.trace.empty() || !plan.reports.empty());
}

std::expected<std::unique_ptr<SessionInstance>, SessionInstance::OpenError> SessionInstance::open(
    const SessionOptions& plan, const Opening& opening, InputKeeper& inputs) {
  const SessionSnapshot* const kept = opening.kept;
  const Time now = io::monotonic_now();
  auto slaves = make_local_slaves(plan.scene, now, kept != nullptr ? &kept->checkpoint : nullptr);
  if (!slaves) return std::unexpected(OpenError{io::kExitUsage, slaves.error()});
  std::unique_ptr<SessionInstance> run{new SessionInstance(plan, std::move(*slaves), opening)};
  const RecordingOptions& record = plan.record;
  if (!record.target.empty() && (record.from_start || record.inputs_bytes > 0)) run->keep_inputs(now, inputs, kept);
  run->epoch_ = kept != nullptr ? std::max(kept->checkpoint.epoch + 1, opening.epoch) : opening.epoch;
  if (kept != nullptr) {
    run->snapshot_ = *kept;
    run->resume_until_ = saved_at(kept) + kResumeLife;
  }
  // A restored session keeps its code, because participants have noted it.
  if (opening.with_code)
    run->code_ = kept != nullptr && !kept->code.empty() ? kept->code
                 : !opening.code.empty()                ? opening.code
                                                        : make_session_code();
  if (const auto problem = run->json_.open(plan.json, true); !problem.empty())
    return std::unexpected(OpenError{io::kExitUsage, {"--json: " + problem}});
  if (const auto problem = run->trace_.open(plan.trace, false); !problem.empty())
    return std::unexpected(OpenError{io::kExitUsage, {"--trace: " + problem}});
  return run;
}

std::optional<Time> SessionInstance::return_until() const noexcept {
  if (!snapshot_ || !snapshot_->checkpoint.begun) return std::nullopt;
  const auto seats = std::span(snapshot_->checkpoint.seats).first(options_->scene.seats.size());
  const bool had = std::ranges::any_of(options_->scene.seats, &SeatSpec::required) ||
                   std::ranges::any_of(seats, &Checkpoint::Seat::taken);
  return had ? std::optional(resume_until_) : std::nullopt;
}

void SessionInstance::set_keeper(SnapshotKeeper* keeper) {
  keeper_ = keeper;
  if (keeper == nullptr) return;
  SessionSnapshot kept = snapshot_ ? *snapshot_ : SessionSnapshot{};
  kept.checkpoint = {};
  kept.checkpoint.epoch = epoch_;
  kept.id = id_;
  kept.name = options_->name;
  kept.code = code_;
  kept.written_s = 0;
  kept.life_left_s.reset();
  if (ends_at_)
    kept.life_left_s = std::clamp<std::int64_t>(
        std::chrono::ceil<std::chrono::seconds>(*ends_at_ - io::monotonic_now()).count(), 0, rpc::kLifeMaxS);
  auto mailbox = keeper->add(std::move(kept));
  stored_ = std::shared_ptr<const StoredOrders>(mailbox, &mailbox->stored());
  live_session_->persist_to(std::move(mailbox), epoch_);
}

void SessionInstance::keep_inputs(Time start, InputKeeper& keeper, const SessionSnapshot* kept) {
  transport::HashKey key;
  auth::fill_random(key);
  inputs_ =
      KeptInputs::make(std::make_unique<InputJournal>(
                           key, InputJournal::capacity_for(options_->scene.seats.size(), options_->scene.tools.size())),
                       recording_folder(options_->record.target), options_->record.inputs_bytes);
  live_session_->session().attach_journal(inputs_->journal(), start, build_text(),
                                          kept != nullptr ? &kept->checkpoint : nullptr);
  keeper.add(inputs_);
}

std::string SessionInstance::outcome_text(const RunReport& report) const {
  const std::string stays = end == EndReason::kGivenUp ? "; it stays in the service" : "";
  if (report.duration_s > 0)
    return format("%s, %.1f s", report.verdict_text(), report.duration_s) + (stays.empty() ? "" : " here") + stays;
  return std::string(on_over()   ? "did not begin here"
                     : snapshot_ ? "did not resume after the restart"
                                 : "never began") +
         (missing_seats.empty() ? "" : ": it waited for " + missing_seats) + stays;
}

std::string SessionInstance::start_recording() {
  const RecordingOptions& wanted = options_->record;
  const std::string id = auth::to_hex(id_);
  const SceneSpec& scene = options_->scene;
  RecordingInfo info;
  info.session = options_->name;
  info.scene_text = readable_scene_text(*options_);
  info.metadata = {{"program", std::string("tandem-server")},
                   {"session_id", id},
                   {"epoch", std::to_string(epoch_)},
                   {"seed", std::to_string(options_->seed)},
                   {"duration_s", format("%g", scene.duration)},
                   {"build", std::string(build_text())},
                   {"law", std::string(setup::law_name(scene.channel.law))},
                   {"scene_hash", to_hex(scene_hash(scene))},
                   {"pseudonyms", wanted.pseudonyms ? "true" : "false"}};
  info.round_tools = true;
  info.persons = desk_->persons();
  info.workstations = desk_->workstations();
  std::expected<std::unique_ptr<KeptInputs::Reader>, std::string> inputs = std::unexpected(kNoneKept);
  if (inputs_) inputs = inputs_->read();
  if (!inputs) info.metadata[rec::kNoInputsKey] = inputs.error();
  auto started = LiveRecording::start(
      recording_path(wanted.target, options_->name, id.substr(0, 8), auth::wall_seconds()), *live_session_, info,
      wanted.limits, wanted.pseudonyms, desk_, inputs ? std::move(*inputs) : nullptr);
  if (!started) return started.error();
  recording_ = std::move(*started);
  recorder_.copy_to(recording_->ticks());
  live_session_->set_recording(true);
  return {};
}

void SessionInstance::end_recording() {
  if (!recording_) return;
  live_session_->set_recording(false);
  recorder_.copy_to(nullptr);
  recording_->begin_finish();
  ending_.push_back(std::move(recording_));
}

std::vector<LiveRecording::Message> SessionInstance::service_recordings() {
  std::vector<LiveRecording::Message> all;
  const auto take = [&all](LiveRecording& from) {
    for (LiveRecording::Message& message : from.take_messages()) all.push_back(std::move(message));
  };
  if (std::string why = inputs_ ? inputs_->take_problem() : std::string(); !why.empty())
    all.push_back({true, "inputs_not_kept",
                   "a recording that begins from now on has no inputs, so that it cannot be replayed bit for bit: " +
                       std::move(why)});
  if (recording_ && recording_->done()) end_recording();
  if (recording_) take(*recording_);
  std::erase_if(ending_, [&](const std::unique_ptr<LiveRecording>& recording) {
    const bool done = recording->done();  // before the messages, of which the last come before it is done
    take(*recording);
    return done;
  });
  return all;
}

SessionInstance::Verdict SessionInstance::finish() {
  recorder_.finish();
  const SessionStatus& last = live_session_->final_status();
  std::vector<LinkReport> links;
  for (std::size_t i = 0; i < options_->scene.seats.size(); ++i) links.push_back(last.seats[i].link);
  Verdict verdict{recorder_.builder().build(links), {}, 0};
  RunReport& report = verdict.report;
  report.seed = options_->seed;
  report.violations = live_session_->violations().list();
  report.passed = live_session_->violations().passed();
  report.trace_hash = recorder_.trace_hash();
  report.cpu_s = cpu_seconds();
  if (!options_->json.empty() || !options_->trace.empty() || !options_->reports.empty())
    report.shed_rows = live_session_->skipped_records();
  for (std::size_t i = 0; i < report.seats.size(); ++i)
    report.seats[i].gate_trips = last.seats[i].gate_trips, report.seats[i].taken = last.seats[i].ever_taken;

  const EndReason why = end.value_or(EndReason::kScene);
  const std::string text = report_json(report, why, epoch_, snapshot(), last.machine, queue_,
                                       live_session_->skipped_records(), missing_seats);
  json_.write(text);
  io::OutputFile kept;
  if (!options_->reports.empty() && report.duration_s > 0) {  // as a recording, none of a session that never ran
    verdict.problem = kept.open(options_->reports + "/" + report_name(options_->name, id_), false);
    if (verdict.problem.empty()) kept.write(text);
  }
  for (io::OutputFile* file : {&json_, &trace_, &kept})
    if (const auto problem = file->close(); !problem.empty())
      verdict.problem += (verdict.problem.empty() ? "" : "; ") + problem;  // each file that is cut is named
  const bool completed = (why == EndReason::kScene || why == EndReason::kAllLeft) && report.passed;
  const bool good = verdict.problem.empty() && (completed || why == EndReason::kSignal || why == EndReason::kOperator ||
                                                why == EndReason::kTimeLimit);
  verdict.code = good ? io::kExitDone : io::kExitTrouble;
  return verdict;
}

}  // namespace tandem::server
