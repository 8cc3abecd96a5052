#include "proto/text/registry_text.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"
#include "proto/text/service_text.h"

namespace tandem {
namespace {

Sha256 hash(unsigned start) {
  Sha256 h;
  for (std::size_t i = 0; i < h.size(); ++i) h[i] = static_cast<std::byte>(start + i);
  return h;
}

const std::string kHex64(64, 'a');

TEST(RegistryText, RoundTripsEveryRegistry) {
  const std::vector<WorkstationRow> workstations{{"touch-07", hash(1), 1'800'000'000}, {"b", hash(200), 0}};
  EXPECT_EQ(parse_workstations(print_workstations(workstations), "f"), workstations);
  const std::vector<CodeRow> codes{{hash(3), "touch-08", 1'800'086'400}};
  EXPECT_EQ(parse_codes(print_codes(codes), "f"), codes);
  const std::vector<ServerRow> servers{{"lab:7000", hash(4), "touch-07"}, {"[::1]:7000", hash(5), "x"}};
  EXPECT_EQ(parse_servers(print_servers(servers), "f"), servers);
  const std::vector<ServerRow> members{
      {"lab:7000", hash(4), "touch-07", ServicePin{hash(9), hash(10), 1'800'000'000}, {"lab:7000", "[::1]:7001"}},
      {"b:1", hash(5), "x", ServicePin{hash(9), {}, 0}}};
  EXPECT_EQ(parse_servers(print_servers(members), "f"), members);
  const MemberRow member{
      "desk-a", hash(1), "tandem-ticket-key-v1 00", {std::byte{1}}, {{std::byte{2}}, {std::byte{3}}}};
  EXPECT_EQ(parse_member(print_member(member), "f"), member);
  EXPECT_EQ(parse_service(print_service(member.key_changes), "f"), member.key_changes);
  const std::vector<VouchedRow> vouched{{"desk-a", hash(1), 1'800'000'000}, {"desk-a", hash(2), 0}};
  EXPECT_EQ(parse_vouched(print_vouched(vouched), "f"), vouched);
  ServingSpec serving{
      "127.0.0.1:7000",
      {{{}, "ABCDE12345", "contact", 3, {{"trainer", AccessRole::kInstructor}, {"trainee", AccessRole::kTrainee}}}}};
  serving.sessions[0].id[5] = std::byte{0xfe};
  EXPECT_EQ(parse_serving(print_serving(serving), "f"), serving);
}

TEST(RegistryText, ReadsAnEmptyFileAsAnEmptyRegistry) {
  EXPECT_EQ(parse_workstations("", "f"), std::vector<WorkstationRow>{});
  EXPECT_EQ(parse_workstations(print_workstations({}), "f"), std::vector<WorkstationRow>{});
  EXPECT_EQ(parse_codes("# nothing\n", "f"), std::vector<CodeRow>{});
}

TEST(RegistryText, ReportsEveryMistakeWithItsPlace) {
  const std::string row = "workstation { name: \"a\" spki_sha256: \"" + kHex64 + "\" enrolled_at_s: 5 }\n";
  const auto messages = [](const std::string& text) {
    const auto got = parse_workstations(text, "w.textproto");
    return got ? std::string() : to_text(got.error());
  };
  EXPECT_EQ(messages(row), "");
  EXPECT_NE(messages(row + row).find("w.textproto:2:"), std::string::npos) << messages(row + row);
  EXPECT_NE(messages(row + row).find("occurs twice"), std::string::npos);
  EXPECT_NE(
      messages("workstation { name: \"a b\" spki_sha256: \"00\" enrolled_at_s: -1 }").find("64 lower-case hex digits"),
      std::string::npos);
  EXPECT_NE(messages("workstation { spki_sha256: \"" + kHex64 + "\" }"), "");
  EXPECT_NE(messages("workstaton { }").find("workstation"), std::string::npos) << "the nearest key is named";
  EXPECT_NE(messages(row.substr(0, row.size() / 2)), "");
  EXPECT_FALSE(parse_servers("server { address: \"nowhere\" spki_sha256: \"" + kHex64 + "\" name: \"a\" }", "f"));
  const std::string known = "server { address: \"a:1\" spki_sha256: \"" + kHex64 + "\" name: \"a\" ";
  EXPECT_FALSE(parse_servers(known + "service_key: \"00\" }", "f"));
  EXPECT_FALSE(parse_servers(known + "service_key: \"" + kHex64 + "\" service_key_before: \"" + kHex64 + "\" }", "f"));
  EXPECT_FALSE(parse_servers(known + "member: \"nowhere\" }", "f"));
  EXPECT_FALSE(parse_member("name: \"a\" service_key: \"" + kHex64 + "\" ticket_key: \"x\" voucher: \"0\"", "f"));
  EXPECT_FALSE(parse_member("name: \"a\" service_key: \"" + kHex64 + "\" ticket_key: \"x\"", "f"));
  EXPECT_FALSE(parse_service("key_change: \"" + std::string(514, 'a') + "\"", "f"));
  EXPECT_FALSE(parse_vouched("server { name: \"a\" spki_sha256: \"00\" not_after_s: 1 }", "f"));
  EXPECT_FALSE(parse_vouched("server { name: \"a b\" spki_sha256: \"" + kHex64 + "\" not_after_s: 1 }", "f"));
  EXPECT_FALSE(parse_serving(
      "address: \"a:1\" session { id: \"00\" code: \"short\" name: \"x\" seat { name: \"a\" role: \"king\" } }", "f"));
}

TEST(RegistryText, SurvivesAnyText) {
  RandomStream random(2);
  const std::string good = print_workstations({{"a", hash(1), 5}}) + print_codes({{hash(1), "a", 5}});
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[random.below(text.size())] = static_cast<char>(random.bits() & 0xff);
    (void)parse_workstations(text, "f");
    (void)parse_codes(text, "f");
    (void)parse_servers(text, "f");
    (void)parse_serving(text, "f");
  }
}

}  // namespace
}  // namespace tandem
