// Fuzzes files of a registry and of a service: workstations, codes, known servers, member file and service file. A
// member file comes from another computer. Each accepted text reads the same after it is printed.
#include "common/auth/io/service_membership.h"
#include "proto/text/registry_text.h"
#include "proto/text/service_text.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem;
  const auto text = fuzz::text(data, size);
  if (const auto rows = parse_workstations(text, "fuzz"))
    FUZZ_EXPECT(parse_workstations(print_workstations(*rows), "fuzz") == *rows);
  if (const auto rows = parse_codes(text, "fuzz")) FUZZ_EXPECT(parse_codes(print_codes(*rows), "fuzz") == *rows);
  if (const auto rows = parse_servers(text, "fuzz")) FUZZ_EXPECT(parse_servers(print_servers(*rows), "fuzz") == *rows);
  if (const auto serving = parse_serving(text, "fuzz"))
    FUZZ_EXPECT(parse_serving(print_serving(*serving), "fuzz").has_value());
  if (const auto changes = parse_service(text, "fuzz"))
    FUZZ_EXPECT(parse_service(print_service(*changes), "fuzz") == *changes);
  if (const auto rows = parse_vouched(text, "fuzz")) FUZZ_EXPECT(parse_vouched(print_vouched(*rows), "fuzz") == *rows);
  if (const auto member = parse_member(text, "fuzz"))
    FUZZ_EXPECT(parse_member(print_member(*member), "fuzz").has_value());
  const auto membership = auth::read_membership(fuzz::bytes(data, size), "fuzz", {});
  FUZZ_EXPECT(!membership && !membership.error().empty());
  return 0;
}
