#pragma once

#include <array>
#include <functional>
#include <string>

#include "netsim/system/simulation.h"
#include "proto/text/scene_bytes.h"
#include "server/recording/recording_writer.h"
#include "tests/netsim/replay/recorded_session.h"

namespace tandem::netsim::test {

/// Runs a session and records it as a server does: the records of the server's ticks, and all inputs.
/// @param inputs  false: the file has no inputs
inline std::string record_file(SimulationConfig setup, double seconds, bool inputs = true,
                               std::size_t capacity = server::InputJournal::kCapacity) {
  server::InputJournal journal{kAddressKey, capacity};
  setup.journal = &journal;
  const auto simulation = *Simulation::make(setup);
  server::RecordingWriter writer{
      setup.scene, {.session = "lesson", .scene_text = scene_file_text(setup.scene), .metadata = {}, .persons = {}}};
  std::array<std::byte, 1500> piece;
  std::string file;
  const Time end = simulation->now() + from_seconds(seconds);
  while (simulation->now() < end && simulation->step()) {
    const server::Session& session = simulation->session();
    if (session.recorded()) writer.add(session.record());
    while (const std::size_t size = inputs ? journal.drain(piece) : 0) writer.add_inputs(std::span{piece}.first(size));
    file += writer.take();
  }
  writer.finish();
  return file + writer.take();
}

}  // namespace tandem::netsim::test
