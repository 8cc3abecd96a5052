#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/profile_report.h"
#include "netsim/app/profile_source.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/profiles/profile_loader.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kPipeWidth = 100;  ///< columns, if the output has no known width

struct ProfilesArguments {
  io::Command command;
  std::string name, svg, capacity;
  double minutes = 30, shown_s = 60, interval_ms = 0;
  std::uint64_t seed = 1;
  bool json = false, text = false, ascii = false;
};

int profiles_usage_error(const std::string& message) {
  return io::report_usage_error("tandem-netsim profiles", message);
}

/// Returns whether the terminal uses UTF-8. As in the C library, the first of these variables that is set names the
/// encoding.
bool speaks_utf8() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const value = std::getenv(variable);
    if (value == nullptr || *value == '\0') continue;
    const std::string_view text(value);
    return text.find("UTF-8") != text.npos || text.find("utf8") != text.npos || text.find("UTF8") != text.npos ||
           text.find("utf-8") != text.npos;
  }
  return false;
}

int list(bool json) {
  std::vector<Profile> all;  // a test reads all shipped profiles; a profile that cannot be read is a bug
  for (const EmbeddedFile& shipped : shipped_profiles())
    if (auto profile = shipped_profile(shipped.name)) all.push_back(std::move(*profile));
  if (json) {
    std::fputs(profiles_json(all).c_str(), stdout);
  } else {
    for (const Profile& profile : all)
      io::print_formatted(stdout, "%-20s %s\n", profile.name.c_str(), profile.summary.c_str());
  }
  return 0;
}

int show(const ProfilesArguments& arguments) {
  auto subject = load_profile_source(arguments.name, from_seconds(arguments.interval_ms * 1e-3));
  if (!subject) return profiles_usage_error(subject.error());
  if (arguments.interval_ms > 0 && !subject->plays_interval)
    return profiles_usage_error("--trace-interval: is for a recording without a column of times, and " +
                                arguments.name + " is none; leave it out");
  if (arguments.text) {
    if (subject->recording)
      return profiles_usage_error("--text: " + arguments.name + " is a recording and has no text of a profile");
    std::fputs(subject->text.c_str(), stdout);
    return 0;
  }
  io::UsageErrors mistakes;
  mistakes.add(complete(*subject, arguments.capacity));
  if (!arguments.svg.empty()) mistakes.add("--svg", io::OutputFile::problem(arguments.svg));
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim profiles");
  const SignalWatcher interruption;
  bool interrupted = false;
  if (!arguments.json) {
    io::print(stdout, profile_heading(*subject));
    std::fflush(stdout);
  }
  io::StatusLine line{isatty(STDERR_FILENO) == 0};
  const ProfilePreviewOptions setup{.link = subject->profile.link,
                                    .seed = arguments.seed,
                                    .length = from_seconds(arguments.minutes * 60),
                                    .shown = from_seconds(arguments.shown_s)};
  const ProfilePreview portrait = preview_profile(setup, [&](double share) {
    if (line.wanted())
      line.show(format("measuring: %.1f of %.1f virtual minutes", share * arguments.minutes, arguments.minutes));
    interrupted = interruption.signalled();
    return !interrupted;
  });
  line.clear();
  if (arguments.json) {
    std::fputs(profile_json(*subject, portrait, interrupted).c_str(), stdout);
  } else {
    const PictureStyle style{io::text_width(stdout).value_or(kPipeWidth), !arguments.ascii && speaks_utf8()};
    io::print(stdout, profile_report(*subject, portrait, style));
  }
  io::OutputFile svg;
  std::string problem = svg.open(arguments.svg, false);
  if (svg.is_open()) svg.write(plot::to_svg_file(profile_figure(*subject, portrait)));
  if (problem.empty()) problem = svg.close();
  if (interrupted)
    SignalWatcher::report("profiles",
                          format("%.2f of %g virtual minutes", seconds(portrait.length) / 60, arguments.minutes));
  if (problem.empty()) return interrupted ? io::kExitTrouble : io::kExitDone;
  io::print_formatted(stderr, "tandem-netsim profiles: --svg: %s\n", problem.c_str());
  return io::kExitTrouble;
}

int profiles_command(const ProfilesArguments& arguments) {
  if (!arguments.name.empty()) return show(arguments);
  for (const char* option : {"--text", "--svg", "--capacity", "--minutes", "--seconds", "--seed", "--trace-interval"})
    if (arguments.command.given(option))
      return profiles_usage_error(
          "--text, --svg, --capacity, --minutes, --seconds, --seed and --trace-interval need NAME");
  return list(arguments.json);
}

}  // namespace

void add_profiles_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "profiles", "Lists the named networks, or shows what one does: measured, judged and drawn.", profiles_command);
  arguments.command = command;
  command.add_option("NAME", arguments.name, "a profile to show, or a file: a .textproto profile, a .csv recording");
  command.add_flag("--json", arguments.json,
                   "for machines: name, version, summary, sources, checks; with NAME also what was measured");
  command.add_flag("--text", arguments.text, "only prints the profile as text: a start for a file of your own");
  command.add_option("--svg", arguments.svg, "also draws it into this file").value_name("FILE.svg");
  command.add_option("--capacity", arguments.capacity, "the recorded capacity that the profile plays (4g-trace)")
      .value_name("FILE");
  command.add_option("--minutes", arguments.minutes, "virtual time to measure; default 30")
      .check(io::number_in(0.05, 1440, "min"))
      .value_name("M");
  command.add_option("--seconds", arguments.shown_s, "how much of the beginning the pictures show; default 60")
      .check(io::number_in(1, 600, "s"))
      .value_name("S");
  command.add_option("--seed", arguments.seed, "the same seed gives the same network; default 1")
      .check(io::whole_number())
      .value_name("N");
  command
      .add_option("--trace-interval", arguments.interval_ms,
                  "time between the rows of a recording without a time column [ms]")
      .check(io::number_in(0.001, 60'000, "ms"))
      .value_name("MS");
  command.add_flag("--ascii", arguments.ascii,
                   "draws pictures with ASCII characters; default on a terminal without UTF-8");
  command.footer(
      "Each profile promises quantiles of its delay (`check` in its file); the table shows them beside the measured "
      "ones.\n"
      "Green, amber and red are what force feedback needs: round trip p99 20 / 100 ms, jitter (p99 - p50) 2 / 10 ms,\n"
      "loss 0.1 / 10 %, no gap above 5 / 50 ms, judged in every 100 ms, 1 s and 10 s.\n\n"
      "Examples\n"
      "  tandem-netsim profiles\n"
      "  tandem-netsim profiles wifi-busy --svg wifi-busy.svg\n"
      "  tandem-netsim profiles 5g --text > mine.textproto\n"
      "  tandem-netsim profiles mine.textproto --minutes 5\n"
      "  tandem-netsim profiles 4g-trace --capacity lte.csv\n\n"
      "Exit: 0 done, 1 trouble while running or interrupted, 2 wrong arguments or files.");
}

}  // namespace tandem::netsim
