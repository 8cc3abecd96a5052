#include "netsim/app/run_recording.h"

#include "common/base/hex.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_bytes.h"
#include "server/recording/lesson_notes.h"
#include "server/session/checkpoint.h"
#include "server/session/session_telemetry.h"

namespace tandem::netsim {
namespace {

constexpr double kLinkHz = 60;

server::RecordingInfo info_of(const SimulationConfig& setup) {
  server::RecordingInfo info;
  info.session = setup.scene.name;
  info.scene_text = scene_file_text(setup.scene);
  info.metadata = {{"program", "tandem-netsim run"},
                   {"seed", std::to_string(setup.seed)},
                   {"law", std::string(setup::law_name(setup.scene.channel.law))},
                   {"scene_hash", to_hex(server::scene_hash(setup.scene))},
                   {"seats", "values of their own tick, without the delay of the network"}};
  return info;
}

}  // namespace

std::string RunRecording::open(const std::string& name) {
  std::string problem = file_.open(name, false);
  if (file_.is_open()) writer_ = std::make_unique<server::RecordingWriter>(setup_->scene, info_of(*setup_));
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
  file_.write(writer_->take());
}

std::string RunRecording::close() {
  if (writer_ == nullptr) return {};
  writer_->finish();
  file_.write(writer_->take());
  writer_.reset();
  return file_.close();
}

}  // namespace tandem::netsim
