// Fuzzes the texts that a server reads from the directory of its service, which any holder of etcd's credentials can
// write. Each accepted text keeps its value when it is written and read again. Rows that the registry takes over can be
// written to the server's files and read from there.
#include "proto/text/registry_text.h"
#include "server/directory/placement/server_record.h"
#include "server/service/servers_table.h"
#include "server/service/service_consoles.h"
#include "server/service/service_session.h"
#include "server/service/shared_registry.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace tandem;
using namespace std::chrono_literals;

const std::string kPrefix = "/t/";

/// Reads the entries of the input: lines KEY=VALUE, in which a byte 1 stands for a line break of the value.
std::vector<directory::KeyValue> entries_of(std::string_view text) {
  std::vector<directory::KeyValue> entries;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t equals = line.find('=');
    std::string value(equals == std::string_view::npos ? std::string_view{} : line.substr(equals + 1));
    std::ranges::replace(value, '\1', '\n');
    const auto revision = static_cast<directory::Revision>(entries.size()) + 1;
    entries.push_back({kPrefix + std::string(line.substr(0, equals)), std::move(value), revision, revision, 7});
  }
  return entries;
}

/// Entries with this prefix, as the answer to the read that a follower of the prefix begins with.
directory::Reply reading(const std::vector<directory::KeyValue>& entries, const std::string& prefix) {
  directory::Reply reply;
  reply.operation = 1;
  reply.revision = static_cast<directory::Revision>(entries.size());
  reply.found.emplace_back();
  for (const directory::KeyValue& entry : entries)
    if (entry.key.starts_with(prefix)) reply.found.front().push_back(entry);
  return reply;
}

template <class Follower>
void feed(Follower& follower, const std::vector<directory::KeyValue>& entries, const std::string& prefix) {
  FUZZ_EXPECT(follower.poll_request(Time{1s}, 1, 1s));
  FUZZ_EXPECT(follower.on_reply(reading(entries, prefix)));
  FUZZ_EXPECT(follower.poll_request(Time{1s}, 2, 1s));  // the watch
}

void read_texts(std::string_view text) {
  if (const auto session = server::parse_service_session(text))
    FUZZ_EXPECT(server::parse_service_session(server::to_text(*session)) == session);
  if (const auto consoles = server::parse_service_consoles(text))
    FUZZ_EXPECT(server::parse_service_consoles(server::to_text(*consoles)) == consoles);
  rpc::ListedSession listed;
  if (server::read_listed(text, listed)) {
    rpc::ListedSession again;
    FUZZ_EXPECT(server::read_listed(server::listed_text(listed), again) && again == listed);
  }
  static_cast<void>(directory::parse_server_record(text));
  if (server::readable_entry(text)) {
    const server::RegistryEntries one{{"desk", std::string(text)}};
    const auth::RegistryLists lists = server::lists_of(one);
    FUZZ_EXPECT(server::lists_of(server::entries_of(lists)) == lists);
  }
  if (const auto agreed = server::parse_registry_agreement(text))
    FUZZ_EXPECT(server::parse_registry_agreement(server::to_text(*agreed)) == agreed);
}

/// Handles the entries as the mirror of the registry does (server/app/service/registry_mirror.cpp).
void share_registry(const std::vector<directory::KeyValue>& entries) {
  directory::DirectoryMark mark(server::SharedRegistry::mark_key(kPrefix), {}, "mark");
  server::SharedRegistry registry(kPrefix, {}, {}, mark);
  WorkstationRow own{"own", {std::byte{1}}, 5};
  registry.set_local(server::entries_of({{own}, {}}));
  feed(registry, entries, kPrefix + "registry/");
  if (const auto wanted = registry.wanted()) {
    const auth::RegistryLists lists = server::lists_of(*wanted);
    const auto workstations = parse_workstations(print_workstations(lists.workstations), "w");
    const auto codes = parse_codes(print_codes(lists.codes), "c");
    FUZZ_EXPECT(workstations && *workstations == lists.workstations);
    FUZZ_EXPECT(codes && *codes == lists.codes);
    registry.set_local(server::entries_of(lists));
  }
  FUZZ_EXPECT(server::parse_registry_agreement(server::to_text(registry.agreed())) == registry.agreed());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text(data, size);
  read_texts(text);
  const auto entries = entries_of(text);
  for (const directory::KeyValue& entry : entries) read_texts(entry.value);
  share_registry(entries);
  server::ServiceCatalogue catalogue{server::ServiceKeys(kPrefix)};
  feed(catalogue, entries, kPrefix + "catalogue/");
  directory::DirectoryView view{directory::DirectoryKeys(kPrefix)};
  feed(view, entries, kPrefix + "live/");
  FUZZ_EXPECT(server::servers_table(view, catalogue, {}).ends_with('\n'));
  return 0;
}
