#include "client/app/attend.h"

#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

#include "client/app/ask.h"
#include "client/app/device_statistics.h"
#include "client/app/held_device.h"
#include "client/app/person.h"
#include "client/app/sample_trace.h"
#include "client/app/seat_pump.h"
#include "client/app/vigil.h"
#include "client/device_facts.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/output_file.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "common/setup/device_stiffness.h"
#include "hal/io/open_device.h"

namespace tandem::client {
namespace {

constexpr int kTrouble = 1;         // while running
constexpr int kWrong = 2;           // in arguments or files

int trouble(const std::string& what, int code = kTrouble) {
  spdlog::error("join: {}", what);
  return code;
}

/// Nobody was attached: said, to machines too.
int not_attached(const AttendPlan& plan, const std::string& why, int code = kTrouble) {
  spdlog::error("join: {}", why);
  io::OutputFile json;
  if (const auto problem = json.open(plan.json, true); !problem.empty()) return trouble("--json: " + problem, kWrong);
  json.write(unattended_json(plan.seat, io::to_text(plan.server), plan.device, why));
  if (const auto problem = json.close(); !problem.empty()) return trouble(problem);
  return code;
}

/// Whether the device, now that the scene chose its model, has the axes the session needs; empty if so.
/// @param held  hardware: it has a rate of its own
std::string unfit(const SeatSetup& setup, const hal::DeviceCaps& caps, bool held) {
  if (constexpr double rate = 1 / seconds(HeldDevice::kPeriod); held && setup.tick_hz > rate * (1 + 1e-9))
    return format("the scene's tick_hz is %.0f, a real device is asked %.0f times a second; join a scene with tick_hz 100 to %.0f", setup.tick_hz, rate, rate);
  const std::size_t has = setup.port == PortSpace::kTip ? caps.tip_axes : caps.joints;
  if (has >= setup.dof) return {};
  return "the scene needs " + std::to_string(setup.dof) + " axes, the device has " + std::to_string(has);
}

}  // namespace

hal::DeviceCaps certain_caps(const hal::DeviceCaps& opened) {
  hal::DeviceCaps caps = opened;
  caps.damping.reset();
  caps.mass.reset();
  caps.stiffness.reset();
  for (hal::AxisLimit& axis : caps.axis) axis = {};
  return caps;
}

int attend(const AttendPlan& plan) {
  const io::Fd signals = io::signals_as_file();
  const std::string server = io::to_text(plan.server);
  io::StatusLine line{plan.quiet};
  // Hardware comes first: to home it takes a person's time, and a seat does not wait for that.
  std::unique_ptr<HeldDevice> held;
  if (HeldDevice::is_meant(plan.device)) {
    auto taken = HeldDevice::take(plan.device, signals.get(), line, {.state = plan.state});
    if (!taken)
      return not_attached(plan, (taken.error().interrupted ? "" : "--device: ") + taken.error().reason,
                          taken.error().wrong_words ? kWrong : kTrouble);
    held = std::move(*taken);
  }
  const hal::DeviceCaps asking = held ? held->caps() : plan.caps;
  const Asking wish{plan.server, plan.seat, plan.session, plan.ticket, plan.state, asking, from_seconds(plan.patience_s), signals.get()};
  auto given = ask_for_seat(wish);
  if (!given) return not_attached(plan, given.error().reason);
  auto socket = io::connect_udp(given->udp);
  if (!socket) return trouble("--server: " + socket.error());
  const SeatSetup& setup = given->setup;

  const auto refuse = [&](const std::string& why, int code) {
    give_back(*socket, *given, asking);
    return not_attached(plan, why, code);
  };
  std::vector<AlphaScript::Change> script;
  if (plan.script) {
    if (setup.seat.role != Role::kInstructor || setup.seat.kind != SeatKind::kMaster)
      return refuse("--alpha-script: only the INSTRUCTOR moves authority, and " + setup.seat.name + " is " +
                        to_text(setup.seat.role) + "; give the script to the instructor's client",
                    kTrouble);
    auto changes = plan.script->for_session(setup.masters, setup.drivers);
    if (!changes) return refuse("--alpha-script: " + changes.error(), kWrong);
    script = std::move(*changes);
  }
  hal::LiveSim live;
  if (!held) {
    auto opened =
        hal::open_stepped(plan.device, setup.seat.device, setup.seat.hand, setup.seat.environment, io::monotonic_now());
    if (!opened) return refuse("--device: " + opened.error().message, kWrong);
    live = hal::make_live(std::move(*opened), from_seconds(1.0 / setup.tick_hz));
  }
  hal::Device& device = held ? held->device() : *live.device;
  const std::string note = held ? held->note() : live.note;
  const hal::DeviceCaps caps = held ? held->caps() : device.caps();
  if (const std::string why = unfit(setup, caps, held != nullptr); !why.empty())
    return refuse("the device does not fit this scene: " + why, kTrouble);

  io::OutputFile json, trace;
  if (const auto problem = json.open(plan.json, true); !problem.empty()) return refuse("--json: " + problem, kWrong);
  if (const auto problem = trace.open(plan.trace, false); !problem.empty())
    return refuse("--trace: " + problem, kWrong);
  std::optional<SampleTrace> writer;
  if (trace.wanted()) writer.emplace(trace, caps.joints, caps.prismatic);

  if (held) {
    if (auto ok = device.enable(); !ok) return refuse("--device: " + ok.error().message, kTrouble);
  }
  line.note("seat " + setup.seat.name + " at " + server + ", " + note);
  if (const std::string softer = setup::softened_words(setup::softened(setup, device_facts(caps)), device_facts(caps)); !softer.empty()) line.note(softer);
  Seat seat{setup, caps, given->link};
  io::UdpSocket kept = io::duplicate(*socket);
  const auto pump = std::make_unique<SeatPump>(std::move(*socket), seat, live.sim, std::move(script),
                                               writer ? &writer->queue() : nullptr, held ? HeldDevice::kPeriod : Duration::zero());
  const bool by_keys = live.sim != nullptr && live.sim->hand().model() == HandModel::kKeyboard;
  Person person{*pump, setup, by_keys ? live.sim->hand().keyboard() : nullptr};
  const io::AwakeProcessor awake;
  const bool memory = io::lock_memory();
  if (held) {
    held->serve(*pump);  // until `device.close()`
  } else {
    if (auto ok = device.start(*pump); !ok) return trouble(ok.error().message);
    if (auto ok = device.enable(); !ok) return trouble(ok.error().message);
  }

  const Time begin = io::monotonic_now();
  Vigil vigil{{plan, wish, *given, seat, *pump, person, device, held.get(), signals.get(), line}, std::move(kept)};
  const SeatEnd end = vigil.keep();
  ClientReport report;
  report.seconds = seconds(io::monotonic_now() - begin);
  device.disable();
  device.close();
  line.clear();
  if (writer) writer->finish();

  report.server = server;
  report.device_note = note;
  report.end = end;
  report.last = pump->final_status();
  report.device = device.stats();
  report.histograms = device.histograms();
  report.trace_dropped = writer ? writer->queue().dropped() : 0;
  report.realtime = device.realtime();
  if (const std::string notice = io::realtime_notice(report.realtime, memory, awake.granted());
      !notice.empty() && report.last.late_ticks > 0)
    line.note(std::to_string(report.last.late_ticks) + " late ticks; " + notice);
  report.away_longest_s = vigil.away_longest_s();
  if (verdict_of(report) == SeatVerdict::kFail) {
    spdlog::error("join: {}", vigil.farewell(end));
  } else {
    line.note(vigil.farewell(end));
  }
  for (const std::string& words : summary(report.device, report.histograms)) line.note(words);
  const SeatVerdict verdict = verdict_of(report);
  if (verdict == SeatVerdict::kNotJudged) line.note("not judged: the session never ran while this seat was taken");
  json.write(to_json(report, setup));
  for (io::OutputFile* file : {&json, &trace})
    if (const auto problem = file->close(); !problem.empty()) return trouble(problem);
  return verdict == SeatVerdict::kPass ? 0 : kTrouble;
}

}  // namespace tandem::client
