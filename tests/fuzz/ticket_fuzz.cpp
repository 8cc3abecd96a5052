// Tickets as bytes and as text, and the enrolment strings and codes that people type. Nobody forges a signature; what is signed by
// mistake is refused by its range; what is read is written the same.
#include "common/trust/enrolment.h"
#include "common/trust/ticket.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem;
  static const trust::TicketKey key{Secret<32>{}};
  trust::TicketUse use;
  use.seat = "trainee";
  use.now = 1'700'000'000;
  const auto in = fuzz::bytes(data, size);
  FUZZ_EXPECT(!trust::check_ticket(in, key.verifier(), use));
  if (size == trust::kTicketSize) {
    trust::TicketBytes ticket;
    std::ranges::copy(in, ticket.begin());
    const auto back = trust::ticket_from_text(trust::ticket_text(ticket));
    FUZZ_EXPECT(back && *back == ticket);
  }
  const auto text = fuzz::text(data, size);
  if (const auto ticket = trust::ticket_from_text(text)) {
    const auto back = trust::ticket_from_text(trust::ticket_text(*ticket));
    FUZZ_EXPECT(back && *back == *ticket);
  }
  if (const auto enrolment = trust::EnrolmentString::from_text(text)) {
    const auto again = trust::EnrolmentString::from_text(enrolment->to_text());
    FUZZ_EXPECT(again && again->to_text() == enrolment->to_text());
  }
  if (const auto code = trust::canonical_session_code(text)) FUZZ_EXPECT(trust::canonical_session_code(*code) == code);
  static_cast<void>(trust::TicketKey::from_text(in));
  return 0;
}
