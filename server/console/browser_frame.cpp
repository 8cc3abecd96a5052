#include "server/console/browser_frame.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/auth/key_fingerprint.h"
#include "common/base/sanitize.h"
#include "proto/rpc/rpc_texts.h"
#include "server/console/join_body.h"
#include "server/policy/roles.h"

namespace tandem::console {
namespace {

using nlohmann::json;

constexpr double kPointerMaxM = 10;  // of each coordinate of a pointer [m]
constexpr double kTimeMaxS = 1e9, kPointsMax = 1000;
constexpr std::size_t kItemsMax = 16, kItemMax = 40,
                      kMarkMax = 1000;  // items of a sheet; name of one, text of a mark [bytes]

/// Reader of one object. The first mistake counts; later reads return defaults.
class Reader {
 public:
  explicit Reader(const json& object) : object_(object) {}

  void only(std::initializer_list<std::string_view> keys) {
    for (const auto& [key, value] : object_.items())
      if (std::ranges::find(keys, key) == keys.end()) fail("unknown key \"" + sanitize(key, 32) + "\"");
  }
  std::uint64_t integer(const char* key, std::uint64_t max) {
    const auto found = object_.find(key);
    if (found != object_.end() && found->is_number_unsigned() && found->get<std::uint64_t>() <= max)
      return found->get<std::uint64_t>();
    fail("\"" + std::string(key) + "\" must be an integer in [0, " + std::to_string(max) + "]");
    return 0;
  }
  std::uint32_t integer32(const char* key, std::uint32_t max = std::numeric_limits<std::uint32_t>::max()) {
    return static_cast<std::uint32_t>(integer(key, max));
  }
  std::string text(const char* key, std::size_t max) {
    const auto found = object_.find(key);
    if (found != object_.end() && found->is_string()) {
      const auto& value = found->get_ref<const std::string&>();
      if (value.size() <= max && sanitize(value, max) == value) return value;
    }
    fail("\"" + std::string(key) + "\" must be a text of at most " + std::to_string(max) +
         " bytes without control characters");
    return {};
  }
  /// A name by the rule of the server.
  std::string name(const char* key) {
    std::string value = text(key, rpc::kNameMax);
    if (!rpc::is_name(value)) fail("\"" + std::string(key) + "\" must be " + std::string(rpc::kNameRule));
    return value;
  }
  std::vector<double> authority(const char* key) {
    std::vector<double> values;
    const auto found = object_.find(key);
    double sum = 0;
    if (found != object_.end() && found->is_array() && found->size() <= kMastersMax)
      for (const json& value : *found) {
        const double number = value.is_number() ? value.get<double>() : -1;
        if (!(number >= 0 && number <= 1)) break;
        values.push_back(number);
        sum += number;
      }
    if (values.empty() || values.size() != found->size() || std::abs(sum - 1) > 1e-9)
      fail("\"" + std::string(key) + "\" must be 1 to " + std::to_string(kMastersMax) +
           " numbers in [0, 1] whose sum is 1");
    return values;
  }
  std::array<double, 3> position(const char* key) {
    std::array<double, 3> x{};
    const auto found = object_.find(key);
    bool good = found != object_.end() && found->is_array() && found->size() == x.size();
    for (std::size_t k = 0; good && k < x.size(); ++k) {
      x[k] = (*found)[k].is_number() ? (*found)[k].get<double>() : kPointerMaxM + 1;
      good = std::abs(x[k]) <= kPointerMaxM;
    }
    if (!good) fail("\"" + std::string(key) + "\" must be three numbers in [-10, 10] m");
    return x;
  }
  /// A time [s], or null: unknown.
  std::optional<double> time(const char* key) {
    const auto found = object_.find(key);
    if (found != object_.end() && found->is_null()) return std::nullopt;
    const double t = found != object_.end() && found->is_number() ? found->get<double>() : -1;
    if (t >= 0 && t <= kTimeMaxS) return t;
    fail("\"" + std::string(key) + "\" must be null or a time in [0, 1e9] s");
    return std::nullopt;
  }
  std::map<std::string, std::int64_t> scores(const char* key) {
    std::map<std::string, std::int64_t> points;
    const auto found = object_.find(key);
    bool good = found != object_.end() && found->is_object() && found->size() <= kItemsMax;
    if (good)
      for (const auto& [item, value] : found->items()) {
        good = good && value.is_number_integer() && std::abs(value.get<double>()) <= kPointsMax;
        if (good) points[sanitize(item, kItemMax)] = value.get<std::int64_t>();
      }
    if (!good) fail("\"" + std::string(key) + "\" must be an object of at most 16 integers by item");
    return points;
  }
  rpc::Id session(const char* key) {
    rpc::Id id{};
    if (!auth::from_hex(text(key, 32), id)) fail("\"" + std::string(key) + "\" must be 32 hexadecimal digits of hello");
    return id;
  }
  /// Persons of a new session: each joins with the key of a workstation, that of the person's name if none is given.
  /// A person without a seat gets a ticket for a console of their role.
  std::vector<rpc::SeatHolder> people(const char* key) {
    std::vector<rpc::SeatHolder> holders;
    const auto found = object_.find(key);
    if (found == object_.end() || !found->is_array() || found->size() > 2 * kSeatsMax) {
      fail("\"" + std::string(key) + "\" must be a list of at most " + std::to_string(2 * kSeatsMax) + " persons");
      return holders;
    }
    for (const json& row : *found) {
      if (!row.is_object()) {
        fail("each of \"" + std::string(key) + "\" must be an object");
        break;
      }
      Reader person(row);
      person.only({"name", "role", "seat", "workstation"});
      rpc::SeatHolder holder{
          .seat = person.text("seat", rpc::kNameMax), .workstation = {}, .person = person.name("name")};
      holder.workstation = row.contains("workstation") ? person.name("workstation") : holder.person;
      const AccessRole role = person.role("role");
      if (holder.seat.empty()) {
        holder.role = role;
      } else if (person.name("seat");
                 std::ranges::find(holders, holder.seat, &rpc::SeatHolder::seat) != holders.end()) {
        person.fail("seat \"" + holder.seat + "\" has two persons; each seat has one");
      }
      if (!person.error().empty()) fail("in \"" + std::string(key) + "\": " + person.error());
      holders.push_back(std::move(holder));
    }
    return holders;
  }
  AccessRole role(const char* key) {
    std::string name = text(key, 16);
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto role = access_role_named(name);
    if (!role)
      fail("\"" + std::string(key) + "\" must be INSTRUCTOR, TRAINEE, EVALUATOR, OBSERVER, OPERATOR or RECORDER");
    return role.value_or(AccessRole::kObserver);
  }
  bool truth(const char* key) {
    const auto found = object_.find(key);
    if (found != object_.end() && found->is_boolean()) return found->get<bool>();
    fail("\"" + std::string(key) + "\" must be true or false");
    return false;
  }
  void fail(std::string text) {
    if (error_.empty()) error_ = std::move(text);
  }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  const json& object_;
  std::string error_;
};

rpc::Body order_of(Reader& in, const std::string& order, const rpc::Id& session) {
  if (order == "stop" || order == "pause") {
    in.only({"type", "id", "order", "why"});
    const std::string why = in.text("why", rpc::kTextMax);
    if (order == "stop") return rpc::StopSession{session, why};
    return rpc::PauseSession{session, why};
  }
  if (order == "resume") {
    in.only({"type", "id", "order", "stop"});
    return rpc::ResumeSession{session, in.integer32("stop")};
  }
  if (order == "authority") {
    in.only({"type", "id", "order", "tool", "version", "alpha"});
    const std::uint32_t tool = in.integer32("tool", static_cast<std::uint32_t>(kToolsMax) - 1);
    const std::uint32_t version = in.integer32("version");
    return rpc::SetAuthority{session, tool, version, in.authority("alpha")};
  }
  if (order == "remove") {
    in.only({"type", "id", "order", "seat", "why"});
    const std::string seat = in.name("seat");
    return rpc::RemoveParticipant{session, seat, in.text("why", rpc::kTextMax)};
  }
  if (order == "drain") {
    in.only({"type", "id", "order", "grace_s"});
    return rpc::Drain{in.integer32("grace_s", 3600)};
  }
  if (order == "create") {
    in.only({"type", "id", "order", "scene", "name", "people"});
    rpc::CreateSession create{.name = in.name("name"), .scene = in.name("scene")};
    create.tickets_only = true;  // a code would let in more than the named persons
    create.holders = in.people("people");
    return create;
  }
  if (order == "end") {
    in.only({"type", "id", "order", "session"});
    return rpc::EndSession{in.session("session"), "ended at the lesson desk"};
  }
  if (order == "record") {
    in.only({"type", "id", "order", "on"});
    return rpc::RecordSession{session, in.truth("on")};
  }
  in.fail("\"order\" must be stop, pause, resume, authority, remove, drain, create, end or record");
  return rpc::Ping{};
}

}  // namespace

std::expected<BrowserFrame, FrameError> parse_browser_frame(std::string_view text, AccessRole role,
                                                            const rpc::Id& session) {
  const json frame = json::parse(text, nullptr, false);
  if (!frame.is_object()) return std::unexpected(FrameError{true, std::nullopt, "the frame is no JSON object"});
  FrameError error;
  if (const auto id = frame.find("id"); id != frame.end() && id->is_number_unsigned())
    error.id = id->get<std::uint64_t>();
  const auto refuse = [&error](std::string why) {
    error.text = std::move(why);
    return std::unexpected(error);
  };
  constexpr std::uint64_t kIdMax = (std::uint64_t{1} << 53U) - 1;  // larger integers are not exact in a browser
  Reader in(frame);
  const std::string type = in.text("type", 16);
  BrowserFrame parsed;
  if (type == "ack") {
    in.only({"type", "n"});
    parsed = Ack{in.integer("n", kIdMax)};
  } else if (type == "watch") {
    in.only({"type", "id", "session"});
    const std::uint64_t id = in.integer("id", kIdMax);
    parsed = Watch{id, in.text("session", 32)};
  } else if (type == "order") {
    const std::uint64_t id = in.integer("id", kIdMax);
    Order order{id, order_of(in, in.text("order", 16), session)};
    if (in.error().empty()) {
      const rpc::Kind kind = rpc::kind_of({0, order.body});
      if (!server::allowed_without_seat(role, kind)) return refuse(server::forbidden_text_without_seat(role, kind));
    }
    parsed = std::move(order);
  } else if (type == "take") {
    in.only({"type", "id", "seat", "ticket"});
    TakeSeat take{in.integer("id", kIdMax), in.text("seat", rpc::kNameMax), {}};
    if (frame.contains("ticket")) take.ticket = in.text("ticket", kTicketTextMax);
    parsed = std::move(take);
  } else if (type == "leave") {
    in.only({"type", "id"});
    parsed = LeaveSeat{in.integer("id", kIdMax)};
  } else if (type == "pointer") {
    in.only({"type", "x", "pressed"});
    const auto x = in.position("x");
    parsed = Pointer{x, in.truth("pressed")};
  } else if (type == "invite") {
    in.only({"type", "id"});
    parsed = Invite{in.integer("id", kIdMax)};
  } else if (type == "mark") {
    in.only({"type", "id", "t", "text"});
    const std::uint64_t id = in.integer("id", kIdMax);
    const auto t = in.time("t");
    parsed = MarkFrame{id, t, in.text("text", kMarkMax)};
    if (!server::allowed_without_seat(role, rpc::Kind::kNote))
      return refuse(server::forbidden_text_without_seat(role, rpc::Kind::kNote));
  } else if (type == "sheet") {
    in.only({"type", "id", "sheet", "of", "scores", "closed"});
    SheetFrame frame_of{in.integer("id", kIdMax), {in.text("sheet", 16), in.text("of", rpc::kNameMax)}};
    frame_of.sheet.scores = in.scores("scores");
    frame_of.sheet.closed = in.truth("closed");
    if (!server::allowed_without_seat(role, rpc::Kind::kNote))
      return refuse(server::forbidden_text_without_seat(role, rpc::Kind::kNote));
    if (const auto good = check(frame_of.sheet); !good) in.fail(good.error());
    parsed = std::move(frame_of);
  } else {
    in.fail("\"type\" must be ack, watch, order, take, leave, pointer, invite, mark or sheet");
  }
  if (!in.error().empty()) return refuse(in.error());
  return parsed;
}

}  // namespace tandem::console
