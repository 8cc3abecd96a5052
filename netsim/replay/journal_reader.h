#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "netsim/replay/journal_events.h"

namespace tandem::netsim {

/// Reads an input journal, piece by piece as InputJournal::drain returned them. Any bytes are safe: the first record
/// that is not as input_records.h describes ends the journal, with an error.
class JournalReader {
 public:
  /// Appends a piece. @return false if bytes before it are missing, or after an error: the piece is ignored
  bool add(std::span<const std::byte> piece);
  /// Next event; nullopt if another piece must be added first, at the end, and after an error.
  [[nodiscard]] std::optional<JournalEvent> next();

  /// Error with its position in the journal; empty: none.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Bytes behind the last whole record: more than 0 if the journal was cut, once `next` returns nothing at its end.
  [[nodiscard]] std::size_t rest() const noexcept { return bytes_.size() - at_; }

 private:
  class Fields;
  std::optional<JournalEvent> read(Fields& fields);
  std::optional<JournalEvent> read_begin(Fields& fields);
  std::optional<JournalEvent> read_admit(Fields& fields);
  std::optional<JournalEvent> read_datagram(Fields& fields);
  std::optional<JournalEvent> read_command(Fields& fields, server::InputRecord kind);
  std::optional<JournalEvent> read_tick(Fields& fields);
  void fail(const std::string& what);

  std::vector<std::byte> bytes_;  ///< not yet dropped
  std::size_t at_ = 0;            ///< of the next record
  std::uint64_t dropped_ = 0;     ///< position of bytes_[0] in the journal
  bool begun_ = false;
  std::string error_;

  struct Seat {
    server::PeerAddress from;
    std::uint64_t next_counter = 0;
  };
  std::array<Seat, kSeatsMax> seats_{};
  server::InputJournal::Settings settings_;
  Time last_{};
};

}  // namespace tandem::netsim
