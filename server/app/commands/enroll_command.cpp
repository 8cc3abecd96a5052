#include <cstdio>

#include "common/auth/enrolment.h"
#include "common/io/command_line.h"
#include "common/io/remote_address.h"
#include "common/io/socket_address.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

struct EnrollArguments {
  std::string name, address, state, hours = "24";
};

constexpr double kHoursMax = 720;

int enroll_command(const EnrollArguments& arguments) {
  io::UsageErrors errors;
  if (!auth::is_valid_name(arguments.name))
    errors.add("NAME", "\"" + arguments.name + "\" must have 1 to 32 characters of A-Z a-z 0-9 _ -");
  std::string hours = arguments.hours;
  errors.add("--hours", io::number_in(0.01, kHoursMax, "h")(hours));
  if (!arguments.address.empty()) errors.add("--address", io::remote_address_error(arguments.address));
  if (!errors.empty()) return print_usage_errors("enroll", errors);

  auto state = open_state(arguments.state);
  if (!state) return print_error("enroll", state.error());
  auth::EnrolmentString out;
  out.address = arguments.address;
  if (out.address.empty()) {
    const auto serving = state->serving().read();
    if (!serving) return print_error("enroll", serving.error());
    if (!*serving)
      return print_usage_error("enroll", "--address is required: " + no_server_text(state->folder()->path()));
    out.address = (*serving)->address;
    if (const auto problem = io::remote_address_error(out.address); !problem.empty())
      return print_usage_error("enroll", "--address is required: the running server listens on " + problem);
  }
  out.server = state->identity().fingerprint();
  auth::fill_random(out.code.bytes);
  const std::int64_t now = auth::wall_seconds();
  const auto life = static_cast<std::int64_t>(std::stod(hours) * 3600.0);
  if (const std::string problem = state->registry().issue_code(out.code, arguments.name, now, now + life);
      !problem.empty())
    return print_error("enroll", problem);
  warn_audit_failure("enroll", *state);
  std::string text = out.to_text();
  std::printf("%s\n", text.c_str());
  wipe(text);
  std::fprintf(stderr, "type on %s, within %s h: tandem-client enroll STRING\nthe string is secret and valid once\n",
               arguments.name.c_str(), hours.c_str());
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_enroll_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "enroll", "Issues a one-time string that enrols one workstation at this server.", enroll_command);
  command.add_option("NAME", arguments.name, "name of the workstation, such as touch-07").value_name(" ").required();
  command
      .add_option("--address", arguments.address,
                  "where workstations reach this server; default: where the running server listens")
      .value_name("HOST:PORT");
  command.add_option("--hours", arguments.hours, "validity of the string [h], 0.01 to 720; default 24").value_name("H");
  add_state_option(command, arguments.state);
  command.footer(
      "Prints one string to standard output: the server's address, the SHA-256 of its key and a code of 128 bits. "
      "The server stores\n"
      "only a hash of it. A second string for the same name makes the first one void. The server may run meanwhile.\n"
      "Exit: 0 done; 1 the state folder cannot be used; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server enroll touch-07 --address lab-server:7000\n"
      "  tandem-server enroll touch-08 --address lab-server:7000 --hours 2 > touch-08.txt");
}

}  // namespace tandem::server
