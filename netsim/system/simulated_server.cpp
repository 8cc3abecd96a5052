#include "netsim/system/simulated_server.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "hal/sim/local_slaves.h"
#include "netsim/system/simulated_handshake.h"
#include "server/session/build_text.h"

namespace tandem::netsim {
namespace {

/// Derives the key of path-challenge tokens from the seed; seats use 1000 and above (simulated_client.cpp).
constexpr std::uint64_t kTokenKey = 999;

FaultSchedule faults_of_server(const std::vector<Fault>& all) {
  std::vector<Fault> faults;
  std::ranges::copy_if(all, std::back_inserter(faults), [](const Fault& f) { return of_server(f.kind); });
  return FaultSchedule{std::move(faults)};
}

}  // namespace

SimulatedServer::SimulatedServer(const SimulationConfig& config)
    : config_(&config),
      faults_(faults_of_server(config.faults)),
      tick_(from_seconds(1.0 / config.scene.tick_hz)),
      load_shedder_(tick_) {}

std::string SimulatedServer::start(Time now, const AxisArray& scale) {
  scale_ = scale;
  if (std::string error = make_session(now, nullptr); !error.empty()) return error;
  checkpoint_ = session_->checkpoint();
  return {};
}

/// The checkpoint is encoded and decoded as for a file. All other state is lost.
std::string SimulatedServer::apply_restarts(Time now) {
  const bool dead = faults_.active(Fault::Kind::kServerRestart, now);
  up_ = up_ && !dead;
  if (up_ || dead) return {};
  std::array<std::byte, server::kCheckpointMax> bytes;
  const std::size_t size = server::encode_checkpoint(checkpoint_, bytes);
  const auto read = server::decode_checkpoint(std::span{bytes}.first(size));
  if (!read || !server::incompatibility(*read, config_->scene).empty()) return "the checkpoint cannot be read back";
  if (std::string error = make_session(now, &*read); !error.empty()) return "after a restart: " + error;
  missed_ = 0;
  up_ = true;
  return {};
}

std::uint32_t SimulatedServer::due_ticks(Time now) noexcept {
  if (now >= busy_until_ && !faults_.active(Fault::Kind::kServerLate, now)) return missed_ + 1;
  ++missed_;
  return 0;
}

void SimulatedServer::run(Time now) noexcept {
  session_->lifecycle().set_load_state(load_shedder_.step(now, missed_ * tick_, tick_used_, tick_used_));
  session_->on_tick(now, missed_);
  if (session_->path_tokens().low())
    fill_path_tokens(*session_, RandomKey{config_->seed}.derive(kTokenKey), token_draws_ += server::PathTokens::kMax);
  missed_ = 0;
}

void SimulatedServer::finish(Time now, std::size_t sent) {
  if (!config_->tick_cost) return;
  tick_used_ = config_->tick_cost(now, sent);
  busy_until_ = now + tick_used_;
}

void SimulatedServer::update_checkpoint(Time now, bool participants_changed) {
  constexpr Duration kEvery = std::chrono::milliseconds(500);
  if (!participants_changed && now - checkpoint_at_ < kEvery &&
      session_->authority().version() == checkpoint_.authority_version &&
      session_->stop_control().latch().stops() == checkpoint_.stops && session_->epoch() == checkpoint_.epoch &&
      session_->start_condition().begun() == checkpoint_.begun)
    return;
  checkpoint_ = session_->checkpoint();
  checkpoint_at_ = now;
}

std::string SimulatedServer::make_session(Time now, const server::Checkpoint* from) {
  const auto& scene = config_->scene;
  auto slaves = hal::sim::make_local_slaves(
      scene, now, [&](std::size_t tool) { return from != nullptr ? &from->tools[tool].slave : nullptr; });
  if (!slaves) return slaves.error().front();
  session_ = from == nullptr ? std::make_unique<server::Session>(scene, std::move(*slaves), scale_)
                             : std::make_unique<server::Session>(scene, std::move(*slaves), scale_, *from);
  if (config_->journal != nullptr) session_->attach_journal(*config_->journal, now, server::build_text(), from);
  session_->set_telemetry_every_tick(config_->telemetry_every_tick);
  for (std::size_t j = 0; config_->contact_source && j < scene.tools.size(); ++j)
    session_->set_contact_source(j, config_->contact_source(j));
  return {};
}

}  // namespace tandem::netsim
