#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "common/auth/io/service_keystore.h"
#include "common/auth/io/write_all.h"
#include "common/base/command_hints.h"
#include "common/base/raw_bytes.h"
#include "common/io/command_line.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/whole_file.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kVoucherDaysMax = auth::Voucher::kLifeMax / auth::Voucher::kDay;
constexpr std::int64_t kGraceDaysMax = auth::KeyChange::kGraceMax / auth::Voucher::kDay;
constexpr std::uintmax_t kMemberFileMax = 64U << 10U;

struct ServiceArguments {
  std::string action, folder, name, key, days = "400", grace = "30", out, state;
  bool new_ticket_key = false, older = false;
};

int service_trouble(const std::string& what) { return print_error("service", what); }

std::string date_text(std::int64_t wall) {
  const std::time_t at = wall;
  std::tm utc{};
  std::array<char, 32> text{};
  if (gmtime_r(&at, &utc) == nullptr) return "?";
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &utc);
  return text.data();
}

std::int64_t seconds_of(const std::string& days) {
  return static_cast<std::int64_t>(std::stod(days) * static_cast<double>(auth::Voucher::kDay));
}

int init_service(const ServiceArguments& arguments) {
  const auto key = auth::ServiceKeystore::init(arguments.folder);
  if (!key) return service_trouble(key.error());
  std::printf("service folder %s\nservice key    %s\n", arguments.folder.c_str(), auth::to_hex(*key).c_str());
  io::print_formatted(
      stderr,
      "next, once for each server: tandem-server service vouch %s --name NAME --key KEY --out FILE, with "
      "the server key that `tandem-server init` printed there\n",
      shell_quote(arguments.folder).c_str());
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

/// Writes a file for its owner only. @return the error
std::string write_member_file(const std::string& path, std::span<const std::byte> text) {
  const io::Fd file{::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, auth::StateDirectory::kFileMode)};
  if (!file.open())
    return path + ": cannot be created: " +
           (errno == EEXIST ? "it exists already; choose another name" : io::write_error_text(errno));
  if (auth::write_all(file.get(), text) && ::fsync(file.get()) == 0) return {};
  const std::string why = io::write_error_text(errno);
  ::unlink(path.c_str());
  return path + ": cannot be written: " + why;
}

int vouch_for_server(const ServiceArguments& arguments) {
  io::UsageErrors errors;
  if (!auth::is_valid_name(arguments.name))
    errors.add("--name", "\"" + arguments.name + "\" must have 1 to 32 characters of A-Z a-z 0-9 _ -");
  const auto server = auth::KeyFingerprint::from_hex(arguments.key);
  if (!server)
    errors.add("--key", "\"" + arguments.key + "\" must be the 64 hex digits that `tandem-server init` printed");
  std::string days = arguments.days;
  errors.add("--days", io::number_in(1, static_cast<double>(kVoucherDaysMax), "days")(days));
  if (arguments.out.empty()) errors.add("--out is required: the member file to write");
  if (!errors.empty()) return print_usage_errors("service", errors);
  const auto service = auth::ServiceKeystore::open(arguments.folder);
  if (!service) return service_trouble(service.error());
  const std::int64_t now = auth::wall_seconds();
  // An hour earlier, for clients whose clocks are late.
  const auth::Voucher voucher{arguments.name, *server, now - 3600, now - 3600 + seconds_of(days)};
  const auto text = service->vouch(voucher);
  if (!text) return service_trouble(text.error());
  if (const std::string problem = write_member_file(arguments.out, text->bytes()); !problem.empty())
    return service_trouble(problem);
  const auto other = service->enter(voucher, now);
  if (!other) {
    io::print_formatted(stderr,
                        "warning: the voucher is not in the list of the service, so a second server of this name will "
                        "not be noticed: %s\n",
                        other.error().c_str());
  } else if (*other) {
    io::print_formatted(
        stderr,
        "warning: the name %s has a voucher until %s for another key, %s. Of two servers with one "
        "name, the second one serves no session while the first one runs. If both are to run, delete %s "
        "and choose another --name; if that server is gone, or has new keys, use the file\n",
        arguments.name.c_str(), date_text((*other)->not_after).c_str(), to_hex((*other)->spki).c_str(),
        arguments.out.c_str());
  }
  std::printf("member file %s\nserver      %s\nvalid until %s\n", arguments.out.c_str(), arguments.name.c_str(),
              date_text(voucher.not_after).c_str());
  io::print_formatted(stderr,
                      "the file is secret: it holds the key that signs tickets. Take it to that server, stop the "
                      "server, run tandem-server service join FILE there, and delete the file\n");
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

void print_membership(const auth::ServiceMembership& membership) {
  std::printf("member      %s\nservice key %s\nvalid until %s\nkey changes %zu (since the service was made)\n",
              membership.name.c_str(), auth::to_hex(membership.service_key).c_str(),
              date_text(membership.not_after).c_str(), membership.key_changes.size());
}

int join_service(const ServiceArguments& arguments) {
  const auto path = auth::server_state_path(arguments.state);
  if (!path) return print_usage_error("service", path.error());
  auto text = io::read_whole_file(arguments.folder, kMemberFileMax);
  if (!text) return service_trouble(text.error());
  const auto membership = auth::ServerKeystore::join_service(*path, bytes_of(*text), arguments.folder,
                                                             auth::wall_seconds(), arguments.older);
  wipe(*text);
  if (!membership) return service_trouble(membership.error());
  std::printf("state folder %s\n", path->c_str());
  print_membership(*membership);
  io::print_formatted(stderr, "tickets that this server signed with another key are void; delete %s\n",
                      arguments.folder.c_str());
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

int rotate_service(const ServiceArguments& arguments) {
  std::string grace = arguments.grace;
  if (const std::string problem = io::number_in(0, static_cast<double>(kGraceDaysMax), "days")(grace); !problem.empty())
    return print_usage_error("service", "--grace-days: " + problem);
  const auto key = auth::ServiceKeystore::rotate(arguments.folder, auth::wall_seconds(), seconds_of(grace),
                                                 arguments.new_ticket_key);
  if (!key) return service_trouble(key.error());
  std::printf("service folder %s\nservice key    %s\n", arguments.folder.c_str(), auth::to_hex(*key).c_str());
  const bool at_once = seconds_of(grace) == 0;
  const std::string when =
      at_once ? "now, as clients that know the new key reject servers with the old one" : "within " + grace + " days";
  io::print_formatted(stderr,
                      "next, for each server, %s: tandem-server service vouch here, and service join there. "
                      "Clients learn the new key from the first server that has it\n",
                      when.c_str());
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

int show_service(const ServiceArguments& arguments) {
  if (!arguments.folder.empty()) {
    const auto service = auth::ServiceKeystore::open(arguments.folder);
    if (!service) return service_trouble(service.error());
    std::printf("service folder %s\nservice key    %s\nkey changes    %zu (since the service was made)\n",
                arguments.folder.c_str(), auth::to_hex(service->public_key()).c_str(), service->key_changes().size());
    return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
  }
  const auto state = open_state(arguments.state);
  if (!state) return service_trouble(state.error());
  std::printf("state folder %s\nserver key  %s\n", state->folder()->path().c_str(),
              state->identity().fingerprint().hex().c_str());
  if (state->membership() == nullptr) {
    std::printf("this server belongs to no service\n");
  } else {
    print_membership(*state->membership());
    if (const std::string problem =
            auth::membership_problem(*state->membership(), state->identity().fingerprint(), auth::wall_seconds());
        !problem.empty())
      return service_trouble(problem);
  }
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

struct ServiceAction {
  const char* name;
  int (*run)(const ServiceArguments& arguments);
  const char* needs;  ///< meaning of the path; empty: it may be missing
};
constexpr std::array kServiceActions{ServiceAction{"init", init_service, "the new folder of the service"},
                                     ServiceAction{"vouch", vouch_for_server, "the folder of the service"},
                                     ServiceAction{"join", join_service, "the member file of this server"},
                                     ServiceAction{"rotate", rotate_service, "the folder of the service"},
                                     ServiceAction{"show", show_service, ""}};

int service_command(const ServiceArguments& arguments) {
  const auto action =
      std::ranges::find(kServiceActions, arguments.action, [](const ServiceAction& a) { return std::string(a.name); });
  if (action == kServiceActions.end()) {
    std::vector<std::string> known;
    for (const ServiceAction& a : kServiceActions) known.emplace_back(a.name);
    return print_usage_error("service",
                             "ACTION: \"" + arguments.action + "\" is unknown; " + suggest(arguments.action, known));
  }
  if (arguments.folder.empty() && *action->needs != '\0')
    return print_usage_error("service", arguments.action + " needs PATH: " + action->needs);
  return action->run(arguments);
}

}  // namespace

void add_service_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "service", "Makes several servers one service: its key, vouchers for its servers, changes of the key.",
      service_command);
  command.add_option("ACTION", arguments.action, "init, vouch, join, rotate or show").value_name(" ").required();
  command
      .add_option("PATH", arguments.folder,
                  "init, vouch, rotate: the folder of the service; join: the member file; show: that folder, or none "
                  "for the server's state folder")
      .value_name(" ");
  command.add_option("--name", arguments.name, "vouch: name of the server in the service, for one server only")
      .value_name("NAME");
  command.add_option("--key", arguments.key, "vouch: key of the server, as `tandem-server init` printed it")
      .value_name("HEX");
  command.add_option("--days", arguments.days, "vouch: validity of the voucher [days], 1 to 1200; default 400")
      .value_name("DAYS");
  command.add_option("--out", arguments.out, "vouch: the member file to write, mode 0600; it must not exist")
      .value_name("FILE");
  command
      .add_option("--grace-days", arguments.grace,
                  "rotate: how long vouchers of the old key stay valid [days], 0 to 400; default 30; 0 if the old key "
                  "may be known to others")
      .value_name("DAYS");
  command.add_flag("--new-ticket-key", arguments.new_ticket_key,
                   "rotate: also replaces the key that signs tickets; tickets issued before are void at each server "
                   "once it has joined again");
  command.add_flag("--older", arguments.older,
                   "join: takes a member file of an older key of the service than the server has now, which undoes a "
                   "rotation at this server");
  add_state_option(command, arguments.state);
  command.footer(
      "Keep the folder of the service on the administrator's computer, not on a server: a user who can read it can add "
      "servers that all\n"
      "workstations trust. `join` needs a stopped server. A client that is enrolled at one server of a service accepts "
      "the others\n"
      "by their vouchers. After `rotate`, each server needs a new member file; clients follow the new key by a "
      "statement signed with the\n"
      "old one.\n"
      "Exit: 0 done; 1 a folder or file cannot be used, or the voucher expired; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server service init ./service\n"
      "  tandem-server service vouch ./service --name desk-a --key 3f9a... --out desk-a.member\n"
      "  tandem-server service join desk-a.member --state ./state\n"
      "  tandem-server service rotate ./service --grace-days 30");
}

}  // namespace tandem::server
