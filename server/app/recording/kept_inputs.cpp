#include "server/app/recording/kept_inputs.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/base/format.h"
#include "common/mcap/byte_order.h"

namespace tandem::server {
namespace {

constexpr std::size_t kDrainBytes = std::size_t{16} << 10U;  // of the journal at once

/// The packer of kept inputs has no rows, so that it needs no seats.
const SceneSpec& no_scene() {
  static const SceneSpec kNone;
  return kNone;
}

/// Replaces `out` by a piece of the journal: its position, then its bytes.
void set_piece(std::string& out, std::uint64_t position, std::string_view bytes) {
  out.clear();
  out.reserve(sizeof position + bytes.size());
  mcap::put(out, position);
  out += bytes;
}

}  // namespace

std::shared_ptr<KeptInputs> KeptInputs::make(std::unique_ptr<InputJournal> journal, std::string folder,
                                             std::uint64_t limit) {
  return std::shared_ptr<KeptInputs>{new KeptInputs(std::move(journal), std::move(folder), limit)};
}

KeptInputs::KeptInputs(std::unique_ptr<InputJournal> journal, std::string folder, std::uint64_t limit)
    : journal_(std::move(journal)), folder_(std::move(folder)), limit_(limit), packer_(no_scene()) {
  if (limit_ == 0) end("this server keeps no inputs (recording { inputs_mib: 0 })", true);
}

void KeptInputs::drain() {
  const std::lock_guard lock(lock_);
  take_journal();
}

void KeptInputs::take_journal() {
  // Without a reader behind the end of the spool, the journal fills and ends: then it costs the session nothing.
  if (!problem_.empty() && readers_.empty()) return;
  std::array<std::byte, kDrainBytes> piece;
  while (const std::size_t size = journal_->drain(piece))
    append(text_of(std::span{piece}.first(size)).substr(InputJournal::kPieceHeader));
  if (!problem_.empty()) return;
  if (journal_->dropped() > 0) {
    end("the computer was too slow to keep them", false);
  } else if (pending_.size() > kPendingMax) {
    end("the disk is too slow", false);
  }
}

void KeptInputs::append(std::string_view bytes) {
  drained_ += bytes.size();
  if (problem_.empty()) pending_ += bytes;
  for (Reader* const reader : readers_) {
    if (!reader->attached_ || reader->overflowed_) continue;
    if (reader->unread_.size() + bytes.size() > kUnreadMax) {
      reader->overflowed_ = true;
    } else {
      reader->unread_ += bytes;
    }
  }
}

void KeptInputs::end(std::string why, bool known) {
  if (!problem_.empty()) return;
  for (Reader* const reader : readers_) reader->attach();
  problem_ = std::move(why);
  told_ = known;
  pending_ = {};
  packed_ = 0;
}

bool KeptInputs::keep(KeptBlockWriter& writer) {
  std::string piece;
  bool read = false;
  {
    const std::lock_guard lock(lock_);
    if (!problem_.empty() || pending_.size() - packed_ < kBlockBytes) return false;
    set_piece(piece, pending_at_ + packed_, std::string_view{pending_}.substr(packed_, kBlockBytes));
    packed_ += kBlockBytes;
    read = std::ranges::any_of(readers_, [](const Reader* reader) { return reader->is_behind(); });
  }
  static_cast<void>(packer_.add(bytes_of(piece)));
  std::string block, entry;
  packer_.take(block, false);
  if (!block.empty()) writer.write(block, entry);
  std::string why = entry.empty() ? std::string() : spool(entry, read);
  const std::lock_guard lock(lock_);
  if (!problem_.empty()) return false;
  if (!why.empty()) {
    end(std::move(why), false);
    return false;
  }
  spooled_ += entry.size();
  // The packer has the begin of a record that is not whole; readers get it from `pending_`.
  const std::size_t done = packed_ - packer_.size();
  pending_.erase(0, done);
  if (pending_.capacity() > 4 * kBlockBytes && pending_.size() < kBlockBytes) pending_.shrink_to_fit();
  pending_at_ += done;
  packed_ -= done;
  return true;
}

/// Adds an entry to the spool. @param beyond  its limit, up to twice of it, too. @return why it is not there
std::string KeptInputs::spool(const std::string& entry, bool beyond) {
  if (!spool_) {
    auto made = InputSpool::create(folder_);
    if (!made) return "no file can be made for them: " + made.error();
    spool_.emplace(std::move(*made));
  }
  if (spool_->size() + entry.size() > (beyond ? 2 * limit_ : limit_))
    return format("the session had run longer than the inputs kept: %.6g MiB (recording { inputs_mib })",
                  static_cast<double>(limit_) / (1 << 20));
  return spool_->append(entry);
}

std::string KeptInputs::problem() const {
  const std::lock_guard lock(lock_);
  return problem_;
}

std::string KeptInputs::take_problem() {
  const std::lock_guard lock(lock_);
  return problem_.empty() || std::exchange(told_, true) ? std::string() : problem_;
}

std::uint64_t KeptInputs::spooled() const {
  const std::lock_guard lock(lock_);
  return spooled_;
}

std::expected<std::unique_ptr<KeptInputs::Reader>, std::string> KeptInputs::read() {
  const std::lock_guard lock(lock_);
  // A spool that has ended has not what followed. Before the first byte was drained the journal has everything.
  if (!problem_.empty() && (drained_ > 0 || journal_->dropped() > 0)) return std::unexpected(problem_);
  std::unique_ptr<Reader> reader{new Reader(shared_from_this(), drained_ > 0)};
  readers_.push_back(reader.get());
  if (!reader->late()) reader->attach();
  return reader;
}

KeptInputs::Reader::~Reader() {
  const std::lock_guard lock(inputs_->lock_);
  std::erase(inputs_->readers_, this);
}

void KeptInputs::Reader::attach() {
  if (std::exchange(attached_, true)) return;
  end_ = inputs_->spooled_;
  unread_ = inputs_->pending_;
  unread_at_ = inputs_->pending_at_;
}

bool KeptInputs::Reader::is_behind() const noexcept { return at_ < (attached_ ? end_ : inputs_->spooled_); }

bool KeptInputs::Reader::behind() const {
  const std::lock_guard lock(inputs_->lock_);
  return is_behind();
}

bool KeptInputs::Reader::urgent() const {
  const std::lock_guard lock(inputs_->lock_);
  return attached_ && is_behind();
}

KeptInputs::Reader::Item KeptInputs::Reader::next() {
  if (!why_.empty()) return {Kind::kLost, why_};
  {
    const std::lock_guard lock(inputs_->lock_);
    if (!is_behind()) {
      attach();
      inputs_->take_journal();
      if (unread_.empty()) return overflowed_ ? lose("the computer was too slow") : Item{};
      set_piece(piece_, unread_at_, unread_);
      unread_at_ += unread_.size();
      unread_ = {};
      return {Kind::kPiece, piece_};
    }
  }
  return read_block();
}

KeptInputs::Reader::Item KeptInputs::Reader::read_block() {
  const InputSpool& spool = *inputs_->spool_;
  std::array<std::byte, KeptBlockHead::kSize> bytes;
  if (!spool.read(at_, bytes)) return lose("the disk does not give the inputs back");
  const auto head = KeptBlockReader::read_head(bytes);
  if (!head) return lose("the kept inputs are damaged");
  packed_.resize(head->packed);
  if (!spool.read(at_ + bytes.size(), packed_)) return lose("the disk does not give the inputs back");
  const auto block = blocks_.read(*head, packed_);
  if (!block) return lose("a block of the kept inputs " + block.error());
  const std::size_t stored = bytes.size() + packed_.size();
  const std::lock_guard lock(inputs_->lock_);  // the thread of `keep` asks whether this is behind
  at_ += stored;
  return {Kind::kBlock, *block, stored};
}

KeptInputs::Reader::Item KeptInputs::Reader::lose(std::string why) {
  why_ = std::move(why);
  return {Kind::kLost, why_};
}

}  // namespace tandem::server
