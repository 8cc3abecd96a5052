#include "server/app/service/service_config.h"

#include "common/auth/io/pem_pair.h"
#include "common/base/command_hints.h"
#include "common/base/utc_date.h"
#include "proto/io/scene_file.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kVoucherWarning = 30 * auth::Voucher::kDay;  // [s] before its end

}  // namespace

std::optional<ServiceOptions> service_options_from(const ServerConfigSpec& config,
                                                   const std::optional<io::SocketAddress>& listen,
                                                   const std::function<std::string(const std::string&)>& path,
                                                   InputErrors& errors) {
  if (!config.directory) return std::nullopt;
  const DirectorySpec& in = *config.directory;
  ServiceOptions out;
  for (const LocatedText& endpoint : in.endpoints) out.etcd.endpoints.push_back(endpoint.text);
  const auto read = [&](const LocatedText& file, std::string& into) {
    if (file.text.empty()) return;
    if (auto text = read_text_file(path(file.text)))
      into = std::move(*text);
    else
      errors.push_back(file.error(config.file, to_text(text.error())));
  };
  read(in.authority, out.etcd.authority);
  read(in.certificate, out.etcd.certificate);
  read(in.private_key, out.etcd.key);
  out.etcd.name_in_certificate = in.name_in_certificate;
  if (!out.etcd.certificate.empty() && !out.etcd.key.empty())
    if (const std::string problem = auth::pem_pair_problem(out.etcd.certificate, out.etcd.key); !problem.empty())
      errors.push_back(in.private_key.error(config.file, "cannot be used with `certificate`: " + problem));
  if (!in.authority.text.empty())
    out.tls_options = " --cacert " + shell_quote(path(in.authority.text)) + " --cert " +
                      shell_quote(path(in.certificate.text)) + " --key " + shell_quote(path(in.private_key.text));
  out.prefix = in.prefix;
  out.times = lease_times(std::chrono::seconds(in.ttl_s));
  if (const auto problem = out.times.problem())
    errors.push_back(in.whole.error(config.file, "has an unusable ttl_s: " + *problem));
  out.etcd.answer_limit = out.times.answer_limit;
  out.server = in.server.text;
  out.zone = in.zone;
  out.balance = in.balance;
  out.address = in.address.text;
  if (!in.address.text.empty()) {
    if (const auto address = io::parse_address(in.address.text, 1); !address)
      errors.push_back(in.address.error(config.file, address.error()));
    else if (address->any())
      errors.push_back(in.address.error(config.file, "is no address that clients can reach; name this computer's own"));
  } else if (listen && listen->any()) {
    errors.push_back(in.whole.error(config.file,
                                    "needs `address`: `listen` names all addresses of this computer, and other servers "
                                    "send clients to one; write HOST:PORT of this server"));
  }
  return out;
}

std::string membership_error(const ServiceOptions& options, const auth::ServerKeystore& keys) {
  if (!keys.on_disk())
    return "a member of a service needs a state folder with keys that last: make one with `tandem-server init`, and "
           "name it with `state` in the configuration";
  const auth::ServiceMembership* const membership = keys.membership();
  if (membership == nullptr)
    return "this server belongs to no service, so no client would follow it: put its member file into the state folder "
           "with `tandem-server service join FILE`, or remove directory { } from the configuration";
  if (!options.server.empty() && options.server != membership->name)
    return "directory { server: \"" + options.server + "\" }: the member file of this server has the name " +
           membership->name + "; use that name, or ask for a member file with the other one";
  return {};
}

std::string voucher_warning(const auth::ServiceMembership& membership, const auth::KeyFingerprint& server,
                            std::int64_t now) {
  if (membership.not_after - now > kVoucherWarning) return {};
  return "the voucher of this server expires on " + utc_date(membership.not_after) +
         " (UTC); then clients reject this server, and it does not start. Renew it: " +
         auth::renewal(membership.name, server) + ", while this server is stopped";
}

}  // namespace tandem::server
