#include "server/app/recording/recording_desk.h"

#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::server {
namespace {

using Json = nlohmann::json;

std::string note_member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? sanitize(found->get<std::string>()) : std::string();
}

}  // namespace

std::optional<rpc::StatusRecording> RecordingDesk::status() const {
  const std::lock_guard lock(lock_);
  return status_;
}

std::uint32_t RecordingDesk::begin(rpc::StatusRecording status) {
  const std::lock_guard lock(lock_);
  status_ = std::move(status);
  return ++recording_;
}

void RecordingDesk::set_status(std::uint32_t recording, std::optional<rpc::StatusRecording> status) {
  const std::lock_guard lock(lock_);
  if (recording == recording_) status_ = std::move(status);
}

void RecordingDesk::set_person(std::size_t seat, const std::string& person, const std::string& workstation) {
  const std::lock_guard lock(lock_);
  if (seat >= persons_.size()) return;
  persons_[seat] = named(person.empty() ? workstation : person);
  workstations_[seat] = person.empty();
}

std::vector<bool> RecordingDesk::workstations() const {
  const std::lock_guard lock(lock_);
  return workstations_;
}

std::vector<std::string> RecordingDesk::persons() const {
  const std::lock_guard lock(lock_);
  return persons_;
}

std::uint32_t RecordingDesk::add_order(const std::string& person) {
  const std::lock_guard lock(lock_);
  if (++order_ == 0) ++order_;  // after 2^32 orders
  orders_[order_ % kOrdersMax] = {order_, person};
  return order_;
}

void RecordingDesk::add_event(LessonEvent event, std::uint32_t order) {
  const std::lock_guard lock(lock_);
  // Without a recording nothing takes the items, and a later one begins with its own.
  if (!status_ || !room()) return;
  const auto& [number, person] = orders_[order % kOrdersMax];
  if (order != 0 && number == order) event.person = named(person);
  items_.events.push_back(std::move(event));
}

/// A note has the name in its author's ticket, else the one typed at the page, else the workstation.
void RecordingDesk::add_note(const SessionNote& note) {
  const Json object = Json::parse(note.json, nullptr, false);
  if (!object.is_object()) return;
  const std::string typed = note_member(object, "person");
  const std::lock_guard lock(lock_);
  if (!status_ || !room()) return;
  std::string by = named(!note.person.empty() ? note.person : !typed.empty() ? typed : note.workstation);
  if (note.kind == rpc::NoteKind::kMark) {
    const auto t = object.find("t");
    items_.marks.push_back({t != object.end() && t->is_number() ? t->get<double>() : note.time_s, std::move(by),
                            note_member(object, "text")});
    return;
  }
  LessonSheet sheet{note_member(object, "sheet"), note_member(object, "of"), by, {}, false};
  if (const auto scores = object.find("scores"); scores != object.end() && scores->is_object())
    for (const auto& [item, score] : scores->items())
      if (score.is_number_integer()) sheet.scores[sanitize(item)] = score.get<int>();
  if (const auto closed = object.find("closed"); closed != object.end() && closed->is_boolean())
    sheet.closed = closed->get<bool>();
  items_.sheets.push_back(std::move(sheet));
}

RecordingDesk::Items RecordingDesk::take(std::uint32_t recording) {
  const std::lock_guard lock(lock_);
  if (recording != recording_) return {};
  Items taken = std::move(items_);
  items_ = {};
  items_.lost = taken.lost;
  return taken;
}

std::string RecordingDesk::named(const std::string& person) {
  if (!pseudonyms_ || person.empty()) return person;
  const auto found = names_.find(person);
  if (found != names_.end()) return found->second;
  if (names_.size() >= kNamesMax) return "P?";
  return names_.emplace(person, format("P%zu", names_.size() + 1)).first->second;
}

bool RecordingDesk::room() {
  if (items_.events.size() + items_.marks.size() + items_.sheets.size() < kItemsMax) return true;
  ++items_.lost;
  return false;
}

}  // namespace tandem::server
