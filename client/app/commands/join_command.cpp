#include <unistd.h>

#include <cstdio>
#include <sstream>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/hardware_device.h"
#include "client/app/run_seat.h"
#include "common/io/command_line.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "hal/backends/backend.h"
#include "hal/io/open_sim_device.h"
#include "hal/io/recording_motion.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {
namespace {

/// Arguments as typed. Numbers remain text until parse_command, so that all errors are reported together.
struct JoinArguments {
  ConnectionArguments connection;
  std::string seat, device, script, trace, json, duration, reconnect_timeout = "60";
  bool quiet = false;
};

void check_files(const JoinArguments& arguments, io::UsageErrors& errors) {
  errors.output_file("--json", arguments.json);
  if (!arguments.trace.empty()) errors.add("--trace", io::OutputFile::problem(arguments.trace));
  if (!arguments.trace.empty() && arguments.trace == arguments.json)
    errors.add("--trace", "is the same file as --json");
}

/// Returns the options, and adds all errors.
SeatOptions parse_command(const JoinArguments& arguments, io::UsageErrors& errors) {
  SeatOptions plan{
      .device = arguments.device, .trace = arguments.trace, .json = arguments.json, .quiet = arguments.quiet};
  plan.join = connection_of(arguments.connection, errors);
  plan.join.seat = arguments.seat;
  if (arguments.seat.empty() || arguments.seat.size() > wire::kSeatNameMax)
    errors.add("--seat: a name has 1 to 32 characters");
  if (HardwareDevice::is_hardware_spec(arguments.device)) {
    errors.add(HardwareDevice::spec_errors(arguments.device));
  } else if (const auto device = hal::open_sim_device(arguments.device, SimDeviceSpec{}, HandSpec{}, {}, {},
                                                      hal::recording_motion_reader(arguments.seat))) {
    plan.join.caps = known_caps(device->device->caps());
  } else {
    std::istringstream lines(device.error().message);
    for (std::string line; std::getline(lines, line);)
      errors.add("--device: " + line.substr(line.starts_with("device: ") ? 8 : 0));
  }
  if (arguments.device.find("keyboard") != std::string::npos && isatty(STDIN_FILENO) == 0)
    errors.add("--device " + arguments.device +
               ": the keys are read from a terminal, and standard input is not a terminal");
  if (!arguments.script.empty()) {
    auto script = AuthorityScript::load(arguments.script);
    if (script) {
      plan.script = std::move(*script);
    } else {
      errors.add(script.error());
    }
  }
  check_files(arguments, errors);
  plan.duration_s = errors.optional_number("--duration", arguments.duration, 0.1, 3e6, "s");
  plan.join.timeout = from_seconds(errors.optional_number("--timeout", arguments.connection.timeout, 0.1, 3600, "s"));
  plan.reconnect_timeout_s = errors.optional_number("--reconnect-timeout", arguments.reconnect_timeout, 0, 600, "s");
  plan.join.ticket = ticket_of(arguments.connection.ticket, errors);
  return plan;
}

int join_command(const JoinArguments& arguments) {
  io::UsageErrors errors;
  const SeatOptions plan = parse_command(arguments, errors);
  return errors.empty() ? run_seat(plan) : errors.report("tandem-client join");
}

}  // namespace

void add_join_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("join", "Attaches one device to one seat of a session.", join_command);
  add_server_option(command, arguments.connection);
  add_session_option(command, arguments.connection);
  add_ticket_options(command, arguments.connection.ticket,
                     "ticket that `tandem-server ticket` printed for this workstation; not needed with a session's "
                     "code, or with a loopback server with ephemeral keys");
  add_state_option(command, arguments.connection.state);
  command.add_option("--seat", arguments.seat, "required: which seat of the scene; the server prints their names")
      .value_name("NAME")
      .required();
  command.add_option("--device", arguments.device, "required: device of the seat, see below")
      .value_name("SPEC")
      .required();
  command
      .add_option(
          "--alpha-script", arguments.script,
          "authority over session time: CSV `t_s[s],SEAT[1],...`, rows sum to 1; each change is requested 50 "
          "ms ahead, because the server announces changes that long. A client that joins late requests the newest "
          "change that is due and skips those before it; INSTRUCTOR's seat only")
      .value_name("FILE.csv");
  command.add_option("--trace", arguments.trace, "writes this seat's own samples, one row per servo tick")
      .value_name("FILE.csv");
  command
      .add_option("--json", arguments.json,
                  "writes verdict, link statistics, gate trips, energies, and the device's periods and round trips as "
                  "histograms; `-`: "
                  "to standard output")
      .value_name("FILE|-");
  command
      .add_option("--duration", arguments.duration,
                  "leaves after this many seconds at the seat; default: stays to the end")
      .value_name("S");
  add_timeout_option(command, arguments.connection.timeout);
  command
      .add_option(
          "--reconnect-timeout", arguments.reconnect_timeout,
          "how long to try to reconnect to the seat after the server fell silent or ended, or the network changed [s]; "
          "default 60, at most 600; 0: no attempt, and a silence of 60 s counts as a lost server. A server ends a "
          "session after the same 60 s without data from any client. Your hand is free meanwhile")
      .value_name("S");
  command.add_flag("--quiet", arguments.quiet, "no status");
  std::string hardware;
  for (const hal::Backend* backend : hal::backends()) hardware += backend->help();
  command.footer(
      "Devices\n"
      "  sim                         simulated, as the scene describes the seat's device and hand\n"
      "  sim:hand=NAME               another hand: none leader relaxed resting letting_go tremor keyboard\n"
      "  sim:keyboard                you move the hand: arrow keys and PgUp/PgDn\n"
      "  sim:motion=FILE.csv         a recorded motion moves the hand; behind it, without spaces, also ,columns=PREFIX "
      ",rec=N\n"
      "                              ,scale=auto|S ,axes=+x+y+z ,end=hold|loop ,middle=zero|keep\n"
      "  sim:motion=FILE.mcap        a hand of a recording moves the hand; ,seat=NAME names it (default: that of "
      "--seat)\n" +
      hardware +
      "                              (`tandem-client doctor` lists what is attached; several of a kind need port= or "
      "serial=)\n"
      "Keys: s (or space) stops your hand, S all hands (a pause, unless you are the instructor), r resumes (in a scene "
      "without an\n"
      "instructor's seat: ends your own pause); when the session is stopped the screen shows the origin, the reason "
      "and who can resume it; the instructor\n"
      "moves authority with left/right (a/d with sim:keyboard), 0 and 1; b clears a latched gate;\n"
      "q or Ctrl-C releases the hand and leaves.\n"
      "When the server falls silent the hand is released, within 120 ms (law set_position) or at most 550 ms (law "
      "replica).\n"
      "After 1 s the client reconnects to its seat, until --reconnect-timeout is over; the force comes up slowly from\n"
      "zero where the hand is.\n"
      "Exit: 0 session over or left (verdict pass); 1 refused, server not reachable, server, seat or device lost "
      "(fail), or the session\n"
      "never ran, so that there is nothing to judge (not_judged); 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-client join --server 127.0.0.1:7000 --seat trainer --device sim\n"
      "  tandem-client join --server 127.0.0.1:7000 --seat trainee --device sim:keyboard\n"
      "  tandem-client join --server 127.0.0.1:7000 --seat trainer --device sim:motion=baton.csv,columns=baton\n"
      "      --alpha-script handover.csv --json trainer.json");
}

}  // namespace tandem::client
