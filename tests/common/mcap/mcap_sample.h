#pragma once

#include <string>
#include <vector>

#include "common/base/raw_bytes.h"
#include "common/mcap/mcap_reader.h"
#include "common/mcap/mcap_writer.h"
#include "common/mcap/message_cursor.h"

namespace tandem::mcap::test {

/// Size of a file after each of its chunks, and the file.
struct SampleFile {
  std::string bytes;
  std::vector<std::size_t> chunk_ends;
};

inline constexpr std::uint32_t kSampleChunk = 10;  ///< messages per channel and chunk

/// A file with two channels, metadata and an attachment. Message n of a channel has sequence n, time 1000 n and a text
/// with n.
inline SampleFile sample_file(std::uint32_t chunks = 3) {
  Writer writer{"x-test", "test"};
  const std::uint16_t schema = writer.add_schema("test.Text", "protobuf", "not a descriptor");
  const std::uint16_t a = writer.add_channel("/a", schema, "protobuf", {{"kind", "seat"}});
  const std::uint16_t b = writer.add_channel("/b", 0, "text");
  writer.add_metadata({"session", {{"seed", "7"}, {"law", "replica"}}});
  writer.add_attachment({5, 0, "scene.txt", "text/plain", "a scene"});
  SampleFile file;
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    for (std::uint32_t k = 0; k < kSampleChunk; ++k) {
      const std::uint32_t n = chunk * kSampleChunk + k;
      writer.add_message(a, n, 1000 * n, "message a " + std::to_string(n));
      writer.add_message(b, n, 1000 * n, "message b " + std::to_string(n));
    }
    writer.close_chunk();
    file.bytes += writer.take();
    file.chunk_ends.push_back(file.bytes.size());
  }
  writer.add_metadata({"counts", {{"/a", "30"}}});
  writer.finish();
  file.bytes += writer.take();
  return file;
}

/// All messages of a file: topic, sequence and text.
inline std::vector<std::string> messages_of(const Reader& reader, TimeRange range = {}) {
  std::vector<std::string> messages;
  MessageCursor cursor{reader, range};
  while (const auto message = cursor.next()) {
    const Channel* channel = cursor.channel(message->channel);
    messages.push_back((channel == nullptr ? "?" : channel->topic) + " " + std::to_string(message->sequence) + " " +
                       std::string(text_of(message->data)));
  }
  return messages;
}

}  // namespace tandem::mcap::test
