#include "tests/common/auth/faults/state_workload.h"

#include <gtest/gtest.h>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "server/app/process/checkpoint_store.h"
#include "tests/common/auth/faults/workload_session.h"

namespace tandem::test {

using auth::test::kNow;

namespace {

bool told(Told& what, bool yes) {
  what = yes ? Told::kYes : Told::kNo;
  return yes;
}

}  // namespace

auth::Ticket story_ticket(std::size_t number) {
  auth::Ticket t = auth::test::sample_ticket();
  t.ticket_id[0] = static_cast<std::byte>(200 + number);
  return t;
}
auth::TicketUse story_use(const auth::Ticket& ticket) { return auth::test::sample_use(ticket); }
auth::EnrolmentCode story_code() { return auth::test::secret_from<16>(77); }
auth::KeyFingerprint story_pin(unsigned workstation) {
  return auth::KeyFingerprint{auth::test::counting<32>(10 * workstation + 1)};
}
std::string story_line(std::size_t number) { return "marker-" + std::to_string(100 + number); }

void prepare(const std::string& folder) {
  ASSERT_TRUE(auth::ServerKeystore::init(folder + "/server", kNow));
  auto trust = auth::ServerKeystore::open(folder + "/server");
  ASSERT_TRUE(trust) << trust.error();
  ASSERT_EQ(trust->registry().enroll_without_code({"w0", story_pin(0).sha256, kNow}), "");
}

bool first_start(const std::string& folder) { return auth::ServerKeystore::init(folder + "/fresh", kNow).has_value(); }

void live_server(const std::string& folder, Story& story) {
  auto trust = auth::ServerKeystore::open(folder + "/server");
  if (!trust || !told(story.serving, trust->begin_serving(kNow).empty())) return;
  // Small files, and more files than the story fills: the log rotates and loses no line.
  trust->enable_audit_rotation({.file_max = 400, .older = 9});
  told(story.code, trust->registry().issue_code(story_code(), "w1", kNow, kNow + 1000).empty());
  told(story.enrolled, trust->registry().enroll(story_code(), story_pin(1), kNow + 1).has_value());
  for (std::size_t i = 0; i < Story::kTickets; ++i) {
    const auth::Ticket ticket = story_ticket(i);
    const auto bytes = *auth::sign_ticket(ticket, trust->ticket_key());
    if (told(story.ticket[i], trust->tickets().redeem(bytes, story_use(ticket)).has_value())) continue;
    told(story.again[i], trust->tickets().redeem(bytes, story_use(ticket)).has_value());
  }
  const std::size_t back = Story::kGivenBack;
  if (story.ticket[back] == Told::kYes)
    told(story.given_back, trust->tickets().restore(story_ticket(back).ticket_id).empty());
  for (std::size_t i = 0; i < Story::kLines; ++i)
    told(story.line[i], trust->audit(kNow + static_cast<std::int64_t>(i), "told", story_line(i)).empty());
  (void)trust->retry_audit(kNow + 20);  // as a server does every second
  (void)trust->serving().write({"127.0.0.1:7000", {}});
  (void)trust->serving().request_shutdown(30);
  (void)trust->serving().requested_shutdown();
  told(story.revoked, trust->registry().revoke("w0").has_value());
}

void live_session(const std::string& folder, Story& story) {
  bool trouble = false;
  auto book = server::CheckpointStore::open(folder + "/server", "", [&](const std::string&) { trouble = true; });
  if (!book) return;
  const server::SessionSnapshot session = story_session(story_scene());
  (*book)->start();
  const auto mail = (*book)->add(session);
  while (!mail->publish(session.checkpoint)) {
  }
  (*book)->stop();
  told(story.kept, !trouble);
}

void live_workstation(const std::string& folder, Story& story) {
  const auto own = auth::ClientKeystore::open_or_make(folder + "/own", kNow);
  if (told(story.workstation, own.has_value()))
    told(story.remembered, own->store_server({"h:1", story_pin(5).sha256, "w1"}).empty());
}

}  // namespace tandem::test
