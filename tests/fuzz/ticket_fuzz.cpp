// Fuzzes tickets as bytes and as text, statements of a service, and the enrolment strings and session codes that users
// type. No input has a valid signature. Each accepted input keeps its value when it is converted to text and back.
#include <algorithm>

#include "common/auth/enrolment.h"
#include "common/auth/service_pin.h"
#include "common/auth/ticket.h"
#include "proto/rpc/ticket_codec.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem;
  static const auth::TicketKey key{Secret<32>{}};
  auth::TicketUse use;
  use.seat = "trainee";
  use.now = 1'700'000'000;
  const auto in = fuzz::bytes(data, size);
  FUZZ_EXPECT(!auth::check_ticket(in, key.verifier(), use));
  if (const auto ticket = rpc::decode_signed_ticket(in)) FUZZ_EXPECT(std::ranges::equal(rpc::encode(*ticket), in));
  if (const auto content = rpc::decode_ticket_content(in)) FUZZ_EXPECT(std::ranges::equal(rpc::encode(*content), in));
  const ServicePin pin{key.verifier().key, {}, 0};
  FUZZ_EXPECT(!auth::check_voucher(in, pin, {}, use.now));
  FUZZ_EXPECT(!auth::accept_member(in, pin, {}, use.now));
  const std::vector<std::vector<std::byte>> change{std::vector<std::byte>(in.begin(), in.end())};
  FUZZ_EXPECT(auth::follow_key_changes(pin, change) == pin);
  if (const auto statement = rpc::decode_service_statement(in))
    FUZZ_EXPECT(std::ranges::equal(rpc::encode(*statement), in));
  if (const auto credential = rpc::decode_member_credential(in))
    FUZZ_EXPECT(std::ranges::equal(rpc::encode(*credential), in));
  static_cast<void>(auth::claimed_role(in));
  static_cast<void>(auth::claimed_workstation(in));
  const auto text = fuzz::text(data, size);
  if (const auto ticket = auth::ticket_from_text(text)) {
    const auto back = auth::ticket_from_text(auth::ticket_text(*ticket));
    FUZZ_EXPECT(back && *back == *ticket);
  }
  if (const auto enrolment = auth::EnrolmentString::from_text(text)) {
    const auto again = auth::EnrolmentString::from_text(enrolment->to_text());
    FUZZ_EXPECT(again && again->to_text() == enrolment->to_text());
  }
  if (const auto code = auth::canonical_session_code(text)) FUZZ_EXPECT(auth::canonical_session_code(*code) == code);
  static_cast<void>(auth::TicketKey::from_text(in));
  return 0;
}
