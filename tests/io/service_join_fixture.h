#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "client/app/join_client.h"
#include "client/app/server_addresses.h"
#include "common/auth/io/client_keystore.h"
#include "proto/text/service_text.h"
#include "tests/io/member_server.h"

namespace tandem::client {

using namespace std::chrono_literals;
using server::ServerLocation;
using server::SessionLocator;
using server::test::MemberServer;

/// A service with a workstation that is enrolled at its server "a".
class ServiceJoin : public testing::Test {
 protected:
  ServiceJoin() {
    EXPECT_TRUE(auth::ServiceKeystore::init(folder.path("service")));
    EXPECT_TRUE(auth::ServiceKeystore::init(folder.path("other")));
  }
  std::unique_ptr<MemberServer> member(const std::string& name, const char* service = "service",
                                       const std::string& at = tandem::test::free_address()) {
    auto made = std::make_unique<MemberServer>(name, folder.path(service), at);
    made->enrol(own().identity());
    return made;
  }
  auth::ClientKeystore own() {
    return std::move(*auth::ClientKeystore::open_or_make(folder.path("client"), auth::wall_seconds()));
  }
  void know(const MemberServer& server) {
    EXPECT_EQ(own().store_server({server.at(), server.key.sha256, "touch-01"}), "");
  }
  JoinOptions options(const std::vector<const MemberServer*>& servers, Duration timeout = 20s) {
    JoinOptions out{.seat = "trainee", .session = MemberServer::kCode, .state = folder.path("client")};
    std::string text;
    for (const MemberServer* s : servers) text += (text.empty() ? "" : ",") + s->at();
    EXPECT_EQ(set_server_addresses(text, out), "");
    out.caps.joints = out.caps.tip_axes = 3;
    out.caps.simulated = true;
    out.timeout = timeout;
    return out;
  }
  /// State with which a seat that was joined is resumed, and the secret's hash for the next server.
  static ResumeState resume_state(const JoinedSeat& joined) {
    return {.session = joined.welcome.session_id,
            .epoch = joined.welcome.epoch,
            .secrets = {joined.welcome.resume_secret},
            .setup = joined.setup,
            .server = joined.server,
            .service = joined.service};
  }
  server::SeatReservation::Hash secret_of(const JoinedSeat& joined) {
    return server::resume_hash(joined.welcome.resume_secret.bytes, own().identity().fingerprint().sha256);
  }
  std::string reason(const JoinOptions& asking) {
    const auto joined = join_seat(asking);
    return joined ? "joined" : joined.error().reason;
  }
  /// The voucher in a member file.
  static std::vector<std::byte> text_of_member(std::span<const std::byte> file) {
    return parse_member({reinterpret_cast<const char*>(file.data()), file.size()}, "member")->voucher;
  }
  static void point(MemberServer& from, SessionLocator::Found to) {
    from.on_thread([&] { from.directory.found = std::move(to); });
  }
  auth::test::Folder folder;
};

}  // namespace tandem::client
