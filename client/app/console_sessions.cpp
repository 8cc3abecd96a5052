#include "client/app/console_sessions.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "common/auth/base32.h"
#include "common/auth/ticket.h"
#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/base/suggestions.h"
#include "common/base/unit_suffix.h"
#include "proto/io/scene_file.h"
#include "proto/text/scene_text.h"

namespace tandem::client {
namespace {

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= rpc::kNameMax && std::ranges::all_of(text, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}
std::string name_problem(const std::string& what, const std::string& text) {
  return "create: " + what + " \"" + text + format("\" must be 1 to %zu of A-Z a-z 0-9 _ -", rpc::kNameMax);
}
bool is_file(const std::string& scene) { return scene.find_first_of("/.") != std::string::npos; }

std::string hex(const rpc::Id& id) {
  std::string text;
  for (const std::byte b : id) text += format("%02x", std::to_integer<unsigned>(b));
  return text;
}

std::optional<std::uint32_t> life_in(std::string_view text) {
  const std::string_view digits = strip_unit(text, "s");
  std::uint32_t life = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), life);
  const bool good = error == std::errc{} && end == digits.data() + digits.size() && life >= 1 && life <= rpc::kLifeMaxS;
  return good ? std::optional(life) : std::nullopt;
}

}  // namespace

std::expected<CreateCommand, std::string> parse_creation(const std::vector<std::string>& words) {
  if (words.size() < 2)
    return std::unexpected("create: NAME or SCENE is missing. Example: create exam contact trainee=desk-2");
  CreateCommand command{.name = words[0], .scene = words[1], .holders = {}};
  if (!is_name(command.name)) return std::unexpected(name_problem("NAME", command.name));
  if (!is_file(command.scene) && !is_name(command.scene)) return std::unexpected(name_problem("SCENE", command.scene));
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto sign = word.find('=');
    if (word == "tickets") {
      command.tickets_only = true;
    } else if (word.starts_with("time=")) {
      const auto life = life_in(std::string_view(word).substr(5));
      if (!life)
        return std::unexpected("create: \"" + word + format("\" must be time=SECONDS in [1, %u]", rpc::kLifeMaxS));
      command.life_s = *life;
    } else if (sign != std::string::npos && is_name(word.substr(0, sign)) && is_name(word.substr(sign + 1))) {
      rpc::SeatHolder holder{word.substr(0, sign), word.substr(sign + 1)};
      if (std::ranges::find(command.holders, holder.seat, &rpc::SeatHolder::seat) != command.holders.end())
        return std::unexpected("create: seat " + holder.seat + " is named twice");
      command.holders.push_back(std::move(holder));
    } else {
      return std::unexpected("create: \"" + word + "\" must be SEAT=WORKSTATION, time=SECONDS or tickets");
    }
  }
  if (command.holders.size() > kSeatsMax)
    return std::unexpected(format("create: a session has at most %zu seats", std::size_t{kSeatsMax}));
  return command;
}

std::expected<rpc::Note, std::string> parse_note(const std::vector<std::string>& words) {
  const bool mark = !words.empty() && words[0] == "mark", sheet = !words.empty() && words[0] == "sheet";
  if (!(mark || sheet) || words.size() < 2)
    return std::unexpected("note: must be mark JSON or sheet JSON. Example: note mark '{\"text\": \"good grip\"}'");
  rpc::Note note{.kind = mark ? rpc::NoteKind::kMark : rpc::NoteKind::kSheet, .json = words[1]};
  for (std::size_t i = 2; i < words.size(); ++i) note.json += " " + words[i];
  if (note.json.size() > rpc::kNoteMax)
    return std::unexpected(format("note: has %zu bytes; at most %zu are allowed", note.json.size(), rpc::kNoteMax));
  return note;
}

std::expected<rpc::CreateSession, std::string> creation_order(const CreateCommand& command) {
  rpc::CreateSession order{
      .name = command.name, .tickets_only = command.tickets_only, .life_s = command.life_s, .holders = command.holders};
  if (!is_file(command.scene)) {
    order.scene = command.scene;
    return order;
  }
  const auto text = read_text_file(command.scene);
  if (!text) return std::unexpected(to_text(text.error()));
  if (command.scene.ends_with(".json"))
    return std::unexpected(command.scene + ": the server reads scenes in text format only, not JSON");
  if (text->empty() || text->size() > rpc::kSceneTextMax)
    return std::unexpected(command.scene + format(": has %zu bytes; a scene to send has 1 to %zu. Put a larger one "
                                                  "into the server's folder of scenes and give its name",
                                                  text->size(), rpc::kSceneTextMax));
  if (const auto scene = parse_scene(*text, command.scene); !scene) return std::unexpected(to_text(scene.error()));
  order.scene_text = *text;
  return order;
}

std::expected<rpc::Id, std::string> listed_session(const rpc::SessionList& list, const std::string& typed) {
  for (const rpc::ListedSession& s : list.sessions)
    if (s.name == typed || hex(s.id) == typed) return s.id;
  return std::unexpected("no session \"" + typed + "\" is open; " + suggest_name(typed, list.sessions));
}

std::string created_text(const rpc::SessionCreated& created, const JoinOptions& asked) {
  const rpc::ListedSession& s = created.session;
  std::string text = "created " + s.name + ": " +
                     (created.code.empty() ? std::string("no code") : "code " + auth::grouped(created.code, 5)) +
                     ", id " + hex(s.id) + "\n";
  for (const rpc::ListedSeat& seat : s.seats)
    text += format("  seat %-16s %s%s\n", seat.name.c_str(), std::string(to_text(seat.role)).c_str(),
                   seat.required ? "" : ", optional");
  for (const rpc::SeatTicket& t : created.tickets)
    text += "  ticket of " + t.workstation + " for seat " + t.seat + ": " + auth::ticket_text(t.ticket) + "\n";
  // A user whose console needed no ticket needs neither ticket nor code for a seat.
  const bool by_ticket = !created.tickets.empty() || (created.code.empty() && !asked.ticket.empty());
  const bool by_code = !by_ticket && !asked.ticket.empty();
  // A seat that this way admits, and a simulated device, so that the command works as it is printed.
  const auto admitted = std::ranges::find_if(s.seats, [&](const auto& seat) {
    return !created.tickets.empty() ? seat.name == created.tickets.front().seat
                                    : !by_code || seat.role != AccessRole::kInstructor;
  });
  const std::string seat = admitted == s.seats.end() ? "SEAT" : admitted->name;
  text += "  join: `tandem-client join --server " + io::to_text(asked.server) + " --session " +
          (by_code ? created.code : s.name) + " --seat " + seat +
          (asked.state.empty() ? std::string() : " --state " + shell_quote(asked.state)) +
          (by_ticket ? " --ticket-file FILE" : "") + " --device sim`\n";
  if (by_ticket) text += "    FILE has the ticket of the workstation and the seat in its first line\n";
  if (by_code) text += "    a seat of role INSTRUCTOR needs a ticket, too: --ticket-file FILE\n";
  return text + "    `tandem-client doctor` lists the devices of this computer\n";
}

std::string created_json(const rpc::SessionCreated& created) {
  // Names, codes, ids and tickets need no escaping.
  const rpc::ListedSession& s = created.session;
  std::string text = "{\"session\": \"" + s.name + "\", \"id\": \"" + hex(s.id) +
                     "\", \"code\": " + (created.code.empty() ? "null" : "\"" + created.code + "\"") + ", \"seats\": [";
  for (const rpc::ListedSeat& seat : s.seats)
    text += (&seat == &s.seats.front() ? "" : ", ") + ("{\"name\": \"" + seat.name) + "\", \"role\": \"" +
            std::string(to_text(seat.role)) + "\"}";
  text += "], \"tickets\": [";
  for (const rpc::SeatTicket& t : created.tickets)
    text += (&t == &created.tickets.front() ? "" : ", ") + ("{\"seat\": \"" + t.seat) + "\", \"workstation\": \"" +
            t.workstation + "\", \"ticket\": \"" + auth::ticket_text(t.ticket) + "\"}";
  return text + "]}\n";
}

}  // namespace tandem::client
