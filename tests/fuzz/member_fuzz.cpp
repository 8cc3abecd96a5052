// Fuzzes a member of a service whose directory answers anything. The first bytes of the input choose the answers. The
// member stays within its bounds, whatever the directory says.
#include <deque>

#include "server/service/service_member.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace tandem;
using namespace std::chrono_literals;

/// Bytes of the input, one after the other; zero behind its end.
class Draws {
 public:
  explicit Draws(std::span<const std::byte> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool any() const noexcept { return !bytes_.empty(); }
  unsigned byte() {
    if (bytes_.empty()) return 0;
    const auto first = std::to_integer<unsigned>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return first;
  }
  /// Small numbers, and now and then the ends of the range.
  std::int64_t number() {
    const unsigned drawn = byte();
    if (drawn == 255) return std::numeric_limits<std::int64_t>::max();
    if (drawn == 254) return std::numeric_limits<std::int64_t>::min();
    return drawn % 16;
  }
  std::string text() {
    std::string out;
    for (unsigned n = byte() % 64; n > 0 && any(); --n) out.push_back(static_cast<char>(byte()));
    return out;
  }

 private:
  std::span<const std::byte> bytes_;
};

server::ServiceSession session_spec() {
  server::ServiceSession spec;
  spec.id[0] = std::byte{1};
  spec.code = "CODE000001";
  spec.scene = "scene";
  spec.scene_name = "contact";
  return spec;
}

/// A directory whose answers the input chooses.
class HostileDirectory final : public directory::Directory {
 public:
  explicit HostileDirectory(Draws& draws) : draws_(draws) {}
  void begin(directory::OperationId operation, const directory::Request& request) override {
    if (operations_.size() < 256) operations_.push_back({operation, request});
  }
  std::optional<directory::Reply> poll() override {
    if (operations_.empty() || !draws_.any()) return std::nullopt;
    const unsigned how = draws_.byte();
    if (how % 8 == 7) return std::nullopt;
    const auto [operation, request] = operations_.front();
    if (how % 8 != 6 || !std::holds_alternative<directory::Watch>(request)) operations_.pop_front();
    return answer(operation, request, how);
  }

 private:
  directory::KeyValue entry(const std::string& near) {
    static const server::ServiceKeys keys("/tandem/v1/");
    static const std::string names[]{"live/servers/a",
                                     "live/servers/b",
                                     "live/sessions/lab/owner",
                                     "live/sessions/lab/standby",
                                     "catalogue/lab/spec",
                                     "catalogue/lab/listed",
                                     "catalogue/lab/move",
                                     "registry/desk",
                                     "registry/.mark",
                                     "snapshots/lab",
                                     "consoles/lab",
                                     "tickets/00"};
    const unsigned which = draws_.byte() % 16;
    directory::KeyValue out;
    out.key = which < std::size(names) ? "/tandem/v1/" + names[which] : near + (which == 15 ? draws_.text() : "");
    switch (draws_.byte() % 8) {
      case 0:
        out.value = "a";
        break;
      case 1:
        out.value = "b";
        break;
      case 2:
        out.value = server::to_text(session_spec());
        break;
      case 3:
        out.value = "address 127.0.0.1:1\nkey 00\nversion 1\ncapacity 1\nused 0\n";
        break;
      case 4:
        out.value = "mark";
        break;
      case 5:
        break;
      default:
        out.value = draws_.text();
    }
    out.created = draws_.number();
    out.modified = draws_.number();
    out.lease = draws_.number();
    return out;
  }

  directory::Reply answer(directory::OperationId operation, const directory::Request& request, unsigned how) {
    directory::Reply reply;
    reply.operation = how >= 248 ? operation + 1 : operation;
    reply.outcome = how % 16 < 12 ? directory::Outcome::kDone : static_cast<directory::Outcome>(how % 16 - 11);
    reply.revision = draws_.number();
    reply.term = draws_.byte() % 2;
    reply.lease = draws_.number();
    reply.ttl = std::chrono::seconds(draws_.byte());
    reply.held = how % 2 == 0;
    if (const auto* const asked = std::get_if<directory::Transaction>(&request)) {
      for (const directory::Step& step : reply.held ? asked->then : asked->otherwise)
        if (const auto* const read = std::get_if<directory::Read>(&step)) {
          auto& found = reply.found.emplace_back();
          for (unsigned n = draws_.byte() % 4; n > 0; --n) found.push_back(entry(read->key));
        }
    } else if (const auto* const watch = std::get_if<directory::Watch>(&request)) {
      for (unsigned n = draws_.byte() % 4; n > 0; --n)
        reply.changes.push_back({entry(watch->prefix), draws_.byte() % 4 == 0});
    }
    return reply;
  }

  Draws& draws_;
  std::deque<std::pair<directory::OperationId, directory::Request>> operations_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Draws draws(fuzz::bytes(data, size));
  HostileDirectory store(draws);
  server::ServiceMemberOptions options{.server = "a"};
  options.configured["lab"] = session_spec();
  options.registry_mark = "mark";
  server::ServiceMember member(std::move(options), store);
  member.describe({"127.0.0.1:1", "00", "1", "", 1, 0});
  std::uint64_t order = 0, results = 0;
  Time now{1s};
  for (int i = 0; i < 400 && (draws.any() || i < 20); ++i) {
    now += draws.byte() % 8 == 0 ? Duration{500ms} : Duration{20ms};
    member.step(now);
    while (const auto event = member.sessions().poll_event()) {
      switch (event->kind) {
        case server::ServiceEvent::Kind::kOpen:
          if (draws.byte() % 4 == 0)
            member.sessions().on_open_failed(now, event->session);
          else
            member.sessions().on_opened(event->session);
          break;
        case server::ServiceEvent::Kind::kGiveUp:
          member.sessions().on_given_up(event->session);
          break;
        case server::ServiceEvent::Kind::kHandOver:
          member.moves().on_handed_over(now, event->session);
          break;
        case server::ServiceEvent::Kind::kRefused:
        case server::ServiceEvent::Kind::kUnreadable:
          break;
      }
    }
    switch (draws.byte() % 32) {
      case 0:
        member.want("two");
        break;
      case 1:
        static_cast<void>(member.create(now, "new", session_spec(), 1));
        break;
      case 2:
        member.end("lab");
        break;
      case 3:
        member.replace("lab", session_spec());
        break;
      case 4:
        member.sessions().set_snapshot("lab", draws.text());
        break;
      case 5:
        member.sessions().set_listed("lab", draws.text());
        break;
      case 6:
        member.tickets().use(now, "lab", "0123", 60s, ++order, draws.byte() % 2 == 0);
        break;
      case 7:
        member.tickets().restore("lab", "0123");
        break;
      case 8:
        static_cast<void>(member.locate(std::string("lab")));
        break;
      case 9:
        member.registry().set_local({});
        break;
      case 10:
        if (draws.byte() == 0) member.leave();
        break;
      case 11:
        member.sessions().set_consoles("lab", draws.text());
        break;
      default:
        break;
    }
    while (const auto result = member.tickets().poll_result()) results += result->order != 0 ? 1 : 0;
    static_cast<void>(member.status(now));
    static_cast<void>(member.directory().members());
    static_cast<void>(member.registry().wanted());
    FUZZ_EXPECT(server::parse_registry_agreement(server::to_text(member.registry().agreed())));
  }
  FUZZ_EXPECT(results <= order);
  return 0;
}
