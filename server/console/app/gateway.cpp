#include "server/console/app/gateway.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/auth/ticket.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "server/console/app/random_secret.h"
#include "server/console/live_json.h"

namespace tandem::console {
namespace {

constexpr double kJoinRate = 0.5, kJoinBurst = 10;      // of one source [1/s], [1]: a class behind one address
constexpr double kAllJoinRate = 2, kAllJoinBurst = 40;  // of all sources
constexpr std::chrono::seconds kTokenLife{600};

}  // namespace

Gateway::Gateway(Options options, GatewayLinks links, std::shared_ptr<Mailbox> mailbox, std::function<void()> news)
    : options_(std::move(options)),
      mailbox_(std::move(mailbox)),
      news_(std::move(news)),
      browsers_(options_.away),
      all_joins_(kAllJoinRate, kAllJoinBurst),
      seats_(options_.seats, options_.join, news_) {
  if (!options_.recordings.empty() || !options_.files.empty())
    library_ = std::make_unique<RecordingLibrary>(options_.recordings, options_.files);
  if (options_.files.empty()) {
    scores_ = std::make_unique<LiveScores>(mailbox_, news_);
  } else {
    house_ = std::make_shared<Person>();
    house_->name = "player";
    house_->house = true;
  }
  const auto watches = [](const JoinedLink& link) { return link.feed.has_value() || !link.warning.empty(); };
  if (links.own) {
    house_ = std::make_shared<Person>();
    house_->proved = !links.own->console.welcome.person.empty();
    house_->name = house_->proved ? links.own->console.welcome.person : "console";
    house_->house = true;
    ServerLink::Options link = own_link(watches(*links.own));
    link.list = options_.local;
    house_->link = std::make_shared<ServerLink>(std::move(link), std::move(links.own));
    views_.add(house_->link);
  }
  if (links.audience) {
    audience_ = std::make_shared<Person>();
    audience_->name = "audience";
    audience_->audience = true;
    ServerLink::Options link = own_link(watches(*links.audience));
    link.join.ticket = options_.audience_ticket;
    link.join.console = AccessRole::kObserver;
    audience_->link = std::make_shared<ServerLink>(std::move(link), std::move(links.audience));
    views_.add(audience_->link);
    audience_secret_ = random_secret();
    static_cast<void>(browsers_.add(audience_secret_, audience_, CookieLife::kPinned, io::monotonic_now()));
  }
}

bool Gateway::audience_lost() const {
  if (!audience_) return false;
  const auto picture = audience_->link->newest();
  return !picture->connected && !picture->again;
}

Gateway::Reach Gateway::reach_of(std::span<const std::shared_ptr<const LivePicture>> pictures) {
  Reach reach;
  for (const auto& picture : pictures) {
    if (picture->connected) return {};
    if (reach.kind == Reach::Kind::kTriesAgain) continue;
    reach = {picture->again ? Reach::Kind::kTriesAgain : Reach::Kind::kGone, picture->warning};
  }
  return reach;
}

Gateway::Reach Gateway::reach() const {
  std::vector<std::shared_ptr<const LivePicture>> pictures;
  for (const auto& own : {house_, audience_})
    if (own && own->link) pictures.push_back(own->link->newest());
  browsers_.each([&](const std::shared_ptr<Person>& person) {
    if (person == house_ || person == audience_ || !person->link) return;
    // A person whose ticket was withdrawn, or whose session is over, says nothing about the server.
    if (const auto picture = person->link->newest(); picture->connected || !picture->answers)
      pictures.push_back(picture);
  });
  return reach_of(pictures);
}

/// Prints a line when the gateway's own connection changes; without one, when the last person loses the server.
void Gateway::log_reach() {
  const bool own = house_ && house_->link;
  const Reach now = own ? reach_of(std::array{house_->link->newest()}) : reach();
  if (now.kind == std::exchange(logged_, now.kind)) return;
  const std::string why = " (" + now.why + ")";
  if (now.kind == Reach::Kind::kReached)
    io::log(io::Level::kInfo, "the connection to the server is back");
  else if (now.kind == Reach::Kind::kTriesAgain)
    io::log(io::Level::kWarn, "the connection to the server is lost" + why + "; trying again");
  else
    io::log(io::Level::kError, "the connection to the server is gone" + why +
                                   (own ? "; start this program again with a new ticket"
                                        : "; persons must sign in again with a new ticket"));
}

/// Options of a link that the gateway joins before it serves pages.
ServerLink::Options Gateway::own_link(bool watch) const {
  return {.join = options_.join, .watch = watch, .again = options_.local, .news = news_};
}

std::string Gateway::make_token(Time now) {
  const std::string secret = random_secret();
  if (tokens_.size() >= kTokensMax) tokens_.pop_front();
  tokens_.emplace_back(secret, now + kTokenLife);
  return secret;
}

std::string Gateway::redeem(std::string_view token, Time now) {
  // Every token is compared, so that the time does not depend on which one is right.
  bool redeemed = false;
  for (OneTimeToken& waiting : tokens_) redeemed = waiting.redeem(token, now) || redeemed;
  if (!house_ || !redeemed) return {};
  std::string secret = random_secret();
  return browsers_.add(secret, house_, CookieLife::kLasting, now) ? secret : std::string{};
}

bool Gateway::has_person(const rpc::Id& session) const {
  const auto is_in = [&](const Person& person) { return person.link->newest()->status.session_id == session; };
  return (house_ && is_in(*house_)) || browsers_.any(is_in);
}

std::expected<void, JoinRefusal> Gateway::join(const JoinBody& body, const auth::Source& from, Time now, Joined done) {
  if (!options_.files.empty())
    return std::unexpected(JoinRefusal{false, "this gateway plays recordings only; it has no server"});
  if (!join_rates_.at(from, now, TokenBucket{kJoinRate, kJoinBurst}).take(now) || !all_joins_.take(now) ||
      pending_.size() >= kJoinsMax)
    return std::unexpected(JoinRefusal{true, "too many persons sign in at once; try again in a few seconds"});
  const auto ticket = auth::ticket_from_text(body.ticket);
  if (!ticket) return std::unexpected(JoinRefusal{false, ticket.error()});
  ServerLink::Options link{.join = options_.join, .news = news_};
  link.join.ticket = body.ticket;
  link.join.session.clear();
  link.join.console = auth::claimed_role(*ticket).value_or(AccessRole::kObserver);
  const auto session = auth::claimed_session(*ticket);
  // The server has eight places of watching consoles per session, so the first persons of a session watch for all.
  link.watch = link.join.console != AccessRole::kRecorder && session && !views_.is_watched(*session);
  const auto person = std::make_shared<Person>();
  person->name = body.name;
  const std::uint64_t number = ++joins_;
  const bool watch = link.watch;
  link.joined = [this, number](const std::expected<void, std::string>& result) {
    mailbox_->post([this, number, result] { finish(number, result); });
  };
  person->link = std::make_shared<ServerLink>(std::move(link));
  pending_.emplace(number, Pending{person, watch, std::move(done)});
  return {};
}

void Gateway::finish(std::uint64_t number, const std::expected<void, std::string>& result) {
  const auto found = pending_.extract(number);
  if (found.empty()) return;
  const auto& [person, watch, done] = found.mapped();
  if (!result) return done(std::unexpected(result.error()));
  const auto picture = person->link->newest();
  person->proved = !picture->person.empty();
  person->name = person->proved ? picture->person : name_for(person->name, picture->role);
  std::string secret = random_secret();
  if (!browsers_.add(secret, person, CookieLife::kIdle, io::monotonic_now()))
    return done(std::unexpected("64 browsers are open already; close one, then ask for a new ticket"));
  if (watch) views_.add(person->link);
  done(secret);
}

/// A name that no other person has at present, so that two persons are not taken for one.
std::string Gateway::name_for(const std::string& wish, AccessRole role) {
  const auto taken = [this](const std::string& name) {
    return name == "console" || (house_ && name == house_->name) ||
           browsers_.any([&](const Person& person) { return person.name == name; });
  };
  if (!wish.empty() && !taken(wish)) return wish;
  const std::string stem = (wish.empty() ? std::string(to_text(role)) : wish).substr(0, 26) + "-";
  std::string name;
  do {
    name = stem + std::to_string(++names_ % 100000);
  } while (taken(name));
  return name;
}

std::vector<rpc::ListedSession> Gateway::sessions_of(const Person& person) const {
  const auto picture = person.link->newest();
  if (person.house && options_.local && picture->sessions && !picture->sessions->empty()) return *picture->sessions;
  if (picture->number == 0) return {};
  return {{picture->status.session_id, picture->status.name, picture->status.phase, {}}};
}

std::shared_ptr<ServerLink> Gateway::open(const Person& person, const std::string& session) {
  if (session_hex(person.link->newest()->status.session_id) == session) return person.link;
  const auto sessions = sessions_of(person);
  const auto found =
      std::ranges::find(sessions, session, [](const rpc::ListedSession& listed) { return session_hex(listed.id); });
  if (found == sessions.end()) return nullptr;
  ServerLink::Options link{.join = options_.join, .again = true, .news = news_};
  link.join.session = found->name;  // a restarted server has another id
  return views_.open(found->name, std::move(link));
}

void Gateway::on_news() {
  log_reach();
  if (!scores_) return;
  const Time now = io::monotonic_now();
  views_.each_live([&](const ServerLink& link) { scores_->hear(*link.newest(), now); });
}

bool Gateway::may_review(const Person& person) {
  return person.link == nullptr || console::may_review(person.link->newest()->role);
}

bool Gateway::ask_recording(RecordingRequest request, Recorded done) {
  const std::uint64_t number = ++readings_asked_;
  const bool asked = library_->ask(std::move(request), [this, number](RecordingReply reply) {
    mailbox_->post([this, number, reply = std::move(reply)] {
      if (const auto found = readings_.extract(number)) found.mapped()(reply);
    });
  });
  if (asked) readings_.emplace(number, std::move(done));
  return asked;
}

void Gateway::abandon_requests() {
  library_.reset();
  scores_.reset();
  readings_.clear();
  pending_.clear();
}

void Gateway::on_second(Time now) {
  browsers_.expire(now);
  views_.expire([this](const rpc::Id& session) { return has_person(session); });
  seats_.on_second();
  if (audience_lost() && !std::exchange(audience_logged_, true))
    io::log(io::Level::kError,
            "the audience has lost its connection to the server; start this program again with a new ticket");
}

}  // namespace tandem::console
