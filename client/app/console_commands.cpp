#include "client/app/console_commands.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "common/base/format.h"
#include "common/base/unit_suffix.h"

namespace tandem::client {
namespace {

constexpr double kSumSlack = 1e-9;  // tolerance for authority with sum 1

using ParsedCommand = std::expected<ConsoleCommand, std::string>;
using CommandWords = std::span<const std::string>;  // the name of the command and its arguments

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : " ") + w;
  return text;
}

/// Parses authority such as `trainer=0.5,trainee=0.5`.
std::expected<std::vector<std::pair<std::string, double>>, std::string> weights(std::string_view text) {
  std::vector<std::pair<std::string, double>> out;
  double sum = 0;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    const auto sign = part.find('=');
    const auto value = sign == std::string_view::npos ? std::nullopt : number<double>(part.substr(sign + 1));
    if (sign == 0 || !value || !(*value >= 0 && *value <= 1))
      return std::unexpected("authority: \"" + std::string(part) +
                             "\" must be SEAT=AUTHORITY with an authority in [0, 1], such as trainer=0.5,trainee=0.5");
    const std::string seat{part.substr(0, sign)};
    if (std::ranges::find(out, seat, &std::pair<std::string, double>::first) != out.end())
      return std::unexpected("authority: " + seat + " is named twice");
    out.emplace_back(seat, *value);
    sum += *value;
  }
  if (std::abs(sum - 1) > kSumSlack)
    return std::unexpected(format("authority: the values sum to %g; they must sum to 1", sum));
  return out;
}

/// Parses a command without arguments.
template <class Command>
ParsedCommand parse_bare(CommandWords words) {
  if (words.size() == 1) return Command{};
  return std::unexpected(words.front() + ": takes no arguments, and got \"" + joined(words.subspan(1)) + "\"");
}

/// Adds the reason that begins at word `first` to a command.
template <class Command>
ParsedCommand with_reason(Command command, CommandWords words, std::size_t first) {
  command.why = joined(words.subspan(first));
  if (command.why.size() <= rpc::kTextMax) return command;
  return std::unexpected(words.front() + format(": WHY must have at most %zu bytes", rpc::kTextMax));
}

ParsedCommand parse_stop(CommandWords words) { return with_reason(rpc::StopSession{}, words, 1); }
ParsedCommand parse_pause(CommandWords words) { return with_reason(rpc::PauseSession{}, words, 1); }

ParsedCommand parse_resume(CommandWords words) {
  if (words.size() == 1) return rpc::ResumeSession{};
  const auto stop = number<std::uint32_t>(words[1]);
  if (stop && *stop != 0 && words.size() == 2) return rpc::ResumeSession{.stop = *stop};
  return std::unexpected("resume: \"" + joined(words.subspan(1)) +
                         "\" must be the number of a stop, as `status` shows it");
}

ParsedCommand parse_authority(CommandWords words) {
  if (words.size() == 1)
    return std::unexpected("authority: SEAT=AUTHORITY is missing. Example: authority trainer=0.5,trainee=0.5");
  auto given = weights(words[1]);
  if (!given) return std::unexpected(given.error());
  AuthorityCommand command{.weights = std::move(*given)};
  for (const std::string& word : words.subspan(2)) {
    if (word.starts_with("tool=") && word.size() > 5) {
      command.tool = word.substr(5);
    } else if (const auto version = word.starts_with("version=")
                                        ? number<std::uint32_t>(std::string_view(word).substr(8))
                                        : std::nullopt) {
      command.version = version;
    } else {
      return std::unexpected("authority: \"" + word +
                             "\" must be tool=NAME or version=N; values are separated by commas, without spaces");
    }
  }
  return command;
}

ParsedCommand parse_remove(CommandWords words) {
  if (words.size() == 1) return std::unexpected("remove: SEAT is missing. Example: remove trainee");
  return with_reason(rpc::RemoveParticipant{.seat = words[1], .why = {}}, words, 2);
}

ParsedCommand parse_drain(CommandWords words) {
  if (words.size() == 1) return rpc::Drain{};
  const auto grace = number<std::uint32_t>(strip_unit(words[1], "s"));
  if (grace && *grace <= 3600 && words.size() == 2) return rpc::Drain{*grace};
  return std::unexpected("drain: \"" + joined(words.subspan(1)) + "\" must be seconds in [0, 3600]");
}

/// Parses a command with a parser of its arguments.
template <auto parse>
ParsedCommand parse_arguments(CommandWords words) {
  auto parsed = parse({words.begin() + 1, words.end()});
  if (!parsed) return std::unexpected(parsed.error());
  return std::move(*parsed);
}

ParsedCommand parse_record(CommandWords words) {
  if (words.size() == 2 && (words[1] == "start" || words[1] == "stop"))
    return rpc::RecordSession{.on = words[1] == "start"};
  return std::unexpected("record: \"" + joined(words.subspan(1)) + "\" must be start or stop");
}

ParsedCommand parse_end(CommandWords words) {
  if (words.size() == 1) return std::unexpected("end: SESSION is missing. Example: end exam");
  return with_reason(EndCommand{.session = words[1], .why = {}}, words, 2);
}

struct CommandName {
  std::string_view word;
  ParsedCommand (*parse)(CommandWords words);
};
constexpr std::array<CommandName, 14> kCommandNames{{{"status", parse_bare<rpc::StatusRequest>},
                                                     {"stop", parse_stop},
                                                     {"pause", parse_pause},
                                                     {"resume", parse_resume},
                                                     {"authority", parse_authority},
                                                     {"remove", parse_remove},
                                                     {"drain", parse_drain},
                                                     {"create", parse_arguments<parse_creation>},
                                                     {"end", parse_end},
                                                     {"sessions", parse_bare<SessionsCommand>},
                                                     {"note", parse_arguments<parse_note>},
                                                     {"record", parse_record},
                                                     {"help", parse_bare<HelpCommand>},
                                                     {"quit", parse_bare<QuitCommand>}}};

}  // namespace

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::expected<ConsoleCommand, std::string> parse_command(std::span<const std::string> words) {
  const auto found = std::ranges::find(
      kCommandNames, words.empty() ? std::string_view() : std::string_view(words.front()), &CommandName::word);
  if (found == kCommandNames.end())
    return std::unexpected(
        "\"" + (words.empty() ? std::string() : words.front()) +
        "\" is no command; commands: status, stop, pause, resume, authority, remove, drain, create, end, "
        "sessions, note, record");
  return found->parse(words);
}

const char* console_commands_help() noexcept {
  return "  status                                    state of the session: phase, stops, seats, authority; it uses up "
         "a "
         "ticket, as the others do\n"
         "  stop [WHY ...]                            releases all hands until an instructor or operator resumes "
         "(instructor, operator);\n"
         "                                            all participants read WHY\n"
         "  pause [WHY ...]                           the same for roles without the right to stop: trainees and "
         "evaluators, from their seats\n"
         "  resume [STOP]                             ends that stop; without a number the one there is now "
         "(instructor, operator; in a\n"
         "                                            scene without an instructor's seat also the seat that paused)\n"
         "  authority SEAT=A,... [tool=T] [version=V]  authority of the seats over a tool, sum 1 (instructor)\n"
         "  remove SEAT [WHY ...]                     releases that hand and frees the seat (instructor, operator)\n"
         "  drain [SECONDS]                           rejects new joins; after SECONDS releases all hands and ends the "
         "server that\n"
         "                                            --server names; in a service its sessions move before "
         "(operator)\n"
         "  create NAME SCENE [tickets] [time=S] [SEAT=WORKSTATION ...]  opens a session of a scene of the server or "
         "of a "
         "file; prints its code, and a\n"
         "                                            ticket for each SEAT=WORKSTATION; it ends after S seconds "
         "(operator)\n"
         "  end SESSION [WHY ...]                     releases all hands of that session and closes it (operator)\n"
         "  sessions                                  the sessions of the server\n"
         "  note mark|sheet JSON                      writes a mark or a sheet of an assessment (instructor, "
         "operator)\n"
         "  record start|stop                         starts or ends the recording of the session by the server "
         "(instructor, operator)\n"
         "  help, quit                                in the console\n";
}

AccessRole role_for(const ConsoleCommand& command) noexcept {
  return std::holds_alternative<AuthorityCommand>(command) ? AccessRole::kInstructor : AccessRole::kOperator;
}

std::expected<rpc::SetAuthority, std::string> authority_frame(const AuthorityCommand& wish, const rpc::Status& status) {
  std::string names;
  for (const rpc::StatusTool& t : status.tools) names += (names.empty() ? "" : ", ") + t.name;
  if (wish.tool.empty() && status.tools.size() != 1)
    return std::unexpected("authority: tool=NAME is missing; tools: " + names);
  const auto tool =
      wish.tool.empty() ? status.tools.begin() : std::ranges::find(status.tools, wish.tool, &rpc::StatusTool::name);
  if (tool == status.tools.end()) return std::unexpected("authority: no tool \"" + wish.tool + "\"; tools: " + names);
  rpc::SetAuthority frame{.session_id = status.session_id,
                          .tool = static_cast<std::uint32_t>(tool - status.tools.begin()),
                          .version = wish.version.value_or(status.authority_version),
                          .alpha = {}};
  std::string drivers;
  std::vector<std::string> unknown;
  for (const auto& [seat, weight] : wish.weights) unknown.push_back(seat);
  for (const rpc::StatusSeat& s : status.seats) {
    if (!s.master) continue;
    const auto given = std::ranges::find(wish.weights, s.name, &std::pair<std::string, double>::first);
    frame.alpha.push_back(given == wish.weights.end() ? 0.0 : given->second);
    const bool drives = s.role != AccessRole::kEvaluator && s.role != AccessRole::kObserver;
    if (drives) drivers += (drivers.empty() ? "" : ", ") + s.name;
    if (drives || frame.alpha.back() == 0) std::erase(unknown, s.name);
  }
  if (!unknown.empty())
    return std::unexpected("authority: no seat \"" + unknown.front() + "\" that can have authority; seats: " + drivers);
  return frame;
}

std::string refusal_hint(const rpc::Body& command, AccessRole own) {
  if (!std::holds_alternative<rpc::SetAuthority>(command) || own == AccessRole::kInstructor) return {};
  return ". Use an instructor's console: join with an instructor's ticket, or without a ticket by --role instructor";
}

}  // namespace tandem::client
