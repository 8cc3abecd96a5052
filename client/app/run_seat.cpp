#include "client/app/run_seat.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "client/app/device_statistics.h"
#include "client/app/hardware_device.h"
#include "client/app/join_client.h"
#include "client/app/keyboard_controls.h"
#include "client/app/sample_trace.h"
#include "client/app/seat_runner.h"
#include "client/app/seat_supervisor.h"
#include "client/seat/device_facts.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/io/log.h"
#include "common/io/output_file.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "common/setup/device_stiffness.h"
#include "hal/io/open_sim_device.h"
#include "hal/io/recording_motion.h"

namespace tandem::client {
namespace {

int trouble(const std::string& what, int code = io::kExitTrouble) {
  io::log(io::Level::kError, "join: " + what);
  return code;
}

/// Reports a failed join in the log and in the JSON report. @return `code`
int not_attached(const SeatOptions& plan, const std::string& why, int code = io::kExitTrouble) {
  io::log(io::Level::kError, "join: " + why);
  io::OutputFile json;
  if (const auto problem = json.open(plan.json, true); !problem.empty())
    return trouble("--json: " + problem, io::kExitUsage);
  json.write(join_failure_json(plan.join.seat, io::to_text(plan.join.server), plan.device, why));
  if (const auto problem = json.close(); !problem.empty()) return trouble(problem);
  return code;
}

/// Returns why the device cannot be used in this session, because of its axes or its rate; empty if it can.
/// @param caps  capabilities after the scene has set the model of a simulated device
/// @param held  true: hardware, which has its own exchange rate
std::string unfit(const SeatSetup& setup, const hal::DeviceCaps& caps, bool held) {
  if (constexpr double rate = 1 / seconds(HardwareDevice::kPeriod); held && setup.tick_hz > rate * (1 + 1e-9))
    return format(
        "the scene's tick_hz is %.0f, a real device is read %.0f times a second; join a scene with tick_hz 100 to %.0f",
        setup.tick_hz, rate, rate);
  const std::size_t has = setup.port == PortSpace::kTip ? caps.tip_axes : caps.joints;
  if (has >= setup.dof) return {};
  return "the scene needs " + std::to_string(setup.dof) + " axes, the device has " + std::to_string(has);
}

}  // namespace

hal::DeviceCaps known_caps(const hal::DeviceCaps& opened) {
  hal::DeviceCaps caps = opened;
  caps.damping.reset();
  caps.mass.reset();
  caps.stiffness.reset();
  for (hal::AxisLimit& axis : caps.axis) axis = {};
  return caps;
}

int run_seat(const SeatOptions& plan) {
  const io::Fd signals = io::make_signalfd();
  io::StatusLine line{plan.quiet};
  // Hardware is opened before the join, because homing takes the user's time and must not reserve a seat meanwhile.
  std::unique_ptr<HardwareDevice> held;
  if (HardwareDevice::is_hardware_spec(plan.device)) {
    auto taken = HardwareDevice::open(plan.device, signals.get(), line, {.state = plan.join.state});
    if (!taken)
      return not_attached(plan, (taken.error().interrupted ? "" : "--device: ") + taken.error().reason,
                          taken.error().invalid_spec ? io::kExitUsage : io::kExitTrouble);
    held = std::move(*taken);
  }
  JoinOptions options = plan.join;
  options.signals = signals.get();
  if (held) options.caps = held->caps();
  auto given = join_seat(options);
  if (!given) return not_attached(plan, given.error().reason);
  auto socket = io::connect_udp(given->udp);
  if (!socket) return trouble("--server: " + socket.error());
  const std::string server = io::to_text(given->udp);  // of several addresses the one that answered
  const SeatSetup& setup = given->setup;

  const auto refuse = [&](const std::string& why, int code) {
    release_seat(*socket, *given, options.caps);
    return not_attached(plan, why, code);
  };
  std::vector<AuthorityScript::Change> script;
  if (plan.script) {
    if (setup.seat.role != Role::kInstructor || setup.seat.kind != SeatKind::kMaster)
      return refuse("--alpha-script: only the INSTRUCTOR moves authority, and " + setup.seat.name + " is " +
                        to_text(setup.seat.role) + "; give the script to the instructor's client",
                    io::kExitTrouble);
    auto changes = plan.script->for_session(setup.masters, setup.driver_mask);
    if (!changes) return refuse("--alpha-script: " + changes.error(), io::kExitUsage);
    script = std::move(*changes);
  }
  hal::LiveSim live;
  if (!held) {
    auto opened = hal::open_sim_device(plan.device, setup.seat.device, setup.seat.hand, setup.seat.environment,
                                       io::monotonic_now(), hal::recording_motion_reader(setup.seat.name));
    if (!opened) return refuse("--device: " + opened.error().message, io::kExitUsage);
    live = hal::make_live(std::move(*opened), from_seconds(1.0 / setup.tick_hz));
  }
  hal::Device& device = held ? held->device() : *live.device;
  const std::string note = held ? held->note() : live.note;
  const hal::DeviceCaps caps = held ? held->caps() : device.caps();
  if (const std::string why = unfit(setup, caps, held != nullptr); !why.empty())
    return refuse("the device does not fit this scene: " + why, io::kExitTrouble);

  io::OutputFile json, trace;
  if (const auto problem = json.open(plan.json, true); !problem.empty())
    return refuse("--json: " + problem, io::kExitUsage);
  if (const auto problem = trace.open(plan.trace, false); !problem.empty())
    return refuse("--trace: " + problem, io::kExitUsage);
  std::optional<SampleTrace> writer;
  if (trace.is_open()) writer.emplace(trace, caps.joints, caps.prismatic);

  if (held) {
    if (auto ok = device.enable(); !ok) return refuse("--device: " + ok.error().message, io::kExitTrouble);
  }
  line.note("seat " + setup.seat.name + " at " + server + ", " + note);
  if (const std::string softer =
          setup::softened_text(setup::with_limited_stiffness(setup, device_facts(caps)), device_facts(caps));
      !softer.empty())
    line.note(softer);
  Seat seat{setup, caps, given->link};
  io::UdpSocket kept = io::duplicate(*socket);
  const auto runner = std::make_unique<SeatRunner>(std::move(*socket), seat, live.sim, std::move(script),
                                                   writer ? &writer->queue() : nullptr,
                                                   held ? HardwareDevice::kPeriod : Duration::zero());
  const bool by_keys = live.sim != nullptr && live.sim->hand().model() == HandModel::kKeyboard;
  KeyboardControls keyboard{runner->commands(), setup, by_keys ? live.sim->hand().keyboard() : nullptr};
  const io::CpuLatencyRequest awake;
  const bool memory = io::lock_memory();
  if (held) {
    held->attach(*runner);  // the device calls it until `device.close()`
  } else {
    if (auto ok = device.start(*runner); !ok) return trouble(ok.error().message);
    if (auto ok = device.enable(); !ok) return trouble(ok.error().message);
  }

  const Time begin = io::monotonic_now();
  SeatSupervisor vigil{{plan, options, *given, seat, *runner, keyboard, device, held.get(), signals.get(), line},
                       std::move(kept)};
  const ExitReason end = vigil.run();
  const double duration_s = seconds(io::monotonic_now() - begin);
  device.disable();
  device.close();
  line.clear();
  if (writer) writer->finish();

  const ClientReport report{.server = server,
                            .device_note = note,
                            .seconds = duration_s,
                            .outage_longest_s = vigil.outage_longest_s(),
                            .end = end,
                            .last = runner->final_status(),
                            .device = device.stats(),
                            .histograms = device.histograms(),
                            .trace_dropped = writer ? writer->queue().dropped() : 0,
                            .realtime = device.realtime()};
  if (const std::string notice = io::realtime_warning(report.realtime, memory, awake.granted());
      !notice.empty() && report.last.late_ticks > 0)
    line.note(std::to_string(report.last.late_ticks) + " late ticks; " + notice);
  const SeatVerdict verdict = verdict_of(report);
  if (verdict == SeatVerdict::kFail) {
    io::log(io::Level::kError, "join: " + vigil.exit_message(end));
  } else {
    line.note(vigil.exit_message(end));
  }
  for (const std::string& words : summary(report.device, report.histograms)) line.note(words);
  if (verdict == SeatVerdict::kNotJudged) line.note("not judged: the session never ran while this seat was taken");
  json.write(to_json(report, setup));
  for (io::OutputFile* file : {&json, &trace})
    if (const auto problem = file->close(); !problem.empty()) return trouble(problem);
  return verdict == SeatVerdict::kPass ? 0 : io::kExitTrouble;
}

}  // namespace tandem::client
