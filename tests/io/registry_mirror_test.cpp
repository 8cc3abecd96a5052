// Workstations and codes of two servers of a service, in their state folders, with a directory in memory.
#include "server/app/service/registry_mirror.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <mutex>
#include <thread>

#include "server/directory/model_store.h"
#include "tests/io/programs.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using tandem::test::Folder;

/// A directory in memory for the threads of several servers.
struct CommonStore {
  std::mutex lock;
  directory::ModelStore store;
};
class CommonDirectory final : public directory::Directory {
 public:
  explicit CommonDirectory(CommonStore& common) : common_(common), inner_(common.store) {}
  void begin(directory::OperationId operation, const directory::Request& request) override {
    const std::lock_guard lock(common_.lock);
    common_.store.advance(ServiceThread::now());
    inner_.begin(operation, request);
  }
  std::optional<directory::Reply> poll() override {
    const std::lock_guard lock(common_.lock);
    return inner_.poll();
  }

 private:
  CommonStore& common_;
  directory::ModelDirectory inner_;
};

/// The parts of a server that keep its lists.
struct Member {
  Member(const std::string& path, CommonStore& store, const std::string& name) : folder(path) {
    if (!std::filesystem::exists(folder)) static_cast<void>(auth::ServerKeystore::init(folder, 1));
    beside = std::make_unique<auth::ServerKeystore>(std::move(*auth::ServerKeystore::open(folder)));
    ServiceMemberOptions options{.server = name};
    options.agreed = RegistryMirror::read_agreement(*beside->folder());
    options.registry_mark = "mark of " + name;
    service = std::make_unique<ServiceThread>(std::move(options), std::make_unique<CommonDirectory>(store), snapshots);
    mirror = std::make_unique<RegistryMirror>(std::move(*auth::ServerKeystore::open(folder)), *service,
                                              [this](const std::string& what) {
                                                const std::lock_guard lock(mutex);
                                                troubles.push_back(what);
                                              });
    service->start({});
    mirror->start();
  }
  /// Waits until `name` is enrolled under a key, or not at all; false after 30 s.
  bool reaches(const std::string& name, std::optional<std::byte> key) {
    for (int i = 0; i < 3000; ++i) {
      const auto rows = beside->registry().workstations();
      const WorkstationRow* const row = rows ? auth::find_workstation(*rows, name) : nullptr;
      if (rows && (row == nullptr ? !key : key == row->spki[0])) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  bool reaches_trouble() {
    for (int i = 0; i < 3000; ++i) {
      {
        const std::lock_guard lock(mutex);
        if (!troubles.empty()) return true;
      }
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }

  std::string folder;
  std::unique_ptr<auth::ServerKeystore> beside;  ///< as a command in the same folder has it
  DirectorySnapshots snapshots;
  std::unique_ptr<ServiceThread> service;
  std::unique_ptr<RegistryMirror> mirror;
  std::mutex mutex;
  std::vector<std::string> troubles;
};

TEST(RegistryMirror, BringsEnrolmentsAndRevocationsFromFolderToFolder) {
  const Folder folder;
  CommonStore store;
  auto a = std::make_unique<Member>(folder.file("a"), store, "a");
  Member b(folder.file("b"), store, "b");
  auth::EnrolmentCode code;
  code.bytes[0] = std::byte{9};
  const std::int64_t now = auth::wall_seconds();
  ASSERT_EQ(a->beside->registry().enroll_without_code({"desk", {std::byte{1}}, now}), "");
  ASSERT_EQ(a->beside->registry().issue_code(code, "office", now, now + 600), "");
  ASSERT_TRUE(b.reaches("desk", std::byte{1}));
  // The code that one server issued enrols at the other, once in the service.
  for (int i = 0; i < 3000 && b.beside->registry().pending_codes(now) != 1U; ++i) std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(b.beside->registry().enroll(code, {{std::byte{2}}}, now));
  ASSERT_TRUE(a->reaches("office", std::byte{2}));
  EXPECT_FALSE(a->beside->registry().enroll(code, {{std::byte{3}}}, now));

  // A revocation while a server is down holds when it is back.
  a->mirror->stop();
  a->service->stop();
  a.reset();
  ASSERT_TRUE(b.beside->registry().revoke("desk"));
  std::this_thread::sleep_for(500ms);
  a = std::make_unique<Member>(folder.file("a"), store, "a");
  EXPECT_TRUE(a->reaches("desk", std::nullopt));
  EXPECT_TRUE(b.reaches("desk", std::nullopt)) << "the server that was down does not bring it back";
  EXPECT_TRUE(a->reaches("office", std::byte{2}));
  // The server writes to its audit log after its lists.
  for (const char* event : {"enrolled_in_service", "revoked_in_service"}) {
    const auto audit = [&] { return folder.read(std::string("a/") + auth::ServerKeystore::kAuditFile); };
    for (int i = 0; i < 3000 && audit().find(event) == std::string::npos; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_NE(audit().find(event), std::string::npos) << audit();
  }
}

TEST(RegistryMirror, ReportsAListThatCannotBeReadAndChangesNothing) {
  const Folder folder;
  CommonStore store;
  Member a(folder.file("a"), store, "a"), b(folder.file("b"), store, "b");
  ASSERT_EQ(a.beside->registry().enroll_without_code({"desk", {std::byte{1}}, 1}), "");
  ASSERT_TRUE(b.reaches("desk", std::byte{1}));
  std::ofstream(folder.file("a") + "/" + auth::ServerRegistry::kWorkstationsFile) << "workstation {";
  ASSERT_TRUE(a.reaches_trouble());
  EXPECT_NE(a.troubles.front().find(auth::ServerRegistry::kWorkstationsFile), std::string::npos) << a.troubles.front();
  std::this_thread::sleep_for(500ms);
  EXPECT_TRUE(b.reaches("desk", std::byte{1})) << "a damaged list revokes nothing";
  EXPECT_EQ(a.troubles.size(), 1U) << "each error once";
}

/// The revision of a directory rises many times a second; a file that followed it would wear out the disk.
TEST(RegistryMirror, StoresANewRevisionAloneEveryTenSecondsOnly) {
  RegistryAgreement stored{.mark = "m", .entries = {}, .created = 1, .revision = 5};
  RegistryAgreement agreed = stored;
  EXPECT_FALSE(RegistryMirror::worth_storing(agreed, stored, 1h)) << "nothing differs";
  agreed.revision = 6;
  EXPECT_FALSE(RegistryMirror::worth_storing(agreed, stored, 9999ms));
  EXPECT_TRUE(RegistryMirror::worth_storing(agreed, stored, 10s));
  agreed.epoch_base = 1;
  EXPECT_TRUE(RegistryMirror::worth_storing(agreed, stored, 0s)) << "else a restart would use an epoch twice";
}

}  // namespace
}  // namespace tandem::server
