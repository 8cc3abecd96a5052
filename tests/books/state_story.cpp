#include "tests/books/state_story.h"

#include <gtest/gtest.h>

#include "common/trust/io/client_trust.h"
#include "common/trust/io/server_trust.h"
#include "server/app/checkpoint_book.h"
#include "tests/books/story_session.h"

namespace tandem::test {

using trust::test::kNow;

namespace {

bool told(Told& what, bool yes) {
  what = yes ? Told::kYes : Told::kNo;
  return yes;
}

}  // namespace

trust::Ticket story_ticket(std::size_t number) {
  trust::Ticket t = trust::test::sample_ticket();
  t.ticket_id[0] = static_cast<std::byte>(200 + number);
  return t;
}
trust::TicketUse story_use(const trust::Ticket& ticket) { return trust::test::sample_use(ticket); }
trust::EnrolmentCode story_code() { return trust::test::secret_from<16>(77); }
trust::Pin story_pin(unsigned workstation) { return trust::Pin{trust::test::counting<32>(10 * workstation + 1)}; }
std::string story_line(std::size_t number) { return "marker-" + std::to_string(100 + number); }

void prepare(const std::string& folder) {
  ASSERT_TRUE(trust::ServerTrust::init(folder + "/server", kNow));
  auto trust = trust::ServerTrust::open(folder + "/server");
  ASSERT_TRUE(trust) << trust.error();
  ASSERT_EQ(trust->enrol_directly({"w0", story_pin(0).sha256, kNow}), "");
}

bool first_start(const std::string& folder) { return trust::ServerTrust::init(folder + "/fresh", kNow).has_value(); }

void live_server(const std::string& folder, Story& story) {
  auto trust = trust::ServerTrust::open(folder + "/server");
  if (!trust || !told(story.serving, trust->begin_serving(kNow).empty())) return;
  // Small files, and more of them than are filled: rotated, and nothing forgotten.
  trust->keep_audit({.file_max = 400, .older = 9});
  told(story.code, trust->give_out(story_code(), "w1", kNow, kNow + 1000).empty());
  told(story.enrolled, trust->enrol(story_code(), story_pin(1), kNow + 1).has_value());
  for (std::size_t i = 0; i < Story::kTickets; ++i) {
    const trust::Ticket ticket = story_ticket(i);
    const auto bytes = *trust::sign_ticket(ticket, trust->ticket_key());
    if (told(story.ticket[i], trust->redeem(bytes, story_use(ticket)).has_value())) continue;
    told(story.again[i], trust->redeem(bytes, story_use(ticket)).has_value());
  }
  const std::size_t back = Story::kGivenBack;
  if (story.ticket[back] == Told::kYes) told(story.given_back, trust->give_back(story_ticket(back).ticket_id).empty());
  for (std::size_t i = 0; i < Story::kLines; ++i) told(story.line[i], trust->audit(kNow + static_cast<std::int64_t>(i), "told", story_line(i)).empty());
  (void)trust->retry_audit(kNow + 20);  // as a server does every second
  (void)trust->write_serving({"127.0.0.1:7000", {}});
  (void)trust->ask_to_end(30);
  (void)trust->asked_to_end();
  told(story.revoked, trust->revoke("w0").has_value());
}

void live_session(const std::string& folder, Story& story) {
  bool trouble = false;
  auto book = server::CheckpointBook::open(folder + "/server", "", [&](const std::string&) { trouble = true; });
  if (!book) return;
  const server::KeptSession session = story_session(story_scene());
  (*book)->start();
  const auto mail = (*book)->begin(session);
  while (!mail->lay_down(session.checkpoint)) {
  }
  (*book)->stop();
  told(story.kept, !trouble);
}

void live_workstation(const std::string& folder, Story& story) {
  const auto own = trust::ClientTrust::open_or_make(folder + "/own", kNow);
  if (told(story.workstation, own.has_value())) told(story.remembered, own->remember({"h:1", story_pin(5).sha256, "w1"}).empty());
}

}  // namespace tandem::test
