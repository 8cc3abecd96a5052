#include "client/app/attend.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/signalfd.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "client/app/ask.h"
#include "client/app/device_statistics.h"
#include "client/app/held_device.h"
#include "client/app/person.h"
#include "client/app/sample_trace.h"
#include "client/app/seat_pump.h"
#include "common/io/clock.h"
#include "common/io/output_file.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "hal/io/open_device.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kTrouble = 1;         // while running
constexpr int kWrong = 2;           // in arguments or files
constexpr double kServerLost = 10;  // [s] without news
constexpr Duration kLeaveMax = 2s;  // for the gate to ramp out and the server to be told
constexpr int kLookEveryMs = 100;

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
std::string unfit(const SeatSetup& setup, const hal::DeviceCaps& caps) {
  const std::size_t has = setup.port == PortSpace::kTip ? caps.tip_axes : caps.joints;
  if (has >= setup.dof) return {};
  return "the scene needs " + std::to_string(setup.dof) + " axes, the device has " + std::to_string(has);
}

/// Waits for the end, shows the status, hands keys to the person.
SeatEnd watch(SeatPump& pump, Person& person, hal::Device& device, HeldDevice* held, const SeatSetup& setup, const AttendPlan& plan, int signals,
              io::StatusLine& line) {
  io::KeyReader keys;
  if (keys.interactive()) line.note(person.help());
  const Time begin = io::monotonic_now();
  Time shown = begin;
  std::optional<Time> left;
  wire::SessionState before = wire::SessionState::kWaiting;
  bool fault_told = false, wants_force_again = false;
  const auto leave = [&](const char* why) {
    if (left) return;
    line.note(why);
    left = io::monotonic_now();
    pump.leave();
  };
  while (true) {
    pollfd files[] = {{pump.finished_fd(), POLLIN, 0}, {signals, POLLIN, 0}, {keys.fd(), POLLIN, 0}};
    poll(files, keys.interactive() ? 3 : 2, kLookEveryMs);
    if (files[0].revents != 0) break;
    if (files[1].revents != 0) {
      const std::string by{io::signal_that_came()};
      signalfd_siginfo taken;
      [[maybe_unused]] const auto got = ::read(signals, &taken, sizeof taken);
      leave(("ended by " + by + ": letting go").c_str());
    }
    for (std::string key = keys.next(); !key.empty(); key = keys.next()) {
      if (key == "b" && device.phase() == hal::Phase::kFault) wants_force_again = device.reset().has_value();
      if (person.press(key)) leave("letting go");
    }
    if (device.phase() == hal::Phase::kFault && !std::exchange(fault_told, true))
      line.warn("the device has a fault: it gave no whole answer for 10 ms, or its readings jumped as no hand does. No force comes; "
                "look at it, then press b");
    if (wants_force_again && device.phase() == hal::Phase::kReady) {  // a person asked for it, just now
      wants_force_again = fault_told = false;
      static_cast<void>(device.enable());
    }
    if (!left && held != nullptr && held->unguarded())
      leave("somebody ended the process that would send zeros if this program died: letting go; join again");
    const Time now = io::monotonic_now();
    const ClientStatus status = pump.status();
    if (left && now - *left > kLeaveMax) break;  // nobody is there to be told
    if (plan.duration_s > 0 && seconds(now - begin) > plan.duration_s)
      leave("the time given by --duration is over: letting go");
    // Silence alone made the gate ramp out long before.
    if (!left && status.silence_s > kServerLost) return SeatEnd::kServerLost;
    if (status.session != before && status.session == wire::SessionState::kRunning) line.note("the session runs");
    before = status.session;
    if (now - shown >= std::chrono::milliseconds(line.interval_ms())) {
      shown = now;
      line.show(status_line(status, setup));
    }
  }
  if (pump.device_lost()) return SeatEnd::kDeviceLost;
  const ClientStatus last = pump.status();
  if (left || last.close_reason == wire::CloseReason::kLeaving) return SeatEnd::kLeft;
  if (last.close_reason == wire::CloseReason::kRemoved) return SeatEnd::kRemoved;
  if (last.close_reason == wire::CloseReason::kRevoked) return SeatEnd::kRevoked;
  return last.close_reason == wire::CloseReason::kDone ? SeatEnd::kDone : SeatEnd::kServerStopped;
}

const char* farewell(SeatEnd end) {
  switch (end) {
    case SeatEnd::kDone:
      return "the session is over";
    case SeatEnd::kServerStopped:
      return "the server ended the session";
    case SeatEnd::kLeft:
      return "left the seat";
    case SeatEnd::kServerLost:
      return "server lost: no news for 10 s; the force was let go after the first losses. Look at the network and the "
             "server, then "
             "join again";
    case SeatEnd::kDeviceLost:
      return "device lost: it is unplugged or stopped answering; plug it in and join again";
    case SeatEnd::kRemoved:
      return "removed: an instructor or operator took this seat away; ask them. The force was let go gently";
    case SeatEnd::kRevoked:
      return "revoked: this workstation is no longer enrolled there; ask the server's operator. The force was let go gently";
  }
  return "";
}

}  // namespace

int attend(const AttendPlan& plan) {
  const io::Fd signals = io::signals_as_file();
  const std::string server = io::to_text(plan.server);
  io::StatusLine line{plan.quiet};
  // Hardware comes first: to home it takes a person's time, and a seat does not wait for that.
  std::unique_ptr<HeldDevice> held;
  if (HeldDevice::is_meant(plan.device)) {
    auto taken = HeldDevice::take(plan.device, signals.get(), line);
    if (!taken)
      return not_attached(plan, (taken.error().interrupted ? "" : "--device: ") + taken.error().reason,
                          taken.error().wrong_words ? kWrong : kTrouble);
    held = std::move(*taken);
  }
  const hal::DeviceCaps asking = held ? held->caps() : plan.caps;
  auto given = ask_for_seat({plan.server, plan.seat, plan.session, plan.ticket, plan.state, asking, from_seconds(plan.patience_s), signals.get()});
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
  if (const std::string why = unfit(setup, caps); !why.empty())
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
  Seat seat{setup, caps, given->link};
  const auto pump = std::make_unique<SeatPump>(std::move(*socket), seat, live.sim, std::move(script),
                                               writer ? &writer->queue() : nullptr);
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
  const SeatEnd end = watch(*pump, person, device, held.get(), setup, plan, signals.get(), line);
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
  const bool lost = end == SeatEnd::kServerLost || end == SeatEnd::kDeviceLost || end == SeatEnd::kRemoved || end == SeatEnd::kRevoked;
  if (lost) {
    spdlog::error("join: {}", farewell(end));
  } else {
    line.note(farewell(end));
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
