#include "server/app/front_door.h"

#include <utility>

#include "common/trust/io/key_choice.h"

namespace tandem::server {
namespace {

constexpr int kPortsTried = 20;  // until one is free for UDP and TCP

/// Keys of a folder that `init` made; on a network somebody must be able to come.
std::expected<trust::ServerTrust, std::string> keys_of(const io::SocketAddress& listen, const std::string& state) {
  const std::int64_t now = trust::wall_seconds();
  if (state.empty() && listen.loopback()) return trust::ServerTrust::throw_away(now);
  const auto path = trust::server_state_path(state);
  if (!path) return std::unexpected("--state: " + path.error());
  auto trust = trust::ServerTrust::open(*path);
  if (!trust) return std::unexpected(trust.error());
  const auto book = trust->workstations();
  if (!book) return std::unexpected(book.error());
  const auto codes = trust->open_codes(now);
  if (!codes) return std::unexpected(codes.error());
  if (!listen.loopback() && book->empty() && *codes == 0)
    return std::unexpected("nobody could join: no workstation is enrolled in " + *path + ". Run `tandem-server enroll NAME` for each, then start again");
  return trust;
}

}  // namespace

FrontDoor::FrontDoor(trust::ServerTrust trust, const Plan& plan)
    : trust_(std::move(trust)),
      tell_(plan.tell),
      house_(thread_.context(), trust_),
      plane_(thread_.context(), trust_, house_, {}, {}, [this](const ControlNews& news) {
        note(news);
        if (tell_) tell_(news);
      }) {}

FrontDoor::~FrontDoor() { stop(); }

std::string FrontDoor::problem_with_keys(const io::SocketAddress& listen, const std::string& state) {
  const auto trust = keys_of(listen, state);
  return trust ? std::string() : trust.error();
}

std::expected<std::unique_ptr<FrontDoor>, std::string> FrontDoor::open(const Plan& plan) {
  auto trust = keys_of(plan.listen, plan.state);
  if (!trust) return std::unexpected(trust.error());
  if (trust->on_disk())
    if (std::string problem = trust->begin_serving(trust::wall_seconds()); !problem.empty()) return std::unexpected(std::move(problem));
  std::unique_ptr<FrontDoor> door{new FrontDoor(std::move(*trust), plan)};
  std::string problem;
  for (int attempt = 0; attempt < kPortsTried; ++attempt) {
    auto socket = io::bind_udp(plan.listen);
    if (!socket) return std::unexpected("--listen: " + socket.error());
    auto listening = door->plane_.listen(socket->local);
    if (listening) {
      door->address_ = *listening;
      door->socket_ = std::move(*socket);
      break;
    }
    problem = "--listen: " + listening.error();
    if (plan.listen.port() != 0) break;  // a port that was chosen for us may be taken for TCP: the next one
  }
  if (!door->socket_) return std::unexpected(problem);
  if (door->throw_away()) {
    auto local = trust::let_local_in(door->trust_, trust::runtime_path(), trust::wall_seconds());
    if (!local) return std::unexpected("clients on this machine could not be told how to join: " + local.error());
    door->local_.emplace(std::move(*local));
  }
  return door;
}

void FrontDoor::add(House::Opening opening) {
  OpenSession session{opening.id, opening.code, opening.name, opening.epoch, {}};
  for (const SeatSpec& seat : opening.session->scene().seats) session.seats.push_back({seat.name, access_role(seat.role)});
  serving_.sessions.push_back(std::move(session));
  house_.open(std::move(opening));
}

void FrontDoor::note(const ControlNews& news) const {
  switch (news.event) {
    case ControlEvent::kWelcomed:
    case ControlEvent::kRefused:
    case ControlEvent::kNotEnrolled:
    case ControlEvent::kCodeRefused:
    case ControlEvent::kBlocked:
      trust_.audit(trust::wall_seconds(), to_text(news.event), news.workstation, news.address + " " + news.detail);
      break;
    default:  // what is no decision about a person is only counted; enrolments note themselves
      break;
  }
}

std::string FrontDoor::start() {
  serving_.address = io::to_text(address_);
  if (trust_.on_disk())
    if (std::string problem = trust_.write_serving(serving_); !problem.empty()) return problem;
  started_ = true;
  thread_.start();
  return {};
}

void FrontDoor::stop() {
  if (!std::exchange(started_, false)) return;
  thread_.stop([this] {
    plane_.stop();
    house_.stop_watching();
  });
}

}  // namespace tandem::server
