#include "tests/common/auth/faults/state_check.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "server/app/process/checkpoint_store.h"
#include "tests/common/auth/faults/state_files.h"
#include "tests/common/auth/faults/workload_session.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using auth::test::kNow;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Collects errors, one a line.
struct Wrong {
  std::string text;
  void unless(bool good, const std::string& what) {
    if (!good) text += what + "\n";
  }
};

bool dies(const FileFault& fault) {
  return fault.kind == FileFault::Kind::kKill || fault.kind == FileFault::Kind::kKillHalfway;
}

/// A disk can accept a line, fail to sync it and fail to truncate it again. The line then stays, and the server cannot
/// remove it.
bool may_stay_used(const FileFault& fault) {
  return dies(fault) || (fault.kind == FileFault::Kind::kInputOutput && fault.lasting);
}

void check_tickets(auth::ServerKeystore& trust, const Story& story, const FileFault& fault, Wrong& wrong) {
  for (std::size_t i = 0; i < Story::kTickets; ++i) {
    const std::string which = "ticket " + std::to_string(i) + ": ";
    const bool accepted = story.ticket[i] == Told::kYes || story.again[i] == Told::kYes;
    if (!fault.lasting && !dies(fault))
      wrong.unless(accepted || story.ticket[i] == Told::kNothing, which + "refused twice though the disk failed once");
    const auth::Ticket ticket = story_ticket(i);
    const auto again = trust.tickets().redeem(*auth::sign_ticket(ticket, trust.ticket_key()), story_use(ticket));
    const bool used = !again && again.error().fault && again.error().fault->rule == auth::TicketCheck::kUsed;
    wrong.unless(again || used, which + "neither good nor used: " + (again ? "" : again.error().text));
    if (i == Story::kGivenBack && story.given_back != Told::kNothing) {
      wrong.unless(!used || story.given_back == Told::kNo, which + "was given back and is used");
    } else if (i == Story::kGivenBack && accepted) {
      wrong.unless(used || dies(fault), which + "was used and is good again");
    } else if (accepted) {
      wrong.unless(used, which + "was used and is good again");
    } else {
      wrong.unless(!used || may_stay_used(fault), which + "admitted no client and is used");
    }
  }
}

void check_workstations(auth::ServerKeystore& trust, const Story& story, Wrong& wrong) {
  const auto has = [&](unsigned workstation) {
    const auto row = trust.registry().find(story_pin(workstation));
    wrong.unless(row.has_value(), "the registry of workstations cannot be read");
    return row && row->has_value();
  };
  if (story.revoked == Told::kYes) wrong.unless(!has(0), "w0 was revoked and is there");
  if (story.revoked == Told::kNothing && story.serving != Told::kNothing)
    wrong.unless(has(0) || story.enrolled != Told::kNothing, "w0 is gone although it was not revoked");
  if (story.enrolled == Told::kYes) wrong.unless(has(1), "w1 received Enrolled and is not enrolled");
  if (story.code == Told::kYes && story.enrolled != Told::kYes && !has(1)) {
    const auto later = trust.registry().enroll(story_code(), story_pin(1), kNow + 2);
    wrong.unless(later.has_value(),
                 "w1 is not enrolled, and its code is used up: " + (later ? "" : later.error().text));
  }
}

/// Checks that every line of every audit file is one JSON object, or a fragment on its own line that a crash left.
void check_audit(const std::string& folder, const Story& story, const FileFault& fault, Wrong& wrong) {
  std::map<std::string, int> seen;
  std::size_t lost = 0, torn = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with("audit.log")) continue;
    std::istringstream lines(text_of(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      const auto object = nlohmann::json::parse(line, nullptr, false);
      if (!object.is_object()) {
        ++torn;
        wrong.unless(line.starts_with("{\"ts\":") || line.size() < 6,
                     entry.path().string() + ": unexpected line: " + line);
        wrong.unless(line.find("}{") == std::string::npos && line.rfind("{\"ts\"") == 0,
                     entry.path().string() + ": two lines were joined: " + line);
        continue;
      }
      if (object["event"] == "told") ++seen[object["name"]];
      if (object["event"] == "audit_lost") lost += object["lines"].get<std::size_t>();
    }
  }
  wrong.unless(torn == 0 || dies(fault), std::to_string(torn) + " torn lines though nothing was killed");
  wrong.unless(torn <= 1, "more torn lines than one");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < Story::kLines; ++i) {
    const int count = seen[story_line(i)];
    if (story.line[i] == Told::kYes)
      wrong.unless(count == 1, story_line(i) + " was written and stands there " + std::to_string(count) + " times");
    if (story.line[i] == Told::kNo) ++refused;
    if (story.line[i] == Told::kNo)
      wrong.unless(count == 0 || may_stay_used(fault), story_line(i) + " was lost, and is there");
  }
  if (!fault.lasting && !dies(fault))
    wrong.unless(refused <= lost,
                 std::to_string(refused) + " lines were lost, and the log tells of " + std::to_string(lost));
}

void check_server(const std::string& folder, const Story& story, const FileFault& fault, Wrong& wrong) {
  for (const std::string& mistake : auth::ServerKeystore::find_errors(folder))
    wrong.unless(false, "--check: " + mistake);
  auto trust = auth::ServerKeystore::open(folder);
  wrong.unless(trust.has_value(), trust ? "" : trust.error());
  if (!trust) return;
  const std::string trouble = trust->begin_serving(kNow + 20);
  wrong.unless(trouble.empty(), "cannot serve again: " + trouble);
  if (!trouble.empty()) return;
  wrong.unless(!trust->serving().requested_shutdown(), "an order to end from before the restart ends this server");
  check_workstations(*trust, story, wrong);
  check_tickets(*trust, story, fault, wrong);
  wrong.unless(trust->audit(kNow + 30, "told", "after").empty(), "the audit log cannot be written");
  check_audit(folder, story, fault, wrong);
  wrong.unless(trust->serving().write({"127.0.0.1:1", {}}).empty(), "serving.textproto cannot be written");
}

void check_workstation(const std::string& folder, const Story& story, Wrong& wrong) {
  const auto own = auth::ClientKeystore::open_or_make(folder, kNow);
  wrong.unless(own.has_value(), own ? "" : "workstation: " + own.error());
  if (!own) return;
  const auto servers = own->servers();
  wrong.unless(servers.has_value(), "servers.textproto cannot be read");
  if (servers && story.remembered == Told::kYes)
    wrong.unless(servers->size() == 1, "the server it was enrolled at is forgotten");
}

/// Checks the rules that hold for every folder. @return all errors collected so far
std::string checked(const std::string& folder, Wrong& wrong) {
  const std::string unknown = unknown_files(folder);
  wrong.unless(
      unknown.empty(),
      "files without a check: add them to tests/common/auth/faults/state_files.h and their checks here:\n" + unknown);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    wrong.unless(written_beside(name).empty(), "left behind after a restart: " + entry.path().string());
    if (const StateFile* file = state_file(name); file != nullptr && file->is == StateFile::Is::kLock)
      wrong.unless(entry.file_size() == 0, name + " is a lock and holds something");
  }
  return wrong.text;
}

}  // namespace

std::string unknown_files(const std::string& folder) {
  std::string unknown;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    const std::string name = entry.path().filename().string();
    const std::string_view of = written_beside(name);
    if (state_file(of.empty() ? name : of) == nullptr) unknown += entry.path().string() + "\n";
  }
  return unknown;
}

std::string wrong_with_server(const std::string& folder, const Story& story, const FileFault& fault) {
  Wrong wrong;
  check_server(folder + "/server", story, fault, wrong);
  return checked(folder, wrong);
}

std::string wrong_with_session(const std::string& folder, const Story& story, const FileFault&) {
  Wrong wrong;
  auth::StateDirectory::open(folder + "/server", auth::StateDirectory::Missing::kIsAnError)
      ->remove_leftovers();  // the next server does this first
  const auto book = server::CheckpointStore::open(folder + "/server", "", [](const std::string&) {});
  wrong.unless(book.has_value(), "no book of checkpoints");
  if (!book) return wrong.text;
  static const SceneSpec scene = story_scene();
  const auto found = (*book)->find("lab", scene, auth::wall_seconds(), true);
  wrong.unless(found.incompatibility.empty(), "the checkpoint is damaged: " + found.incompatibility);
  if (story.kept == Told::kYes)
    wrong.unless(found.snapshot.has_value(), "the checkpoint was written, and is not there");
  return checked(folder, wrong);
}

std::string wrong_with_workstation(const std::string& folder, const Story& story, const FileFault&) {
  Wrong wrong;
  check_workstation(folder + "/own", story, wrong);
  return checked(folder, wrong);
}

}  // namespace tandem::test
