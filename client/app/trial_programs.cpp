#include "client/app/trial_programs.h"

#include <utility>

#include "common/base/format.h"
#include "common/base/suggestions.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kServerStarts = 20s;

bool is_master(const SeatSpec& s) { return s.kind == SeatKind::kMaster; }

}  // namespace

std::expected<const SeatSpec*, std::string> seat_for_person(const SceneSpec& scene, const std::string& wanted) {
  std::vector<std::string> names;
  for (const SeatSpec& s : scene.seats)
    if (is_master(s)) names.push_back(s.name);
  for (const SeatSpec& s : scene.seats)
    if (is_master(s) && (wanted.empty() ? s.role == Role::kInstructor : s.name == wanted)) return &s;
  if (!wanted.empty())
    return std::unexpected("--seat " + wanted + ": no MASTER seat of the scene " + scene.name + " has this name; " +
                           suggest(wanted, names));
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    for (const AuthorityRow& row : scene.authority)
      if (row.alpha[i] > 0) return &scene.seats[i];
  return &scene.seats.front();
}

std::vector<std::string> partners_of(const SceneSpec& scene, const SeatSpec& own) {
  std::vector<std::string> partners;
  for (const SeatSpec& s : scene.seats)
    if (&s != &own && s.required) partners.push_back(s.name);
  return partners;
}

std::expected<TrialPrograms, std::string> TrialPrograms::start(const std::string& scene,
                                                               const std::vector<std::string>& partners,
                                                               std::optional<double> duration, int interrupt) {
  const std::string server_path = io::program_path("tandem-server"), client_path = io::program_path("tandem-client");
  for (const auto& [path, name] : {std::pair{&server_path, "tandem-server"}, std::pair{&client_path, "tandem-client"}})
    if (path->empty())
      return std::unexpected(std::string("it needs the program ") + name +
                             ", which is neither beside this one nor in $PATH; install the package " + name +
                             " (apt install ./" + name +
                             "_*.deb), or join a server on another computer with `tandem-client join`");
  std::vector<std::string> words{server_path, "run", scene, "--listen", "127.0.0.1:0", "--quiet"};
  if (duration) words.insert(words.end(), {"--duration", format("%g", *duration)});
  auto server = io::ChildProgram::start("the server", words);
  if (!server) return std::unexpected(server.error());
  const auto address = server->wait_for_line("listening on ", kServerStarts, interrupt);
  if (!address) {
    if (!io::pending_signal().empty()) return std::unexpected(std::string());
    return std::unexpected("the server did not start" +
                           (server->last_output().empty() ? "" : ": " + server->last_output()));
  }
  std::vector<io::ChildProgram> programs;
  programs.push_back(std::move(*server));
  TrialPrograms trial(std::move(programs), *address);
  for (const std::string& partner : partners) {
    auto child = io::ChildProgram::start(
        "the simulated " + partner, {client_path, "join", "--server", *address, "--seat", partner, "--device", "sim",
                                     "--quiet", "--reconnect-timeout", "0"});
    if (!child) return std::unexpected(child.error());
    trial.children_.push_back(std::move(*child));
  }
  return trial;
}

std::string TrialPrograms::failure() {
  for (io::ChildProgram& child : children_)
    if (child.failed())
      return child.name() + " ended by itself" + (child.last_output().empty() ? "" : ": " + child.last_output());
  return "";
}

}  // namespace tandem::client
