#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/io/event_fd.h"
#include "server/app/control/session_registry.h"
#include "tests/server/app/process/table_rig.h"

namespace tandem::server::test {

/// Keeps what the table passes on.
class KeptSnapshots final : public SnapshotKeeper {
 public:
  std::shared_ptr<CheckpointMailbox> add(SessionSnapshot kept) override {
    last = std::move(kept);
    mailbox = std::make_shared<CheckpointMailbox>(wake_);
    return mailbox;
  }
  void set_removed(const std::string&, const std::vector<std::array<std::byte, 32>>&) override {}
  void set_persons(const std::string&, const std::vector<std::string>&) override {}
  void set_consoles(const std::string& name, const std::vector<auth::Id16>& tickets) override {
    consoles[name] = tickets;
  }
  void remove(const std::string& name) override { removed.push_back(name); }
  SessionSnapshot last;
  std::shared_ptr<CheckpointMailbox> mailbox;
  std::vector<std::string> removed;
  std::map<std::string, std::vector<auth::Id16>> consoles;

 private:
  io::EventFd wake_;
};

/// Options of a member of a service whose shards tick at the rate of scene `lesson`.
inline ServerOptions member() {
  ServerOptions options = options_with({lesson("configured")});
  options.service = true;
  return options;
}

struct Member {
  explicit Member(bool notes = false) : rig(member(), notes) {}
  /// A session of scene `lesson` as `revision` of its ownership.
  OwnedSession owned(std::uint64_t revision) {
    return {.options = std::make_shared<const SessionOptions>(lesson("exam")),
            .id = {std::byte{7}},
            .code = "ABCDEFGHJK",
            .revision = revision,
            .keeper = &kept,
            .on_over = [this](bool given_up) { overs.push_back(given_up); }};
  }
  /// The checkpoint that the session has published last; the test fails after 10 s without one.
  Checkpoint checkpoint() {
    Checkpoint newest;
    for (int i = 0; i < 1000; ++i) {
      if (kept.mailbox->take(newest)) return newest;
      poll(nullptr, 0, 10);
    }
    ADD_FAILURE() << "no checkpoint for 10 s";
    return newest;
  }
  SessionInstance& only() { return *rig.table->all().front(); }
  void service_until_over() {
    rig.wait_until_over(only());
    rig.table->service(io::monotonic_now());
  }
  KeptSnapshots kept;
  std::vector<bool> overs;
  TableRig rig;
};

}  // namespace tandem::server::test
