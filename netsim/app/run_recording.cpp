#include "netsim/app/run_recording.h"

#include <span>
#include <utility>

#include "common/base/hex.h"
#include "common/base/rng.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_bytes.h"
#include "server/recording/lesson_notes.h"
#include "server/session/checkpoint.h"
#include "server/session/session_telemetry.h"

namespace tandem::netsim {
namespace {

constexpr double kLinkHz = 60;
constexpr std::size_t kPieceMax = std::size_t{1} << 16;  // of inputs [bytes]

server::RecordingInfo info_of(const SimulationConfig& setup, const std::map<std::string, std::string>& facts) {
  server::RecordingInfo info;
  info.session = setup.scene.name;
  info.scene_text = scene_file_text(setup.scene);
  info.metadata = {{"program", "tandem-netsim run"},
                   {"seed", std::to_string(setup.seed)},
                   {"law", std::string(setup::law_name(setup.scene.channel.law))},
                   {"scene_hash", to_hex(server::scene_hash(setup.scene))},
                   {"seats", "values of their own tick, without the delay of the network"}};
  for (const auto& [key, value] : facts) info.metadata[key] = value;
  return info;
}

/// The addresses of a simulation are not personal, so the seed gives the key: the same run gives the same bytes.
transport::HashKey address_key(std::uint64_t seed) noexcept {
  transport::HashKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(RandomKey{seed}.bits(i) & 0xff);
  return key;
}

}  // namespace

RunRecording::RunRecording(const SimulationConfig& setup, std::map<std::string, std::string> facts)
    : setup_(&setup), facts_(std::move(facts)), journal_(address_key(setup.seed)), piece_(kPieceMax) {}

std::string RunRecording::open(const std::string& name) {
  std::string problem = file_.open(name, false);
  if (file_.is_open()) writer_ = std::make_unique<server::RecordingWriter>(setup_->scene, info_of(*setup_, facts_));
  return problem;
}

void RunRecording::attach(Simulation& simulation) {
  if (writer_ == nullptr) return;
  simulation.on_audit = [this, &simulation](const server::AuditEvent& event) {
    writer_->add_event(lesson_event(event, setup_->scene, simulation.session().clock().elapsed()));
  };
}

void RunRecording::on_tick(const Simulation& simulation) {
  if (writer_ == nullptr) return;
  writer_->add(simulation.record());
  const std::size_t seats = setup_->scene.seats.size();
  // Seats take turns, so that each has kLinkHz samples per second.
  const auto turn = [&](std::uint64_t step) {
    return static_cast<std::uint64_t>(static_cast<double>(step) * kLinkHz * static_cast<double>(seats) /
                                      setup_->scene.tick_hz);
  };
  for (std::uint64_t k = turn(steps_); k < turn(steps_ + 1); ++k)
    writer_->add_link(server::lesson_link(server::link_of(simulation.session(), simulation.now(), k % seats),
                                          simulation.record().tick));
  ++steps_;
  take_inputs();
  file_.write(writer_->take());
}

void RunRecording::take_inputs() {
  while (const std::size_t size = journal_.drain(piece_)) writer_->add_inputs(std::span{piece_}.first(size));
}

std::string RunRecording::close() {
  if (writer_ == nullptr) return {};
  writer_->finish();
  file_.write(writer_->take());
  writer_.reset();
  return file_.close();
}

}  // namespace tandem::netsim
