#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "server/app/recording/kept_inputs.h"
#include "server/recording/input_unpacker.h"
#include "tests/io/programs.h"

/// Sessions whose inputs are kept, for tests of spools.
namespace tandem::server::test {

inline constexpr std::uint64_t kMib = std::uint64_t{1} << 20U;

/// A session's journal that a test writes, and the journal of a twin that nothing keeps.
class KeptSession {
 public:
  KeptSession(std::string folder, std::uint64_t limit, std::uint64_t seed)
      : random_(RandomKey{seed}),
        inputs_(KeptInputs::make(std::make_unique<InputJournal>(kKey, kMib), std::move(folder), limit)) {}
  ~KeptSession() { release(); }

  [[nodiscard]] KeptInputs& inputs() { return *inputs_; }
  [[nodiscard]] const std::shared_ptr<KeptInputs>& shared() { return inputs_; }
  void release() { inputs_.reset(); }

  /// Writes ticks of two seats whose numbers change slowly, with noise and rare other records.
  void run(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      now_ += std::chrono::milliseconds(1);
      for (std::size_t seat = 0; seat < 2; ++seat) {
        std::array<std::byte, 96> plaintext{};
        const auto put = [&plaintext](std::size_t at, auto value) {
          std::memcpy(&plaintext[at], &value, sizeof value);
        };
        put(0, ++counter_);
        put(8, static_cast<float>(counter_) * 1e-5F);
        put(16, random_.bits() % 1000);
        for (const std::size_t noise : {32, 40, 48}) put(noise, random_.bits());
        const auto sent = std::span{plaintext}.first(90 + random_.below(2) * 6);
        for (InputJournal* const to : {&inputs_->journal(), &twin_})
          to->datagram(now_, seat, {}, {.counter = counter_}, sent, nullptr);
      }
      const bool removed = random_.below(300) == 0;
      for (InputJournal* const to : {&inputs_->journal(), &twin_}) {
        if (removed) to->remove(1, wire::CloseReason::kLeaving);
        to->tick(now_, 0, {});
        to->end_tick();
      }
      drain_twin();
    }
  }
  /// Writes ticks, and lets the keeper's threads do their work meanwhile.
  void run_kept(int ticks) {
    for (int k = 0; k < ticks; k += 20) {
      run(20);
      inputs_->drain();
      while (inputs_->keep(blocks_)) {
      }
    }
  }
  void keep() {
    inputs_->drain();
    while (inputs_->keep(blocks_)) {
    }
  }
  /// All bytes of the journal so far.
  [[nodiscard]] const std::string& all() const { return all_; }
  [[nodiscard]] RandomStream& random() { return random_; }

 private:
  static constexpr transport::HashKey kKey{std::byte{7}};
  void drain_twin() {
    std::array<std::byte, 4096> piece;
    while (const std::size_t size = twin_.drain(piece))
      all_ += text_of(std::span{piece}.first(size)).substr(InputJournal::kPieceHeader);
  }

  RandomStream random_;
  std::shared_ptr<KeptInputs> inputs_;
  InputJournal twin_{kKey, kMib};
  KeptBlockWriter blocks_;
  std::string all_;
  std::uint64_t counter_ = 0;
  Time now_{};
};

/// Inputs that a recording gets from a reader.
struct Taken {
  std::string bytes{};  ///< of the journal; ends before the first gap
  std::string why{};    ///< inputs were lost
  std::size_t blocks = 0, stored = 0;
};

/// Takes at most `count` items.
inline void take(KeptInputs::Reader& reader, Taken& out, int count = 1'000'000) {
  const Lesson no_rows;
  InputUnpacker unpacker{no_rows};
  for (int k = 0; k < count; ++k) {
    const KeptInputs::Reader::Item item = reader.next();
    if (item.kind == KeptInputs::Reader::Kind::kNothing) return;
    if (item.kind == KeptInputs::Reader::Kind::kLost) {
      out.why = item.bytes;
      return;
    }
    std::span<const std::byte> piece = bytes_of(item.bytes);
    if (item.kind == KeptInputs::Reader::Kind::kBlock) {
      const auto unpacked = unpacker.unpack(piece);
      ASSERT_TRUE(unpacked);
      piece = *unpacked;
      ++out.blocks;
      out.stored += item.stored;
    }
    std::uint64_t position = 0;
    std::memcpy(&position, piece.data(), sizeof position);
    ASSERT_EQ(position, out.bytes.size()) << "a gap";
    out.bytes += text_of(piece.subspan(sizeof position));
  }
}

/// Files in a folder, hidden ones too.
inline std::size_t files_in(const tandem::test::Folder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.file("")), std::filesystem::directory_iterator{}));
}

/// Descriptor of the spool that this process has open below a folder.
inline int spool_of(const tandem::test::Folder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const std::string target = std::filesystem::read_symlink(entry.path(), error).string();
    if (target.starts_with(folder.file("")) && target.ends_with("(deleted)"))
      return std::stoi(entry.path().filename().string());
  }
  return -1;
}

}  // namespace tandem::server::test
