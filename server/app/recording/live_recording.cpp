#include "server/app/recording/live_recording.h"

#include <utility>

#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/clock.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr Duration kPause = 20ms;  // between two looks at the queues
// Blocks of earlier inputs per look. One is at least six times as much as the session makes meanwhile, and takes a
// sixth of a core.
constexpr int kUrgentBlocks = 4;
constexpr Duration kFilesInterval = 250ms, kLinksInterval = 64ms;

}  // namespace

std::expected<std::unique_ptr<LiveRecording>, std::string> LiveRecording::start(
    const std::string& path, const LiveSession& session, const RecordingInfo& info, const RecordingLimits& limits,
    bool pseudonyms, std::shared_ptr<RecordingDesk> desk, std::unique_ptr<KeptInputs::Reader> inputs) {
  auto files = RecordingFiles::open(path, session.scene(), info, limits, io::monotonic_now());
  if (!files) return std::unexpected(std::move(files.error()));
  const std::string part = (*files)->part();
  std::unique_ptr<LiveRecording> made{
      new LiveRecording(std::move(*files), session, pseudonyms, std::move(desk), std::move(inputs))};
  made->say(false, "recording", "recording to " + part);
  return made;
}

LiveRecording::LiveRecording(std::unique_ptr<RecordingFiles> files, const LiveSession& session, bool pseudonyms,
                             std::shared_ptr<RecordingDesk> desk, std::unique_ptr<KeptInputs::Reader> inputs)
    : session_(&session),
      pseudonyms_(pseudonyms),
      desk_(std::move(desk)),
      number_(desk_->begin(rpc::StatusRecording{.by_server = true, .pseudonyms = pseudonyms})),
      inputs_(std::move(inputs)),
      ticks_(std::make_shared<TickFeed>(session.scene().seats.size(), session.scene().tools.size())),
      files_(std::move(files)),
      thread_([this] { run(); }) {}

LiveRecording::~LiveRecording() {
  abandon_.store(true, std::memory_order_release);
  begin_finish();
  thread_.join();
}

std::vector<LiveRecording::Message> LiveRecording::take_messages() {
  const std::lock_guard lock(lock_);
  return std::exchange(messages_, {});
}

void LiveRecording::say(bool warning, const char* event, std::string text) {
  const std::lock_guard lock(lock_);
  messages_.push_back({warning, event, std::move(text)});
}

void LiveRecording::run() {
  while (!finish_.load(std::memory_order_acquire) && !files_->ended()) {
    step(io::monotonic_now());
    std::this_thread::sleep_for(kPause);
  }
  const Time began = io::monotonic_now();
  step(began);
  desk_->set_status(number_, std::nullopt);
  finish_inputs();
  const Time ends = io::monotonic_now();
  if (files_->begun() && ticks_->newest() > tick_) files_->count_dropped(ticks_->newest() - tick_);
  files_->begin_close();
  while (!files_->closed() && !abandon_.load(std::memory_order_acquire) && io::monotonic_now() - ends < kEndLimit)
    std::this_thread::sleep_for(kPause);
  files_->abandon();
  report();
  done_.store(true, std::memory_order_release);
}

void LiveRecording::begin(Time now) {
  const auto first = session_->first_tick();
  if (files_->begun() || !first) return;
  files_->begin((io::read_clock(CLOCK_REALTIME) - (now - *first)).count());
}

void LiveRecording::step(Time now) {
  begin(now);
  if (!files_->begun() || files_->ended()) return;
  add_ticks();
  add_inputs();
  const RecordingDesk::Items items = desk_->take(number_);
  RecordingWriter& writer = files_->writer();
  for (const LessonEvent& event : items.events) writer.add_event(event);
  for (const LessonMark& mark : items.marks) writer.add_mark(mark);
  for (const LessonSheet& sheet : items.sheets) writer.add_sheet(sheet);
  if (now >= next_links_) {
    next_links_ = now + kLinksInterval;
    if (files_->trouble().empty()) add_links();
  }
  if (now < next_files_) return;
  next_files_ = now + kFilesInterval;
  files_->set_persons(desk_->persons(), desk_->workstations());
  files_->step(now);
  report();
}

void LiveRecording::add_ticks() {
  TickQueue& ticks = ticks_->ticks();
  for (const TickRecord* record = ticks.front(); record != nullptr; record = ticks.front()) {
    tick_ = record->tick;
    files_->add(*record);
    ticks.pop();
    const std::uint64_t dropped = ticks.dropped();
    files_->count_dropped(dropped - std::exchange(unqueued_, dropped));
  }
}

void LiveRecording::add_inputs() {
  // Inputs from before the recording have the time of its first row, not that of the session's begin.
  if (inputs_ == nullptr || (inputs_->late() && files_->recorded() == 0)) return;
  for (int blocks = inputs_->urgent() ? kUrgentBlocks : 1; blocks > 0; --blocks)
    if ((inputs_->behind() && !files_->accepts()) || !add_next_inputs()) return;
}

void LiveRecording::finish_inputs() {
  if (inputs_ == nullptr || !files_->begun() || files_->ended()) return;
  const Time until = io::monotonic_now() + kCopyLimit;
  for (Time now = io::monotonic_now(); inputs_ != nullptr && inputs_->behind() && files_->recorded() > 0;
       now = io::monotonic_now()) {
    if (now > until || abandon_.load(std::memory_order_acquire)) {
      say(true, "recording_trouble", "the recording has ended before all earlier inputs of its session were in it");
      return;
    }
    files_->step(now);
    if (files_->ended()) return;
    if (!files_->accepts()) {
      std::this_thread::sleep_for(kPause);
    } else {
      static_cast<void>(add_next_inputs());
    }
  }
  add_inputs();
}

/// @return whether more may follow at once
bool LiveRecording::add_next_inputs() {
  const KeptInputs::Reader::Item item = inputs_->next();
  switch (item.kind) {
    case KeptInputs::Reader::Kind::kNothing:
      return false;
    case KeptInputs::Reader::Kind::kBlock:
      files_->add_input_block(item.bytes, item.stored);
      return true;
    case KeptInputs::Reader::Kind::kPiece:
      files_->add_inputs(bytes_of(item.bytes));
      return false;
    case KeptInputs::Reader::Kind::kLost:
      break;
  }
  const std::string why{item.bytes};
  files_->writer().add_event({tick_, files_->time_ns(), "inputs-lost", "", why});
  say(true, "recording_trouble", "the recording lost inputs, so that it cannot be replayed bit for bit: " + why);
  inputs_.reset();
  return false;
}

void LiveRecording::add_links() {
  const SessionStatus status = session_->status();
  for (std::size_t i = 0; i < session_->scene().seats.size(); ++i) {
    const SeatStatus& seat = status.seats[i];
    if (!seat.taken) continue;
    files_->writer().add_link({.tick = tick_,
                               .seat = static_cast<std::uint32_t>(i),
                               .rtt_p50_ms = seat.link.rtt_p50_ms,
                               .loss_up_percent = seat.link.up.loss_percent,
                               .loss_down_percent = seat.link.down.loss_percent,
                               .gap_up_ms = seat.link.up.longest_gap_ms,
                               .gap_down_ms = seat.link.down.longest_gap_ms,
                               .age_p99_ms = seat.link.down.age_p99_ms,
                               .gate_trips = seat.gate_trips,
                               .late_ticks = seat.late_ticks});
  }
}

void LiveRecording::report() {
  recorded_.store(files_->recorded(), std::memory_order_relaxed);
  lost_.store(files_->lost(), std::memory_order_relaxed);
  cpu_ns_.store((io::read_clock(CLOCK_THREAD_CPUTIME_ID) + files_->disk_cpu()).count(), std::memory_order_relaxed);
  static_cast<void>(files_->closed());
  for (const std::string& path : files_->take_completed()) say(false, "recording_file", path + " is complete");
  for (const std::string& path : files_->take_removed())
    say(false, "recording_file", path + " was removed: the session never ran, and nothing was noted");
  for (std::string& problem : files_->take_problems()) say(true, "recording_trouble", std::move(problem));
  std::string trouble = files_->trouble();
  if (trouble.empty() && session_->status().machine.load_state.level >= ShedLevel::kTelemetry)
    trouble = "the server is too busy and records one row in ten (load shedding); give it fewer sessions or programs";
  if (trouble != trouble_) {
    if (trouble.empty()) {
      std::string text =
          format("the recording goes on; it dropped %llu ticks so far", static_cast<unsigned long long>(lost()));
      if (files_->lost_inputs() > 0) text += ", and inputs: it cannot be replayed bit for bit from there on";
      say(false, "recording_goes_on", std::move(text));
    } else {
      say(true, "recording_trouble", "the recording drops ticks, the session is not disturbed: " + trouble);
    }
    trouble_ = trouble;
  }
  if (files_->ended()) return;
  desk_->set_status(number_, rpc::StatusRecording{
                                 .by_server = true, .pseudonyms = pseudonyms_, .dropped = lost(), .trouble = trouble});
}

}  // namespace tandem::server
