#include "proto/recording/event_messages.h"

#include <google/protobuf/stubs/logging.h>

#include "common/base/raw_bytes.h"
#include "proto/recording/protobuf_fields.h"
#include "proto/schema/recording.pb.h"

namespace tandem::rec {
namespace {

template <class Message>
std::optional<Message> parse(std::span<const std::byte> bytes) {
  const google::protobuf::LogSilencer silence;  // bytes of a foreign file must not flood the log
  std::optional<Message> message(std::in_place);
  if (bytes.size() > 16 * kTextMax || !message->ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return std::nullopt;
  return message;
}

template <class... Text>
bool fit(const Text&... text) {
  return ((text.size() <= kTextMax) && ...);
}

}  // namespace

std::string encode_event(const LessonEvent& event) {
  recording::Event out;
  out.set_what(event.what);
  out.set_seat(event.seat);
  out.set_text(event.text);
  out.set_person(event.person);
  return out.SerializeAsString();
}

std::string encode_mark(const LessonMark& mark) {
  recording::Mark out;
  out.set_t_s(mark.t_s);
  out.set_by(mark.by);
  out.set_text(mark.text);
  return out.SerializeAsString();
}

std::string encode_sheet(const LessonSheet& sheet) {
  recording::Sheet out;
  out.set_sheet(sheet.sheet);
  out.set_of(sheet.of);
  out.set_by(sheet.by);
  for (const auto& [item, value] : sheet.scores) {
    recording::Score& score = *out.add_scores();
    score.set_item(item);
    score.set_value(value);
  }
  out.set_closed(sheet.closed);
  return out.SerializeAsString();
}

std::string encode_link(const LessonLink& link, const std::string& seat) {
  recording::Link out;
  out.set_seat(seat);
  out.set_rtt_p50_ms(link.rtt_p50_ms);
  out.set_loss_up_percent(link.loss_up_percent);
  out.set_loss_down_percent(link.loss_down_percent);
  out.set_gap_up_ms(link.gap_up_ms);
  out.set_gap_down_ms(link.gap_down_ms);
  out.set_age_p99_ms(link.age_p99_ms);
  out.set_gate_trips(link.gate_trips);
  out.set_late_ticks(link.late_ticks);
  return out.SerializeAsString();
}

std::string encode_counts(const CountsMessage& counts) {
  recording::Counts out;
  out.set_ticks(counts.ticks);
  out.set_tools_digest(counts.tools_digest);
  for (const auto& [topic, count] : counts.channels) {
    recording::Count& row = *out.add_channels();
    row.set_topic(topic);
    row.set_recorded(count.recorded);
    row.set_dropped(count.dropped);
    row.set_never_received(count.never_received);
  }
  return out.SerializeAsString();
}

void encode_inputs(std::uint32_t tick, std::span<const std::byte> data, std::string& out) {
  out.clear();
  FieldWriter fields{out};
  fields.fixed32(1, tick);
  fields.bytes(2, text_of(data));
}

std::optional<LessonEvent> decode_event(std::span<const std::byte> bytes) {
  const auto in = parse<recording::Event>(bytes);
  if (!in || !fit(in->what(), in->seat(), in->text(), in->person())) return std::nullopt;
  return LessonEvent{.what = in->what(), .seat = in->seat(), .text = in->text(), .person = in->person()};
}

std::optional<LessonMark> decode_mark(std::span<const std::byte> bytes) {
  const auto in = parse<recording::Mark>(bytes);
  if (!in || !fit(in->by(), in->text())) return std::nullopt;
  return LessonMark{.t_s = in->t_s(), .by = in->by(), .text = in->text()};
}

std::optional<LessonSheet> decode_sheet(std::span<const std::byte> bytes) {
  const auto in = parse<recording::Sheet>(bytes);
  if (!in || !fit(in->sheet(), in->of(), in->by())) return std::nullopt;
  LessonSheet sheet{.sheet = in->sheet(), .of = in->of(), .by = in->by(), .scores = {}, .closed = in->closed()};
  for (const recording::Score& score : in->scores()) sheet.scores[score.item()] = score.value();
  return sheet;
}

std::optional<LessonLink> decode_link(std::span<const std::byte> bytes, std::string& seat) {
  const auto in = parse<recording::Link>(bytes);
  if (!in || !fit(in->seat())) return std::nullopt;
  seat = in->seat();
  LessonLink link;
  link.rtt_p50_ms = in->rtt_p50_ms();
  link.loss_up_percent = in->loss_up_percent();
  link.loss_down_percent = in->loss_down_percent();
  link.gap_up_ms = in->gap_up_ms();
  link.gap_down_ms = in->gap_down_ms();
  link.age_p99_ms = in->age_p99_ms();
  link.gate_trips = in->gate_trips();
  link.late_ticks = in->late_ticks();
  return link;
}

std::optional<CountsMessage> decode_counts(std::span<const std::byte> bytes) {
  const auto in = parse<recording::Counts>(bytes);
  if (!in) return std::nullopt;
  CountsMessage counts;
  counts.ticks = in->ticks();
  counts.tools_digest = in->tools_digest();
  for (const recording::Count& row : in->channels()) {
    if (!fit(row.topic())) return std::nullopt;
    counts.channels.push_back({row.topic(), {row.recorded(), row.dropped(), row.never_received()}});
  }
  return counts;
}

std::optional<InputsMessage> decode_inputs(std::span<const std::byte> bytes) noexcept {
  InputsMessage inputs;
  FieldScanner scanner{bytes};
  Field field;
  while (scanner.next(field)) {
    if (field.number == 1) inputs.tick = static_cast<std::uint32_t>(field.value);
    if (field.number == 2) inputs.data = field.bytes;
  }
  return scanner.ok() ? std::optional(inputs) : std::nullopt;
}

}  // namespace tandem::rec
