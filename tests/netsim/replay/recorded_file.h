#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "netsim/system/simulation.h"
#include "proto/recording/recording_format.h"
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
  server::RecordingWriter writer{setup.scene,
                                 {.session = "lesson",
                                  .scene_text = scene_file_text(setup.scene),
                                  .metadata = {},
                                  .round_tools = true,
                                  .persons = {}}};
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

/// Records a session into several files, as a server does: inputs come at once, rows some ticks later.
struct PartsRecorder {
  double part_s = 1;        ///< session time after which the next file begins
  std::size_t behind = 20;  ///< ticks by which rows come later than inputs
  bool round_tools = true;  ///< as a server does
  /// Changes a record before it is recorded; may be empty.
  std::function<void(server::TickRecord&)> change = {};

  /// @return the files
  [[nodiscard]] std::vector<std::string> record(SimulationConfig setup, double seconds) const {
    server::InputJournal journal{kAddressKey};
    setup.journal = &journal;
    const auto simulation = *Simulation::make(setup);
    server::RecordingInfo info{
        .session = "lesson", .scene_text = scene_file_text(setup.scene), .metadata = {}, .persons = {}};
    info.round_tools = round_tools;
    info.metadata = {{"session_id", "5"}, {"epoch", "1"}, {rec::kRecordingKey, "lesson"}};
    std::vector<std::string> files;
    std::optional<server::RecordingWriter> writer;
    std::optional<std::uint32_t> first;
    const auto begin = [&] {
      info.metadata[rec::kPartKey] = std::to_string(files.size() + 1);
      if (!files.empty()) info.metadata[rec::kPreviousKey] = "lesson-" + std::to_string(files.size()) + ".mcap";
      writer.emplace(setup.scene, info);
      files.emplace_back();
      first.reset();
    };
    const auto end = [&](bool last) {
      writer->finish(last);
      files.back() += writer->take();
    };
    begin();
    std::deque<server::TickRecord> rows;
    const auto add_row = [&] {
      server::TickRecord record = std::exchange(rows.front(), {});
      rows.pop_front();
      if (record.running && first && record.tick - *first >= part_s * setup.scene.tick_hz) {
        end(false);
        begin();
      }
      if (record.running && !first) first = record.tick;
      if (change) change(record);
      writer->add(record);
      files.back() += writer->take();
    };
    std::array<std::byte, 1500> piece;
    const Time until = simulation->now() + from_seconds(seconds);
    while (simulation->now() < until && simulation->step()) {
      if (simulation->session().recorded()) rows.push_back(simulation->session().record());
      while (const std::size_t size = journal.drain(piece)) writer->add_inputs(std::span{piece}.first(size));
      while (rows.size() > behind) add_row();
    }
    while (!rows.empty()) add_row();
    end(true);
    return files;
  }
};

}  // namespace tandem::netsim::test
