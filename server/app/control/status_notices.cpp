#include "server/app/control/status_notices.h"

#include <utility>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::server {

void StatusNotices::add(std::string_view text) {
  if (events_.size() == rpc::kStatusEventsMax) events_.erase(events_.begin());
  events_.push_back({++count_, truncate_utf8(text, rpc::kTextMax)});
}

void StatusNotices::set_resume(std::uint32_t number, std::string who) {
  resumed_ = number;
  resumer_ = std::move(who);
}

void StatusNotices::update(const StopLatch& latch, const SceneSpec& scene, const std::string& person) {
  const StopLatch::Ended& ended = latch.ended();
  if (ended.number == 0 || ended.number == std::exchange(resume_reported_, ended.number)) return;
  std::string who = ended.by < scene.seats.size()
                        ? (person.empty() ? "" : person + " at ") + scene.seats[ended.by].name + " (" +
                              std::string(to_text(ended.role)) + ")"
                        : "a console";
  if (resumed_ == ended.number) who = resumer_;
  add(format("stop %u is over: RESUMED by ", ended.number) + who +
      format("; force returns over %.1f s", scene.gate.ramp_in));
}

void StatusNotices::set_storage_problem(const std::string& why) {
  if (const bool before = std::exchange(storage_fails_, !why.empty()); before == storage_fails_) return;
  add(why.empty() ? "the state of the session is stored again: a stop survives a kill of the server"
                  : "the state of the session is NOT STORED: " + why +
                        ". Until that succeeds, a kill of the server undoes a stop");
}

}  // namespace tandem::server
