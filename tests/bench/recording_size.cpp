// The bytes of recordings as a server makes them, in virtual time, by channel: index, messages alone under zstd.
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "common/base/raw_bytes.h"
#include "common/mcap/chunk_compression.h"
#include "common/mcap/mcap_reader.h"
#include "common/mcap/mcap_writer.h"
#include "common/mcap/message_cursor.h"
#include "tests/netsim/replay/recorded_file.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

constexpr const char* kScenes[] = {"eight_seats",      "lesson",        "contact",         "cooperative_slave",
                                   "evaluation",       "two_by_two",    "guidance",        "free_motion",
                                   "eight_evaluators", "demonstration", "seven_trainees",  "devices",
                                   "one_axis",         "seed_contact",  "seed_free_motion"};

/// Size of the chunks of some messages, each as long as the file's chunk.
struct Part {
  std::uint64_t messages = 0, raw = 0, compressed = 0;
  std::string open;
};

/// @param by_channel  prints the parts of each channel too
void print(const char* name, double seconds, std::uint64_t seed, bool by_channel) {
  netsim::SimulationConfig setup;
  setup.scene = test::shipped(name);
  setup.scene.duration = seconds;
  setup.seed = seed;
  setup.network = netsim::link_from(test::delayed(20));
  const std::string file = netsim::test::record_file(setup, seconds + 5);
  const auto reader = mcap::Reader::open(bytes_of(file));
  mcap::MessageCursor cursor{*reader};
  std::map<std::string, Part> parts;
  mcap::Compressor compressor{mcap::Writer::kLevel};
  std::string out;
  std::string_view chunk;
  const auto close = [&] {
    for (auto& [topic, part] : parts) {
      compressor.compress(part.open, out);
      part.compressed += out.size();
      part.open.clear();
    }
  };
  std::uint32_t first = 0, last = 0;
  std::uint64_t chunk_end = 0;
  while (const auto message = cursor.next()) {
    if (message->log_time >= chunk_end) {
      close();
      chunk_end = message->log_time + 500'000'000;
    }
    const mcap::Channel& channel = *cursor.channel(message->channel);
    const auto kind = channel.metadata.find("kind");
    std::string topic = channel.topic;
    if (kind->second == "view") topic = "views";
    Part& part = parts[topic];
    ++part.messages;
    part.raw += message->data.size();
    part.open += std::string(22, '\1');
    part.open += text_of(message->data);
    if (first == 0) first = message->sequence;
    last = message->sequence;
  }
  close();
  const double per =
      static_cast<double>(setup.scene.seats.size()) * (last - first + 1) / setup.scene.tick_hz / 60 * 1e6;
  std::printf("%s: %.2f MB per seat and minute, %zu seats, %zu tools, %zu bytes\n", name,
              static_cast<double>(file.size()) / per, setup.scene.seats.size(), setup.scene.tools.size(), file.size());
  if (by_channel)
    for (const auto& [topic, part] : parts)
      std::printf("  %-28s %9llu messages, %7.1f bytes each; MB per seat and minute: index %.2f, alone %.2f\n",
                  topic.c_str(), static_cast<unsigned long long>(part.messages),
                  static_cast<double>(part.raw) / static_cast<double>(part.messages),
                  16.0 * static_cast<double>(part.messages) / per, static_cast<double>(part.compressed) / per);
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  if (argc > 1)
    tandem::bench::print(argv[1], 20, 1, true);
  else
    for (const char* name : tandem::bench::kScenes) tandem::bench::print(name, 20, 1, false);
  return 0;
}
