#include <unistd.h>

#include <cstdio>
#include <optional>
#include <utility>

#include "client/app/commands/client_commands.h"
#include "client/app/run_seat.h"
#include "client/app/try_session.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/log.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "hal/io/open_sim_device.h"
#include "proto/io/scene_file.h"

namespace tandem::client {
namespace {

struct TryArguments {
  std::string scene = "lesson", seat, duration;
};

int try_trouble(const std::string& what, int code = io::kExitTrouble) {
  io::log(io::Level::kError, "try: " + what);
  return code;
}

/// Runs a trial. All child processes have ended when it returns. @return exit code
int try_scene(const SceneSpec& scene, const std::string& scene_text, const SeatSpec& own, double duration_s) {
  const bool by_keys = isatty(STDIN_FILENO) != 0;
  const io::Fd signals = io::make_signalfd();
  const std::vector<std::string> partners = partners_of(scene, own);
  const std::optional<double> longer = TrySession::longer_duration(scene);
  if (longer)
    io::print_formatted(stderr, "the session lasts %.10g s instead of the scene's %.10g s, so that the guidance fits\n",
                        *longer, scene.duration);
  auto programs = TrialPrograms::start(scene_text, partners, longer, signals.get());
  if (!programs) return programs.error().empty() ? io::kExitDone : try_trouble(programs.error());
  const std::string address = programs->address();
  TrySession trial{by_keys, duration_s <= 0, partners, std::move(*programs)};

  SeatOptions plan{.device = by_keys ? "sim:keyboard" : "sim", .duration_s = duration_s, .observer = &trial};
  plan.join.server = *io::parse_address(address, 0);
  plan.join.seat = own.name;
  plan.join.caps = known_caps((*hal::open_sim_device(plan.device, SimDeviceSpec{}, HandSpec{})).device->caps());
  const int code = run_seat(plan);
  trial.stop();
  if (!trial.failure().empty()) return try_trouble(trial.failure());
  io::print_formatted(stderr, "the server and the simulated hands were ended as well\n");
  return code;
}

int try_command(const TryArguments& arguments) {
  io::UsageErrors errors;
  const double duration_s = errors.optional_number("--duration", arguments.duration, 0.1, 3e6, "s");
  const auto scene = load_scene(arguments.scene);
  if (!scene) {
    errors.add(to_text(scene.error()));
    return errors.report("tandem-client try");
  }
  const auto own = seat_for_person(*scene, arguments.seat);
  if (!own) errors.add(own.error());
  if (errors.empty()) return try_scene(*scene, arguments.scene, **own, duration_s);
  return errors.report("tandem-client try");
}

}  // namespace

void add_try_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "try", "Shows a session on this computer: a server, a simulated partner, and your hand moved by keys.",
      try_command);
  command
      .add_option("SCENE", arguments.scene,
                  "a scene file, or the name of a shipped scene (tandem-server scenes); default lesson")
      .value_name(" ");
  command
      .add_option("--seat", arguments.seat,
                  "which seat is yours; default: the instructor's, else the first with authority")
      .value_name("NAME");
  command
      .add_option("--duration", arguments.duration,
                  "leaves after this many seconds; default: at q or Ctrl-C, and without a terminal after the guidance")
      .value_name("S");
  command.footer(
      "Starts tandem-server on a free port of 127.0.0.1, joins it with a simulated hand for every other seat that the "
      "scene requires, and\n"
      "gives you one seat. Twenty seconds of guidance show which keys to press and what they did; the session "
      "of a shorter scene is extended to a minute. The end of this "
      "command, for any reason, ends\n"
      "everything that it started.\n"
      "Exit: 0 left or over; 1 the server or a partner could not be started or failed; 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-client try\n"
      "  tandem-client try contact --seat trainee");
}

}  // namespace tandem::client
