#include "server/console/app/server_link.h"

#include <chrono>
#include <variant>

#include "client/app/console_commands.h"
#include "common/auth/io/control_client.h"
#include "proto/rpc/session_pages.h"
#include "server/console/live_json.h"
#include "server/console/state_json.h"
#include "server/policy/roles.h"

namespace tandem::console {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kReplyTimeout = 2s;
constexpr std::chrono::milliseconds kPeriod = 500ms;       // of status requests beside datagrams
constexpr std::chrono::milliseconds kPeriodAlone = 200ms;  // without them; the server answers ten per second
constexpr std::chrono::milliseconds kPeriodRelieved = 2s;  // if another link shows the session
constexpr std::chrono::milliseconds kPokeInterval = 250ms;
constexpr std::chrono::milliseconds kRetry = 1s, kListPeriod = 2s, kScenesPeriod = 30s;
constexpr const char* kLost =
    "not carried out, because the connection to the server is lost; repeat the order when it is back";
constexpr std::chrono::milliseconds kFeedRetry = 5s;  // a watcher that was silent, or found no place, asks again

/// Whether a session refuses for good, so that only a new join helps.
bool is_final(rpc::ErrorCode code) noexcept {
  return code == rpc::ErrorCode::kNoSession || code == rpc::ErrorCode::kSessionOver ||
         code == rpc::ErrorCode::kNotAllowed || code == rpc::ErrorCode::kNotEnrolled;
}

}  // namespace

std::expected<JoinedLink, client::JoinError> join_link(client::JoinOptions options, bool watch) {
  JoinedLink joined;
  options.watch = watch;
  if (watch) {
    auto feed = client::TelemetryFeed::open(options);
    if (feed) {
      joined.console = feed->console();
      joined.feed.emplace(std::move(*feed));
    } else if (feed.error().interrupted || feed.error().absent) {
      return std::unexpected(feed.error());
    } else {
      joined.warning = feed.error().reason + std::string(kStatusOnly);
    }
  }
  if (!joined.feed) {
    options.watch = false;
    auto console = client::join_console(options);
    if (!console) return std::unexpected(console.error());
    joined.console = std::move(*console);
  }
  auto answer = joined.console.connection->ask(rpc::StatusRequest{joined.console.welcome.session_id},
                                               std::chrono::duration_cast<std::chrono::milliseconds>(options.timeout));
  if (!answer) return std::unexpected(client::JoinError{false, answer.error().text});
  auto* status = std::get_if<rpc::Status>(&*answer);
  if (status == nullptr)
    return std::unexpected(
        client::JoinError{false, "the server gave no status of the session; use the same release on both"});
  joined.status = std::move(*status);
  return joined;
}

ServerLink::ServerLink(Options options, std::optional<JoinedLink> joined)
    : options_(std::move(options)), first_(std::move(joined)) {
  options_.join.signals = end_.get();
  if (first_) adopt(std::move(*first_));
  thread_ = std::thread([this] { work(); });
}

ServerLink::~ServerLink() {
  {
    const std::lock_guard hold{lock_};
    over_ = true;
  }
  end_.signal();
  wake_.notify_all();
  thread_.join();
}

std::shared_ptr<const LivePicture> ServerLink::newest() const {
  const std::lock_guard hold{lock_};
  return picture_;
}

bool ServerLink::order(rpc::Body body, Reply reply) {
  {
    const std::lock_guard hold{lock_};
    // Seconds later, when a new connection is there, the order may surprise.
    const bool lost = !picture_->connected;
    if (!lost && orders_.size() >= kOrdersMax) return false;
    if (!lost) orders_.emplace_back(std::move(body), reply);
    if (!lost) reply = nullptr;
  }
  if (reply) {
    reply(false, kLost, "");
  } else {
    wake_.notify_all();
  }
  return true;
}

void ServerLink::poke() {
  {
    const std::lock_guard hold{lock_};
    poked_ = true;
  }
  wake_.notify_all();
}

const std::string& ServerLink::state_members(const LivePicture& picture) {
  if (written_ != picture.number) {
    members_ = console::state_members(picture);
    written_ = picture.number;
  }
  return members_;
}

template <class Change>
void ServerLink::update(Change change) {
  {
    const std::lock_guard hold{lock_};
    auto next = std::make_shared<LivePicture>(*picture_);
    change(*next);
    ++next->number;
    live_.store(next->live != nullptr, std::memory_order_release);
    number_.store(next->number, std::memory_order_release);
    picture_ = std::move(next);
  }
  if (options_.news) options_.news();
}

void ServerLink::adopt(JoinedLink joined) {
  feed_.reset();
  follows_until_.reset();
  console_ = std::move(joined.console);
  comes_back_ = !options_.again;
  std::shared_ptr<const SceneSpec> scene;
  if (joined.feed) scene = std::make_shared<const SceneSpec>(joined.feed->scene());
  update([&](LivePicture& picture) {
    picture.status = std::move(joined.status);
    picture.role = console_.welcome.role;
    picture.person = console_.welcome.person;
    picture.notes = nullptr;
    picture.connected = true;
    picture.again = options_.again;
    picture.scene = scene;
    picture.live = nullptr;
    picture.warning = std::move(joined.warning);
  });
  notes_after_ = notes_known_ = 0;
  notes_again_ = false;
  scenes_stale_ = true;
  if (!joined.feed) return;
  feed_ = std::make_unique<FeedThread>(
      std::move(*joined.feed), [this](const std::shared_ptr<const LiveValues>& values, const std::string& why) {
        bool changed = false;  // the status has the words to it
        update([&](LivePicture& picture) {
          changed = !values || !picture.live || values->telemetry.stops != picture.live->telemetry.stops ||
                    values->telemetry.state != picture.live->telemetry.state;
          picture.live = values;
          picture.warning = why;
        });
        if (changed) poke();
      });
}

void ServerLink::lose(const std::string& why, bool answers) {
  feed_.reset();
  console_.connection.reset();
  if (!options_.again && (console_.service || !answers)) follows_until_ = Clock::now() + kFollow;
  update([&](LivePicture& picture) {
    picture.connected = false;
    picture.again = joins_again();
    picture.live = nullptr;
    picture.warning = why;
    picture.answers = answers;
  });
}

bool ServerLink::joins_again() const { return options_.again || (follows_until_ && Clock::now() < *follows_until_); }

void ServerLink::stop_following(const std::string& why) {
  if (!std::exchange(follows_until_, std::nullopt)) return;
  update([&](LivePicture& picture) {
    picture.again = false;
    if (!why.empty()) picture.warning = why;
  });
}

client::JoinOptions ServerLink::join_options() const {
  client::JoinOptions options = options_.join;
  if (comes_back_) options.back = client::ConsoleReturn{console_.welcome.session_id, console_.welcome.resume_secret};
  return options;
}

std::expected<JoinedLink, client::JoinError> ServerLink::join_once() {
  auto joined = join_link(join_options(), options_.watch);
  const auto refused = joined ? std::nullopt : joined.error().refused;
  // An older server knows no secret of a console.
  if (!comes_back_ || (refused != rpc::ErrorCode::kResume && refused != rpc::ErrorCode::kNoSeat)) return joined;
  comes_back_ = false;
  return join_link(options_.join, options_.watch);
}

bool ServerLink::join() {
  auto joined = join_once();
  if (options_.joined) {
    const auto report = std::exchange(options_.joined, {});
    if (joined) {
      adopt(std::move(*joined));
      report({});
      return true;
    }
    report(std::unexpected(joined.error().reason));
    return false;
  }
  if (!joined) {
    const client::JoinError& why = joined.error();
    const bool over = why.absent || (why.refused && is_final(*why.refused));
    if (why.refused == rpc::ErrorCode::kTicket || (over && !console_.service)) stop_following(why.reason);
    return false;
  }
  adopt(std::move(*joined));
  return true;
}

bool ServerLink::ask_status() {
  auto answer = console_.connection->ask(rpc::StatusRequest{console_.welcome.session_id}, kReplyTimeout);
  if (!answer) {
    lose(answer.error().text);
    return false;
  }
  if (auto* status = std::get_if<rpc::Status>(&*answer)) {
    const std::uint32_t notes = status->notes;
    update([&](LivePicture& picture) { picture.status = std::move(*status); });
    if (notes != notes_known_) ask_notes(notes);
    return console_.connection != nullptr;
  }
  if (const auto* moved = std::get_if<rpc::Elsewhere>(&*answer)) {  // a link that joins again follows
    lose(client::moved_text(*moved), true);
    return false;
  }
  if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer); refused != nullptr && is_final(refused->code)) {
    lose(refused->text, true);
    return false;
  }
  return true;
}

void ServerLink::ask_sessions() {
  std::string lost;
  const auto ask = [&](const rpc::Body& page) -> std::optional<rpc::SessionList> {
    auto answer = console_.connection->ask(page, kReplyTimeout);
    if (!answer) lost = answer.error().text;
    auto* const list = answer ? std::get_if<rpc::SessionList>(&*answer) : nullptr;
    return list == nullptr ? std::nullopt : std::optional(std::move(*list));  // after a refusal, the next period asks
  };
  auto list = rpc::all_sessions(ask);
  if (!lost.empty()) return lose(lost);
  if (!list) return;
  auto sessions = std::make_shared<const std::vector<rpc::ListedSession>>(std::move(list->sessions));
  update([&](LivePicture& picture) { picture.sessions = std::move(sessions); });
}

void ServerLink::ask_scenes() {
  auto answer = console_.connection->ask(rpc::SceneListRequest{}, kReplyTimeout);
  if (!answer) return lose(answer.error().text);
  scenes_stale_ = false;  // after a refusal, the next period asks again
  if (auto* list = std::get_if<rpc::SceneList>(&*answer)) {
    auto scenes = std::make_shared<const rpc::SceneList>(std::move(*list));
    update([&](LivePicture& picture) { picture.scenes = std::move(scenes); });
  }
}

void ServerLink::ask_notes(std::uint32_t newest) {
  const auto known = this->newest()->notes;
  const auto notes = known ? std::make_shared<EvaluationNotes>(*known) : std::make_shared<EvaluationNotes>();
  while (true) {
    const auto answer =
        console_.connection->ask(rpc::NotesRequest{console_.welcome.session_id, notes_after_}, kReplyTimeout);
    if (!answer) return lose(answer.error().text);
    const auto* const list = std::get_if<rpc::NoteList>(&*answer);
    if (list == nullptr) break;  // too fast: the next status goes on from here
    for (const rpc::StoredNote& note : list->notes) {
      notes_again_ = notes->put(note) || notes_again_;
      notes_after_ = note.number;
    }
    if (list->more && !list->notes.empty()) continue;
    if (!notes_again_) {
      notes_after_ = notes_known_ = newest;
      break;
    }
    notes_again_ = false;
    notes_after_ = 0;
  }
  update([&](LivePicture& picture) { picture.notes = notes; });
}

/// Joins once more if datagrams are missing, beside the connection that works.
void ServerLink::regain_feed() {
  client::JoinOptions options = join_options();
  options.watch = true;
  auto feed = client::TelemetryFeed::open(options);
  if (!feed) return;
  client::Console console = feed->console();
  adopt({std::move(console), newest()->status, std::move(*feed)});
}

void ServerLink::execute(const rpc::Body& body, const Reply& reply) {
  if (!console_.connection) return reply(false, kLost, "");
  const auto answer = console_.connection->ask(body, kReplyTimeout);
  if (!answer) {
    lose(answer.error().text);
    return reply(false, answer.error().text + "; check the state of the session, then repeat the order", "");
  }
  if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer))
    return reply(false, refused->text + client::refusal_hint(body, console_.welcome.role), "");
  if (const auto* moved = std::get_if<rpc::Elsewhere>(&*answer)) {
    const std::string why = client::moved_text(*moved);
    if (!std::holds_alternative<rpc::EndSession>(body)) lose(why, true);
    return reply(false, why, "");
  }
  if (const auto* authority = std::get_if<rpc::AuthorityReply>(&*answer); authority != nullptr && !authority->applied)
    return reply(false, "another change of authority came first; check it, then repeat the order", "");
  const auto* const created = std::get_if<rpc::SessionCreated>(&*answer);
  const auto* const done = std::get_if<rpc::Ok>(&*answer);
  std::string message;  // after the reply
  if (created != nullptr) message = tickets_json(*created, io::to_text(options_.join.server), console_.workstation);
  if (done != nullptr && !done->not_stored.empty()) message = notice_json("warning", done->not_stored);
  reply(true, "", message);
  scenes_stale_ = scenes_stale_ || created != nullptr;
  poke();
}

void ServerLink::work() {
  Clock::time_point asked{}, listed{}, scenes{}, watched = Clock::now();
  bool good = console_.connection != nullptr;
  std::unique_lock hold{lock_};
  while (!over_) {
    while (!orders_.empty() && !over_) {
      auto [body, reply] = std::move(orders_.front());
      orders_.pop_front();
      hold.unlock();
      execute(body, reply);
      hold.lock();
    }
    if (over_) return;
    poked_ = false;
    hold.unlock();
    if (!console_.connection) {
      const bool first = options_.joined != nullptr;
      if (!first && !joins_again()) {
        stop_following();
        hold.lock();
        wake_.wait(hold, [this] { return over_ || !orders_.empty(); });
        continue;
      }
      good = join();
    } else {
      good = ask_status();
    }
    asked = Clock::now();
    if (good && console_.connection && options_.list && asked - listed >= kListPeriod) {
      listed = asked;
      ask_sessions();
    }
    if (good && console_.connection && (scenes_stale_ || asked - scenes >= kScenesPeriod) &&
        server::allowed_without_seat(console_.welcome.role, rpc::Kind::kSceneListRequest)) {
      scenes = asked;
      ask_scenes();
    }
    if (live()) {
      watched = asked;
    } else if (good && console_.connection && options_.watch && (options_.again || (comes_back_ && !feed_)) &&
               asked - watched >= kFeedRetry) {
      watched = asked;
      regain_feed();
    }
    hold.lock();
    const auto period = !good ? kRetry : live() ? kPeriod : relieved_ ? kPeriodRelieved : kPeriodAlone;
    wake_.wait_until(hold, asked + std::min(period, kPokeInterval), [this] { return over_ || !orders_.empty(); });
    wake_.wait_until(hold, asked + period, [this] { return over_ || poked_ || !orders_.empty(); });
  }
}

}  // namespace tandem::console
